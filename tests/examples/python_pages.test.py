# SPDX-License-Identifier: BSL-1.0
"""The Python of the pages runs as it stands, a page's blocks one after the other, beside the mesh of the tutorial. Environment: SCARP_EXAMPLES, beside
whose folder the module is (skipped, exit 77, without)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
from expectations import expect, finish, leave_out, python_module

module = python_module()
programs = pathlib.Path(os.environ["SCARP_EXAMPLES"]).resolve()
root = pathlib.Path(__file__).resolve().parents[2]
needed = {"python.md": ["fault_rupture", "rve_lab"], "tutorials/biaxial_test.md": ["rve_lab"], "tutorials/own_problem.md": []}
# What a block has from the text around it.
BEFORE = {"python.md": "import numpy\npositions = numpy.array([[0.0, -1.0], [1.0, -2.0]])\ngradients = numpy.zeros((2, 2, 2))\ngradients[:, 1, 1] = -1e-4\n"}
for page, wanted in needed.items():
    missing = [name for name in wanted if not (programs / name).is_file()]
    if missing:
        leave_out(f"{', '.join(missing)} is not built")
        continue
    blocks = re.findall(r"^```python\n(.*?)^```", (root / "docs" / page).read_text(), re.DOTALL | re.MULTILINE)
    expect(blocks, f"{page} has no Python")
    with tempfile.TemporaryDirectory() as scratch:
        shutil.copy(root / "examples/tutorials/excavation.msh", scratch)
        os.symlink(root / "examples", pathlib.Path(scratch) / "examples")
        run = subprocess.run([sys.executable, "-c", BEFORE.get(page, "") + "".join(blocks)], cwd=scratch, capture_output=True, text=True, timeout=900,
                             env={**os.environ, "PYTHONPATH": str(module), "MPLBACKEND": "Agg", "SCARP_PROGRAMS": str(programs)})
        expect(run.returncode == 0, f"{page}: {run.stderr[-1500:]}")
finish()
