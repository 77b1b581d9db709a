# SPDX-License-Identifier: BSL-1.0
"""The notebooks of examples/notebooks run from their first cell to their last, and are stored without outputs. Environment: SCARP_EXAMPLES, beside
whose folder the module is (skipped, exit 77, without)."""
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from expectations import expect, finish, leave_out, python_module

module = python_module()
programs = pathlib.Path(os.environ["SCARP_EXAMPLES"]).resolve()
needed = {"fault_and_footing": "fault_rupture", "calibration": "rve_lab"}
notebooks = sorted((pathlib.Path(__file__).resolve().parents[2] / "examples/notebooks").glob("*.ipynb"))
expect(len(notebooks) >= 4, f"{len(notebooks)} notebooks")
can_run = subprocess.run([sys.executable, "-c", "import nbconvert, ipykernel, matplotlib"], capture_output=True).returncode == 0
if not can_run:
    leave_out("nbconvert, ipykernel or matplotlib is not installed")
for notebook in notebooks:
    for number, cell in enumerate(json.loads(notebook.read_text())["cells"]):
        expect(not cell.get("outputs") and cell.get("execution_count") is None, f"{notebook.name}: cell {number} has outputs: strip them")
    if not can_run:
        continue
    if notebook.stem in needed and not (programs / needed[notebook.stem]).is_file():
        leave_out(f"{needed[notebook.stem]} is not built")
        continue
    with tempfile.TemporaryDirectory() as scratch:
        copied = pathlib.Path(scratch) / notebook.name
        copied.write_bytes(notebook.read_bytes())
        run = subprocess.run([sys.executable, "-m", "nbconvert", "--to", "notebook", "--execute", "--output", "done.ipynb", copied], cwd=scratch,
                             env={**os.environ, "PYTHONPATH": str(module), "SCARP_PROGRAMS": str(programs)}, capture_output=True, text=True, timeout=900)
        expect(run.returncode == 0, f"{notebook.name}: {run.stderr[-2000:]}")
        if run.returncode == 0:
            cells = json.loads((pathlib.Path(scratch) / "done.ipynb").read_text())["cells"]
            pictures = sum("image/png" in output.get("data", {}) for cell in cells for output in cell.get("outputs", []))
            expect(pictures >= 1, f"{notebook.name} draws nothing")
finish()
