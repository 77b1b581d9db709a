# SPDX-License-Identifier: BSL-1.0
"""Figures of a footing over a fault: how it moves, and the pressures on its base."""

import numpy as np
import scarp_figures as figures
from scarp_figures import BLACK, BLUE, GREY, VERMILION, plt


def footing(folder):
    """Settlement, tilt and pressed share over the throw; the stage before the fault moves is left out."""
    table = figures.read_csv(folder / "footing.csv", ["load", "throw_over_depth", "settlement", "tilt", "pressure_min",
                                                      "pressure_max", "contact_share"])
    moving = table["load"] >= 0.0
    throw = 100.0 * table["throw_over_depth"][moving]
    fig, (left, right) = plt.subplots(1, 2, figsize=(7.2, 2.8), layout="constrained")
    left.plot(throw, table["settlement"][moving], color=BLUE, label="settlement [m]")
    left.set(xlabel="throw over depth [%]", ylabel="settlement of the base's centre [m]")
    tilt = left.twinx()
    tilt.plot(throw, np.degrees(table["tilt"][moving]), color=VERMILION)
    tilt.set_ylabel("tilt to the hanging wall [degrees]", color=VERMILION)
    tilt.grid(False)
    right.fill_between(throw, table["pressure_min"][moving] / 1e3, table["pressure_max"][moving] / 1e3, color=GREY,
                       alpha=0.4, label="range over the base")
    right.set(xlabel="throw over depth [%]", ylabel="contact pressure [kPa]")
    share = right.twinx()
    share.plot(throw, 100.0 * table["contact_share"][moving], color=BLACK, linewidth=0.8)
    share.set_ylabel("pressed share of the base [%]")
    share.set_ylim(0.0, 105.0)
    share.grid(False)
    return fig


def base_pressure(folder):
    """Contact pressure along the base at a few throws."""
    table = figures.read_csv(folder / "footing_base.csv", ["throw_over_depth", "x", "pressure"])
    throws = np.unique(table["throw_over_depth"])
    chosen = throws[np.unique(np.linspace(0, len(throws) - 1, 5).astype(int))]
    fig, axes = plt.subplots(figsize=(4.6, 2.8), layout="constrained")
    colours = plt.get_cmap("viridis")(np.linspace(0.0, 0.85, len(chosen)))
    for throw, colour in zip(chosen, colours):
        row = table["throw_over_depth"] == throw
        order = np.argsort(table["x"][row])
        axes.plot(table["x"][row][order], table["pressure"][row][order] / 1e3, color=colour, marker=".", markersize=3,
                  label=f"h/H {100.0 * throw:.1f} %")
    axes.set(xlabel="x [m]", ylabel="contact pressure [kPa]")
    axes.legend(fontsize="small")
    return fig
