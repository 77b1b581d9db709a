# SPDX-License-Identifier: BSL-1.0
"""[slow] Random valid options of every example that has many: it runs for about a second and ends well, says why it does not go on, or is
killed; never a crash, a report of a sanitizer, a file that is cut off or a summary that does not parse. Environment: SCARP_EXAMPLES,
the folder of the built programs (skipped, exit 77, without); SCARP_DRAWS, runs of each program (2); SCARP_SEED, of the draws;
SCARP_ONLY, one program."""
import json
import math
import os
import pathlib
import random
import re
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

PROGRAMS = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve()
DRAWS = int(os.environ.get("SCARP_DRAWS", "2"))
SEED = int(os.environ.get("SCARP_SEED", "1"))
SECONDS = 1  # that a run is given
GRACE = 90  # seconds after which a run that should end by itself counts as hanging: neither the preparation nor one answer of all
            # points, of up to 20 000 steps each, is cut short


def between(low, high):
    """Mostly inside, now and then at the ends."""
    return lambda chance: f"{chance.choice((low, high)) if chance.random() < 0.1 else chance.uniform(low, high):.6g}"


def decades(low, high):
    return lambda chance: f"{math.exp(chance.uniform(math.log(low), math.log(high))):.6g}"


def whole(low, high):
    return lambda chance: str(round(math.exp(chance.uniform(math.log(low + 1), math.log(high + 1))) - 1))


def one_of(*words):
    return lambda chance: chance.choice(words)


def several(draw, most=3):
    return lambda chance: ",".join(draw(chance) for _ in range(chance.randint(1, most)))


flag = None
SEEDS = lambda chance: str(chance.choice((0, 1, 999999999999999, chance.randrange(10**6))))
MATERIAL = {"shape": one_of("disc", "ellipse", "superellipse"), "law": one_of("linear", "hertz", "rolling"),
            "normal-stiffness": decades(1e3, 1e9), "tangential-stiffness": decades(1e3, 1e9), "friction": between(0, 2),
            "modulus": decades(1e6, 1e11), "poisson": between(0, 0.5), "rolling-stiffness": decades(1e-3, 1e6),
            "rolling-friction": between(0, 1)}
CLOUD = {"aspect": between(0.1, 1), "exponent": between(0.2, 2), "grains": whole(1, 200), "seed": SEEDS,
         "density": decades(1, 1e5), "thickness": decades(1e-3, 1e2), "pressure": decades(1, 1e8),
         "smallest": decades(1e-4, 1e-1), "largest": decades(1e-4, 1e-1)}
# program: words before the options, its options, and whether it stops by itself in time
TABLE = {
    "fault_rupture": (["--quick", "--time-limit", str(SECONDS)], {
        "case": one_of("free", "heavy", "light"), "soil": one_of("dem", "mohr_coulomb", "elastic"),
        "footing": one_of("tied", "frictional"), "footing-centre": between(-45, 18), "footing-width": decades(1, 20),
        "bearing-pressure": between(0, 1e6), "base-friction": between(0, 2), "size": between(4, 25),
        "pattern": one_of("crossed", "left", "right", "jittered"), "aspect": between(0.3, 3), "mesh-seed": SEEDS,
        "grains": whole(1, 100), "seed": SEEDS, "preparation-friction": between(0, 1), "overconsolidation-ratio": between(1, 3), "grain-aspect": between(0.1, 1),
        "grain-friction": between(0, 2), "peak-friction-angle": between(20, 50), "peak-dilation-angle": between(0, 20),
        "residual-friction-angle": between(10, 30), "softening-strain": decades(1e-3, 1), "young-modulus": decades(1e5, 1e9), "k0": between(0.2, 2),
        "throw-over-depth": decades(1e-4, 1), "dip": between(5, 90), "reverse": flag, "tip": between(-50, 22),
        "tolerance": decades(1e-9, 0.5), "max-displacement-gradient": decades(1e-5, 0.2), "max-iterations": whole(1, 1000),
        "strain-per-dem-step": decades(1e-7, 1e-3), "min-dem-steps": whole(1, 500), "unbalanced-tolerance": decades(1e-5, 0.9),
        "threads": one_of("0", "1", "2", "3"), "frames": whole(1, 100000), "probe-a-x": between(-50, 22),
        "probe-a-y": between(0.1, 24), "checkpoint-every": one_of("0", "1")}, True),
    "rve_biaxial": ([], {
        "grains": whole(1, 100), "seeds": whole(1, 3), "seed": SEEDS, "preparation-friction": several(between(0, 2)),
        "pressure": decades(1, 1e8), "strain": decades(1e-4, 1), "strain-per-dem-step": decades(1e-7, 1e-3),
        "smoothing": decades(1e-5, 0.5)}, False),
    "rve_lab prepare": ([], {**MATERIAL, **CLOUD, "preparation-friction": between(0, 2), "format": one_of("yade", "lammps")}, False),
    "rve_lab shear": ([], {**MATERIAL, **CLOUD, "path": one_of("biaxial", "simple_shear", "isochoric", "undrained"),
                           "strain": decades(1e-4, 1), "strain-step": decades(1e-8, 1e-3), "cycles": whole(0, 3),
                           "amplitude": decades(1e-4, 0.1)}, False),
    "retaining_wall": ([], {
        "soil": one_of("sand", "mohr_coulomb"), "grains": whole(20, 100), "size": one_of("2", "1", "0.5"), "seed": SEEDS,
        "preparation-friction": between(0, 2), "strain": between(0.02, 0.3), "threads": one_of("0", "1", "2")}, False),
    "biaxial_specimen": ([], {
        "width": decades(1e-3, 10), "height": decades(1e-3, 10), "columns": whole(1, 3), "rows": whole(1, 3),
        "grains": whole(20, 100), "packings": whole(1, 3), "preparation-friction": between(0, 2), "seed": SEEDS,
        "density": decades(1, 1e5), "thickness": decades(1e-3, 10), "strain-per-dem-step": decades(1e-7, 1e-3),
        "confining": decades(1, 1e8), "axial-strain-step": decades(1e-5, 0.1), "steps": whole(1, 20),
        "residual": decades(1e-6, 0.5), "iterations": whole(1, 100), "halvings": whole(0, 5),
        "threads": one_of("0", "1", "2"), "frames": whole(1, 1000)}, False),
}


def arguments(program, chance):
    before, options, _ = TABLE[program]
    words = [*program.split()[1:], *before]
    for name, draw in options.items():
        if chance.random() < 0.4:
            words += [f"--{name}"] if draw is flag else [f"--{name}", draw(chance)]
    return words


def check_files(title, folder, killed):
    for path in folder.rglob("*"):
        if not path.is_file():
            continue
        what = f"{title}: {path.relative_to(folder)}"
        if ".partial-" in path.name:
            expect(killed, f"{what} is left")
        elif path.suffix == ".json":
            try:
                json.loads(path.read_text())
            except ValueError as problem:
                expect(False, f"{what} does not parse: {problem}")
        elif path.suffix in (".csv", ".jsonl"):
            text = path.read_text()
            expect(text == "" or text.endswith("\n"), f"{what} is cut off")
            if path.suffix == ".csv":
                widths = {line.count(",") for line in text.splitlines() if '"' not in line}
                expect(len(widths) <= 1, f"{what} has rows of {widths} commas")


def check_run(program, number):
    chance = random.Random(f"{SEED} {program} {number}")
    words = arguments(program, chance)
    title = f"{program} {' '.join(words)}"
    stops = TABLE[program][2]
    with tempfile.TemporaryDirectory() as scratch:
        process = subprocess.Popen([PROGRAMS / program.split()[0], *words, "--output", "out"], cwd=scratch,
                                   stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, errors="replace")
        killed = False
        try:
            said = process.communicate(timeout=GRACE if stops else SECONDS)[0]
        except subprocess.TimeoutExpired:
            killed = True
            process.kill()
            said = process.communicate()[0]
            expect(not stops, f"{title}: still running after {GRACE} s\n{said[-1000:]}")
        code = process.returncode
        expect(killed or 0 <= code < 126 or code == 130, f"{title}: ended with {code}\n{said[-2000:]}")
        expect(not re.search(r"Sanitizer|runtime error:|terminate called|Assertion", said), f"{title}:\n{said[-3000:]}")
        if not killed and code not in (0, 130):
            expect(len(said.strip()) > 20, f"{title}: ended with {code} and says '{said}'")
        check_files(title, pathlib.Path(scratch), killed)
        return "killed" if killed else code


built = [program for program in TABLE if (PROGRAMS / program.split()[0]).exists()
         and os.environ.get("SCARP_ONLY") in (None, program)]
if not built:
    print(f"skipped: no programs in {PROGRAMS} (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
print(f"SCARP_SEED={SEED}")
for program in built:
    started = time.monotonic()
    ends = [check_run(program, number) for number in range(DRAWS)]
    counts = ", ".join(f"{ends.count(end)} x {end}" for end in sorted(set(ends), key=str))
    print(f"{program}: {DRAWS} runs in {time.monotonic() - started:.1f} s: {counts}")
finish()
