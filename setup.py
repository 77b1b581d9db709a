# SPDX-License-Identifier: BSL-1.0
"""The wheel of the Python module: CMake builds the module and its programs and installs them into it. CMAKE_ARGS has further arguments of CMake."""
import os
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

from setuptools import Extension, setup
from setuptools.command.build_ext import build_ext
from setuptools.command.sdist import sdist

ROOT = pathlib.Path(__file__).resolve().parent


def cmake(*words):
    done = subprocess.run(["cmake", *map(str, words)])
    if done.returncode != 0:
        sys.exit(f"scarp: 'cmake {' '.join(map(str, words))}' ended with {done.returncode}: see above; docs/packages.md has the packages that are needed")


class ByCMake(build_ext):
    def run(self):
        build = ROOT / "build" / f"wheel_{sys.implementation.cache_tag}"
        options = [f"-DPython_EXECUTABLE={sys.executable}", "-DCMAKE_BUILD_TYPE=Release", "-DSCARP_BUILD_TESTS=OFF"]
        if shutil.which("ninja"):
            options.append("-GNinja")
        if shutil.which("ccache"):
            options.append("-DCMAKE_CXX_COMPILER_LAUNCHER=ccache")
        shutil.rmtree(self.build_lib, ignore_errors=True)
        cmake("--fresh", "-S", ROOT, "-B", build, *options, *shlex.split(os.environ.get("CMAKE_ARGS", "")))
        cmake("--build", build, "--parallel", os.environ.get("SCARP_JOBS", os.cpu_count()), "--target", "python_points", "fault_rupture", "rve_lab")
        cmake("--install", build, "--component", "python", "--prefix", pathlib.Path(self.build_lib).resolve())


class WholeSource(sdist):
    def make_release_tree(self, base_dir, files):
        tracked = subprocess.run(["git", "-C", ROOT, "ls-files"], capture_output=True, text=True, check=True).stdout
        super().make_release_tree(base_dir, sorted({*files, *tracked.splitlines()}))


(ROOT / "build").mkdir(exist_ok=True)
version = re.search(r'SCARP_VERSION "([\d.]+)"', (ROOT / "include/scarp/core/version.hpp").read_text())[1]
setup(version=version, packages=[], ext_modules=[Extension("scarp._points", [])], cmdclass={"build_ext": ByCMake, "sdist": WholeSource})
