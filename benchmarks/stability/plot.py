# SPDX-License-Identifier: BSL-1.0
"""Draws bisected over predicted time step limits: plot.py CASES.csv FOLDER."""
import csv
import sys
from pathlib import Path

import matplotlib.pyplot as plt


def main(table, folder):
    with open(table, newline="") as file:
        rows = [row for row in csv.DictReader(file) if row["measure"] == "bisected over predicted limit"]
    if not rows:
        sys.exit(f"plot.py: '{table}' has no time step limits (nothing to draw): run the whole suite")
    names = [row["name"] for row in rows]
    limits = [float(row["worst"]) for row in rows]
    shares = [float(row["remark"].split()[2]) * limit for row, limit in zip(rows, limits)]
    figure, axes = plt.subplots(figsize=(8.0, 0.28 * len(rows) + 1.2), layout="constrained")
    places = range(len(rows))
    axes.axvspan(0.9, 1.1, color="0.9", label="within 10 %")
    axes.axvline(0.8, color="0.5", linewidth=0.8, linestyle="--", label="0.8")
    axes.plot(limits, places, "o", color="tab:blue", label="bisected limit")
    axes.plot(shares, places, "|", color="tab:red", markersize=10, label="default time step")
    axes.set_yticks(list(places), names, fontsize=8)
    axes.invert_yaxis()
    axes.set_xlim(0.0, 1.3)
    axes.set_xlabel("time step over the predicted limit")
    axes.legend(fontsize=8, loc="lower left")
    figure.savefig(Path(folder) / "stability_limits.png", dpi=120)


if __name__ == "__main__":
    main(*sys.argv[1:])
