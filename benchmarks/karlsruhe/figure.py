# SPDX-License-Identifier: BSL-1.0
"""Data of Karlsruhe fine sand beside packings of spheres, from the rows of docs/data/karlsruhe.csv."""
import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples" / "shared"))
import numpy as np
import scarp_figures as figures
from scarp_figures import BLACK, BLUE, plt


def panel(axes, rows, across, quantity, labels):
    own = [row for row in rows if row["quantity"] == quantity]
    x, data, mean, deviation = (np.array([row[key] for row in own], float) for key in (across, "data", "packings", "deviation"))
    every = slice(None, None, 3) if across.startswith("axial strain") else slice(None)
    axes.plot(x[every], data[every], "o", color=BLACK, markersize=3, markerfacecolor="none", label="data")
    axes.plot(x, mean, color=BLUE, label="packings of spheres")
    if across.startswith("axial strain"):
        axes.fill_between(x, mean - deviation, mean + deviation, color=BLUE, alpha=0.2, linewidth=0.0, label="± standard deviation")
    else:
        axes.errorbar(x, mean, yerr=deviation, color=BLUE, linewidth=0.8)
    axes.set(xlabel=labels[0], ylabel=labels[1])


def draw(rows, path):
    drawn, (strength, volume, column) = plt.subplots(1, 3, figsize=(10.5, 3.4))
    panel(strength, rows, "axial strain [%]", "friction angle [deg]", ("axial strain [%]", "mobilised friction angle [degrees]"))
    panel(volume, rows, "axial strain [%]", "volumetric strain [%]", ("axial strain [%]", "volumetric strain [%] (contraction positive)"))
    panel(column, rows, "axial stress [kPa]", "axial strain [%]", ("axial stress [kPa]", "axial strain [%]"))
    column.set(xscale="log")
    column.invert_yaxis()
    strength.set_title("Drained triaxial test, 50 kPa: calibrated on")
    volume.set_title("Its volume: calibrated on")
    column.set_title("Oedometer test: predicted")
    strength.legend(loc="lower right")
    figures.save(drawn, path)
