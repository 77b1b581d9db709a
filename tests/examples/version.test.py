# SPDX-License-Identifier: BSL-1.0
"""Every example with options tells its version and how it was compiled, and programs without optimisation say so when they
start. Environment: SCARP_EXAMPLES, the folder of the built programs (those that are missing are not run); see also
compiler.py."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from compiler import compiler, root
from expectations import expect, finish

programs = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve()
VERSION = re.search(r'^#define SCARP_VERSION "(.+)"', (root / "include/scarp/core/version.hpp").read_text(), re.M)[1]
BUILD = r"(g\+\+|clang\+\+) \d+\.\S+( .*)?, (NOT )?optimised, \S.*, \d+ lanes? in a pack"


def check_examples():
    mains = [path for path in root.glob("examples/*/*.cpp") if "CLI::App app" in path.read_text()]
    expect(len(mains) >= 14, f"only {len(mains)} examples with options found: this test looks for them in the wrong way")
    for path in mains:
        expect("declare_version(app)" in path.read_text(), f"{path.name} has no --version")
        program = programs / path.stem
        if not program.is_file():
            continue
        done = subprocess.run([program, "--version"], capture_output=True, text=True, timeout=60)
        wanted = rf"scarp {re.escape(VERSION)}\nprogram: {BUILD}\nscarp::precompiled: {BUILD}\n(compiled without .*\n)?"
        expect(done.returncode == 0 and re.fullmatch(wanted, done.stdout),
               f"{path.stem} --version: ended with {done.returncode}\n{done.stdout}{done.stderr}")


def check_note(scratch):
    (scratch / "main.cpp").write_text("int main() {}\n")
    for flag, slow in (("-O0", True), ("-O1", False)):
        subprocess.run([compiler, "-std=c++20", flag, f"-I{root / 'include'}", str(root / "examples/shared/build_note.cpp"),
                        str(scratch / "main.cpp"), "-o", str(scratch / "main")], check=True)
        said = subprocess.run([str(scratch / "main")], capture_output=True, text=True).stderr
        expect(said.count("without optimisation") == slow and said.count("\n") == slow, f"with {flag} it said: {said}")


check_examples()
with tempfile.TemporaryDirectory() as folder:
    check_note(pathlib.Path(folder))
finish()
