# SPDX-License-Identifier: BSL-1.0
"""What a small program contains: its symbols and the headers that it pulls in.

Environment: CXX (default c++), SCARP_INCLUDES (further include folders, separated by ':').
"""
import os
import pathlib
import re
import subprocess

root = pathlib.Path(__file__).resolve().parent.parent
compiler = os.environ.get("CXX", "c++")

# What a program may do without, by names that only it has; a program that has it must show one of them,
# or a name here is out of date.
features = {
    "nanoflann": re.compile(r"nanoflann"),
    "DEM": re.compile(r"TimeStepper|rebuild_pairs|pair_forces|PairScratch|scarp::Packing"),
    "SparseLU": re.compile(r"SparseLU|SparseLu"),
    "VTU": re.compile(r"write_vtu|VtuField|PvdSeries|FieldSeries"),
    "Gmsh": re.compile(r"[Gg]msh"),
    "fabric": re.compile(r"(contact|particle)_fabric"),
    "interface": re.compile(r"scarp::Interface<|RigidFooting|MeshedFooting|InterfacePoint"),
    "length": re.compile(r"Nonlocal"),
    "MPI": re.compile(r"MPI_|ompi_|RankExecutor"),
    "checkpoint": re.compile(r"Checkpoint"),
    "saved states": re.compile(r"StateWriter|StateReader"),  # of checkpoints and of ranks
}


def features_of(symbols):
    """Names of the features that these lines of `nm -C` show."""
    return {name for name, pattern in features.items() if any(pattern.search(line) for line in symbols)}


def symbols_of(binary):
    return subprocess.run(["nm", "-C", str(binary)], check=True, capture_output=True, text=True).stdout.splitlines()


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
    return symbols_of(compiled)


def included_headers(folder, name):
    """Of a program that object_symbols has written."""
    command = [compiler, "-std=c++20", *include_folders(), "-MM", str(folder / f"{name}.cpp")]
    return subprocess.run(command, check=True, capture_output=True, text=True).stdout
