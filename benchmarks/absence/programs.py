# SPDX-License-Identifier: BSL-1.0
"""Programs of benchmarks/absence/run: built, looked into, counted under valgrind."""
import json
import pathlib
import re
import shlex
import shutil
import subprocess
import sys

root = pathlib.Path(__file__).resolve().parent.parent.parent
sys.path.insert(0, str(root / "tests"))
from compiled_symbols import features_of, symbols_of

compiler = "g++"
# valgrind 3.19 knows no AVX-512; the other options are those of scarp_native.
flags = ["-std=c++20", "-O3", "-DNDEBUG", "-march=x86-64-v3", "-fno-math-errno", "-fno-trapping-math", "-mmove-max=512",
         "-mstore-max=512"]
includes = ["-I", str(root / "include"), "-isystem", "/usr/include/eigen3"]


def mpi(what):
    """What the MPI compiler adds to "compile" or "link"; nothing where there is no MPI."""
    if not shutil.which("mpicxx"):
        return []
    said = subprocess.run(["mpicxx", f"--showme:{what}"], check=True, capture_output=True, text=True).stdout
    return shlex.split(said) + (["-DOMPI_SKIP_MPICXX"] if what == "compile" else [])


class Program:
    """A source compiled with some features left out, `without`; `ranks`: it may use MPI."""

    def __init__(self, scratch, source, without=(), ranks=False):
        self.binary = scratch / "-".join([source.stem, *without])
        extra = [f"-DWITHOUT_{name.upper()}" for name in without] + (mpi("compile") if ranks else [])
        self.command = [compiler, *flags, *includes, *extra]
        compiled = self.binary.with_suffix(".o")
        cached = ["ccache"] if shutil.which("ccache") else []
        subprocess.run([*cached, *self.command, "-c", str(source), "-o", str(compiled)], check=True)
        libraries = [*(mpi("link") if ranks else []), "-lfmt", "-pthread"]
        subprocess.run([compiler, str(compiled), "-o", str(self.binary), *libraries], check=True)
        self.features = features_of(symbols_of(self.binary))
        stripped = self.binary.with_suffix(".stripped")
        subprocess.run(["strip", "-o", str(stripped), str(self.binary)], check=True)
        self.bytes = stripped.stat().st_size
        listed = subprocess.run([*self.command, "-MM", str(source)], check=True, capture_output=True, text=True).stdout
        self.headers = len(set(re.findall(r"include/scarp/\S+\.hpp", listed)))
        text = subprocess.run([*self.command, "-E", "-P", str(source)], check=True, capture_output=True).stdout
        self.lines = text.count(b"\n")

    def told(self, *arguments):
        """What it prints, a JSON object in each line."""
        printed = subprocess.run([str(self.binary), *arguments], check=True, capture_output=True, text=True).stdout
        return [json.loads(line) for line in printed.splitlines()]

    def counted(self, function, *arguments):
        """What it prints, and how many instructions it spends in `function`."""
        folder = self.binary.with_suffix(f".{function}-{'-'.join(arguments)}")
        folder.mkdir()
        command = ["valgrind", "--tool=callgrind", "--callgrind-out-file=/dev/null", "--collect-atstart=no",
                   f"--toggle-collect=*{function}*", str(self.binary), *arguments]
        ran = subprocess.run(command, check=True, cwd=folder, capture_output=True, text=True)
        return json.loads(ran.stdout), int(re.search(r"Collected : (\d+)", ran.stderr).group(1))
