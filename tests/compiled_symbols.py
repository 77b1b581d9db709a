# SPDX-License-Identifier: BSL-1.0
"""What a small program contains: its symbols and the headers that it pulls in.

Environment: CXX (default c++), SCARP_INCLUDES (further include folders, separated by ':').
"""
import os
import pathlib
import subprocess

root = pathlib.Path(__file__).resolve().parent.parent
compiler = os.environ.get("CXX", "c++")


def include_folders():
    folders = [root / "include"]
    folders += [pathlib.Path(name) for name in os.environ.get("SCARP_INCLUDES", "").split(":") if name]
    eigen = (pathlib.Path("/usr/include/eigen3"), pathlib.Path("/usr/local/include/eigen3"))
    folders += [path for path in eigen if path.is_dir()]
    return [f"-I{folder}" for folder in folders]


def object_symbols(folder, name, source):
    """Compiles without optimisation, so that nothing is inlined away, and lists the symbols."""
    written = folder / f"{name}.cpp"
    written.write_text(source)
    compiled = folder / f"{name}.o"
    command = [compiler, "-std=c++20", "-O0", *include_folders(), "-c", str(written), "-o", str(compiled)]
    subprocess.run(command, check=True)
    return subprocess.run(["nm", "-C", str(compiled)], check=True, capture_output=True, text=True).stdout.splitlines()


def included_headers(folder, name):
    """Of a program that object_symbols has written."""
    command = [compiler, "-std=c++20", *include_folders(), "-MM", str(folder / f"{name}.cpp")]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout
