# SPDX-License-Identifier: BSL-1.0
"""Figures of a footing over a fault: how it moves, and the pressures on its base."""

import numpy as np
import scarp_figures as figures
from scarp_figures import BLACK, BLUE, GREY, PALE, VERMILION, plt

THICKNESS = 0.1  # of a rigid footing as it is drawn, over its width


def corners(folder, summary, throw, surface):
    """Of a rigid footing at a throw [m], shape (4, 2), else None: one that is tied is part of the mesh. surface: its level at rest [m]"""
    options = summary.get("run", {}).get("options", {})
    centre, width = (figures.finite(summary.get(f"footing_{name}")) for name in ("centre", "width"))
    if options.get("footing") != "frictional" or centre is None or width is None:
        return None
    table = figures.read_csv(folder / "footing.csv", ["load", "throw_over_depth", "settlement", "horizontal_displacement", "tilt"])
    row = figures.last_nearest(table["throw_over_depth"], max(throw, 0.0))
    tilt = table["tilt"][row]
    base = np.array([centre + table["horizontal_displacement"][row], surface - table["settlement"][row]])
    turned = np.array([[np.cos(tilt), np.sin(tilt)], [-np.sin(tilt), np.cos(tilt)]])  # clockwise
    own = width * np.array([[-0.5, 0.0], [0.5, 0.0], [0.5, THICKNESS], [-0.5, THICKNESS]])
    return base + own @ turned.T


def draw_block(axes, folder, summary, throw, surface):
    """A rigid footing where it is at a throw: its patch, None for none."""
    place = corners(folder, summary, throw, surface)
    return None if place is None else axes.add_patch(figures.block(place))


def draw_extent(axes, summary):
    """Where a footing stood before the fault moved, below curves over x: what a legend shows."""
    centre, width = (figures.finite(summary.get(f"footing_{name}")) for name in ("centre", "width"))
    if centre is None or width is None:
        return []
    return [axes.axvspan(centre - 0.5 * width, centre + 0.5 * width, color=PALE, alpha=0.6, zorder=0, label="footing, before the fault moved")]


def footing(folder):
    """Settlement, tilt and pressed share over the throw; the stage before the fault moves is left out."""
    table = figures.read_csv(folder / "footing.csv", ["load", "throw_over_depth", "settlement", "tilt", "pressure_min",
                                                      "pressure_max", "contact_share"])
    moving = table["load"] >= 0.0
    if not moving.any():
        raise figures.InputError("'footing.csv' holds no load from zero on (the fault has not moved yet): let it run on")
    throw = 100.0 * table["throw_over_depth"][moving]
    fig, (left, right) = plt.subplots(1, 2, figsize=(7.2, 3.6), layout="constrained")
    left.plot(throw, table["settlement"][moving], color=BLUE, label="settlement [m]")
    left.set(xlabel="throw over depth [%]", ylabel="settlement of the base's centre [m]")
    tilt = left.twinx()
    tilt.plot(throw, np.degrees(table["tilt"][moving]), color=VERMILION)
    tilt.set_ylabel("tilt to the hanging wall [degrees]", color=VERMILION)
    tilt.grid(False)
    pressure = right.fill_between(throw, table["pressure_min"][moving] / 1e3, table["pressure_max"][moving] / 1e3, color=GREY,
                                  alpha=0.4, label="pressure, from least to largest")
    right.set(xlabel="throw over depth [%]", ylabel="contact pressure [kPa]")
    share = right.twinx()
    line = share.plot(throw, 100.0 * table["contact_share"][moving], color=BLACK, linewidth=0.8, label="pressed share")
    share.set_ylabel("pressed share of the base [%]")
    share.set_ylim(0.0, 105.0)
    share.grid(False)
    right.legend(handles=[pressure, *line], loc="upper center", bbox_to_anchor=(0.5, -0.2))
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
