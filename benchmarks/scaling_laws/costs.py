# SPDX-License-Identifier: BSL-1.0
"""costs.json of examples/fault_rupture and the data files, from the runs that are there."""
import datetime
import json
import math
import re
import statistics

import fit
import runs
from common import origin, write_table

COMMAND = "./benchmarks/run scaling_laws"


def predicted(build, run):
    """What the program now predicts of a run: steps, iterations, DEM steps, CPU time at the machine's speed during the run, memory."""
    text = runs.said_by(build / "release" / "examples" / "fault_rupture", run["options"])
    steps, iterations = map(int, re.search(r"steps: (\d+), with (\d+) iterations", text).groups())
    dem = re.search(r"and ([0-9.e+]+) million DEM steps", text)
    seconds = float(re.search(r"CPU time: ([0-9.e+]+) s", text)[1])
    memory, unit = re.search(r"memory: ([0-9.]+) ([MG])B", text).groups()
    return {"steps": steps, "iterations": iterations, "dem_steps": float(dem[1]) * 1e6 if dem else 0.0,
            "cpu_seconds": seconds * run["kernel"] / (1e-6 * runs.kernel_of(text)),
            "peak_memory_bytes": float(memory) * (1e9 if unit == "G" else 1e6)}


def thread_efficiency(path, measured):
    """Of two threads; where they were not measured on an idle machine, the value of the file."""
    alone, both = ([run for key, run in measured.items() if key.startswith(f"team-{name}-")] for name in ("1-thread", "2-threads"))
    if alone and both and all(run["cpu_seconds"] > 0.95 * run["wall_seconds"] for run in alone):
        return statistics.median(run["in_steps"] for run in alone) / statistics.median(run["in_steps"] for run in both) / 2.0
    return json.loads(path.read_text())["thread_efficiency"]


def cost_file(path, model, measured, largest):
    any_run = next(iter(measured.values()))
    values = {"date": str(datetime.date.today()), "commit": any_run["commit"][:7], "machine": any_run["processor"],
              **{name: float(f"{value:.4g}") for name, value in model.constants.items()},
              "thread_efficiency": float(f"{thread_efficiency(path, measured):.3g}"), "largest_error": math.ceil(10.0 * largest) / 10.0}
    partial = path.with_suffix(".partial")
    partial.write_text(json.dumps(values, indent=2) + "\n")
    partial.replace(path)


def row(name, run, guess, model):
    """Measured and predicted columns of a run; times are for a machine whose kernel takes `kernel`."""
    outside = model.scaled(run, run["in_steps"] - run["in_points"]) / run["iterations"]
    return {"run": name, "options": " ".join(run["options"]), "triangles": run["elements"], "grains": run["grains"] or None,
            **{title: value for key, title, unit in (("steps", "steps", 1), ("iterations", "iterations", 1), ("dem_steps", "DEM steps [million]", 1e-6),
                                                     ("cpu_seconds", "CPU time [s]", 1.0), ("peak_memory_bytes", "memory [MB]", 1e-6))
               for title, value in ((title, unit * run[key]), (f"{title}, predicted", unit * guess[key]))},
            "wall time of the load steps [s]": run["in_steps"], "DEM step [us]": 1e6 * model.dem_step[name] if name in model.dem_step else None,
            "outside of the points, an iteration [ms]": 1e3 * outside,
            "all DEM steps over those of the slowest points": run["dem_steps"] / run["longest"] if run["longest"] else None}


def write(root, output, build):
    measured = runs.read_all(output, runs.all_runs())
    model = fit.Model(measured)
    path = root / "examples" / "fault_rupture" / "costs.json"
    cost_file(path, model, measured, 1.0)
    guesses = {name: predicted(build, run) for name, run in measured.items()}
    # Runs that were not fitted tell how far predictions are off.
    ratios = [guesses[name]["cpu_seconds"] / run["cpu_seconds"] for name, run in measured.items() if name.startswith("check")]
    cost_file(path, model, measured, max(max(ratio, 1.0 / ratio) for ratio in ratios))
    said = origin(COMMAND, ["g++"], f"kernel {1e6 * model.kernel:.2f} us")
    write_table("scaling", [row(name, run, guesses[name], model) for name, run in measured.items()], said)
    write_table("scaling_constants", [{"constant": name, "value": float(value)} for name, value in model.constants.items()], said)
    space = output / "space.jsonl"
    if space.exists():
        write_table("scaling_space", map(json.loads, space.read_text().splitlines()), said)
