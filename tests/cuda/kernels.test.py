# SPDX-License-Identifier: BSL-1.0
"""[slow] nvcc compiles the kernels of the study's grains, of spheres in single precision, and of the tutorials' own law and shape as they
stand; registers and memory that registers spill into stay within bounds; a law that forgets constexpr is an error that names it."""
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
NVCC = shutil.which("nvcc") or "/usr/local/cuda/bin/nvcc"
TWO_BLOCKS, ONE_BLOCK = 128, 255  # registers of a thread where so many blocks of 256 share a multiprocessor
FLAGS = ["-std=c++20", "-arch=sm_90", "-O3", "--expt-relaxed-constexpr", "-Werror", "cross-execution-space-call", "-DFMT_USE_CONSTEXPR=1",
         "-diag-suppress", "20012,186", "-Xptxas", "-v", "-cubin", "-isystem", "/usr/include/eigen3", f"-I{ROOT / 'include'}",
         f"-I{ROOT / 'examples' / 'tutorials'}"]
HEAD = '#include "scarp/cuda/cuda_kernels.hpp"\n#include "scarp/dem/damping.hpp"\n'
STUDY = '#include "scarp/contact/linear_frictional.hpp"\n#include "scarp/shape/ellipse.hpp"\n'
SPHERES = '#include "scarp/contact/hertz_mindlin.hpp"\n#include "scarp/shape/sphere.hpp"\n'
FORGOTTEN = '''#include "scarp/contact/frictionless.hpp"
#include "scarp/shape/disc.hpp"
struct Forgotten : scarp::Frictionless {
  template <int Dim, class T>
  scarp::ContactForce<Dim, T> respond(scarp::ContactKinematics<Dim, T> const& approach, scarp::ContactMemory<Dim, T>& memory) const {
    return scarp::Frictionless::respond(approach, memory);
  }
};
'''


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


faults = []
# Spills are of numbers that all threads have alike; bounds are what was measured and a quarter more.
for name, most, spilled, arguments in [
        ("the study's ellipses", TWO_BLOCKS, 700, ("scarp::Ellipse", "scarp::LinearFrictional", "double", STUDY)),
        ("spheres in single precision", TWO_BLOCKS, 560, ("scarp::Sphere", "scarp::HertzMindlin<>", "float", SPHERES)),
        ("the tutorial's law", TWO_BLOCKS, 200, ("scarp::Disc", "Stiffening", "double", tutorial("own_law"))),
        ("the tutorial's shape", ONE_BLOCK, 200, ("Oval", "scarp::LinearFrictional", "double", tutorial("own_shape")))]:
    said, is_good = compiled(*arguments)
    kernel = re.search(r"properties for \S*respond_kernel.*?(\d+) bytes stack frame.*?(\d+) bytes spill loads.*?Used (\d+) registers.*?(\d+) bytes smem",
                       said, re.DOTALL)
    if not is_good or not kernel:
        faults.append(f"{name}: nvcc does not compile it\n{said[-3000:]}")
        continue
    frame, spills, registers, shared = map(int, kernel.groups())
    print(f"{name}: {registers} registers, {spills} bytes of spill loads, {frame} of stack, {shared} of shared memory beside the packing")
    if registers > most or spills > spilled:
        faults.append(f"{name}: {registers} registers (at most {most}), {spills} bytes of spill loads (at most {spilled})")
said, is_good = compiled("scarp::Disc", "Forgotten", "double", FORGOTTEN)
if is_good or "Forgotten::respond" not in said:
    faults.append(f"a law that forgets constexpr is not named\n{said[-3000:]}")
sys.exit("\n".join(faults) or None)
