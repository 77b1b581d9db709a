# SPDX-License-Identifier: BSL-1.0
"""steps.py NAME OUTPUT_DIR COMMAND: the load steps of a run into docs/data/study_NAME_steps.csv."""
import json
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from common import origin, summary_of, write_table

COLUMNS = {"attempt": "attempt", "step": "step", "throw_over_depth": "h/H", "accepted": "accepted", "reason": "reason", "iterations": "iterations",
           "residual": "residual", "dem_steps": "DEM steps", "seconds": "wall time [s]", "share_outside_points": "share outside of the points",
           "max_displacement_gradient": "largest gradient"}
name, folder, command = sys.argv[1], pathlib.Path(sys.argv[2]), sys.argv[3]
if not summary_of(folder):
    sys.exit(f"'{folder}' has no summary (the run was killed): start it again, it resumes")
lines = map(json.loads, (folder / "convergence.jsonl").read_text().splitlines())
said = origin(command)
write_table(f"study_{name}_steps", [{title: line[key] for key, title in COLUMNS.items()} for line in lines if line["kind"] == "step"], said)
