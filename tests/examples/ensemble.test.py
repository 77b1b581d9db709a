# SPDX-License-Identifier: BSL-1.0
"""[slow] Several packings in one process: fault_rupture --seeds runs each as it would run alone, tells mean and scatter, goes on after a stop,
and says which member did not come to its end. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import pathlib
import statistics
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

program = example("fault_rupture")
FILES = ("surface.csv", "probe_A.csv", "probe_B.csv", "packing_grains.csv")


def run(folder, *options):
    command = [program.resolve(), "--quick", "--size", "8", "--grains", "64", "--throw-over-depth", "0.004", "--frames", "1", *options]
    return subprocess.run(command, cwd=folder, capture_output=True, text=True, timeout=300)


def same(one, other):
    return all((one / name).read_bytes() == (other / name).read_bytes() for name in FILES)


with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    done = run(scratch, "--seeds", "1,3,2", "--threads", "2", "--output", "all")
    expect(done.returncode == 0, f"an ensemble ends well: {done.stderr[-500:]}")
    expect("seed 3: step" in done.stderr, "its lines tell whose they are")
    alone = run(scratch, "--seed", "3", "--threads", "1", "--output", "alone")
    expect(alone.returncode == 0 and same(scratch / "all" / "seed_3", scratch / "alone"), "a member has the bits of a run of its own")

    summaries = [json.loads((scratch / "all" / f"seed_{seed}" / "summary.json").read_text()) for seed in (1, 2, 3)]
    expect([summary["seed"] for summary in summaries] == [1, 2, 3], "each folder has its own seed")
    told = json.loads((scratch / "all" / "ensemble.json").read_text())
    places = [summary["surface_x50"] for summary in summaries]
    x50 = told["measures"]["surface_x50"]
    expect(x50["count"] == 3 and abs(x50["mean"] - statistics.mean(places)) < 1e-12, f"the mean is that of the members: {x50}")
    expect(abs(x50["scatter"] - statistics.stdev(places)) < 1e-12 and x50["scatter"] > 0.0, "and the scatter")
    expect((x50["what"], x50["unit"]) == ("half of the throw has passed at x", "m"), f"a measure is told in words: {x50}")
    dip = next(line for line in done.stdout.splitlines() if line.startswith("dip from the tip"))
    expect(" degrees " in dip and 20.0 < float(dip[56:].split()[0]) < 150.0, f"angles are in degrees: {dip}")
    for seed, summary in zip((1, 2, 3), summaries):
        side = "in" if summary["error_budget"]["within"] else "out"
        expect(f"seed {seed}: {side}side its error budget" in done.stdout, f"each member has its verdict: {done.stdout[:500]}")
    with open(scratch / "all" / "surface_mean.csv") as file:
        means = [float(row["settlement"]) for row in csv.DictReader(file)]
    ends = []
    for seed in (1, 2, 3):
        with open(scratch / "all" / f"seed_{seed}" / "surface.csv") as file:
            ends.append([float(row["settlement"]) for row in csv.DictReader(file)][-len(means):])
    expect(len(means) > 5, "the mean surface has a row for each point")
    worst = max(abs(mean - statistics.mean(all_of_one)) for mean, *all_of_one in zip(means, *ends))
    expect(worst < 1e-12, f"the mean surface is that of the members' last ones: {worst}")

    again = run(scratch, "--seeds", "1,3,2", "--output", "all")
    expect(again.returncode == 2 and "all" in again.stderr, "it keeps an ensemble that is there")

    before = {path: path.read_bytes() for path in (scratch / "all").rglob("*") if path.is_file()}
    failed = subprocess.run([program.resolve(), "--quick", "--size", "8", "--grains", "1", "--seeds", "1,3,2", "--output", "all", "--overwrite"],
                            cwd=scratch, capture_output=True, text=True, timeout=300)
    after = {path: path.read_bytes() for path in (scratch / "all").rglob("*") if path.is_file()}
    expect(failed.returncode > 0 and after == before, f"packings that cannot be made replace nothing: {failed.stderr[-300:]}")

    other = run(scratch, "--seeds", "1,2", "--output", "all", "--checkpoint", "elsewhere", "--resume")
    expect(other.returncode == 2 and "all" in other.stderr, f"also from one of other seeds that resumes: {other.stderr[-300:]}")

    stopped = run(scratch, "--seeds", "1,2", "--output", "parts", "--checkpoint", "states", "--time-limit", "0.01")
    expect(stopped.returncode == 130 and "INCOMPLETE: seed 1" in stopped.stdout, f"stopped members are named: {stopped.stdout[:300]}")
    resumed = run(scratch, "--seeds", "1,2", "--output", "parts", "--checkpoint", "states", "--resume")
    expect(resumed.returncode == 0, f"and go on: {resumed.stderr[-500:]}")
    expect(same(scratch / "parts" / "seed_2", scratch / "all" / "seed_2"), "to the same bits")

    for options, named in ((("--seeds", "1"), "--seed 1"), (("--seeds", "1,1"), "twice"), (("--seeds", "1,"), "--seeds"),
                           (("--seeds", "1,x"), "--seeds"), (("--seeds", "1,2", "--seed", "3"), "--seed"),
                           (("--seeds", "1,2", "--soil", "elastic"), "without packings"),
                           (("--seeds", "1,2", "--sensitivity-file", "known.json"), "--sensitivity-file"),
                           (("--seeds", "1,2", "--sensitivity-runs"), "--sensitivity-runs")):
        refused = run(scratch, *options, "--output", "refused")
        expect(refused.returncode not in (0, 77) and named in refused.stderr and not (scratch / "refused").exists(),
               f"{options} is refused: {refused.stderr[-300:]}")

    single = run(scratch, "--seed", "2", "--output", "all", "--overwrite")
    expect(single.returncode == 0 and not (scratch / "all" / "ensemble.json").exists(), "a single run leaves no older ensemble")
    members = run(scratch, "--seeds", "1,2", "--output", "all", "--overwrite")
    left = [path.name for path in (scratch / "all").rglob("*") if path.is_file() and "seed_" not in str(path)]
    expect(members.returncode == 0 and not {"surface.csv", "probe_A.csv", "convergence.jsonl"} & set(left) and not any(name.endswith(".vtu") for name in left),
           f"an ensemble leaves no older single run: {left}")
finish()
