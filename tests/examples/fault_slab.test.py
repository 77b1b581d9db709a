# SPDX-License-Identifier: BSL-1.0
"""[nightly] fault_slab: a slab whose fault is the same along the strike tells one answer for any number of elements there, on packings of
spheres too; one that dies out tells a smaller settlement towards its end; a stopped run goes on with the same results.
Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

program = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / "fault_slab"
if not program.is_file():
    print("skipped: no fault_slab (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
DEPTH = 25.0


def run(*options, code=0, resumed=False):
    """-> (summary, [[settlement from left to right] for each line of nodes across the fault]) of a run in a folder of its own."""
    global number
    number += not resumed
    words = [program.resolve(), "--quick", "--threads", "1", "--frames", "1", "--output", str(number), *options]
    done = subprocess.run(words, cwd=scratch, capture_output=True, text=True, timeout=120)
    expect(done.returncode == code, f"{options}: ended with {done.returncode}: {done.stderr[-500:]}")
    if code == 2:
        return done.stderr, []
    folder = pathlib.Path(scratch, str(number))
    with open(folder / "surface.csv") as file:
        rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
    lines = {}
    for row in rows:
        lines.setdefault(row["y"], []).append(row["settlement"])
    return json.loads((folder / "summary.json").read_text()), list(lines.values())


def largest_difference(lines, others):
    """Of every line of nodes from the mean of the others [m]."""
    mean = [sum(settlements) / len(others) for settlements in zip(*others, strict=True)]
    return max(abs(settlement - usual) for line in lines for settlement, usual in zip(line, mean, strict=True))


number = 0
with tempfile.TemporaryDirectory() as scratch:
    for soil, tolerance, allowed in (("mohr_coulomb", "1e-8", 1e-6), ("dem", "1e-4", 5e-3)):
        # Of the throw. Mohr-Coulomb: a hundred times the residual. Packings: 1e-3 is what a residual of 1e-4 lets differ.
        alike = ("--soil", soil, "--slip", "uniform", "--length", "0", "--tolerance", tolerance,
                 "--throw-over-depth", "0.004")
        _, one = run(*alike, "--across", "1", "--elements", "32")
        _, many = run(*alike, "--across", "3", "--elements", "96")
        throw = 0.004 * DEPTH
        expect((len(one), len(many)) == (2, 4), f"{soil}: {len(one)} and {len(many)} lines of nodes")
        difference = largest_difference(many, one) / throw
        expect(difference < allowed, f"{soil}: three elements along the strike differ from one by {difference} of the throw")
        expect(max(map(max, many)) > 0.5 * throw, f"{soil}: the surface has hardly settled")

    tapered, _ = run("--soil", "mohr_coulomb")
    expect(tapered["near"]["share_of_throw"] == 1.0 and tapered["far"]["share_of_throw"] == 0.0, "no taper")
    settled = [section["settlement_max"] for section in tapered["sections"]]
    expect(settled == sorted(settled, reverse=True) and settled[-1] < 0.5 * settled[0], f"settlements are {settled}")
    expect(tapered["far"]["x50"] is None, "half of no throw has a place")

    whole = ("--soil", "mohr_coulomb", "--throw-over-depth", "0.004")
    _, straight = run(*whole)
    number += 1
    run(*whole, "--checkpoint", "states", "--time-limit", "1e-6", code=130, resumed=True)
    _, gone_on = run(*whole, "--checkpoint", "states", "--resume", resumed=True)
    expect(gone_on == straight, "a run that was stopped at once and went on has other results")

    said, _ = run("--across", "0", code=2)
    expect("--across" in said, f"the message is {said}")
    said, _ = run("--length", "30", code=2)
    expect("--length is 30 m" in said and "25 m deep" in said, f"the message is {said}")
    words = [program.resolve(), "--quick", "--soil", "mohr_coulomb", "--grains", "99", "--seed", "4", "--time-limit", "1e-6", "--output", "unused"]
    said = subprocess.run(words, cwd=scratch, capture_output=True, text=True, timeout=120).stderr
    expect("--grains has no effect" in said and "--seed has no effect" in said, f"the message is {said}")
    said, _ = run("--elements", "2", code=2)
    expect("2 elements" in said, f"the message is {said}")
finish()
