# SPDX-License-Identifier: BSL-1.0
"""[nightly] A wheel is made without a network, installed into an environment of its own, and has module, programs, scripts and data: a fault scene, its
estimate, figures and page, and a packing. The Debian package holds the same files, the source archive those of the
repository. The files of the package that run programs pass mypy --strict. Skipped, exit 77, without the packages that
docs/packages.md names."""
import importlib.util
import os
import pathlib
import shutil
import subprocess
import sys
import tarfile
import tempfile
import zipfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "tests" / "examples"))
from expectations import expect, finish

TYPED = ("programs", "program_options", "results", "fault", "lab", "study")
missing = [name for name in ("build", "setuptools", "wheel", "venv", "pip", "numpy", "matplotlib", "mypy") if importlib.util.find_spec(name) is None]
if missing:
    print(f"skipped: no {', '.join(missing)} (install python3-build, python3-setuptools, python3-wheel, python3-venv, python3-pip, python3-matplotlib, mypy)")
    sys.exit(77)
USE = """
import numpy, pathlib, scarp
here = pathlib.Path(scarp.__file__).parent
assert here.is_relative_to(HOME), here
assert scarp.programs.find("fault_rupture").is_relative_to(here)
points = scarp.MaterialPoints(scarp.linear_elastic(young=1e7, poisson=0.25), numpy.zeros((1, 2)))
run = scarp.fault_rupture("scene", quick=True, soil="mohr_coulomb")
assert run.summary.elements == 220 and scarp.fault_estimate(quick=True).points == 220
assert (here / "examples/fault_rupture/plot.py").is_file() and len(run.plot()) > 4 and run.report().is_file()
packing = scarp.rve_lab("prepare", "sand", sand="fontainebleau", grains=100)
assert packing.packing.is_file()
# The costs of the estimate are those of the wheel.
(here / "examples/fault_rupture/costs.json").write_text("{")
try:
    scarp.fault_estimate(quick=True)
except (ValueError, RuntimeError) as trouble:
    print("rejected:", trouble)
"""


def must(*words, **keywords):
    done = subprocess.run([str(word) for word in words], capture_output=True, text=True, **keywords)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, words))}\nended with {done.returncode}:\n{done.stdout[-4000:]}{done.stderr[-4000:]}")
    return done.stdout


must(sys.executable, "-m", "mypy", "--strict", "--follow-imports=silent", "--cache-dir=/dev/null",
     *(ROOT / f"examples/python_points/package/{name}.py" for name in TYPED))
with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch).resolve()
    must(sys.executable, "-m", "build", "--no-isolation", "--wheel", "--outdir", scratch, ROOT)
    wheels = list(scratch.glob("scarp-*.whl"))
    expect(len(wheels) == 1 and f"cp{sys.version_info[0]}{sys.version_info[1]}" in wheels[0].name, f"{wheels}")
    with zipfile.ZipFile(wheels[0]) as wheel:
        names = wheel.namelist()
        expect(all(name.startswith(("scarp/", "scarp-")) for name in names), f"{names}")
        expect(wheel.getinfo("scarp/bin/rve_lab").external_attr >> 16 & 0o111, "a program of the wheel is no executable")
    must(sys.executable, "-m", "venv", "--system-site-packages", scratch / "own")
    must(scratch / "own/bin/pip", "install", "--no-index", "--no-deps", wheels[0])
    alone = {name: value for name, value in os.environ.items() if name not in ("PYTHONPATH", "SCARP_PROGRAMS")}
    printed = must(scratch / "own/bin/python", "-c", USE.replace("HOME", repr(str(scratch / "own"))), cwd=scratch, env=alone)
    expect(f"rejected: fault_rupture: '{scratch}/own" in printed, printed)
    if (ROOT / ".git").exists():
        must(sys.executable, "-m", "build", "--no-isolation", "--sdist", "--outdir", scratch, ROOT)
        with tarfile.open(next(scratch.glob("scarp-*.tar.gz"))) as sources:
            kept = {name.partition("/")[2] for name in sources.getnames()}
        lost = set(must("git", "-C", ROOT, "ls-files").splitlines()) - kept
        expect(not lost, f"the source archive has no {sorted(lost)[:5]}")
    if shutil.which("dpkg-deb"):
        build = ROOT / "build" / f"wheel_{sys.implementation.cache_tag}"
        must("cpack", "-G", "DEB", "--config", "CPackPython.cmake", "-B", scratch / "debian", cwd=build)
        package = next((scratch / "debian").glob("python3-scarp_*.deb"))
        held = {line.split("dist-packages/")[1] for line in must("dpkg-deb", "--contents", package).splitlines() if "dist-packages/scarp/" in line}
        expect({name for name in names if name.startswith("scarp/")} == {name for name in held if not name.endswith("/")}, f"{held} of {names}")
finish()
