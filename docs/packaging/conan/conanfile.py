# SPDX-License-Identifier: BSL-1.0
"""Recipe for conan 2 of the sources that it lies in: conan create docs/packaging/conan --build=missing"""
import os
import re

from conan import ConanFile
from conan.errors import ConanInvalidConfiguration
from conan.tools.build import check_min_cppstd
from conan.tools.files import copy, load
from conan.tools.layout import basic_layout
from conan.tools.scm import Version

required_conan_version = ">=2.0"


class ScarpConan(ConanFile):
    name = "scarp"
    description = "Hierarchical multiscale boundary-value problems"
    license = "BSL-1.0"
    topics = ("finite-elements", "discrete-elements", "multiscale", "geomechanics", "header-only")
    package_type = "header-library"
    settings = "os", "arch", "compiler", "build_type"
    no_copy_source = True

    _native = os.path.join("share", "cmake", "scarp", "scarpNative.cmake")

    @property
    def _repository(self):
        return os.path.normpath(os.path.join(self.recipe_folder, "..", "..", ".."))

    def set_version(self):
        header = load(self, os.path.join(self._repository, "include", "scarp", "core", "version.hpp"))
        self.version = re.search(r'^#define SCARP_VERSION "(.+)"', header, re.MULTILINE).group(1)

    def export_sources(self):
        for pattern in ("LICENSE", "include/scarp/*.hpp", "docs/packaging/scarpNative.cmake"):
            copy(self, pattern, self._repository, self.export_sources_folder)

    def layout(self):
        basic_layout(self)

    def requirements(self):
        self.requires("boost/[>=1.74 <2]", transitive_headers=True, options={"header_only": True})
        self.requires("eigen/[>=3.4 <4]", transitive_headers=True)
        self.requires("fmt/[>=9.1 <12]", transitive_headers=True, transitive_libs=True)
        self.requires("nanoflann/[>=1.4 <2]", transitive_headers=True)

    def package_id(self):
        self.info.clear()

    def validate(self):
        check_min_cppstd(self, 20)
        oldest = {"gcc": "12", "clang": "14"}.get(str(self.settings.compiler))
        if oldest is None or Version(self.settings.compiler.version) < oldest:
            raise ConanInvalidConfiguration(
                f"scarp does not know {self.settings.compiler} {self.settings.compiler.version} "
                "(it needs the packs of libstdc++): use gcc 12 or clang 14, or newer")

    def package(self):
        copy(self, "LICENSE", self.source_folder, os.path.join(self.package_folder, "licenses"))
        copy(self, "*.hpp", os.path.join(self.source_folder, "include"), os.path.join(self.package_folder, "include"))
        copy(self, os.path.basename(self._native), os.path.join(self.source_folder, "docs", "packaging"),
             os.path.join(self.package_folder, os.path.dirname(self._native)))

    def package_info(self):
        self.cpp_info.bindirs = []
        self.cpp_info.libdirs = []
        self.cpp_info.set_property("cmake_file_name", "scarp")
        self.cpp_info.set_property("cmake_target_name", "scarp::scarp")
        self.cpp_info.set_property("cmake_build_modules", [self._native])  # the function scarp_native
        self.cpp_info.set_property("pkg_config_name", "scarp")
        if self.settings.os == "Linux":
            self.cpp_info.system_libs = ["pthread"]
