# SPDX-License-Identifier: BSL-1.0
"""[slow] Convergence in mesh and length: the fits return laws that are known, the interval has the truth in it, and the benchmark keeps, repeats and
reports its runs. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without them, NumPy or Matplotlib)."""
import itertools
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the imports below leave no folders in the sources
root = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(root / "benchmarks" / "length_convergence"), str(root / "benchmarks"), str(root / "examples" / "shared")]
try:
    import convergence
    import numpy as np
    from common import read_table
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
from expectations import NIGHTLY, expect, finish

if not (pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / "fault_rupture").is_file():
    print("skipped: no fault_rupture (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)

LENGTHS, LIMITS, AREA = np.array([1.0, 1.41, 2.0, 2.83, 4.0, 5.66, 8.0]), np.array([0.3, 0.1]), convergence.AREA


def band(length):
    """The docstring's closed form with numbers near those of sand."""
    u = length / 5.0
    return 1.4 + 5.0 * u * (1.0 - np.exp(-1.0 / u))


def apart(form, law, lengths=LENGTHS):
    return np.abs(convergence.fit(form, lengths, law(lengths), np.ones(len(lengths)))(LIMITS) - law(LIMITS)).max()


# Analytic: each form returns its own law, and any of them the line that all three contain.
expect(apart("line", lambda x: 2.0 - 3.0 * x) < 1e-9, "a line")
expect(apart("power", lambda x: 2.0 + 3.0 * x**0.75) < 1e-9, "a power that is among those looked at")
expect(apart("power", lambda x: 2.0 - 3.0 * x) < 1e-9, "the power one")
# The lengths L0 that are looked at lie 6 % apart, which is at most 3 % of the 0.6 m by which the limit changes with log L0.
expect(apart("band", band) < 0.02, f"the band's law, {apart('band', band)} m off")
expect(apart("line", band) > 0.3, "a line through a law that bends is off")
# Concave: a line through the shortest lengths is too high, a power, whose slope at no length has no bound, too low.
short = LENGTHS[:4]
low, high = (convergence.fit(form, short, band(short), np.ones(4))(LIMITS) for form in ("power", "line"))
expect(np.all(low < band(LIMITS)) and np.all(band(LIMITS) < high), f"{low} and {high} are not on both sides of {band(LIMITS)}")

BLOCK = -13.8  # x of the mean without dilation [m]
BY_SIZE = (-4.0, -3.0)  # error of the area by the square of the elements' size over the length, crossed and right, as in sand


def table(seed_scatter, rest, seed, power=0.0):
    """Rows of runs with known deviations, as the data file has them. power: of the length, in the error by the size of elements"""
    random = np.random.default_rng(seed)
    of_seed = random.normal(0.0, seed_scatter, 3)
    rows = []
    for length, i, mesh in itertools.product(LENGTHS, range(3), ("crossed", "right", "finer")):
        if length > 1.5 or i == 0 or mesh == "crossed":
            of_size = BY_SIZE[mesh == "right"] * (convergence.size_of(mesh, length) / length) ** 2 * length**power
            area = band(length) + of_seed[i] + of_size + random.normal(0.0, rest)
            rows.append({"soil": "sand", "length [m]": f"{length:g}", "mesh": mesh, "seed": str(i),
                         AREA: str(area), "mean [m]": str(BLOCK + area), "status": "ok"})
    return rows


def limits_of(rows, quantity=AREA):
    return np.percentile(convergence.of_rows(rows, quantity, LIMITS), [2.5, 50.0, 97.5], axis=0)


trials = [limits_of(table(0.15, 0.1, seed, power=float(seed % 2))) for seed in range(8)]
inside = sum(np.all((low < band(LIMITS)) & (band(LIMITS) < high)) for low, _, high in trials)
# Of eight intervals of 95 % less than six miss with a chance of 1 in 170 only; theirs are wider, since few levels tell their scatter badly.
expect(inside >= 6, f"the truth is in {inside} of 8 intervals")
widths = [np.mean(high - low) for low, _, high in trials]
expect(np.mean(widths) < 3.0, f"intervals of {widths} m say nothing about a quantity of 1.4 to 5 m")
rows = table(0.15, 0.1, 1)
checks = convergence.held_out(rows)
expect([(row["quantity"], row["length [m]"]) for row in checks] == [("mean [m]", 1.0), (AREA, 1.0)], f"what is there, at the shortest length: {checks}")
of_runs = np.mean([float(row[AREA]) for row in rows if row["length [m]"] == "1" and row["mesh"] == "crossed"])
expect(checks[1]["of the runs"] == of_runs and checks[1]["low"] < of_runs < checks[1]["high"], f"{of_runs} is held out and foreseen: {checks[1]}")
others = [row for row in rows if row["length [m]"] != "1" or row["mesh"] != "crossed"]
expect(not convergence.held_out(others), "nothing is foreseen for a mesh that has not run")
expect(not convergence.limits([row for row in rows if float(row["length [m]"]) > 3.0]), "three lengths are as many as a form has parameters")
expect(not convergence.limits([row for row in rows if row["mesh"] != "finer" and float(row["length [m]"]) < 6.0]), "one size does not tell its error")
exact = limits_of(table(0.0, 0.0, 1))
expect(np.mean(exact[2] - exact[0]) < 0.8 * np.mean(widths), f"seeds and meshes widen what the forms leave open: {exact} of {widths}")
expect(np.all(exact[2] - exact[0] > 0.1), "the forms alone leave something open")
shifted = limits_of(table(0.15, 0.1, 0), "mean [m]")
expect(np.allclose(np.subtract(shifted, trials[0]), BLOCK, atol=1e-9), "the mean and the area extrapolate alike, as the balance of areas has it")

script = root / "benchmarks" / "length_convergence" / "run"
with tempfile.TemporaryDirectory() as scratch:
    def run(*options):
        done = subprocess.run([sys.executable, script, *options], cwd=scratch, capture_output=True, text=True)
        expect(done.returncode == 0, f"{options}: ended with {done.returncode}: {done.stderr[-1000:]}")
        return done.stdout

    every = run("--list").splitlines()
    expect(sum(" done" in line for line in every) == 0 and "hours of CPU are left" in every[-1], "nothing is done in an empty folder")
    for length in ("8", "5.66", "4", "2.83", "2"):
        count = sum(line.startswith(f"sand-{length}m-") for line in every)
        wanted = 9 + {"2": 2, "4": 1}.get(length, 0)  # more meshes of one seed
        expect(count == wanted, f"three seeds on three meshes with {length} m and {wanted - 9} more, not {count}")
    chosen = run("--list", "sand-4m-*", "mohr_coulomb-2m-right").splitlines()
    expect(len(chosen) == 12, f"ten runs of sand, one of Mohr-Coulomb ground and a sum, not {len(chosen)}")
    unknown = subprocess.run([sys.executable, script, "--list", "sand-3m-*"], cwd=scratch, capture_output=True, text=True)
    expect(unknown.returncode == 2 and "no run matches sand-3m-*" in unknown.stderr, f"names of no run are refused: {unknown.stderr}")
    costs = [float(line.split()[1]) for line in every[:-1]]
    expect(costs == sorted(costs) and costs[-1] > 1000.0, "the cheapest come first")

    if not NIGHTLY:
        finish()
    run("--quick")
    runs = pathlib.Path(scratch, "output", "length_convergence", "quick")
    ended = {file: file.stat().st_mtime_ns for file in runs.glob("*/summary.json")}
    expect(len(ended) == 8, f"eight runs, not {len(ended)}")
    lost = runs / "mohr_coulomb-4m-finer" / "summary.json"
    lost.unlink(missing_ok=True)
    before = read_table(pathlib.Path(scratch, "output", "quick", "length_convergence.csv"))
    run("--quick")
    expect(lost.is_file(), "a run without a summary is done again")
    expect(all(file.stat().st_mtime_ns == time for file, time in ended.items() if file != lost), "finished runs are kept")
    after = read_table(pathlib.Path(scratch, "output", "quick", "length_convergence.csv"))
    expect([row["mean [m]"] for row in before] == [row["mean [m]"] for row in after] and len(after) == 8, "and so are the rows")
    for row in after:
        expect(abs(float(row["mean [m]"]) - float(row[AREA]) + (25.0 - 25.0 * 0.085 / 2) / np.tan(np.pi / 3)) < 1e-3, f"the balance of areas: {row}")
    shown = [line for line in run("--quick", "--page").splitlines() if line.startswith("| Mohr-Coulomb")]
    expect(len(shown) == 4 and len({line.count("|") for line in shown}) == 1, f"rows for the page: {shown}")
    for name in ("length_places.png", "length_widths.png"):
        expect(pathlib.Path(scratch, "output", "quick", name).is_file(), f"no {name}")
finish()
