# SPDX-License-Identifier: BSL-1.0
"""[slow] Every C++ block of README.md is a translation unit that compiles without a warning; one with a `main` is linked and runs to
exit code 0. Environment: see compiler.py; SCARP_LIBRARY, scarp::precompiled, which saves half a minute."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent / "examples"), str(pathlib.Path(__file__).resolve().parent)]
from compiler import compiler, include_folders, root
from expectations import expect, finish

WARNINGS = ["-Wall", "-Wextra", "-Wpedantic", "-Werror"]
folders = [f"-isystem{folder[2:]}" if "eigen3" in folder else folder for folder in include_folders()]
command = [compiler, "-std=c++20", *WARNINGS, *folders]
text = (root / "README.md").read_text()
library = os.environ.get("SCARP_LIBRARY", "")
if library.endswith(".a") and pathlib.Path(library).is_file():
    # A static library is compiled for this machine, and so must be what it meets.
    command += ["-march=native", "-DSCARP_PRECOMPILED", "-DEIGEN_MAX_ALIGN_BYTES=64", "-DEIGEN_MAX_STATIC_ALIGN_BYTES=64"]
    linked = [library, "-lfmt", "-pthread"]
else:
    command.append("-DFMT_HEADER_ONLY")
    linked = ["-pthread"]
blocks = [(text[: match.start()].count("\n") + 2, match[1]) for match in re.finditer(r"^```cpp\n(.*?)^```$", text, re.M | re.S)]
expect(any("int main" in block for _, block in blocks), "README.md has no block that is a program")
expect(any("DemRve" in block for _, block in blocks), "README.md has no block with a packing")
with tempfile.TemporaryDirectory() as scratch:
    for line, block in blocks:
        source = pathlib.Path(scratch) / f"readme_{line}.cpp"
        source.write_text(f'#line {line} "README.md"\n{block}')
        program = source.with_suffix("")
        is_program = "int main" in block
        how = ["-O1", "-o", str(program), *linked] if is_program else ["-fsyntax-only"]
        done = subprocess.run([*command, str(source), *how], capture_output=True, text=True)
        expect(done.returncode == 0, f"README.md:{line} does not compile:\n{done.stderr[-4000:]}")
        if is_program and done.returncode == 0:
            done = subprocess.run([program], cwd=scratch, capture_output=True, text=True, timeout=200)
            print(done.stdout, end="")
            expect(done.returncode == 0, f"README.md:{line} ends with {done.returncode}: {done.stdout}{done.stderr}")
finish()
