# SPDX-License-Identifier: BSL-1.0
"""The compiler of the build and its include folders, for tests that compile.

Environment: CXX (default c++), SCARP_INCLUDES (further include folders, separated by ':').
"""
import os
import pathlib

root = pathlib.Path(__file__).resolve().parent.parent
compiler = os.environ.get("CXX", "c++")


def include_folders():
    folders = [root / "include"]
    folders += [pathlib.Path(name) for name in os.environ.get("SCARP_INCLUDES", "").split(":") if name]
    eigen = (pathlib.Path("/usr/include/eigen3"), pathlib.Path("/usr/local/include/eigen3"))
    folders += [path for path in eigen if path.is_dir()]
    return [f"-I{folder}" for folder in folders]
