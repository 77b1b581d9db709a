# SPDX-License-Identifier: BSL-1.0
"""Compiles kernels by nvcc, as a program with packings on a card does, and reads what it reports of them."""
import pathlib
import re
import shutil
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NVCC = shutil.which("nvcc") or "/usr/local/cuda/bin/nvcc"
TWO_BLOCKS, ONE_BLOCK = 128, 255  # registers of a thread where so many blocks of 256 share a multiprocessor
FLAGS = ["-std=c++20", "-arch=sm_90", "-O3", "--expt-relaxed-constexpr", "-Werror", "cross-execution-space-call", "-DFMT_USE_CONSTEXPR=1",
         "-diag-suppress", "20012,186", "-Xptxas", "-v", "-cubin", "-isystem", "/usr/include/eigen3", f"-I{ROOT / 'include'}",
         f"-I{ROOT / 'examples' / 'tutorials'}"]
HEAD = '#include "scarp/cuda/cuda_kernels.hpp"\n#include "scarp/dem/damping.hpp"\n'


def tutorial(name):
    """What stands in a tutorial before its main."""
    return (ROOT / "examples" / "tutorials" / f"{name}.cpp").read_text().split("int main(")[0]


def compiled(shape, law, scalar, parts, rooms="scarp::BlockSize{400, 1216}"):
    """What nvcc says of a kernel, and whether it compiles."""
    with tempfile.TemporaryDirectory() as folder:
        source = pathlib.Path(folder) / "kernels.cu"
        source.write_text(f"{HEAD}{parts}\nusing Types = scarp::BlockTypes<{shape}, {law}, {scalar}>;\n"
                          f"SCARP_CUDA_DEVICE(Types, scarp::LocalDamping, {rooms})\n")
        ran = subprocess.run([NVCC, *FLAGS, "-o", f"{folder}/kernels.cubin", source], capture_output=True, text=True)
    return ran.stdout + ran.stderr, ran.returncode == 0


def check(kernels):
    """kernels: of each its name, the most registers, the most bytes of spill loads, arguments of compiled(). Returns faults."""
    faults = []
    for name, most, spilled, arguments in kernels:
        said, is_good = compiled(*arguments)
        found = re.search(r"properties for \S*respond_kernel.*?(\d+) bytes stack frame.*?(\d+) bytes spill loads.*?Used (\d+) registers"
                          r".*?(\d+) bytes smem", said, re.DOTALL)
        if not is_good or not found:
            faults.append(f"{name}: nvcc does not compile it\n{said[-3000:]}")
            continue
        frame, spills, registers, shared = map(int, found.groups())
        print(f"{name}: {registers} registers, {spills} bytes of spill loads, {frame} of stack, {shared} of shared memory beside the packing",
              flush=True)
        if registers > most or spills > spilled:
            faults.append(f"{name}: {registers} registers (at most {most}), {spills} bytes of spill loads (at most {spilled})")
    return faults
