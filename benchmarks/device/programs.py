# SPDX-License-Identifier: BSL-1.0
"""Tools and programs of benchmarks/device/run."""
import concurrent.futures
import os
import pathlib
import re
import shutil
import subprocess
import sys

from common import ROOT, commit, compilers, version_of

here = pathlib.Path(__file__).resolve().parent
KERNEL = ["-fno-math-errno", "-fno-trapping-math", "-mmove-max=512", "-mstore-max=512"]
PORTABLE = "x86-64-v3"


def found(tool, *places):
    """A program of PATH or of CUDA's folders; None where it is not installed."""
    paths = [shutil.which(tool), *sorted(str(path) for place in ("/usr/local/cuda/bin", "/usr/local/cuda", *places)
                                         for path in pathlib.Path("/").glob(f"{place[1:]}/{tool}"))]
    return next((path for path in paths if path and os.access(path, os.X_OK)), None)


def of_card(field):
    """What nvidia-smi says of the first card; None without one."""
    if not (tool := found("nvidia-smi")):
        return None
    said = subprocess.run([tool, f"--query-gpu={field}", "--format=csv,noheader"], capture_output=True, text=True)
    lines = said.stdout.splitlines()
    return lines[0].strip() if said.returncode == 0 and lines else None


def run_or_exit(command):
    if subprocess.run([str(word) for word in command], stdout=sys.stderr).returncode != 0:
        sys.exit(f"benchmarks/device/run: '{command[0]}' failed (see its message): the programs are not built")


def build(folder, level, architecture=None, exact=False, name="device_speed"):
    """A program for an instruction set; with CUDA for an architecture; exact: without contraction of products and sums, with IEEE roots."""
    plain = ["-std=c++20", f"-I{ROOT / 'include'}", "-isystem", "/usr/include/eigen3", "-DFMT_HEADER_ONLY", "-DNDEBUG", "-O3"]
    host = [f"-march={level}", *(["-ffp-contract=off"] if exact else [])]
    objects = [folder / f"{name}.o"]
    run_or_exit(["g++", *plain, *host, *KERNEL, *(["-DSCARP_WITH_CUDA"] if architecture else []), "-c", here / "device_speed.cpp", "-o", objects[0]])
    static = ["-static-libstdc++", "-static-libgcc"]
    if architecture:
        nvcc = [found("nvcc"), f"-arch={architecture}"]
        objects.append(folder / f"{name}_kernels.o")
        run_or_exit([*nvcc, *plain, "--expt-relaxed-constexpr", "-Werror", "cross-execution-space-call", "-DFMT_USE_CONSTEXPR=1", "-lineinfo",
                     "-diag-suppress", "20012,20208", *(f"-Xcompiler={flag}" for flag in host),
                     *(["-fmad=false", "-DSCARP_DEVICE_IEEE"] if exact else []), "-c", here / "kernels.cu", "-o", objects[1]])
        run_or_exit([*nvcc, "-cudart", "static", *objects, "-o", folder / name, *(f"-Xcompiler={flag}" for flag in static), "-lpthread"])
    else:
        run_or_exit(["g++", *objects, "-o", folder / name, *static, "-pthread"])
    for one in objects:
        one.unlink()


def build_all(folder, architecture, level="native"):
    """The programs of a folder; level native: for this machine."""
    if architecture and not found("nvcc"):
        sys.exit("benchmarks/device/run: there is no nvcc (neither in PATH nor in /usr/local/cuda/bin): install CUDA 12 or newer, or take "
                 "programs from a machine that has it (--build there, --programs here)")
    folder.mkdir(parents=True, exist_ok=True)
    wanted = [{"level": level, "architecture": architecture}]
    if architecture:
        wanted.append({"level": level, "architecture": architecture, "exact": True, "name": "device_speed_exact"})
    if level != "native":
        wanted.append({"level": "x86-64-v4", "name": "device_speed_x86-64-v4"})
    with concurrent.futures.ThreadPoolExecutor(max(1, (os.cpu_count() or 1) // 2)) as pool:
        list(pool.map(lambda one: build(folder, **one), wanted))
    names = [*map(version_of, compilers()[:1])]
    if architecture:
        said = subprocess.run([found("nvcc"), "--version"], capture_output=True, text=True).stdout
        names.append(f"nvcc {re.search(r'release [^,]*, V([0-9.]+)', said)[1]} for {architecture}")
    (folder / "built").write_text("; ".join([f"commit {commit()}", *names]))


def is_fresh(folder):
    sources = [*here.iterdir(), here.parent / "kernel_packings.hpp", *(ROOT / "include").rglob("*.hpp")]
    made = folder / "built"  # written last
    return made.exists() and made.stat().st_mtime > max(path.stat().st_mtime for path in sources)
