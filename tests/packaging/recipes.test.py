# SPDX-License-Identifier: BSL-1.0
"""The recipes for vcpkg and conan say what the sources say, and make a package that holds every header. The tools
themselves are not run: stand-ins take the place of their functions (docs/packages.md). Skipped, exit 77, where a package
that scarp needs is not installed. Environment: CMAKE."""
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
here = pathlib.Path(__file__).resolve().parent
root = here.parents[1]
sys.path.insert(0, str(here))
sys.path.insert(0, str(root / "tests" / "examples"))
from conan_stand_in import Recipe
from expectations import expect, finish

VERSION = re.search(r'^#define SCARP_VERSION "(.+)"', (root / "include/scarp/core/version.hpp").read_text(), re.M)[1]
# Of the library itself: these stand before those of tests, examples and benchmarks in CMakeLists.txt.
NEEDED = dict(re.findall(r"^scarp_require\((\w+) ([0-9.]+)", (root / "CMakeLists.txt").read_text(), re.M))
VCPKG_NAMES = {"Eigen3": "eigen3", "Boost": "boost-hana", "nanoflann": "nanoflann", "fmt": "fmt"}
CONAN_NAMES = {"Eigen3": "eigen", "Boost": "boost", "nanoflann": "nanoflann", "fmt": "fmt"}
HEADERS = {path.relative_to(root / "include") for path in (root / "include").rglob("*.hpp")}
OF_SUITESPARSE = {pathlib.Path("scarp/solver/cholmod.hpp"), pathlib.Path("scarp/solver/umfpack.hpp")}
OF_MPI = {pathlib.Path("scarp/solver/rank_executor.hpp")}


def headers_of(package):
    return {path.relative_to(package / "include") for path in (package / "include").rglob("*.hpp")}


def check_manifest():
    manifest = json.loads((root / "docs/packaging/vcpkg/vcpkg.json").read_text())
    expect(manifest["version"] == VERSION, f"vcpkg.json says {manifest['version']}, version.hpp {VERSION}")
    expect(manifest["license"] == "BSL-1.0", f"vcpkg.json: licence {manifest['license']}")
    names = {entry if isinstance(entry, str) else entry["name"] for entry in manifest["dependencies"]}
    wanted = {VCPKG_NAMES[name] for name in NEEDED} | {"vcpkg-cmake", "vcpkg-cmake-config"}
    expect(names == wanted, f"vcpkg.json depends on {sorted(names)}, CMakeLists.txt on {sorted(wanted)}")
    return set(manifest["features"])


def check_port(folder, *features):
    script = ["-D", f"PORT_FOLDER={root / 'docs/packaging/vcpkg'}", "-D", f"WORK={folder}",
              "-D", f"FEATURES={';'.join(features)}", "-P", here / "vcpkg_functions.cmake"]
    done = subprocess.run([os.environ.get("CMAKE", "cmake"), *map(str, script)], capture_output=True, text=True)
    if done.returncode != 0 and "is not installed, fetching" in done.stderr:
        sys.exit(77)
    expect(done.returncode == 0, f"portfile.cmake with {features}: {done.stderr}")
    package = folder / "package"
    left_out = OF_SUITESPARSE if headers_of(package) & OF_MPI else OF_SUITESPARSE | OF_MPI
    expect(headers_of(package) == HEADERS - left_out, f"port: headers differ, {headers_of(package) ^ HEADERS}")
    if shutil.which("mpicxx") or not features:
        expect(bool(headers_of(package) & OF_MPI) == ("mpi" in features), f"port with {features}: MPI's header")
    share = {path.name for path in (package / "share" / "scarp").iterdir()}
    wanted = {"scarpConfig.cmake", "scarpConfigVersion.cmake", "scarpTargets.cmake", "scarpNative.cmake", "usage", "copyright"}
    expect(share == wanted, f"port: share/scarp holds {sorted(share)}")
    expect({path.name for path in package.iterdir()} == {"include", "share"}, f"port: {list(package.iterdir())}")
    usage = (package / "share/scarp/usage").read_text()
    project = folder / "user"
    project.mkdir()
    project.joinpath("main.cpp").write_text('#include "scarp/core/version.hpp"\nint main() {}\n')
    project.joinpath("CMakeLists.txt").write_text(
        "cmake_minimum_required(VERSION 3.25)\nproject(user LANGUAGES CXX)\nadd_executable(main main.cpp)\n"
        + usage.split("\n", 1)[1])
    done = subprocess.run(["cmake", "-S", project, "-B", project / "build", "-D", f"scarp_DIR={package / 'share/scarp'}"],
                          capture_output=True, text=True)
    expect(done.returncode == 0, f"what `usage` tells does not work: {done.stderr}")


def as_numbers(version):
    return [int(part) for part in version.split(".")]


def check_conan(folder):
    recipe = Recipe(root / "docs/packaging/conan/conanfile.py", folder)
    made = recipe.make(compiler="gcc", version="12")
    expect(made.version == VERSION, f"conanfile.py finds version {made.version}")
    expect((made.name, made.license, made.package_type) == ("scarp", "BSL-1.0", "header-library"), "conanfile.py: identity")
    required = {name: text for name, text in (reference.split("/") for reference in recipe.required)}
    expect(set(required) == {CONAN_NAMES[name] for name in NEEDED}, f"conanfile.py requires {sorted(required)}")
    for name, oldest in NEEDED.items():
        said = re.match(r"\[>=([0-9.]+) <", required.get(CONAN_NAMES[name], ""))
        expect(said and as_numbers(said[1]) == as_numbers(oldest), f"conanfile.py: {name} is not from {oldest} on")
    package = folder / "package"
    expect(headers_of(package) == HEADERS, f"conan: headers differ, {headers_of(package) ^ HEADERS}")
    expect((package / "licenses" / "LICENSE").is_file(), "conan: no licence")
    for module in recipe.properties["cmake_build_modules"]:
        expect((package / module).is_file(), f"conan: no {module}")
    expect(recipe.properties["cmake_target_name"] == "scarp::scarp", f"conan: {recipe.properties}")
    for compiler, version in (("gcc", "11"), ("msvc", "193")):
        expect(recipe.refuses(compiler, version), f"conan: {compiler} {version} was not refused")


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    for name in ("port", "port_with_mpi", "conan"):
        (scratch / name).mkdir()
    expect(check_manifest() == {"mpi"}, "vcpkg.json: other features than portfile.cmake knows")
    check_port(scratch / "port")
    check_port(scratch / "port_with_mpi", "mpi")
    check_conan(scratch / "conan")
    compile((root / "docs/packaging/conan/test_package/conanfile.py").read_text(), "test_package/conanfile.py", "exec")
finish()
