# SPDX-License-Identifier: BSL-1.0
"""The runs that are measured: what each is asked, what it took, and how fast the machine was meanwhile."""
import json
import os
import re
import subprocess
import time

SIZES = [220, 480, 960, 1900, 3800, 7616, 15000, 30000]  # triangles asked for
# Open MPI otherwise refuses more ranks than cores, and the root user of a container.
ON_RANKS = {**os.environ, "OMPI_MCA_rmaps_base_oversubscribe": "1", "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1"}
GRAINS = [100, 200, 400, 800, 1600]
SAND = ["--grains", 100, "--overconsolidation-ratio", 1]


def of_sizes():
    """Packings of 100 grains. Fine meshes end after a few load steps, with few least DEM steps and fewer columns."""
    for triangles in SIZES:
        mesh = ["--elements", triangles] if triangles != 960 else ["--size", 2.5]
        if triangles <= 960:
            yield f"length-{triangles}", [*SAND, *mesh, "--throw-over-depth", 0.006]
            yield f"local-{triangles}", ["--local", *SAND, *mesh, "--throw-over-depth", 0.002]
            continue
        short = [*SAND, *mesh, "--min-dem-steps", 5]
        yield f"length-{triangles}", [*short, "--packings", 2, "--throw-over-depth", 0.0006 if triangles < 15000 else 0.0001]
        far = 0.0006 if triangles < 7616 else 0.0003 if triangles < 15000 else 0.0001
        yield f"local-{triangles}", ["--local", *short, "--throw-over-depth", far]


def of_grains():
    for grains in GRAINS:
        yield f"grains-{grains}", ["--overconsolidation-ratio", 1, "--elements", 220, "--packings", 2, "--grains", grains, "--throw-over-depth", 0.001]


def whole():
    """To the end of the throw, or far, with another residual: iterations and strains of the later steps."""
    half = ["--strain-per-dem-step", 2e-5, "--unbalanced-tolerance", 0.1]
    yield "whole-length-220", [*SAND, "--elements", 220, *half]
    yield "far-length-480", [*SAND, "--elements", 480, *half, "--tolerance", 5e-3, "--throw-over-depth", 0.03]
    yield "whole-local-220", ["--local", *SAND, "--elements", 220, *half]
    yield "far-local-1900", ["--local", *SAND, "--elements", 1900, *half, "--tolerance", 1e-2, "--min-dem-steps", 5,
                             "--throw-over-depth", 0.008]
    yield "residual-local-480", ["--local", *SAND, "--elements", 480, *half, "--tolerance", 2e-3, "--throw-over-depth", 0.02]
    yield "residual-length-480", [*SAND, "--elements", 480, *half, "--tolerance", 2e-3, "--throw-over-depth", 0.02]
    for length in (8, 5.66, 4):
        yield f"graded-{length}", ["--length", length]


def of_plain_soil():
    for triangles in SIZES:
        for name, length in (("length", 8), ("local", 0)):
            far = 0.01 if name == "local" and triangles <= 7616 else 0.001 if name == "local" or triangles <= 7616 else 0.0001
            to = [] if triangles <= 1900 else ["--throw-over-depth", far]
            yield f"plain-{name}-{triangles}", ["--soil", "mohr_coulomb", "--length", length, "--elements", triangles, *to]
    for length, triangles in ((4, 1900), (2.83, 3800), (2, 7616)):
        yield f"plain-short-{triangles}", ["--soil", "mohr_coulomb", "--length", length, "--elements", triangles]


def checks():
    """Not fitted."""
    yield "check-quick", ["--quick"]
    yield "check-graded", ["--length", 2.83]
    yield "check-uniform", ["--length", 4, "--elements", 7616]
    yield "check-plain-graded", ["--soil", "mohr_coulomb", "--length", 2]
    yield "check-plain-length", ["--soil", "mohr_coulomb", "--length", 5.66, "--elements", 1400]
    yield "check-plain-local", ["--soil", "mohr_coulomb", "--length", 0, "--elements", 1400]
    yield "check-grains", ["--elements", 480, "--packings", 2, "--grains", 200, "--tolerance", 5e-3, "--throw-over-depth", 0.015]


TEAMS = {"1 thread": (1, 1), "2 threads": (1, 2), "2 ranks": (2, 1)}  # ranks, threads


def teams(repetitions=3):
    """For the wall time, in turns."""
    for k in range(1, repetitions + 1):
        for name, (ranks, threads) in TEAMS.items():
            yield (f"team-{name.replace(' ', '-')}-{k}",
                   ["--local", *SAND, "--throw-over-depth", 0.002, "--threads", threads, *(["--ranks", ranks] if ranks > 1 else [])])


def all_runs():
    return dict([*of_sizes(), *of_grains(), *of_plain_soil(), *whole(), *checks(), *teams()])


def quick_runs():
    few = [f"{name}-{triangles}" for name in ("length", "local", "plain-length", "plain-local") for triangles in (220, 480)]
    far = [f"{name}-480" for name in ("far-length", "residual-length", "residual-local")] + ["whole-local-220"]
    return {name: options for name, options in all_runs().items() if name in (*few, *far, "grains-100", "grains-200", "grains-400")}


def said_by(program, options):
    """Prediction of a run: words before the numbers of its lines."""
    done = subprocess.run([program, *map(str, options), "--estimate"], capture_output=True, text=True, check=True)
    return done.stdout


def kernel_of(text):
    """[us] for a DEM step of 100 grains, by which the machine's speed is told."""
    return float(re.search(r"machine: ([0-9.]+) us", text)[1])


def nodes_of(text):
    return int(re.search(r"(\d+) nodes", text)[1])


def pairs_of(text):
    """Points within the length of one, itself too; 0 without a length."""
    found = re.search(r"(\d+) points within", text)
    return int(found[1]) if found else 0


def strip_area_of(text):
    """[m2] Of an element in the strip of a graded mesh; 0 on uniform ones."""
    found = re.search(r"in the strip ([0-9.e+-]+) m2", text)
    return float(found[1]) if found else 0.0


def command_of(build, options):
    """Program of the build that has ranks where they are requested."""
    options = list(map(str, options))
    ranks = 0
    if "--ranks" in options:
        at = options.index("--ranks")
        ranks = int(options[at + 1])
        del options[at:at + 2]
    program = build / ("ranks" if ranks else "release") / "examples" / "fault_rupture"
    if "--threads" not in options:
        options += ["--threads", "1"]
    launcher = ["mpirun", "-np", str(ranks), "--bind-to", "none"] if ranks else []
    return launcher, program, options


def one(build, folder, options):
    """Runs it unless it has been; the record is written last."""
    record = folder / "measured.json"
    if record.exists():
        return False
    folder.parent.mkdir(parents=True, exist_ok=True)
    launcher, program, options = command_of(build, options)
    before = said_by(program, options)
    started = time.monotonic()
    command = [*launcher, program, *options, "--frames", "1", "--output", folder, "--overwrite"]
    done = subprocess.run(command, capture_output=True, text=True, env=ON_RANKS)
    took = time.monotonic() - started
    if done.returncode != 0:
        raise SystemExit(f"benchmarks/scaling_laws/run: {' '.join(options)} ended with {done.returncode}:\n{done.stderr[-2000:]}")
    said = said_by(program, options)
    record.write_text(json.dumps({"options": options, "nodes": nodes_of(said), "pairs": pairs_of(said), "strip_area": strip_area_of(said), "wall": took,
                                  "kernel": 0.5e-6 * (kernel_of(before) + kernel_of(said))}))
    return True


def read(folder):
    """What a run took, with its accepted load steps; times [s]."""
    measured = json.loads((folder / "measured.json").read_text())
    summary = json.loads((folder / "summary.json").read_text())
    lines = [json.loads(line) for line in (folder / "convergence.jsonl").read_text().splitlines()]
    steps = [line for line in lines if line["kind"] == "step"]
    longest = sum(max((slow["dem_steps"] for slow in line["slowest"]), default=0) for line in lines if line["kind"] == "iteration")
    return {**measured, **{name: summary[name] for name in ("elements", "steps", "iterations", "dem_steps", "cpu_seconds", "wall_seconds",
                                                            "peak_memory_bytes", "throw_over_depth")},
            "longest": longest, "grains": summary.get("grains_per_rve", 0), "history": steps,
            "processor": summary["run"]["processor"], "commit": summary["run"]["commit"],
            "in_steps": sum(step["seconds"] for step in steps), "in_points": sum(step["seconds_in_points"] for step in steps)}


def read_all(output, names):
    return {name: read(output / name) for name in names if (output / name / "measured.json").exists()}
