# SPDX-License-Identifier: BSL-1.0
"""page.py FOLDER SOIL: the table of benchmarks/grounds/run, from the summaries in FOLDER into docs/grounds.md."""
import json
import math
import pathlib
import sys

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.dont_write_bytecode = True
sys.path.insert(0, str(REPOSITORY / "benchmarks"))
from generated_sections import rewrite, with_section

ELEMENTS = ["tri3", "tri6", "quad4", "quad8"]
COLUMNS = ["element", "mesh", "aspect", "elements", "h/H", "x05", "x50", "x95", "largest slope", "mid-line dip",
           "outcrop_x", "iterations", "refused", "CPU s", "ends"]


def number(value, digits):
    return "-" if value is None else f"{value:.{digits}f}"


def degrees(angle):
    return None if angle is None else math.degrees(angle)


def row(folder, summary):
    element, mesh, aspect = folder.name.split("-")
    iterations = summary["iterations"]
    return [element, mesh, aspect, str(summary["elements"]), number(summary["throw_over_depth"], 4),
            number(summary["surface_x05"], 1), number(summary["surface_x50"], 1), number(summary["surface_x95"], 1),
            number(summary["surface_slope_max"], 2), number(degrees(summary["mid_line_dip"]), 1), number(summary["outcrop_x"], 1),
            str(iterations), str(summary["refused_steps"]), number(summary["cpu_seconds"], 0), summary["status"]]


folder, soil = pathlib.Path(sys.argv[1]), sys.argv[2]
files = sorted(folder.glob("*/summary.json"), key=lambda file: (ELEMENTS.index(file.parent.name.split("-")[0]), file.parent.name))
rows = [row(file.parent, json.loads(file.read_text())) for file in files]
if not rows:
    sys.exit(f"no summaries in '{folder}' (nothing was run): run benchmarks/grounds/run first")
lines = ["| " + " | ".join(line) + " |" for line in [COLUMNS, ["---"] * len(COLUMNS), *rows]]
page = REPOSITORY / "docs" / "grounds.md"
rewrite(page, with_section(page.read_text(), soil, "\n".join(lines)))
