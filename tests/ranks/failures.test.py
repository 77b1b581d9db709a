# SPDX-License-Identifier: BSL-1.0
"""[slow] What one MPI rank throws ends all ranks with its words, none waits for ever. Environment: SCARP_TEST_PROGRAMS, the folder
of failing_ranks (skipped, exit 77, without it or mpirun)."""
import os
import pathlib
import shutil
import subprocess
import sys

PROGRAM = pathlib.Path(os.environ.get("SCARP_TEST_PROGRAMS", "nowhere")) / "failing_ranks"
if not PROGRAM.exists() or shutil.which("mpirun") is None:
    print("skipped: no MPI here")
    sys.exit(77)

# Open MPI otherwise refuses more ranks than cores, and the root user of a container.
environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1"}
WORDS = {"nobody": "done", "task": "point 1 has no packing", "first": "the log cannot be written",
         "answer": "the state cannot be read", "file": "done"}

for who, words in WORDS.items():
    # MPI ends the other ranks when one has failed, perhaps before they have printed: one is enough, and that it ends.
    done = subprocess.run(["mpirun", "-np", "3", PROGRAM, who], env=environment, capture_output=True, text=True, timeout=120)
    print(done.stdout, done.stderr, sep="")
    if (done.returncode == 0) != (who in ("nobody", "file")) or words not in done.stdout:
        sys.exit(f"{who}: exit code {done.returncode}, expected the words '{words}'")
