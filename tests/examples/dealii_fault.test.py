# SPDX-License-Identifier: BSL-1.0
"""[nightly] dealii_fault: elastic ground settles as the closed form says; two processes find what one finds, with and without means; the
sum of forces survives a refinement, and cells that are joined again; a saved run goes on with two processes; a folder without a run is refused.
Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without; it is not built where there is no deal.II)."""
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

program = example("dealii_fault").resolve()
NUMBER = r"(-?[\d.]+(?:e[+-]?\d+)?)"
environment = dict(os.environ, OMPI_ALLOW_RUN_AS_ROOT="1", OMPI_ALLOW_RUN_AS_ROOT_CONFIRM="1",
                   OMPI_MCA_rmaps_base_oversubscribe="1", OMPI_MCA_mpi_yield_when_idle="1")


def run(*options, ranks=1, code=0):
    """-> what the program prints, of so many processes."""
    launcher = ["mpirun", "-np", str(ranks), "--bind-to", "none"] if ranks > 1 else []
    done = subprocess.run([*launcher, program, *options], cwd=scratch, capture_output=True, text=True, timeout=60, env=environment)
    expect(done.returncode == code, f"{options} on {ranks}: ended with {done.returncode}: {done.stdout[-300:]} {done.stderr[-300:]}")
    return done.stdout + done.stderr


def found(text, what):
    """-> every number that follows these words."""
    return [float(value) for value in re.findall(f"{what} {NUMBER}", text)]


def expect_near(first, second, share, what):
    expect(first and second and abs(first[-1] - second[-1]) <= share * abs(second[-1]), f"{what}: {first} and {second}")


with tempfile.TemporaryDirectory() as scratch:
    run("--block")  # compares with the closed form itself
    soil = ("--size", "5", "--throw-over-depth", "0.02")
    for options in (("--newton", *soil), (*soil, "--length", "8")):
        one, two = run(*options), run(*options, ranks=2)
        # The residuals, 1e-8 and 1e-5, let the path differ by a hundred times as much.
        share = 1e-6 if "--newton" in options else 1e-3
        for what in ("x50", "profile mean", "reaction"):
            expect_near(found(one, what), found(two, what), share, f"{options}: {what} on one and two processes")
    sand = ("--soil", "dem", "--size", "8", "--throw-over-depth", "0.003", "--checkpoint", "saved")
    start = run(*sand, "--stop-at", "0.05")
    shutil.copytree(pathlib.Path(scratch, "saved"), pathlib.Path(scratch, "copy"))
    one = run(*sand, "--resume")
    shutil.rmtree(pathlib.Path(scratch, "saved"))
    pathlib.Path(scratch, "copy").rename(pathlib.Path(scratch, "saved"))
    two = run(*sand, "--resume", ranks=2)
    for resumed in (one, two):  # six digits are printed
        expect_near(found(resumed, "reaction")[:1], found(start, "reaction"), 1e-5, "reaction right after a run is resumed")
    for what in ("x50", "reaction"):  # packings magnify round-off, up to what a residual of 1e-3 lets differ
        expect_near(found(two, what), found(one, what), 1e-2, f"{what} of a saved run that goes on with one and two processes")
    expect("saved by another run" in run(*sand, "--resume", "--grains", "90", code=1), "another run's states were taken")
    expect("is not the folder of a saved run" in run("--checkpoint", "nowhere", "--resume", code=1), "a folder without a run was taken")
    adaptive = ("--size", "5", "--levels", "1")
    fine = run(*adaptive, "--throw-over-depth", "0.03", "--refine-at", "0.005", "--checkpoint", "joined1")
    shutil.copytree(pathlib.Path(scratch, "joined1"), pathlib.Path(scratch, "joined2"))
    cells, forces = found(fine, "(?:before|after) refinement:"), found(fine, "reaction")
    expect(len(cells) > 1 and cells[1] > cells[0], f"cells {cells} before and after refinements")
    expect_near(forces[1:2], forces[:1], 0.05, "reaction over a refinement")  # measured: below 2 %, docs/dealii.md
    for ranks in (1, 2):  # a bound that no cell reaches joins all that were divided
        coarse = run(*adaptive, "--resume", "--checkpoint", f"joined{ranks}", "--throw-over-depth", "0.05", "--refine-at", "1", ranks=ranks)
        cells, forces = found(coarse, "(?:before|after) refinement:"), found(coarse, "reaction")
        expect(len(cells) > 1 and cells[0] == 91 and cells[-1] == 55, f"cells {cells} before and after they are joined, on {ranks}")
        expect_near(forces[2:3], forces[1:2], 0.1, f"reaction when cells are joined, on {ranks}")  # measured: below 5 %
finish()
