# SPDX-License-Identifier: BSL-1.0
"""[nightly] States of every adaptor around every adaptor have the same bits on one and two MPI ranks, in one go and from checkpoints, and observers
on the root rank see the same. Environment: SCARP_TEST_PROGRAMS, the folder of states_on_ranks (skipped, exit 77, without it or mpirun)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(os.environ.get("SCARP_TEST_PROGRAMS", "nowhere")) / "states_on_ranks"
if not PROGRAM.exists() or shutil.which("mpirun") is None:
    print("skipped: no MPI here")
    sys.exit(77)

# Open MPI otherwise refuses more ranks than cores, and the root user of a container.
environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def run(ranks):
    """What the root rank prints."""
    with tempfile.TemporaryDirectory() as folder:
        done = subprocess.run(["mpirun", "-np", str(ranks), PROGRAM, folder], env=environment, capture_output=True, text=True,
                              timeout=300)
    print(done.stdout, done.stderr, sep="")
    if done.returncode != 0:
        sys.exit(f"{ranks} ranks: exit code {done.returncode}")
    lines = done.stdout.splitlines()
    wrong = [line for line in lines if not re.search(r": ok in \d+ steps, hash \w+, in parts the same$", line)]
    if wrong or len(lines) < 5:
        sys.exit(f"{ranks} ranks: {len(lines)} cases, of which went wrong: {wrong}")
    return lines


alone = run(1)
shared = run(2)
if alone != shared:
    sys.exit(f"one rank and two differ: {[pair for pair in zip(alone, shared) if pair[0] != pair[1]]}")
