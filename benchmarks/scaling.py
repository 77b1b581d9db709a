# SPDX-License-Identifier: BSL-1.0
"""Wall time of the local fault_rupture on one thread, two threads and two MPI ranks of one thread, in turns on a machine that should be
idle otherwise: each run's time in load steps, and the ratios of the medians."""
import argparse
import json
import pathlib
import statistics
import subprocess
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
TEAMS = {"one thread": ([], "1"), "two threads": ([], "2"), "two ranks": (["--ranks", "2"], "1")}


def seconds_in_steps(ranks, threads, throw):
    """Wall time of all attempts at load steps, without set-up."""
    with tempfile.TemporaryDirectory() as folder:
        subprocess.run([ROOT / "examples/run", *ranks, "fault_rupture", "--local", "--no-figures", "--threads", threads, "--frames", "1",
                        "--throw-over-depth", throw, "--output", folder], check=True, stdout=subprocess.DEVNULL)
        lines = map(json.loads, (pathlib.Path(folder) / "convergence.jsonl").read_text().splitlines())
        return sum(line["seconds"] for line in lines if line["kind"] == "step")


def main():
    options = argparse.ArgumentParser(description=__doc__)
    options.add_argument("--repetitions", type=int, default=3)
    options.add_argument("--throw-over-depth", type=float, default=0.012, help="where each run ends")
    asked = options.parse_args()
    if asked.repetitions < 1:
        options.error("--repetitions: at least one run of each is needed")
    times = {team: [] for team in TEAMS}
    for _ in range(asked.repetitions):
        for team, (ranks, threads) in TEAMS.items():
            times[team].append(seconds_in_steps(ranks, threads, str(asked.throw_over_depth)))
            print(f"{team}: {times[team][-1]:.1f} s", flush=True)
    alone = statistics.median(times["one thread"])
    for team, seconds in times.items():
        print(f"{team}: median {statistics.median(seconds):.1f} s, {alone / statistics.median(seconds):.2f} times as fast")


if __name__ == "__main__":
    main()
