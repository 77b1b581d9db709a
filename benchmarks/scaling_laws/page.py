# SPDX-License-Identifier: BSL-1.0
"""costs.json of examples/fault_rupture, docs/scaling.md and its figure, from the runs that are there."""
import datetime
import json
import math
import re
import statistics

import numpy as np

import fit
import runs
from generated_sections import rewrite, rows_on, table, with_section

COMMAND = "`./benchmarks/run scaling_laws`"
# [B]; a process that starts another one leaves it its own peak, some 30 MB here, so that smaller runs tell nothing.
LARGE = 6e7


def digits(value, count=2):
    """As many significant digits, without powers of ten where they can be avoided."""
    if value == 0 or math.isnan(value):
        return "-" if math.isnan(value) else "0"
    return f"{value:.{count}g}" if not 1e3 <= abs(value) < 1e7 else f"{float(f'{value:.{count}g}'):.0f}"


def law_row(x, y, unit=1.0):
    _, exponent, error = fit.power_law(x, y)
    return [f"{digits(min(x), 3)} to {digits(max(x), 3)}", str(len(x)), f"{exponent:.2f}",
            "-" if math.isnan(error) else f"{error:.2f}", f"{digits(min(y) * unit)} to {digits(max(y) * unit)}"]


def chosen(measured, start):
    """Runs of a series by their number."""
    return [measured[name] for name in keys(measured, start)]


def read_lines(path):
    """Rows of a file of JSON lines; none where there is no file."""
    return [json.loads(line) for line in path.read_text().splitlines()] if path.exists() else []


def keys(measured, start):
    return sorted((name for name in measured if re.fullmatch(rf"{start}-\d+", name)), key=lambda name: int(name.rsplit("-", 1)[1]))


def outside(model, run):
    """Time of an iteration outside of the points [s]."""
    return model.scaled(run, run["in_steps"] - run["in_points"]) / run["iterations"]


def memory(series):
    """Triangles and largest memory [B] of runs that take far more than the program itself."""
    large = [run for run in series if run["peak_memory_bytes"] > LARGE]
    return [run["elements"] for run in large], [run["peak_memory_bytes"] for run in large]


def memory_errors(build, measured):
    """Least and largest prediction over measurement of runs that take far more than the program itself."""
    found = [predicted(build, run)["peak_memory_bytes"] / run["peak_memory_bytes"] for name, run in measured.items()
             if run["peak_memory_bytes"] > LARGE and not name.startswith("team")]
    return f"Memory of all {len(found)} runs that take more than 60 MB: {min(found):.2f} to {max(found):.2f} of what they took."


def exponents(page, model, measured, space):
    """Rows of the page stay where there are no such runs."""
    rows = {(what, over): cells for what, over, *cells in rows_on(page, "exponents")}

    def add(what, over, x, y, unit=1.0):
        if len(set(x)) > 1 and min(y) > 0.0:
            rows[what, over] = law_row(x, y, unit)

    grains = chosen(measured, "grains")
    add("a DEM step [us]", "grains", [run["grains"] for run in grains], [model.dem_step[name] for name in keys(measured, "grains")], 1e6)
    add("a column of packings, prepared [s]", "grains", [run["grains"] for run in grains], [model.column(run) for run in grains])
    for name, title in (("local", "without a length"), ("length", "with 8 m")):
        series = chosen(measured, name)
        size = [run["elements"] for run in series]
        add(f"a DEM step of 100 grains, {title} [us]", "triangles", size, [model.dem_step[key] for key in keys(measured, name)], 1e6)
        add(f"the rest of an iteration, {title} [ms]", "triangles", size, [outside(model, run) for run in series], 1e3)
        add(f"throw of a load step, {title} [m over gradient]", "triangles", size,
            [float(np.median([step["load_increment"] / step["largest_gradient"] for step in fit.throws(run)])) for run in series])
        add(f"memory, {title} [MB]", "triangles", *memory(series), 1e-6)
        plain = chosen(measured, f"plain-{name}")
        size = [run["elements"] for run in plain]
        add(f"Mohr-Coulomb: points in an iteration, {title} [ms]", "triangles", size,
            [model.scaled(run, run["in_points"]) / run["iterations"] for run in plain], 1e3)
        add(f"Mohr-Coulomb: the rest of an iteration, {title} [ms]", "triangles", size, [outside(model, run) for run in plain], 1e3)
        whole = [run for run in plain if run["throw_over_depth"] > 0.08]
        add(f"Mohr-Coulomb: iterations of the whole throw, {title}", "triangles", [run["elements"] for run in whole],
            [run["iterations"] for run in whole])
        add(f"Mohr-Coulomb: memory, {title} [MB]", "triangles", *memory(plain), 1e-6)
    large = [run for run in grains if run["peak_memory_bytes"] > LARGE]
    if len(large) > 1:
        add("memory, 220 triangles [MB]", "grains", [run["grains"] for run in large], [run["peak_memory_bytes"] for run in large], 1e-6)
    by_grains = [row for row in space if row["series"] == "grains"]
    by_size = [row for row in space if row["series"] == "elements"]
    add("in space: a DEM step with its share of tangents [us]", "spheres", [row["grains"] for row in by_grains],
        [row["in_points"] / row["dem_steps"] for row in by_grains], 1e6)
    add("in space: preparation [s]", "spheres", [row["grains"] for row in by_grains], [row["preparation"] for row in by_grains])
    add("in space: memory [MB]", "spheres", [row["grains"] for row in by_grains], [row["peak_memory_bytes"] for row in by_grains], 1e-6)
    add("in space: the rest of an iteration [ms]", "hexahedra", [row["elements"] for row in by_size],
        [row["outside"] / row["iterations"] for row in by_size], 1e3)
    add("in space: points in an iteration [s]", "hexahedra", [row["elements"] for row in by_size],
        [row["in_points"] / row["iterations"] for row in by_size])
    add("in space: memory [MB]", "hexahedra", [row["elements"] for row in by_size], [row["peak_memory_bytes"] for row in by_size], 1e-6)
    return table(["what", "over", "from, to", "runs", "exponent", "+- (two standard errors)", "values"], [[*key, *cells] for key, cells in rows.items()])


def constants_table(constants):
    return table(["constant", "value"], [[f"`{name}`", digits(value, 3)] for name, value in constants.items()])


def predicted(build, run):
    """What the program says now of a run: steps, iterations, DEM steps, CPU time at the machine's speed during the run, memory."""
    text = runs.said_by(build / "release" / "examples" / "fault_rupture", run["options"])
    steps, iterations = map(int, re.search(r"steps: (\d+), with (\d+) iterations", text).groups())
    dem = re.search(r"and ([0-9.e+]+) million DEM steps", text)
    seconds = float(re.search(r"CPU time: ([0-9.e+]+) s", text)[1])
    memory, unit = re.search(r"memory: ([0-9.]+) ([MG])B", text).groups()
    return {"steps": steps, "iterations": iterations, "dem_steps": float(dem[1]) * 1e6 if dem else 0.0,
            "cpu_seconds": seconds * run["kernel"] / (1e-6 * runs.kernel_of(text)),
            "peak_memory_bytes": float(memory) * (1e9 if unit == "G" else 1e6)}


def factor(a, b):
    return max(a / b, b / a) if a > 0.0 and b > 0.0 else 1.0


def said(measured, prediction):
    return f"{digits(prediction, 3)} / {digits(measured, 3)}"


def predictions(build, measured, pages):
    """Table of runs that were not fitted; largest factor of the CPU time."""
    rows, largest = [], 1.0
    for name, run in measured.items():
        if not name.startswith("check"):
            continue
        guess = predicted(build, run)
        largest = max(largest, factor(guess["cpu_seconds"], run["cpu_seconds"]))
        rows.append([f"`{' '.join(run['options'][:-2])}`", str(run["elements"]), said(run["steps"], guess["steps"]),
                     said(run["iterations"], guess["iterations"]),
                     said(1e-6 * run["dem_steps"], 1e-6 * guess["dem_steps"]) if run["dem_steps"] else "-",
                     said(run["cpu_seconds"], guess["cpu_seconds"]), f"{guess['cpu_seconds'] / run['cpu_seconds']:.2f}",
                     said(1e-6 * run["peak_memory_bytes"], 1e-6 * guess["peak_memory_bytes"])])
    for title, options, found in pages:
        guess = predicted(build, {"options": options, "kernel": 1.0})
        counts = [said(found[key] * unit, guess[key] * unit) if key in found else "-"
                  for key, unit in (("steps", 1.0), ("iterations", 1.0), ("dem_steps", 1e-6))]
        rows.append([f"`{' '.join(options)}` ({title})", "", *counts, "-", "-", "-"])
    return table(["run", "triangles", "steps", "iterations", "million DEM steps", "CPU s", "factor", "memory [MB]"], rows), largest


def team(measured, name):
    return [run for key, run in measured.items() if key.startswith(f"team-{name.replace(' ', '-')}-")]


def is_idle(measured):
    """Whether the machine had a processor for each run on one thread."""
    return all(run["cpu_seconds"] > 0.95 * run["wall_seconds"] for run in team(measured, "1 thread"))


def teams_table(measured):
    rows, alone = [], None
    for name in runs.TEAMS:
        if not (found := team(measured, name)):
            continue
        wall = statistics.median(run["in_steps"] for run in found)
        alone = alone or wall
        rows.append([name, str(len(found)), f"{alone / wall:.2f}" if is_idle(measured) else "-",
                     f"{statistics.median(run['cpu_seconds'] for run in found):.1f}"])
    columns = ["team", "runs", "times as fast by the wall time of the load steps", "CPU time of the first process [s]"]
    return table(columns, rows) if rows else ""


def thread_efficiency(path, measured):
    """Of two threads; where they were not measured on an idle machine, what the file says."""
    if team(measured, "1 thread") and team(measured, "2 threads") and is_idle(measured):
        alone, both = (statistics.median(run["in_steps"] for run in team(measured, name)) for name in ("1 thread", "2 threads"))
        return alone / both / 2.0
    return json.loads(path.read_text())["thread_efficiency"]


def cost_file(path, model, measured, largest):
    any_run = next(iter(measured.values()))
    values = {"date": str(datetime.date.today()), "commit": any_run["commit"][:7], "machine": any_run["processor"],
              **{name: float(f"{value:.4g}") for name, value in model.constants.items()},
              "thread_efficiency": float(f"{thread_efficiency(path, measured):.3g}"), "largest_error": math.ceil(10.0 * largest) / 10.0}
    rewrite(path, json.dumps(values, indent=2) + "\n")
    return values


def figure(path, model, measured, space):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    drawn, axes = plt.subplots(1, 3, figsize=(13.5, 4.0), layout="constrained")

    def line(axis, x, y, label, mark):
        factor_of, exponent, _ = fit.power_law(x, y)
        points, = axis.loglog(x, y, mark, ms=5, label=f"{label}: {exponent:.2f}")
        ends = np.array([min(x), max(x)])
        axis.loglog(ends, factor_of * ends ** exponent, "-", color=points.get_color(), lw=0.8)

    for name, title, mark in (("local", "sand", "o"), ("length", "sand, 8 m", "s"), ("plain-local", "Mohr-Coulomb", "^"),
                              ("plain-length", "Mohr-Coulomb, 8 m", "v")):
        series = chosen(measured, name)
        if len(series) < 2:
            continue
        size = [run["elements"] for run in series]
        line(axes[0], size, [1e3 * outside(model, run) for run in series], title, mark)
        if len(memory(series)[0]) > 1:
            line(axes[2], memory(series)[0], [1e-6 * most for most in memory(series)[1]], title, mark)
    grains = chosen(measured, "grains")
    line(axes[1], [run["grains"] for run in grains], [1e6 * model.dem_step[name] for name in keys(measured, "grains")],
         "DEM step, ellipses", "o")
    by_grains = [row for row in space if row["series"] == "grains"]
    if by_grains:
        line(axes[1], [row["grains"] for row in by_grains], [1e6 * row["in_points"] / row["dem_steps"] for row in by_grains],
             "DEM step, spheres", "s")
    axes[0].set(xlabel="triangles", ylabel="an iteration outside of the points [ms]")
    axes[1].set(xlabel="grains", ylabel="time [us]")
    axes[2].set(xlabel="triangles", ylabel="memory [MB] (sand: 100 grains)")
    for axis in axes:
        axis.legend(fontsize=8)
        axis.grid(alpha=0.3, which="both")
    drawn.savefig(path, dpi=100)


def default_run(root):
    """Counts of the default run as docs/profile.md has them; how fast its machine was is not known."""
    rows = rows_on((root / "docs" / "profile.md").read_text(), "default")
    solver = rows[next(k for k, row in enumerate(rows) if row[0] == "accepted steps") + 2]
    return {"steps": int(solver[0]), "iterations": int(solver[2]) + int(solver[3]), "dem_steps": 1e6 * float(rows[0][3])}


def write(root, output, build):
    measured = runs.read_all(output, runs.all_runs())
    space = read_lines(output / "space.jsonl")
    model = fit.Model(measured)
    costs = root / "examples" / "fault_rupture" / "costs.json"
    values = cost_file(costs, model, measured, 1.0)
    found, largest = predictions(build, measured, [("the default, `docs/profile.md`", ["--threads", "1"], default_run(root))])
    values = cost_file(costs, model, measured, largest)
    path = root / "docs" / "scaling.md"
    page = path.read_text()
    head = f"{COMMAND}, {values['date']}, commit {values['commit']}, {values['machine']}."
    page = with_section(page, "exponents", f"{head}\n\n{exponents(page, model, measured, space)}")
    page = with_section(page, "constants", f"{head} Times [s] for a machine whose kernel takes {1e6 * model.kernel:.2f} us.\n\n"
                                           f"{constants_table(model.constants)}")
    page = with_section(page, "predictions", f"{head} Prediction / measurement.\n\n{found}\n\n"
                                             f"{memory_errors(build, measured)}")
    if teams := teams_table(measured):
        page = with_section(page, "teams", f"{head}\n\n{teams}")
    import beyond
    page = beyond.sections(page, head, model, measured, output, build)
    rewrite(path, page)
    if space:
        figure(root / "docs" / "figures" / "scaling_laws.png", model, measured, space)
