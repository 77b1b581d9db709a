# SPDX-License-Identifier: BSL-1.0
"""[slow] A fault scene that is killed at random moments goes on from its checkpoints, with any number of threads, and ends with the bits
of a run that nobody disturbed. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without);
SCARP_KILLS, how often each scene is killed (3); SCARP_SEED, of the moments; SCARP_SCENES=all, every soil with every
structure."""
import csv
import io
import json
import os
import pathlib
import random
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

FAULT = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / "fault_rupture"
KILLS = int(os.environ.get("SCARP_KILLS", "3"))
SEED = int(os.environ.get("SCARP_SEED", "1"))
SCENES = {
    "packings": ["--quick", "--size", "12", "--grains", "49", "--throw-over-depth", "0.01"],
    "frictional footing": ["--quick", "--soil", "mohr_coulomb", "--case", "light", "--footing", "frictional",
                           "--throw-over-depth", "0.02"],
}
if os.environ.get("SCARP_SCENES") == "all":
    for soil in ("dem", "mohr_coulomb", "elastic"):
        for structure in ("free", "tied", "frictional"):
            case = ["--case", "free"] if structure == "free" else ["--case", "heavy", "--footing", structure]
            SCENES[f"{soil}, {structure}"] = ["--quick", "--grains", "49", "--soil", soil, *case,
                                              "--throw-over-depth", "0.005"]
WALL_TIMES = ("threads", "cpu_seconds", "wall_seconds", "peak_memory_bytes", "share_of_time_in_points", "share_of_time_in_rves", "share_of_time_outside_rves",
              "share_of_time_outside_points", "run", "seconds", "seconds_in_points", "share_outside_points")


def command(scene, *more):
    return [str(FAULT), *SCENES[scene], "--output", "out", *more]


def saving(scene, threads):
    return command(scene, "--checkpoint", "states", "--resume", "--checkpoint-every", "0", "--threads", str(threads))


def run(words, folder):
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=120)
    return done.returncode, done.stdout + done.stderr


def lasting(values):
    return {key: value for key, value in values.items() if key not in WALL_TIMES}


def results(folder):
    """All files of the output folder, without what tells of wall time or of the run, and without files under a temporary name, which
    a process that is killed while it writes leaves behind."""
    found = {}
    for path in folder.rglob("*"):
        if path.is_file() and ".partial-" not in path.name and path.name not in ("run.json", "run.lock"):
            found[str(path.relative_to(folder))] = path.read_bytes()
    rows = list(csv.DictReader(io.StringIO(found["convergence.csv"].decode())))
    found["convergence.csv"] = [lasting(row) for row in rows]
    found["convergence.jsonl"] = [lasting(json.loads(line)) for line in found["convergence.jsonl"].splitlines()]
    found["summary.json"] = lasting(json.loads(found["summary.json"]))
    lines = found["summary.txt"].splitlines()
    found["summary.txt"] = [line for line in lines if not line.startswith(b"share of the time")]
    return found


def check_same(title, folder, expected):
    found = results(folder)
    expect(sorted(found) == sorted(expected), f"{title}: other files: {sorted(set(found) ^ set(expected))}")
    for name in expected:
        expect(found.get(name) == expected[name], f"{title}: {name} differs")


def kill_once(scene, folder, chance, seconds):
    """Starts or continues a run and kills it: at a random moment, or after its third step where seconds is None.
    Tells whether it was killed and whether it had gone on from a checkpoint."""
    with subprocess.Popen(saving(scene, chance.choice((1, 2, 3))), cwd=folder, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True) as process:
        if seconds is None:
            seen = []
            while len(seen) < 3 and (line := process.stderr.readline()):
                seen += [line] if line.startswith("step") else []
            process.kill()
        else:
            try:
                process.wait(seconds)
            except subprocess.TimeoutExpired:
                process.kill()
        said = process.stderr.read()
        process.wait()
        killed = process.returncode < 0
        expect(killed or process.returncode == 0, f"{scene}: ended with {process.returncode}\n{said[-2000:]}")
        return killed, "resuming from" in said


def check_kills(scene):
    chance = random.Random(f"{SEED} {scene}")
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        started = time.monotonic()
        code, said = run(command(scene, "--threads", "1"), scratch)
        whole = time.monotonic() - started
        expect(code == 0, f"{scene}: the undisturbed run ended with {code}\n{said[-2000:]}")
        if code != 0:
            return
        expected = results(scratch / "out")
        kills = continued = chains = 0
        while kills < KILLS or chains == 0:
            chains += 1
            folder = scratch / f"chain_{chains}"
            folder.mkdir()
            first = chains == 1
            while True:
                killed, went_on = kill_once(scene, folder, chance, None if first else chance.uniform(0.0, whole))
                first = False
                kills += killed
                continued += went_on
                if not killed or kills >= KILLS:
                    break
            if killed:
                code, said = run(saving(scene, chance.choice((1, 2, 3))), folder)
                continued += "resuming from" in said
                expect(code == 0, f"{scene}: the last part ended with {code}\n{said[-2000:]}")
            check_same(f"{scene}, run {chains} after {kills} kills in all", folder / "out", expected)
        expect(continued > 0, f"{scene}: no run went on from a checkpoint")
        print(f"{scene}: {kills} kills, {continued} times gone on from a checkpoint, {chains} runs to the end, "
              f"{len(expected)} files each, undisturbed {whole:.1f} s")


def check_stops_and_refusals():
    scene = "packings"
    with tempfile.TemporaryDirectory() as scratch:
        scratch = pathlib.Path(scratch)
        code, said = run([*saving(scene, 2), "--time-limit", "1e-6"], scratch)
        expect(code == 130, f"time limit: ended with {code}\n{said}")
        states = sorted((scratch / "states").iterdir())
        expect(len(states) >= 1, "time limit: nothing was saved")
        before = {path: path.read_bytes() for path in scratch.rglob("*") if path.is_file()}

        def check_refused(title, words, named):
            code, said = run(words, scratch)
            expect(code == 2 and named in said, f"{title}: ended with {code}\n{said}")
            found = {path: path.read_bytes() for path in scratch.rglob("*") if path.is_file()}
            expect(found == before, f"{title}: files have changed")

        check_refused("another scene", [*saving(scene, 1), "--tip", "0.5"], "'tip = 0' there, 'tip = 0.5' here")
        check_refused("no --resume", [word for word in saving(scene, 1) if word != "--resume"], "--resume")
        check_refused("--resume alone", command(scene, "--resume"), "--checkpoint")
        whole = states[-1].read_bytes()
        for title, harmed, named in (("a damaged checkpoint", whole[:99] + bytes([whole[99] ^ 1]) + whole[100:],
                                      "have changed"), ("a cut checkpoint", whole[:-7], "cut off"),
                                     ("another version", whole[:12] + b"\x63" + whole[13:], "of version")):
            states[-1].write_bytes(harmed)
            before[states[-1]] = harmed
            check_refused(title, saving(scene, 1), named)


if not FAULT.is_file():
    print(f"skipped: no program {FAULT} (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
print(f"seed {SEED}")
for scene in SCENES:
    check_kills(scene)
check_stops_and_refusals()
finish()
