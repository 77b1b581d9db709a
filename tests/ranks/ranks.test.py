# SPDX-License-Identifier: BSL-1.0
"""[slow] A small fault in packings, dry and in water, has the same bits on one, two and three MPI ranks of one or two threads, and no rank keeps a packing of
another; stopped and gone on from checkpoints by other numbers of ranks it ends with these bits too. Environment:
SCARP_TEST_PROGRAMS, the folder of ground_on_ranks (skipped, exit 77, without it or mpirun)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

PROGRAM = pathlib.Path(os.environ.get("SCARP_TEST_PROGRAMS", "nowhere")) / "ground_on_ranks"
if not PROGRAM.exists() or shutil.which("mpirun") is None:
    print("skipped: no MPI here")
    sys.exit(77)

# Open MPI otherwise refuses more ranks than cores, and the root user of a container.
environment = {**os.environ, "OMPI_ALLOW_RUN_AS_ROOT": "1", "OMPI_ALLOW_RUN_AS_ROOT_CONFIRM": "1",
               "OMPI_MCA_rmaps_base_oversubscribe": "1"}


def run(ranks, *arguments, resumes=0):
    """What the root rank prints. Every packing is held once, and evenly; `resumes` ranks go on from a checkpoint."""
    done = subprocess.run(["mpirun", "-np", str(ranks), PROGRAM, *map(str, arguments)], env=environment,
                          capture_output=True, text=True, timeout=300)
    print(done.stdout, done.stderr, sep="")
    if done.returncode != 0:
        sys.exit(f"{ranks} ranks: exit code {done.returncode}")
    held = [tuple(map(int, found)) for found in re.findall(r"holds (\d+) of (\d+) packings", done.stderr)]
    if len(held) != ranks or sum(own for own, _ in held) != held[0][1]:
        sys.exit(f"{ranks} ranks hold {held} packings: together they should hold each one once")
    if max(own for own, _ in held) - min(own for own, _ in held) > 1:
        sys.exit(f"packings are shared out unevenly: {held}")
    if done.stderr.count("went on from a checkpoint") != resumes:
        sys.exit(f"{resumes} ranks should have gone on from a checkpoint")
    return done.stdout


for length in (0, 40, "wet"):  # [m], of points that look around themselves; in water
    answers = {(ranks, threads): run(ranks, threads, length) for ranks, threads in ((1, 1), (2, 1), (3, 1), (2, 2))}
    whole = answers[1, 1]
    if len(set(answers.values())) != 1 or not whole.startswith("ok hash"):
        sys.exit(f"length {length}: the answers differ or fail: {answers}")
    with tempfile.TemporaryDirectory() as folder:
        for ranks, attempts, resumes in ((2, 3, 0), (3, 2, 3), (1, 1, 1)):
            stopped = run(ranks, 1, length, folder, attempts, resumes=resumes)
            if not stopped.startswith("not_converged"):
                sys.exit(f"length {length}: {ranks} ranks did not stop after {attempts} attempts: {stopped}")
        resumed = run(2, 1, length, folder, resumes=2)
    if resumed != whole:
        sys.exit(f"length {length}: gone on from checkpoints of 2, 3 and 1 ranks: '{resumed}', in one go: '{whole}'")
