# SPDX-License-Identifier: BSL-1.0
"""plot.py OUTPUT_DIR: pressure on the wall over its movement, beside Rankine's with the packings' own friction."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import numpy as np
import scarp_figures as figures
from scarp_figures import BLUE, GREY, PALE, VERMILION, plt

SIDES = {"active": (BLUE, "away from the ground"), "passive": (VERMILION, "into the ground")}


def draw_tests(axes, folder, movement):
    """Tests on the packings of all depths; a soil that is no packing has none."""
    path = folder / f"{movement}_tests.csv"
    if not path.is_file():
        return
    table = figures.read_csv(path, ["packing", "strain", "ratio"])
    for packing in np.unique(table["packing"])[::-1]:
        rows = table["packing"] == packing
        together = packing == 0
        axes.plot(100.0 * table["strain"][rows], table["ratio"][rows], color=GREY if together else PALE,
                  linewidth=1.2 if together else 0.6, zorder=2 if together else 1)
    axes.plot([], [], color=PALE, linewidth=0.8, label="biaxial tests, one packing each")
    axes.plot([], [], color=GREY, linewidth=1.2, label="tests, all together")


def pressure(folder):
    summary = figures.read_summary(folder)
    fig, panels = plt.subplots(1, 2, figsize=(7.6, 3.1))
    for axes, (movement, (colour, title)) in zip(panels, SIDES.items()):
        table = figures.read_csv(folder / f"{movement}.csv", ["strain", "ratio"])
        draw_tests(axes, folder, movement)
        axes.plot(100.0 * table["strain"], table["ratio"], color=colour, marker="o", markersize=2.5, zorder=4,
                  label="wall")
        found = summary.get(movement, {})
        formula = figures.finite(found.get("rankine"))
        if formula is not None:
            least, most = (formula * part for part in found["explained"])
            axes.axhspan(least, most, color=colour, alpha=0.15, linewidth=0, zorder=0)
            axes.axhline(formula, color=colour, linewidth=0.9, linestyle="--",
                         label=f"Rankine, $\\phi$ = {found['friction_angle']:.1f}°")
        axes.set(xlabel="wall displacement / length of the ground,\nstrain of a test [%]", title=f"{movement}: {title}",
                 ylim=(0.0, None), xlim=(0.0, None))
        axes.legend(loc="lower right")
    panels[0].set_ylabel("$K$: horizontal over vertical [-]")
    return fig


figures.draw_all({"pressure": pressure})
