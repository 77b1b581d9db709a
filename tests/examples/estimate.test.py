# SPDX-License-Identifier: BSL-1.0
"""[slow] fault_rupture --estimate says what a run will take, and does nothing else. Environment: SCARP_EXAMPLES, the folder of the built
programs (skipped, exit 77, without)."""
import json
import math
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

program = example("fault_rupture")


def run(folder, *options):
    return subprocess.run([program.resolve(), *options], cwd=folder, capture_output=True, text=True, timeout=120)


def estimate(folder, *options):
    """Words before numbers: scene, steps, CPU time [s], wall time [s], memory [MB]; "work" is the CPU time in DEM steps of this machine, which
    other programs on it do not change."""
    done = run(folder, "--estimate", *options)
    expect(done.returncode == 0, f"{options}: ended with {done.returncode}: {done.stderr}")
    found = {}
    for line in done.stdout.splitlines():
        name, _, rest = line.partition(": ")
        if number := re.match(r"[-+.0-9e]+", rest):
            found[name] = float(number[0]) * (1e3 if rest.startswith(f"{number[0]} GB") else 1.0)
    found["work"] = found["CPU time"] / found["machine"]
    expect(all(name in found for name in ("scene", "steps", "CPU time", "wall time", "memory")), f"{options}: says {done.stdout}")
    return found, done.stdout


def is_empty(folder):
    return not list(pathlib.Path(folder).iterdir())


with tempfile.TemporaryDirectory() as scratch:
    small, said = estimate(scratch)
    expect(is_empty(scratch), "an estimate writes nothing")
    expect("commit" in said and "uncertainty" in said, f"it says where its numbers come from, and how wrong they may be: {said}")
    for options in (["--elements", "12000"], ["--grains", "800"], ["--length", "1.41"], ["--strain-per-dem-step", "1e-6"], ["--tolerance", "1e-5"], ["--packings", "200"]):
        expect(estimate(scratch, *options)[0]["work"] > small["work"], f"{options} take more time")
    for options in (["--elements", "12000"], ["--grains", "800"]):
        expect(estimate(scratch, *options)[0]["memory"] > small["memory"], f"{options} take more memory")
    expect(estimate(scratch, "--throw-over-depth", "0.01")[0]["work"] < 0.5 * small["work"], "a small throw takes less")
    expect(estimate(scratch, "--elements", "200000", "--grains", "2000")[0]["memory"] > 1e5, "a scene that no machine holds is told")
    for options in (["--soil", "mohr_coulomb"], ["--soil", "elastic"], ["--case", "heavy"], ["--max-displacement-gradient", "1e-12"]):
        expect(estimate(scratch, *options)[0]["CPU time"] > 0.0, f"{options} have one too")

    # What is refused for a run is refused for its estimate.
    for options, named in ((["--grains", "0"], "--grains"), (["--size", "many"], "--size"), (["--tip", "500", "--left", "0"], "500"),
                           (["--probe-a-x", "1000"], "probe A"), (["--mesh", "none.msh"], "none.msh"),
                           (["--estimate=no"], "estimate")):
        done = run(scratch, "--estimate", *options)
        expect(done.returncode > 0 and named in done.stderr, f"{options}: ended with {done.returncode}: {done.stderr}")
    expect(is_empty(scratch), "nor does one that is refused")

    # Where results of another run lie, they stay.
    results = pathlib.Path(scratch, "output", "fault_rupture")
    results.mkdir(parents=True)
    (results / "summary.json").write_text("{}")
    estimate(scratch)
    estimate(scratch, "--overwrite")
    expect([path.name for path in results.iterdir()] == ["summary.json"] and (results / "summary.json").read_text() == "{}",
           "results that are there stay")

    tiny = ["--quick", "--threads", "1", "--throw-over-depth", "0.02"]
    predicted, said = estimate(scratch, *tiny)
    done = run(scratch, *tiny, "--output", "out")
    expect(done.returncode == 0, f"the run ends well: {done.stderr[-500:]}")
    took = json.loads(pathlib.Path(scratch, "out", "summary.json").read_text())
    # How long a step takes hangs on who else uses the machine; how many steps there are does not.
    expect(took["cpu_seconds"] > 0.0 and predicted["CPU time"] > 0.0, f"the run and its estimate have a CPU time: {said}")
    iterations, million = map(float, re.search(r"with (\d+) iterations and ([\d.]+) million DEM steps", said).groups())
    for what, found, expected in (("steps", predicted["steps"], took["steps"]), ("iterations", iterations, took["iterations"]),
                                  ("DEM steps", 1e6 * million, took["dem_steps"])):
        expect(abs(found - expected) <= 0.3 * expected, f"{what}: {found} are predicted, the run took {expected}")

    _, said = estimate(scratch, "--quick", "--threads", "1024")
    expect("on 1024 threads" in said and "so that it needs" in said, f"threads beyond the machine's are noted: {said}")

    # A graded mesh of a file, and other depths: the load steps follow the elements along the fault and the depth.
    mesh = pathlib.Path(__file__).resolve().parents[2] / "examples" / "fault_rupture" / "meshes" / "unstructured.msh"
    for options in (["--mesh", mesh, "--grains", "36"], ["--depth", "8"], ["--depth", "80", "--dip", "50"]):
        other = ["--quick", "--threads", "1", "--throw-over-depth", "0.02", *options]
        predicted, said = estimate(scratch, *other)
        expect("reference study's site" in said or "--mesh" in options, f"{options}: it says what it was measured on: {said}")
        done = run(scratch, *other, "--output", "other", "--overwrite")
        took = json.loads(pathlib.Path(scratch, "other", "summary.json").read_text())["steps"] if done.returncode == 0 else math.nan
        expect(abs(predicted["steps"] - took) <= 0.15 * took, f"{options}: {predicted['steps']} steps are predicted, the run took {took}")
finish()
