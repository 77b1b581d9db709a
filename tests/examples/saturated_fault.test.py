# SPDX-License-Identifier: BSL-1.0
"""[slow] fault_rupture on saturated ground: limits of slow and fast slip, drainage, footings, packings, resumed runs, figures.
Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import os
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

DRY = example("fault_rupture")
WET = example("fault_rupture_water")
PLOT = pathlib.Path(__file__).resolve().parents[2] / "examples" / "fault_rupture" / "plot.py"
BUOYANT = 15.68e3 - 9.81e3 / 1.7
SOIL = ["--soil", "mohr_coulomb", "--quick"]
scratch = tempfile.TemporaryDirectory()


def run(program, name, *options, code=0):
    done = subprocess.run([program.resolve(), *map(str, options), "--output", name], cwd=scratch.name, capture_output=True, text=True)
    expect(done.returncode == code, f"{name}: ended with {done.returncode}: {done.stderr[-500:]}")
    return done.stderr


def told(name):
    return json.loads(pathlib.Path(scratch.name, name, "summary.json").read_text())


def bits(name, file):
    return pathlib.Path(scratch.name, name, file).read_bytes()


# Slow slip: the dry ground of the buoyant weight, but for the sizes of steps: with steps of half the size middles of both move by 0.03 m.
small = [*SOIL, "--max-displacement-gradient", 0.005]
run(DRY, "dry", *small, "--unit-weight", BUOYANT)
run(WET, "slow", *small, "--water-table", 0, "--slip-rate", 1e-10)
for name in ("surface_x05", "surface_x50", "surface_x95", "surface_mean"):
    expect(abs(told("dry")[name] - told("slow")[name]) < 1e-2, f"drained {name}: {told('slow')[name]}, dry {told('dry')[name]}")
expect(abs(told("dry")["reaction"] / told("slow")["reaction"] - 1.0) < 1e-3, "a drained rupture has another reaction than the dry one")

# Fast slip: what counts is the water that passes in the time of the throw.
run(WET, "fast", *SOIL, "--water-table", 0, "--slip-rate", 1, "--drain", 1e6)
run(WET, "alike", *SOIL, "--water-table", 0, "--slip-rate", 1e-2, "--conductivity", 1e-6)
thrown, later, end = (told("fast")["water"][when] for when in ("after_the_throw", "after_a_minute", "at_the_end"))
alike = told("alike")["water"]["after_the_throw"]
for name in ("excess_pressure_min", "excess_pressure_max", "surface_x50", "vapour"):
    expect(abs(alike[name] / thrown[name] - 1.0) < 1e-3, f"slip and permeability, both a hundredth: {name} {alike[name]}, not {thrown[name]}")
expect(thrown["excess_pressure_min"] < -100e3 and thrown["vapour"] > 0.0, f"no cavitation: {thrown}")
expect(thrown["excess_pressure_min"] > -100e3 - 9.81e3 * 25.0 - 3e3, f"suction that water cannot have: {thrown}")
expect(abs(later["excess_pressure_min"]) < abs(thrown["excess_pressure_min"]), "nothing has drained in a minute")
expect(abs(end["excess_pressure_min"]) < 1.0 and end["vapour"] == 0.0, f"not drained: {end}")
expect(abs(-end["expelled"] / told("fast")["dilated_area"] - 1.0) < 1e-2, f"water {end['expelled']}, ground {told('fast')['dilated_area']}")
parts = told("fast")["error_budget"]["parts"]
expect(all(0.0 < parts[name]["value"] and parts[name]["within"] for name in ("water", "time")), f"budget of the water: {parts}")
expect(not {"water", "time"} & told("dry")["error_budget"]["parts"].keys(), "dry ground has a budget of water")
run(WET, "bounded", *SOIL, "--water-table", 0, "--slip-rate", 1, "--drain", 1e6, "--largest-time-error", 4e3)
time, pressure = (told("bounded")["error_budget"]["parts"]["time"]["value"], told("bounded")["water"]["after_the_throw"]["excess_pressure_min"])
expect(time <= 4e3 / abs(pressure) and time < 0.5 * parts["time"]["value"], f"steps of a bounded error in time: {time}, else {parts['time']['value']}")
expect(told("fast")["throw_over_depth"] == told("dry")["throw_over_depth"], "the throw is another")
with open(pathlib.Path(scratch.name, "fast", "water.csv"), encoding="utf-8") as file:
    times = [float(row["time"]) for row in csv.DictReader(file)]
expect(times == sorted(times) and abs(times[-1] - 1e6 - thrown["time"]) < 1.0, f"times {times[:3]} to {times[-1]}")

expect(abs(later["time"] - thrown["time"] - 60.0) < 1e-6, f"a minute after the throw is {later['time'] - thrown['time']} s")
# Water that needs ages to drain before the throw: the clock of the throw keeps its digits.
run(WET, "clay", *SOIL, "--water-table", 0, "--slip-rate", 1, "--conductivity", 1e-12, "--drain", 10)
clay = told("clay")["water"]
expect(abs(clay["after_the_throw"]["time"] / thrown["time"] - 1.0) < 1e-12, f"the throw takes {clay['after_the_throw']['time']} s")
expect("after_a_minute" not in clay, "a run that ends before has a minute after the throw")

# A run in two parts has the bits of one.
whole = [*SOIL, "--water-table", 0, "--drain", 100]
run(WET, "whole", *whole)
for number in range(40):
    status = subprocess.run([WET.resolve(), *map(str, whole), "--checkpoint", "state", "--checkpoint-every", "0", "--time-limit", f"{0.02 * (number + 1)}",
                             "--output", "parts", *(["--resume"] if number else ["--overwrite"])],
                            cwd=scratch.name, capture_output=True, text=True).returncode
    if status == 0:
        break
expect(status == 0 and number > 0, f"a run in parts ended with {status} after {number + 1}")
for file in ("water.csv", "surface.csv"):
    expect(bits("whole", file) == bits("parts", file), f"{file} of a run in {number + 1} parts differs")

# A footing, and packings.
run(WET, "footing", *SOIL, "--water-table", -3, "--case", "heavy", "--drain", 1e5)
water = told("footing")["water"]
expect(abs(water["after_the_throw"]["tilt"] - water["at_the_end"]["tilt"]) > 1e-5, "a footing does not feel the drainage")
run(WET, "frictional", *SOIL, "--water-table", 2, "--case", "heavy", "--footing", "frictional", "--drain", 1e5)
sliding = told("frictional")["water"]
expect(abs(sliding["after_the_throw"]["settlement"] - sliding["at_the_end"]["settlement"]) > 1e-4, "a footing on a frictional base does not feel the drainage")
expect(abs(sliding["at_the_end"]["excess_pressure_min"]) < 1.0, f"not drained: {sliding['at_the_end']}")
run(WET, "packings", "--quick", "--grains", 49, "--water-table", 4, "--throw-over-depth", 0.004, "--drain", 1e4)
expect(told("packings")["water"]["after_the_throw"]["excess_pressure_min"] < -1e3, "packings have no suction")
at_half = 1e-4 * (0.5**3 / 1.5) / (0.7**3 / 1.7)  # Kozeny and Carman: the conductivity that is 1e-4 m/s at a void ratio of 0.7
pathlib.Path(scratch.name, "wet.sand").write_text(f"shape = ellipse\nconductivity = {at_half}\nconductivity-void-ratio = 0.5\n")
run(WET, "sand", "--quick", "--grains", 49, "--water-table", 4, "--throw-over-depth", 0.004, "--drain", 1e4, "--sand", "wet.sand")
found = [told(name)["water"]["after_the_throw"]["excess_pressure_min"] for name in ("packings", "sand")]
expect(abs(found[1] / found[0] - 1.0) < 1e-3, f"suction with the conductivity of an option and of a sand: {found}")

run(WET, "stopped", *SOIL, "--water-table", 0, "--time-limit", 0.001, code=130)
for name in ("stopped", "footing"):
    done = subprocess.run([sys.executable, str(PLOT), str(pathlib.Path(scratch.name, name))], capture_output=True, text=True,
                          env={**os.environ, "MPLBACKEND": "Agg"})
    # What a run that stopped before the throw has not is told figure by figure.
    expect(done.returncode == (1 if name == "stopped" else 0) and "Traceback" not in done.stderr, f"figures of {name}: {done.stderr}")
for name in ("excess_pressure.png", "pressures.gif", "water.png"):
    expect(pathlib.Path(scratch.name, "footing", "figures", name).stat().st_size > 10_000, f"no figure {name}")

for program, options, said in ((DRY, [*SOIL, "--water-table", 0], "which builds one with water"), (WET, SOIL, "is not given to a program with water"), (WET, [*SOIL, "--water-table", 2e3], "out of range"), (WET, [*SOIL, "--water-table", 30], "all of it dry"),
                               (WET, [*SOIL, "--drain", 5], "requires --water-table"), (WET, [*SOIL, "--largest-time-error", 5], "requires --water-table"),
                               (WET, [*SOIL, "--water-table", 0, "--unit-weight", 3000], "would float")):
    error = run(program, "refused", "--overwrite", *options, code=2)
    expect(said in error, f"{options}: {error}")
finish()
