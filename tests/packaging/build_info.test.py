# SPDX-License-Identifier: BSL-1.0
"""`build_info` tells what compilers were told: optimisation and the level of the instruction set, as the System V ABI
names them, and containers that check their use; flags that hide a NaN are rejected. Environment: see compiler.py."""
import pathlib
import platform
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from compiler import compiler, root

# Flags, then what must be true of them.
CASES = [([], "!build.optimised"), (["-O1"], "build.optimised"), (["-O3"], "build.optimised"),
         (["-O2"], "!build.checked_containers"), (["-D_GLIBCXX_DEBUG"], "build.checked_containers")]
if platform.machine() in ("x86_64", "AMD64"):
    LEVELS = [(["-march=x86-64"], "x86-64", "", 2), (["-march=x86-64-v2"], "x86-64-v2", "", 2),
              (["-march=x86-64-v2", "-mavx"], "x86-64-v2", "AVX", 4), (["-march=x86-64-v3"], "x86-64-v3", "", 4),
              (["-march=x86-64-v3", "-mavx512f"], "x86-64-v3", "AVX-512", 8), (["-march=x86-64-v4"], "x86-64-v4", "", 8)]
    CASES += [(flags, f'build.instruction_set == "{level}" && build.beyond == "{beyond}" && build.lanes == {lanes}')
              for flags, level, beyond, lanes in LEVELS]

faults = []
with tempfile.TemporaryDirectory() as folder:
    source = pathlib.Path(folder) / "asks.cpp"
    for flags, truth in CASES:
        source.write_text('#include "scarp/core/build_info.hpp"\n'
                          f"constexpr auto build = scarp::build_info();\nstatic_assert({truth});\n")
        # Nothing is run: this machine may not have the instructions.
        done = subprocess.run([compiler, "-std=c++20", f"-I{root / 'include'}", *flags, "-fsyntax-only", str(source)],
                              capture_output=True, text=True)
        if done.returncode != 0:
            faults.append(f"with {' '.join(flags) or 'no flags'} this is false: {truth}\n{done.stderr}")
    for flags, may_compile in ((["-Ofast"], False), (["-O1", "-ffinite-math-only"], False), (["-ffast-math", "-fno-finite-math-only"], True)):
        source.write_text('#include "scarp/core/error.hpp"\n')
        done = subprocess.run([compiler, "-std=c++20", f"-I{root / 'include'}", *flags, "-fsyntax-only", str(source)],
                              capture_output=True, text=True)
        if (done.returncode == 0) != may_compile or (not may_compile and "add -fno-finite-math-only" not in done.stderr):
            faults.append(f"{' '.join(flags)}: {done.returncode} {done.stderr}")
    source.write_text('#include "scarp/tensor/tensor.hpp"\n')
    done = subprocess.run([compiler, "-std=c++20", f"-I{root / 'include'}", "-I/usr/include/eigen3", "-DEIGEN_DEFAULT_TO_ROW_MAJOR", "-fsyntax-only",
                           str(source)], capture_output=True, text=True)
    if done.returncode == 0 or "EIGEN_DEFAULT_TO_ROW_MAJOR is defined" not in done.stderr:
        faults.append(f"matrices by rows: {done.returncode} {done.stderr}")
sys.exit("\n".join(faults) or None)
