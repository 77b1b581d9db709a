# SPDX-License-Identifier: BSL-1.0
"""[slow] Probes of fault_rupture tell the strain that their packing has, with a length too: its volume grows by what its void ratio says. So does the
ground: exactly where no means are taken, and within the budget where they are.
Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import csv
import json
import math
import pathlib
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import example, expect, finish

program = example("fault_rupture")
with tempfile.TemporaryDirectory() as scratch:
    for length in ("0", "12"):
        done = subprocess.run([program.resolve(), "--quick", "--length", length, "--throw-over-depth", "0.02", "--frames", "1", "--output", length],
                              cwd=scratch, capture_output=True, text=True)
        expect(done.returncode == 0, f"length {length}: ended with {done.returncode}: {done.stderr[-500:]}")
        with open(pathlib.Path(scratch, length, "probe_A.csv")) as file:
            rows = [{name: float(value) for name, value in row.items()} for row in csv.DictReader(file)]
        apart = max(abs(row["q"] - math.hypot(row["sxx"] - row["syy"], 2.0 * row["sxy"])) / row["q"] for row in rows)
        expect(apart < 1e-12, f"length {length}: q is not the difference of the principal stresses, by {apart}")
        grown = (1.0 + rows[-1]["void_ratio"]) / (1.0 + rows[0]["void_ratio"]) - 1.0
        expect(grown > 0.005, f"length {length}: the packing at probe A has hardly dilated, by {grown}")
        # Steps of up to 2 % strain each: their products, and turns between them, are what the two may differ by.
        told = -(rows[-1]["eps_v"] - rows[0]["eps_v"])
        expect(abs(told - grown) < 0.1 * grown, f"length {length}: it has dilated by {grown}, the probe says {told}")
        summary = json.loads(pathlib.Path(scratch, length, "summary.json").read_text())
        volume = summary["error_budget"]["parts"]["volume"]
        expect(volume["value"] < (1e-9 if length == "0" else volume["bound"]), f"length {length}: the ground has grown by more than its packings: {volume}")
        expect(summary["dilated_area_of_packings"] > 0.1, f"length {length}: the packings have hardly dilated")
finish()
