# SPDX-License-Identifier: BSL-1.0
"""[slow] Runs of the examples do not harm each other: an output folder belongs to one run, a refusal touches nothing, and results say what
made them. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import json
import os
import pathlib
import re
import resource
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

programs = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve()
FAULT = ["fault_rupture", "--quick", "--size", "12", "--throw-over-depth", "0.01", "--threads", "1"]
SOIL = [*FAULT, "--soil", "mohr_coulomb"]
STOPPING = ["--size", "2", "--grains", "20", "--seed", "5", "--preparation-friction", "2", "--strain", "0.03"]  # packings that lose their contacts
LONG = ["fault_rupture", "--quick", "--size", "12", "--grains", "49", "--throw-over-depth", "1", "--frames", "100000"]
TINY = {
    "rve_biaxial": ["rve_biaxial", "--grains", "60", "--seeds", "1", "--strain", "0.01", "--smoothing", "0.005",
                    "--strain-per-dem-step", "2e-5"],
    "rve_lab prepare": ["rve_lab", "prepare", "--grains", "60"],
    "rve_lab shear": ["rve_lab", "shear", "--grains", "60", "--strain", "0.002", "--strain-step", "2e-5"],
    "retaining_wall": ["retaining_wall", "--soil", "mohr_coulomb", "--size", "2", "--strain", "0.02"],
    "biaxial_specimen": ["biaxial_specimen", "--columns", "1", "--rows", "1", "--grains", "60", "--steps", "1"],
    "fault_rupture": SOIL,
}


def run(words, folder, limit=None):
    """limit: of the address space [bytes]"""
    bound = (lambda: resource.setrlimit(resource.RLIMIT_AS, (limit, limit))) if limit else None
    done = subprocess.run([programs / words[0], *words[1:]], cwd=folder, capture_output=True, text=True, timeout=120,
                          preexec_fn=bound)
    return done.returncode, done.stdout + done.stderr


def contents(folder):
    return {path.relative_to(folder): path.read_bytes() if path.is_file() else None for path in folder.rglob("*")}


def succeeded(title, words, folder):
    code, said = run(words, folder)
    expect(code == 0, f"{title}: ended with {code}\n{said[-2000:]}")


def refused(title, words, folder, *named, never=()):
    before = contents(folder)
    code, said = run(words, folder)
    expect(code == 2, f"{title}: ended with {code}\n{said[-2000:]}")
    for word in named:
        expect(word in said, f"{title}: the message does not say '{word}'\n{said[-2000:]}")
    for word in never:
        expect(word not in said, f"{title}: the message says '{word}'\n{said[-2000:]}")
    expect(contents(folder) == before, f"{title}: files have changed")


def checkpointed(output, checkpoint, *more):
    return [*SOIL, "--output", output, "--checkpoint", checkpoint, "--resume", *more]


def check_resume(folder):
    code, said = run(checkpointed("r5", "k5", "--time-limit", "1e-6"), folder)
    expect(code == 130, f"a stopped run: ended with {code}\n{said[-2000:]}")
    succeeded("another run", [*SOIL, "--tip", "1", "--output", "r6"], folder)
    refused("into another run's folder", checkpointed("r6", "k5"), folder, "r5'", never=("remove", "--overwrite"))
    refused("into a new folder", checkpointed("r7", "k5"), folder, "r5'")
    refused("a typo over a stopped run", checkpointed("r5", "k55"), folder, "k5'", never=("--overwrite",))
    refused("another scene", checkpointed("r5", "k5", "--seed", "2"), folder, "'seed = 1' there, 'seed = 2' here",
            never=("remove", "newest"))
    refused("another soil", [word.replace("mohr_coulomb", "elastic") for word in checkpointed("r5", "k5")], folder,
            "'soil = mohr_coulomb' there, 'soil = elastic' here")
    table = folder / "r5/surface.csv"
    whole = table.read_bytes()
    table.write_bytes(whole[:-9])
    refused("a table that has lost rows", checkpointed("r5", "k5"), folder, "surface.csv' has")
    table.write_bytes(whole)
    succeeded("its own", checkpointed("r5", "k5"), folder)
    refused("a typo over a finished run", checkpointed("r5", "k55"), folder, "finished", "k5'")
    succeeded("its own, finished", checkpointed("r5", "k5"), folder)
    expect(json.loads((folder / "r5/run.json").read_text())["state"] == "finished", "run.json does not say that it has finished")


def check_repeat(folder):
    for title, words in TINY.items():
        words = [*words, "--output", title.replace(" ", "_")]
        succeeded(title, words, folder)
        refused(f"{title}, again", words, folder, "--overwrite", "finished")
        succeeded(f"{title}, over the old results", [*words, "--overwrite"], folder)
    succeeded("a packing", [*TINY["rve_lab prepare"], "--output", "lab"], folder)
    succeeded("its shearing in the same folder", ["rve_lab", "shear", "--packing", "lab/packing.packing", "--strain", "0.002",
                                                  "--strain-step", "2e-5", "--output", "lab"], folder)


def check_records(folder):
    """After check_repeat, in its folder."""
    for title in TINY:
        output = folder / title.replace(" ", "_")
        record = json.loads(next(path for path in output.glob("run*.json")).read_text())
        help_text = run([*TINY[title][:2 if " " in title else 1], "--help"], folder)[1]
        names = set(re.findall(r"^  (?:-o,)?--([a-z0-9-]+)", help_text, re.M)) - {"help", "version"}
        expect(len(names) > 8, f"{title}: only the options {names} in its help")
        expect(names == set(record["options"]), f"{title}: run.json differs in {names ^ set(record['options'])}")
        told = [record["build"]]
        if (output / "summary.json").exists():
            summary = json.loads((output / "summary.json").read_text())["run"]
            expect(summary["options"] == record["options"], f"{title}: summary.json has other options than run.json")
            told.append(summary)
        for lines in told:
            expect(all(lines.get(name) for name in ("version", "commit", "compiler", "processor")), f"{title}: {lines}")
    options = json.loads((folder / "fault_rupture/summary.json").read_text())["run"]["options"]
    expect((options["soil"], options["size"], options["case"], options["quick"]) == ("mohr_coulomb", "12", "free", "true"),
           f"fault_rupture: options {options}")


def check_walls(folder):
    """A wall that stops is recorded so; options of packings are told to have no effect on ground without."""
    code, said = run(["retaining_wall", *STOPPING, "--output", "stopped"], folder)
    state = json.loads((folder / "stopped/run.json").read_text())["state"]
    summary = json.loads((folder / "stopped/summary.json").read_text())
    reason = next((summary[movement]["status"] for movement in ("active", "passive") if summary[movement]["status"] != "ok"), "ok")
    expect(code == 1 and "movement stopped at the strain" in said, f"a wall that stops: ended with {code}\n{said[-1000:]}")
    expect(state == summary.get("status") == reason != "ok", f"it is recorded as {state}, {summary.get('status')}, {reason}")
    unused = {"--grains": "50", "--seed": "7", "--preparation-friction": "0.3", "--threads": "2"}
    words = [word for option in unused.items() for word in option]
    code, said = run([*TINY["retaining_wall"], *words, "--output", "unused"], folder)
    expect(code == 0 and all(f"{option} has no effect" in said for option in unused), f"ended with {code}\n{said}")
    code, said = run([*TINY["retaining_wall"], "--output", "used"], folder)
    expect(code == 0 and "no effect" not in said, f"ended with {code}\n{said}")


def check_two_at_once(folder):
    with subprocess.Popen([programs / LONG[0], *LONG[1:], "--output", "out"], cwd=folder, stdout=subprocess.DEVNULL,
                          stderr=subprocess.PIPE, text=True) as process:
        line = process.stderr.readline()
        while line and not line.startswith("step"):
            line = process.stderr.readline()
        code, said = run([*SOIL, "--output", "out"], folder)
        expect(code == 2 and f"process {process.pid}" in said, f"a second run: ended with {code}\n{said}")
        code, said = run([*SOIL, "--output", "out", "--overwrite"], folder)
        expect(code == 2 and "is in use" in said, f"a second run that may overwrite: ended with {code}\n{said}")
        expect(process.poll() is None, "the first run has ended by itself")
        process.kill()
        process.wait()
    code, said = run([*SOIL, "--output", "out"], folder)
    expect(code == 2 and "not finished" in said, f"after a run that was killed: ended with {code}\n{said}")
    succeeded("over a run that was killed", [*SOIL, "--output", "out", "--overwrite"], folder)


def check_folders(folder):
    (folder / "circle").symlink_to("circle")
    for title, words in TINY.items():
        for output in ("circle/out", "/proc/scarp"):
            refused(f"{title} into {output}", [*words, "--output", output], folder, output.split("/")[1],
                    never=("preparing", "friction", "terminate"))
    for place in ("circle/states", "/proc/states"):
        refused(f"checkpoints in {place}", [*SOIL, "--checkpoint", place], folder, "states", never=("preparing",))


def check_memory(folder):
    code, said = run(["fault_rupture", "--elements", "60000", "--threads", "1"], folder, 3 * 1024**3)
    expect(code == 2 and re.search(r"400 grains would need about 15\.\d GB of memory \(\d\.\d GB are left by .*ulimit", said),
           f"too many triangles: ended with {code}\n{said}")
    code, said = run(["fault_rupture", "--elements", "1000000", "--grains", "100000"], folder)
    expect(code == 2 and "GB are left by" in said, f"far too many: ended with {code}\n{said}")
    expect(not list(folder.iterdir()), "a run that would take too much memory leaves files")
    # Enough to start, by two megabytes: a packing of this size needs more than five.
    start = next(size for size in range(4, 400, 2) if run(["rve_lab", "--version"], folder, size * 1024**2)[0] == 0)
    code, said = run(["rve_lab", "prepare", "--grains", "100000"], folder, (start + 2) * 1024**2)
    expect(code > 0 and "--grains 100000" in said and "out of memory" in said, f"no memory: ended with {code}\n{said}")


def check_values(folder):
    for option in ("--seed", "--mesh-seed"):
        for value in ("-1", "12345678901234567890123", "1.5"):
            refused(f"{option} {value}", [*SOIL, f"{option}={value}"], folder, option, value)
    for title in ("rve_biaxial", "rve_lab prepare", "retaining_wall", "biaxial_specimen"):
        refused(f"{title}, a negative seed", [*TINY[title], "--seed=-1"], folder, "--seed")
    refused("a probe beside the ground", [*SOIL, "--probe-a-x", "1000"], folder, "probe A", "1000")
    refused("a probe above the ground", [*SOIL, "--probe-b-y", "26"], folder, "probe B", "26")
    refused("two sizes", [*SOIL, "--elements", "500"], folder, "excludes", "--elements")
    code, said = run(["provider_swap", "--help"], folder)
    expect(code == 0 and "--version" in said and "throw" not in said, f"provider_swap --help: ended with {code}\n{said}")
    code, said = run([*TINY["rve_biaxial"], "--overwrite"], folder)
    expect(code == 0 and "largest where the test ends, which is no peak" in said, f"a test that ends before its peak: ended with {code}\n{said}")
    code, said = run(["rve_biaxial", "--help"], folder)
    expect(re.search(r"--grains .*=400", said) and re.search(r"--strain .*=0\.2", said),
           f"rve_biaxial --help shows no defaults\n{said}")


def check_material(folder):
    succeeded("a packing", [*TINY["rve_lab prepare"], "--friction", "0.3", "--output", "made"], folder)
    shear = ["rve_lab", "shear", "--packing", "made/packing.packing", "--strain", "0.002", "--strain-step", "2e-5", "--output", "out"]
    for option, value in (("--grains", "50"), ("--pressure", "1e5"), ("--seed", "3")):
        refused(f"{option} for a packing that is there", [*shear, option, value], folder, option, "--packing")
    (folder / "made/packing.sand").rename(folder / "elsewhere.sand")
    before = contents(folder)
    code, said = run(shear, folder)
    expect(code == 2 and "packing.sand" in said and "--friction" in said, f"no material: ended with {code}\n{said}")
    expect(contents(folder) == before, "a packing without material leaves files")
    material = ["--shape", "disc", "--law", "linear", "--normal-stiffness", "6e6", "--tangential-stiffness", "6e6",
                "--friction", "0.3"]
    succeeded("a material by options", [*shear, *material], folder)


if not all((programs / name).is_file() for name in ("fault_rupture", "rve_lab", "rve_biaxial", "biaxial_specimen",
                                                     "retaining_wall", "provider_swap")):
    print(f"skipped: no programs in {programs} (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
for checks in ((check_resume,), (check_repeat, check_records), (check_walls,), (check_two_at_once,), (check_folders,), (check_memory,),
               (check_values,), (check_material,)):
    with tempfile.TemporaryDirectory() as scratch:
        for check in checks:
            started = time.monotonic()
            check(pathlib.Path(scratch))
            print(f"{check.__name__}: {time.monotonic() - started:.1f} s", flush=True)
finish()
