# SPDX-License-Identifier: BSL-1.0
"""[slow] Footings of fault_rupture stand: all cases and bases, the whole throw on Mohr-Coulomb ground, the beginning of it on packings.
Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without); SCARP_THROW=whole: packings too go to
h/H = 0.085."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

program = example("fault_rupture")
PART = [] if os.environ.get("SCARP_THROW") == "whole" else ["--throw-over-depth", "0.004", "--grains", "49"]
# What carries the weight may differ from it by as much, and the share of the attempts that may be refused.
SOILS = {"mohr_coulomb": ([], 1e-8, 0.05), "dem": (PART, 1e-2, 0.05)}
with tempfile.TemporaryDirectory() as scratch:
    for soil, (more, unbalanced, refused) in SOILS.items():
        for case, bases in (("free", ["tied"]), ("light", ["tied", "frictional"]), ("heavy", ["tied", "frictional"])):
            for base in bases:
                title = f"{soil}, {case}, {base}"
                began = time.monotonic()
                done = subprocess.run([program.resolve(), "--quick", "--soil", soil, "--case", case, "--footing", base, *more,
                                       "--frames", "1", "--output", title.replace(", ", "_")],
                                      cwd=scratch, capture_output=True, text=True)
                expect(done.returncode == 0, f"{title}: ended with {done.returncode}: {done.stderr[-500:]}")
                if done.returncode != 0:
                    continue
                told = json.loads(pathlib.Path(scratch, title.replace(", ", "_"), "summary.json").read_text())
                tries = told["steps"] + told["rejected_steps"]
                print(f"{title}: {told['steps']} steps, {told['rejected_steps']} refused, {told['iterations']} iterations, "
                      f"{time.monotonic() - began:.0f} s")
                expect(told["rejected_steps"] <= refused * tries, f"{title}: {told['rejected_steps']} of {tries} attempts were refused")
                # Of every part: a tied footing's and a frictional one's are over its own weight.
                expect(told["max_accepted_residual"] <= 1e-2, f"{title}: a residual of {told['max_accepted_residual']} was accepted")
                expect(told["vertical_stress_error"] <= 1e-2, f"{title}: vertical stress is wrong by {told['vertical_stress_error']}")
                if case != "free":
                    expect("sheared by 0 %" not in done.stderr, f"{title}: it warns of an element that nothing has sheared: {done.stderr[:1000]}")
                    for table in ("probe_A.csv", "convergence.csv"):
                        with open(pathlib.Path(scratch, title.replace(", ", "_"), table), newline="") as rows:
                            throws = [float(row["throw_over_depth"]) for row in csv.DictReader(rows)]
                        expect(min(throws) == 0.0 < max(throws), f"{title}: throws of {table} begin at {min(throws)}")
                    expect(told["force_imbalance"] <= unbalanced, f"{title}: the ground carries {told['force_imbalance']} too much or little")
    # More than the ground bears: the run ends while a part of the weight acts.
    done = subprocess.run([program.resolve(), "--quick", "--soil", "mohr_coulomb", "--case", "heavy", "--bearing-pressure", "1e7", "--frames", "1",
                           "--output", "sunk"], cwd=scratch, capture_output=True, text=True)
    expect(done.returncode == 3, f"a footing that sinks: ended with {done.returncode}: {done.stderr[-500:]}")
    told = json.loads(pathlib.Path(scratch, "sunk", "summary.json").read_text())
    with open(pathlib.Path(scratch, "sunk", "footing.csv"), newline="") as rows:
        last = list(csv.DictReader(rows))[-1]
    expect(-1.0 < float(last["load"]) < 0.0, f"it ends at a load of {last['load']}")
    for key, column in (("contact_pressure_min", "pressure_min"), ("contact_pressure_max", "pressure_max")):
        expect(abs(told[key] / float(last[column]) - 1.0) < 1e-9, f"{key} is {told[key]}, the last row {last[column]}")
    expect(told["force_imbalance"] < 1e-6, f"the ground carries {told['force_imbalance']} of the weight too much or little")
finish()
