# SPDX-License-Identifier: BSL-1.0
"""page.py NAME OUTPUT_DIR [SHORTER_RUN]: what a fault rupture cost and how sure it is of itself, into the section NAME of
docs/study/README.md; its load steps into docs/study/NAME_steps.csv, figures beside. A run that stopped short is projected to the whole
throw, by its own pace and by that of a finished run on a coarser mesh (OUTPUT_DIR of it). The environment says SCARP_COMMAND and
SCARP_COMMIT."""

import csv
import os
import pathlib
import platform
import re
import sys

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPOSITORY / "benchmarks"), str(REPOSITORY / "examples" / "shared")]
import numpy as np
import scarp_figures as figures
from PIL import Image
from generated_sections import rewrite, with_section

PAGE = REPOSITORY / "docs" / "study" / "README.md"
WHOLE = 0.085  # h/H
COLUMNS = ["attempt", "step", "throw_over_depth", "accepted", "reason", "iterations", "residual", "dem_steps",
           "seconds", "share_outside_points", "largest_gradient"]
FIGURES = {"surface": "Settlement of the surface", "deformation": "Deviatoric strain at the end",
           "convergence": "Residuals of all iterations", "effort": "Work, slow points and time shares"}


def processor():
    try:
        found = re.search(r"model name\s*:\s*(.*)", pathlib.Path("/proc/cpuinfo").read_text())
    except OSError:
        found = None
    return f"{found.group(1) if found else platform.processor()}, {os.cpu_count()} processors"


def load_steps(folder):
    return [line for line in figures.read_json_lines(folder / "convergence.jsonl") if line["kind"] == "step"]


def wall_until(steps):
    """h/H of the accepted steps and the seconds that the run had taken by then."""
    accepted = [step["accepted"] for step in steps]
    return (np.array([step["throw_over_depth"] for step in steps])[accepted],
            np.cumsum([step["seconds"] for step in steps])[accepted])


def projections(steps, coarser):
    """[(how, seconds for the whole throw)]"""
    throw, seconds = wall_until(steps)
    if len(throw) < 2 or not throw[-1] > 0.0:
        return []
    reached = throw[-1]
    if reached >= WHOLE * (1 - 1e-9):
        return [("measured", seconds[-1])]
    half = np.interp(reached / 2, throw, seconds)
    pace = (seconds[-1] - half) / (reached / 2)
    found = [("pace of the second half of what was reached", seconds[-1] + pace * (WHOLE - reached))]
    if coarser is not None:
        coarse_throw, coarse_seconds = wall_until(load_steps(coarser))
        if coarse_throw[-1] < WHOLE * (1 - 1e-9):
            raise figures.InputError(f"'{coarser}' ends at h/H = {coarse_throw[-1]:.4f} (a finished run is compared): "
                                     "let it run on")
        ratio = coarse_seconds[-1] / np.interp(reached, coarse_throw, coarse_seconds)
        found.append(("as the time of the coarser mesh grew from there", seconds[-1] * ratio))
    return found


def tabulated(head, rows):
    return "\n".join("| " + " | ".join(map(str, row)) + " |" for row in [head, ["---"] * len(head), *rows])


def of_the_run(summary, steps):
    gigabytes = summary["peak_memory_bytes"] / 2**30
    return tabulated(["", "this run"], [
        ["triangles", summary["elements"]],
        ["grains in each", summary["grains_per_rve"]],
        ["throw over depth reached", f"{summary['throw_over_depth']:.4f}"],
        ["steps accepted, refused", f"{summary['steps']}, {summary['refused_steps']}"],
        ["iterations", summary["iterations"]],
        ["DEM steps", f"{summary['dem_steps']:.4g}"],
        ["largest residual of an accepted step", f"{summary['max_accepted_residual']:.2e}"],
        ["time in load steps, wall [s]", f"{sum(step['seconds'] for step in steps):.0f}"],
        ["CPU time of the last session [s]", f"{summary['cpu_seconds']:.0f}"],
        ["outside the points, share of the time", f"{summary['share_of_time_outside_rves']:.1%}"],
        ["peak memory [GiB]", f"{gigabytes:.2f}"],
        ["surface_x05, surface_x50, surface_x95 [m]",
         ", ".join(f"{summary[f'surface_x{share}']:.2f}" for share in ("05", "50", "95"))],
        ["outcrop, steepest place of the surface [m]", f"{summary['outcrop_x']:.2f}, {summary['steepest_x']:.2f}"],
        ["width of the outcrop [m]", f"{summary['outcrop_width']:.2f}"]])


def along_the_way(steps):
    """What each tenth of the throw took."""
    throw = np.array([step["throw_over_depth"] for step in steps])
    edges = np.linspace(0.0, throw.max() * (1 + 1e-9), 11)
    rows = []
    for low, high in zip(edges, edges[1:]):
        part = [step for step, at in zip(steps, throw) if low <= at < high]
        seconds = sum(step["seconds"] for step in part)
        if not part or not seconds:
            continue
        outside = sum(step["seconds"] * step["share_outside_points"] for step in part) / seconds
        rows.append([f"{low:.4f} to {high:.4f}", sum(step["accepted"] for step in part),
                     sum(not step["accepted"] for step in part), sum(step["iterations"] for step in part),
                     f"{sum(step['dem_steps'] for step in part):.3g}", f"{seconds:.0f}", f"{outside:.1%}"])
    return tabulated(["h/H", "accepted", "refused", "iterations", "DEM steps", "wall [s]", "outside the points"], rows)


def budget(summary):
    parts = summary["error_budget"]["parts"]
    return tabulated(["part", "estimate", "bound", "", "meaning"],
                     [[f"`{name}`", "-" if part["value"] is None else f"{part['value']:.3g}",
                       f"{part['bound']:.3g}" if "bound" in part else "-", "" if part["within"] else "**outside**",
                       part["meaning"]] for name, part in parts.items()])


def main():
    if not 3 <= len(sys.argv) <= 4 or not pathlib.Path(sys.argv[2]).is_dir():
        print(f"usage: {sys.argv[0]} NAME OUTPUT_DIR [SHORTER_RUN]   (folders that fault_rupture wrote)", file=sys.stderr)
        return 2
    run, folder = sys.argv[1], pathlib.Path(sys.argv[2])
    coarser = pathlib.Path(sys.argv[3]) if len(sys.argv) == 4 else None
    try:
        steps = load_steps(folder)
        projected = projections(steps, coarser)
        summary = figures.read_summary(folder)
    except figures.InputError as trouble:
        print(f"{sys.argv[0]}: {trouble}", file=sys.stderr)
        return 1
    if not summary:
        print(f"{sys.argv[0]}: '{folder}' has no summary (the run was killed): start it again, it goes on",
              file=sys.stderr)
        return 1
    PAGE.parent.mkdir(exist_ok=True)
    with open(PAGE.with_name(f"{run}_steps.csv"), "w", newline="") as table:
        writer = csv.writer(table)
        writer.writerow(COLUMNS)
        writer.writerows([[f"{value:.6g}" if isinstance(value, float) else value
                           for value in (step[name] for name in COLUMNS)] for step in steps])
    parts = [f"`{os.environ.get('SCARP_COMMAND', 'fault_rupture')}`; {processor()}; "
             f"commit {os.environ.get('SCARP_COMMIT', 'unknown')}.", of_the_run(summary, steps),
             "Time until h/H = 0.085: " + "; ".join(f"{seconds / 3600:.2f} h ({how})"
                                                     for how, seconds in projected) + ".",
             along_the_way(steps), budget(summary)]
    for name, title in FIGURES.items():
        if (folder / "figures" / f"{name}.png").is_file():
            # 256 colours are enough for a page, and a third of the bytes.
            Image.open(folder / "figures" / f"{name}.png").convert("RGB").quantize().save(PAGE.with_name(f"{run}_{name}.png"), optimize=True)
            parts.append(f"![{title}]({run}_{name}.png)")
    page = PAGE.read_text() if PAGE.is_file() else "# The study's size, once\n"
    rewrite(PAGE, with_section(page, run, "\n\n".join(parts)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
