# SPDX-License-Identifier: BSL-1.0
"""A project that takes scarp by add_subdirectory can install and export a target which links scarp::scarp, when it asks for
scarp's install rules; a third project then finds both, installed or in the build folder. Without those rules CMake refuses.
Skipped, exit 77, where a package that scarp needs is not installed. Environment: CXX, CMAKE."""
import os
import pathlib
import subprocess
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
