# SPDX-License-Identifier: BSL-1.0
"""A small fault in packings has the same bits on one, two and three MPI ranks of one or two threads, and no rank holds a packing of
another. Environment: SCARP_TEST_PROGRAMS, the folder of ground_on_ranks (skipped, exit 77, without it or mpirun)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys

PROGRAM = pathlib.Path(os.environ.get("SCARP_TEST_PROGRAMS", "nowhere")) / "ground_on_ranks"
if not PROGRAM.exists() or shutil.which("mpirun") is None:
    print("no MPI here: skipped")
    sys.exit(77)

# Open MPI otherwise refuses more ranks than cores, and the root user of a container.
environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1"}
answers = {}
for ranks, threads in ((1, 1), (2, 1), (3, 1), (2, 2)):
    done = subprocess.run(["mpirun", "-np", str(ranks), PROGRAM, str(threads)], env=environment, capture_output=True,
                          text=True, timeout=300)
    print(done.stdout, done.stderr, sep="")
    if done.returncode != 0:
        sys.exit(f"{ranks} ranks: exit code {done.returncode}")
    answers[ranks, threads] = done.stdout
    held = [tuple(map(int, found)) for found in re.findall(r"holds (\d+) of (\d+) packings", done.stderr)]
    if len(held) != ranks or sum(own for own, _ in held) != held[0][1]:
        sys.exit(f"{ranks} ranks hold {held} packings: together they should hold each one once")
    if max(own for own, _ in held) - min(own for own, _ in held) > 1:
        sys.exit(f"packings are shared out unevenly: {held}")
if len(set(answers.values())) != 1 or not answers[1, 1].startswith("ok hash"):
    sys.exit(f"the answers differ or fail: {answers}")
