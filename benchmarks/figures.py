#!/usr/bin/python3
# SPDX-License-Identifier: BSL-1.0
"""figures.py [NAME...]: figures of docs/figures from the data files of the benchmarks.

NAME: beyond_map, beyond_dips, device, objectivity, or error_vs_time_SUBJECT; all for which there are data without any.
"""
import itertools
import pathlib
import re
import sys

sys.dont_write_bytecode = True
here = pathlib.Path(__file__).resolve().parent
sys.path[:0] = [str(here), str(here.parent / "examples" / "shared")]
import numpy as np
import scarp_figures as figures
from common import ROOT, data_folder, read_table
from scarp_figures import plt

MARKERS = "osD^vP*X<>"
COLOURS = [figures.BLUE, figures.VERMILION, figures.GREEN, figures.ORANGE, figures.PURPLE, figures.SKY, figures.BLACK, figures.GREY]


def number(cell):
    return float(cell) if cell else np.nan


def place_of(run):
    """Pressure [kPa] and centre [m] of a run's name."""
    pressure, centre = run.split("_")[:2]
    return float(pressure.removesuffix("kPa")), float(centre.removesuffix("m"))


def beyond_map(rows):
    runs = {row["run"]: row for row in rows}
    at = {place_of(name): row for name, row in runs.items() if name != "free" and row["status"] == "ok"}
    pressures, centres = (sorted({place[k] for place in at}) for k in (0, 1))
    crossed, free = "x50 at 3/4 of the depth [m]", runs["free"]
    drawn, axes = plt.subplots(1, 2, figsize=(11.0, 4.0), sharey=True)
    for axis, title, colours, value in (
            (axes[0], "diversion at 3/4 of the depth [m]\n(negative: towards the footwall)", "RdBu", lambda row: number(row[crossed]) - number(free[crossed])),
            (axes[1], "tilt [degrees]\n(positive: towards the hanging wall)", "PuOr_r", lambda row: number(row["tilt [deg]"]))):
        values = np.array([[value(at[p, c]) if (p, c) in at else np.nan for c in centres] for p in pressures])
        most = np.nanmax(np.abs(values))
        shown = axis.pcolormesh(centres, pressures, values, cmap=colours, vmin=-most, vmax=most, shading="nearest")
        for (row, column), cell in np.ndenumerate(values):
            if not np.isnan(cell):
                axis.text(centres[column], pressures[row], f"{cell:.1f}", ha="center", va="center", fontsize=7, color="white" if abs(cell) > 0.65 * most else "black")
        axis.axvline(number(free["x50 [m]"]), color="k", lw=1.0, ls="--", label="x50 of the free field")
        axis.set(title=title, xlabel="centre of a footing 10 m wide, x [m]")
        drawn.colorbar(shown, ax=axis)
    axes[0].set(ylabel="bearing pressure [kPa]")
    axes[0].legend(loc="upper left", bbox_to_anchor=(0.0, -0.13))
    return drawn


def beyond_dips(rows):
    drawn, axis = plt.subplots(figsize=(6.2, 4.2))
    for way, colour in (("normal", figures.BLUE), ("reverse", figures.VERMILION)):
        runs = sorted((int(row["run"].split("_")[1]), row) for row in rows if row["run"].startswith(way) and row["status"] == "ok")
        dips = [dip for dip, _ in runs]
        x05, x50, x95 = ([number(row[f"{share} [m]"]) for _, row in runs] for share in ("x05", "x50", "x95"))
        axis.plot(x50, dips, "o-", color=colour, label=f"{way} fault: x50, and x05 to x95")
        axis.fill_betweenx(dips, x05, x95, color=colour, alpha=0.15)
    dips = np.linspace(30.0, 90.0, 61)
    axis.plot(-25.0 / np.tan(np.radians(dips)), dips, "k--", lw=1.0, label="the fault's own line")
    axis.set(xlabel="x at the surface [m]; the tip is at 0", ylabel="dip [degrees]", xlim=(-52.0, 23.0))
    axis.legend()
    return drawn


def objectivity(rows):
    soils = {"mohr_coulomb": "Mohr-Coulomb", "dem": "sand, 100 grains"}
    soils = {soil: title for soil, title in soils.items() if any(row["soil"] == soil for row in rows)}
    drawn, axes = plt.subplots(1, len(soils), figsize=(5.2 * len(soils), 3.8), sharey=True, squeeze=False)
    for axis, (soil, title) in zip(axes[0], soils.items()):
        runs = [row for row in rows if row["soil"] == soil]
        for part, colour in (("x05", figures.BLUE), ("x50", figures.VERMILION), ("x95", figures.GREEN)):
            axis.plot([number(row["length [m]"]) for row in runs], [number(row[f"{part} [m]"]) for row in runs], "o", color=colour, ms=4, alpha=0.6, label=part)
        axis.set(title=title, xlabel="nonlocal length [m]; 0: none")
    axes[0][0].set(ylabel="x where the surface has settled by\n5, 50, 95 % of the throw [m]")
    axes[0][0].legend()
    return drawn


def device(rows):
    """DEM steps a second over points on a device, predicted and measured, and those of the vector kernel on all processors."""
    drawn, axis = plt.subplots(figsize=(6.4, 4.4))
    rate, shades = "million steps/s", {"double": figures.BLUE, "float": figures.VERMILION}
    for precision, colour in shades.items():
        for grains, style in (("400", "o-"), ("100", "s:")):
            own = [row for row in rows if (row["precision"], row["grains"]) == (precision, grains)]
            runs = [row for row in own if row["work"] == "like"]
            if runs:
                axis.plot([number(row["points"]) for row in runs], [number(row[rate]) for row in runs], style, color=colour, ms=4, label=f"{precision}, {grains} grains")
            predicted = [row for row in runs if row.get("expected to [million steps/s]")]
            if predicted:
                points, *bounds = ([number(row[column]) for row in predicted] for column in (
                    "points", "expected from [million steps/s]", "expected to [million steps/s]", "limit [million steps/s]"))
                axis.fill_between(points, *bounds[:2], color=colour, alpha=0.15, label=f"{precision}, 400 grains, expected")
                axis.plot(points, bounds[2], "--", color=colour, lw=0.8, label=f"{precision}, 400 grains, limit by shared memory")
            kernel = [row for row in own if row["work"] == "vector kernel"]
            if kernel and grains == "400":
                axis.axhline(number(kernel[-1][rate]), color=colour, lw=0.8, ls="-.", label=f"{precision}, vector kernel on {kernel[-1]['threads']} threads")
    axis.set(xscale="log", yscale="log", xlabel="points in one call", ylabel="million DEM steps per second", title=rows[0]["device"])
    axis.legend(fontsize=7)
    return drawn


COST = "CPU time over the base setting [-]"


def front_of(points):
    """(cost, error) that no other point beats in both, the cheapest first."""
    found = []
    for cost, error in sorted(points):
        if not found or error < found[-1][1]:
            found.append((cost, error))
    return found


def error_vs_time(rows):
    """A panel for each response, a curve for each setting, the front in grey."""
    responses = [column.removesuffix(" error [%]") for column in rows[0] if column.endswith(" error [%]")]
    drawn, axes = plt.subplots(1, len(responses) + 1, figsize=(3.3 * (len(responses) + 1), 3.9), squeeze=False)
    knobs = list(dict.fromkeys(row["knob"] for row in rows if row["knob"] != "base"))
    handles = {}
    for axis, response in zip(axes[0], responses):
        known = [(row["knob"], row["setting"], number(row[COST]), number(row[f"{response} error [%]"])) for row in rows
                 if row[COST] and row[f"{response} error [%]"] and row.get("new sample") != "1" and row["knob"] != "grains"]
        known = [point for point in known if point[-1] > 0.0]
        handles["front"], = axis.step(*zip(*front_of([point[2:] for point in known])), where="post", color=figures.BLACK, linewidth=4.0, alpha=0.15)
        for knob, group in itertools.groupby(known, key=lambda point: point[0]):
            _, settings, costs, errors = zip(*group)
            ordered = all(re.fullmatch(r"[0-9.e+-]+", setting) for setting in settings)
            k = knobs.index(knob) if knob in knobs else -1
            style = {"marker": MARKERS[k % len(MARKERS)], "color": COLOURS[k % len(COLOURS)], "markersize": 4 if k >= 0 else 10}
            if k < 0:
                style["markerfacecolor"] = "none"
            handles[knob], = axis.plot(costs, errors, linestyle="-" if ordered else "", **style)
        axis.set(xscale="log", yscale="log", xlabel="CPU time over the base setting's [-]", title=response)
    axes[0][0].set_ylabel("error relative to the reference [%]")
    axes[0][-1].axis("off")
    axes[0][-1].legend(handles.values(), handles.keys(), loc="center left")
    return drawn


DRAWN = {"beyond_map": beyond_map, "beyond_dips": beyond_dips, "device": device, "objectivity": objectivity}
there = sorted(path.stem for path in data_folder().glob("*.csv") if path.stem in DRAWN or path.stem.startswith("error_vs_time_"))
wanted = sys.argv[1:] or there
if unknown := set(wanted) - set(there):
    sys.exit(f"figures.py: there are no data of {', '.join(sorted(unknown))}: run the benchmark first, or choose among {', '.join(there)}")
folder = pathlib.Path(ROOT / "docs" / "figures" if data_folder() == ROOT / "docs" / "data" else data_folder())
for name in wanted:
    figures.save(DRAWN.get(name, error_vs_time)(read_table(data_folder() / f"{name}.csv")), folder / f"{name}.png")
    print(folder / f"{name}.png")
