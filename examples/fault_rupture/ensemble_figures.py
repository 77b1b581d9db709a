# SPDX-License-Identifier: BSL-1.0
"""Figures of several runs that differ in their packings."""
import json
import pathlib

import footing_figures
import numpy as np
import scarp_figures as figures
from scarp_figures import BLACK, BLUE, GREY, plt

SHOWN = ("surface_x05", "surface_x50", "surface_x95")


def ensemble(folder):
    """Settlement of every member at its end, their mean with one standard deviation, and where the rupture comes out."""
    table = figures.read_csv(folder / "surface_mean.csv", ["x_initial", "settlement", "scatter"])
    ensemble = json.loads((folder / "ensemble.json").read_text())
    measures = ensemble["measures"]
    fig, axes = plt.subplots(figsize=(7.0, 4.2), layout="constrained")
    tables = [folder / member["folder"] / "surface.csv" for member in ensemble["members"]]
    for k, table_of_member in enumerate(filter(pathlib.Path.is_file, tables)):
        own = figures.read_csv(table_of_member, ["throw_over_depth", "x_initial", "settlement"])
        last = own["throw_over_depth"] == own["throw_over_depth"][-1]
        axes.plot(own["x_initial"][last], own["settlement"][last], color=GREY, linewidth=0.7, label=None if k else "members")
    mean, scatter = table["settlement"], np.nan_to_num(table["scatter"])
    axes.fill_between(table["x_initial"], mean - scatter, mean + scatter, color=BLUE, alpha=0.3, label="one standard deviation")
    axes.plot(table["x_initial"], mean, color=BLACK, linewidth=1.2, label="mean")
    for name in SHOWN:
        place = measures[name]
        axes.axvspan(place["mean"] - (place["scatter"] or 0.0), place["mean"] + (place["scatter"] or 0.0), color=BLUE, alpha=0.12)
        axes.axvline(place["mean"], color=BLUE, linewidth=0.9, linestyle="-" if name == "surface_x50" else ":")
    axes.invert_yaxis()
    footing_figures.draw_extent(axes, next(map(figures.read_summary, (table.parent for table in tables if table.is_file())), {}))
    count = measures["surface_x50"]["count"]
    axes.set(xlabel="x before the fault moved [m]", ylabel="settlement [m]",
             title=f"{count} packings: 5, 50 and 95 % of the throw at "
                   + ", ".join(f"{measures[name]['mean']:.1f} ± {measures[name]['scatter'] or 0.0:.1f}" for name in SHOWN) + " m")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.14), ncol=4)
    return fig
