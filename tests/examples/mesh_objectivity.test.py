# SPDX-License-Identifier: BSL-1.0
"""[slow] With an intrinsic length the rupture comes out at one place, whatever directions the mesh offers. Environment: SCARP_EXAMPLES, the
folder of the built programs (skipped, exit 77, without)."""
import os
import pathlib
import subprocess
import sys
import tempfile

if not (pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / "fault_rupture").is_file():
    print("skipped: no fault_rupture (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
script = pathlib.Path(__file__).resolve().parents[2] / "benchmarks" / "mesh_objectivity" / "run"
with tempfile.TemporaryDirectory() as scratch:
    sys.exit(subprocess.run([sys.executable, script, "--quick"], cwd=scratch).returncode)
