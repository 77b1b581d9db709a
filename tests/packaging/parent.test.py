# SPDX-License-Identifier: BSL-1.0
"""A project that takes scarp by add_subdirectory can install and export a target which links scarp::scarp, when it asks for
scarp's install rules; a third project then finds both, installed or in the build folder. Without those rules CMake refuses. Two parts
of a project may both bring scarp; a project without a build type, or without C++, gets a sentence; a clone that was moved is configured anew.
Skipped, exit 77, where a package that scarp needs is not installed. Environment: CXX, CMAKE."""
import os
import pathlib
import subprocess
import re
import shutil
import sys
import tempfile

here = pathlib.Path(__file__).resolve().parent
root = here.parents[1]
cmake = os.environ.get("CMAKE", "cmake")


def run(*words):
    done = subprocess.run(list(map(str, words)), capture_output=True, text=True)
    return done.returncode, done.stdout + done.stderr


def must(*words):
    code, said = run(*words)
    if code != 0:
        sys.exit(f"{' '.join(map(str, words))}\nended with {code}:\n{said}")
    return said


def configure(source, folder, *more):
    # Without MPI: it takes longest to find and has no part in this.
    return (cmake, "-S", source, "-B", folder, "-D", "CMAKE_DISABLE_FIND_PACKAGE_MPI=ON", *more)


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    parent = configure(here / "parent", scratch / "parent", "-D", f"SCARP_FOLDER={root}")
    code, said = run(*parent)
    if "is not installed, fetching" in said:
        print("skipped: a package that scarp needs is not installed")
        sys.exit(77)
    if code == 0 or "not in any export set" not in said:
        sys.exit(f"without SCARP_INSTALL the export was expected to be refused, got {code}:\n{said}")
    must(*parent, "-D", "SCARP_INSTALL=ON")
    must(cmake, "--install", scratch / "parent", "--prefix", scratch / "prefix")
    installed = f"CMAKE_PREFIX_PATH={scratch / 'prefix'}"
    must(*configure(here / "parent" / "user", scratch / "user", "-D", installed))
    must(cmake, "--build", scratch / "user")
    must(scratch / "user" / "layers_user")
    in_build = [f"layers_DIR={scratch / 'parent'}", f"scarp_DIR={scratch / 'parent' / 'scarp'}"]
    must(*configure(here / "parent" / "user", scratch / "user_of_build", *(word for d in in_build for word in ("-D", d))))
    must(cmake, "--build", scratch / "user_of_build")

    def project(name, languages, text, *more):
        """What CMake says to a project of these lines, without its line breaks."""
        folder = scratch / name
        folder.mkdir()
        (folder / "CMakeLists.txt").write_text(f"cmake_minimum_required(VERSION 3.25)\nproject({name} LANGUAGES {languages})\n{text}\n")
        code, said = run(*configure(folder, folder / "build", *more))
        return code, " ".join(said.split())

    def expect(truth, code, said):
        if not truth:
            sys.exit(f"ended with {code}:\n{said}")

    # The lines of README.md, in an installation without the precompiled library.
    (scratch / "main.cpp").write_text("int main() {}\n")
    linked = f"find_package(scarp CONFIG REQUIRED)\nadd_executable(one {scratch}/main.cpp)\ntarget_link_libraries(one PRIVATE scarp::precompiled)"
    code, said = project("linked", "CXX", linked, "-D", installed)
    expect(code == 0 and said.count("there is no CMAKE_BUILD_TYPE") == 1, code, said)
    for more in ("CMAKE_BUILD_TYPE=Debug", "CMAKE_CXX_FLAGS=-O2"):
        code, said = project(f"linked_{len(more)}", "CXX", linked, "-D", installed, "-D", more)
        expect(code == 0 and "CMAKE_BUILD_TYPE" not in said, code, said)
    code, said = project("component", "CXX", "find_package(scarp CONFIG REQUIRED COMPONENTS precompiled)", "-D", installed)
    expect(code != 0 and "scarp has no component 'precompiled'" in said, code, said)
    for languages in ("C", "NONE"):
        code, said = project(f"of_{languages}", languages, "find_package(scarp CONFIG REQUIRED)", "-D", installed)
        expect(code != 0 and "scarp is a C++ library" in said and "add CXX to project()" in said, code, said)
        code, said = project(f"part_of_{languages}", languages, f"add_subdirectory({root} part)")
        expect(code != 0 and "scarp is a C++ library" in said and "add CXX to project()" in said, code, said)

    other = scratch / "other"
    (other / "include/scarp/core").mkdir(parents=True)
    shutil.copy(root / "CMakeLists.txt", other)
    header = "include/scarp/core/version.hpp"
    (other / header).write_text(re.sub(r'"\d+[.]\d+[.]\d+"', '"7.8.9"', (root / header).read_text()))
    code, said = project("twice", "CXX", "".join(f"add_subdirectory({folder} part_{k})\n" for k, folder in enumerate((root, root, other))))
    expect(code == 0 and said.count("there is no CMAKE_BUILD_TYPE") == 1 and said.count("another part brings 7.8.9") == 1, code, said)

    clone = scratch / "clone"
    for folder in (".ci", "build/release", "build/clang", "programs"):
        (clone / folder).mkdir(parents=True)
    shutil.copy(root / ".ci/set_up.sh", clone / ".ci")
    (clone / "programs/cmake").write_text('#!/bin/sh\necho "configured with: $*"\n')
    (clone / "programs/cmake").chmod(0o755)
    for folder, more, home, fresh in (("release", "", scratch / "former", True), ("release", "", clone, False), ("clang", "-B build/clang", root, True)):
        (clone / f"build/{folder}/CMakeCache.txt").write_text(f"# cache\nCMAKE_HOME_DIRECTORY:INTERNAL={home}\n")
        code, said = run("env", f"PATH={clone}/programs:{os.environ['PATH']}", "bash", "-euo", "pipefail", "-c",
                         f"source {clone}/.ci/set_up.sh; configure release g++ {more}")
        told = f"build/{folder} was made for the sources in '{home}': configuring it anew" in said
        expect(code == 0 and "configured with: --preset release" in said and told == fresh == ("--fresh" in said), code, said)
