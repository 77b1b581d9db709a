# SPDX-License-Identifier: BSL-1.0
"""The curves of `rve_lab test`, with those of other runs and of laboratory tables."""

import csv
import pathlib

import numpy as np
import scarp_figures as figures
from scarp_figures import BLACK, BLUE, GREEN, GREY, ORANGE, PALE, PURPLE, SKY, VERMILION, plt

COLOURS = (VERMILION, GREEN, PURPLE, ORANGE, SKY, BLACK)
# Quantities by the names of a laboratory's columns, their factor to per cent, kPa and one.
AXIAL = {"axial_strain": 100.0, "axial_strain_percent": 1.0, "eps1_percent": 1.0, "eps1": 100.0, "engineering_axial_strain": 100.0,
         "engineering_axial_strain_percent": 1.0}
NAMES = {"strain": {"length": 100.0, **AXIAL, "gamma_percent": 1.0},
         "volume": {"volumetric_strain": 100.0, "volumetric_strain_percent": 1.0, "epsv_percent": 1.0, "epsv": 100.0,
                    "engineering_volumetric_strain": 100.0, "engineering_volumetric_strain_percent": 1.0},
         "q": {"q": 1e-3, "q_kPa": 1.0}, "p": {"p": 1e-3, "p_kPa": 1.0},
         "axial": {"axial_stress": 1e-3, "sigma1_kPa": 1.0, "sig1_kPa": 1.0},
         "lateral": {"lateral_stress": 1e-3, "sigma3_kPa": 1.0, "sig3_kPa": 1.0}, "void_ratio": {"void_ratio": 1.0, "e": 1.0}}


def read_laboratory(path):
    """Columns of a laboratory's table, parted by commas, semicolons or tabs as `rve_lab calibrate` reads it."""
    figures.require_file(path)
    try:
        text = path.read_text(encoding="utf-8-sig")
    except UnicodeError:
        raise figures.InputError(f"'{path}' is no UTF-8 text: save it as CSV in UTF-8") from None
    lines = [line for line in text.splitlines() if line.strip(" \t,;")]
    parted = lines.pop(0)[4] if lines and len(lines[0]) == 5 and lines[0].startswith("sep=") else None
    parted = parted or max(",;\t", key=lambda one: min((line.count(one) for line in lines[:2]), default=0))
    header, *rows = [[cell.strip() for cell in row] for row in csv.reader(lines, delimiter=parted)] or [[]]
    for row in (header, *rows):
        while row and not row[-1] and (row is header or len(row) > len(header)):
            row.pop()  # as spreadsheets leave them
    for line, row in enumerate(rows, start=2):
        if len(row) != len(header):
            raise figures.InputError(f"'{path}', row {line}, has {len(row)} cells (its header has {len(header)}): give one to each column")
    if not rows:
        raise figures.InputError(f"'{path}' holds no rows (a curve has some): leave it out")
    return {name: np.array([figures.number(row[k]) for row in rows]) for k, name in enumerate(header)}


def read_curves(path, by_axial_strain=False):
    """Curves of a table, one for each point: {quantity: array}, NaN where the table does not have it.
    by_axial_strain: also of runs, as for paths of a table, whose length counts its rows."""
    table = figures.read_csv(path, []) if path.name == "test.csv" else read_laboratory(path)
    count = len(next(iter(table.values())))
    curve = {}
    for quantity, names in NAMES.items():
        names = {**AXIAL, **names} if quantity == "strain" and by_axial_strain else names
        name = next((name for name in names if name in table), None)
        curve[quantity] = table[name] * names[name] if name else np.full(count, np.nan)
        if name and name.startswith("engineering_"):  # curves are of logarithmic strains
            curve[quantity] = -100.0 * np.log1p(-curve[quantity] / 100.0)
    for missing, quantities in (("strain", ["strain"]), ("stress, volumetric strain or void ratio", [name for name in NAMES if name != "strain"])):
        if not any(np.isfinite(curve[quantity]).any() for quantity in quantities):
            known = ", ".join(name for quantity in quantities for name in NAMES[quantity])
            raise figures.InputError(f"'{path}' has no column of a {missing} (it has: {', '.join(table)}): name one of {known}")
    curve["length"] = table.get("length", np.zeros(count))
    if is_cyclic(curve) and "shear_stress" in table:  # a deviator that changes sign with the direction
        shear = 2.0 * table["shear_stress"]
        axial = table["axial_stress"] - table["lateral_stress"] if {"axial_stress", "lateral_stress"} <= set(table) else np.zeros(count)
        curve["q"] = 1e-3 * (axial if np.ptp(axial) > np.ptp(shear) else shear)
    points = table.get("point", np.zeros(count))
    rows = np.argsort(points, kind="stable")
    rows_of_points = np.split(rows, np.flatnonzero(np.diff(points[rows])) + 1)
    curves = [{name: values[own] for name, values in curve.items()} for own in rows_of_points]
    for one in curves:  # the total lateral stress is held
        one["pore"] = one["lateral"][0] - one["lateral"]
    return curves


def is_cyclic(curve):
    return np.nanmin(curve["strain"]) < 0.0 < np.nanmax(curve["strain"])


def mean_of(curves):
    """Over the tests that came farthest, as the summary has it, and how many; without a last row where each ended at a length of its own."""
    count = max(len(curve["strain"]) for curve in curves)
    longest = [curve for curve in curves if len(curve["strain"]) == count]
    ends = [curve["length"][-1] for curve in longest]
    rows = slice(count - 1 if np.ptp(ends) > 1e-9 * np.max(np.abs(ends)) else count)
    return {name: np.mean([curve[name][rows] for curve in longest], axis=0) for name in longest[0]}, len(longest)


def is_of_table(path):
    """Whether a test.csv is of a path of a table."""
    return path.name == "test.csv" and figures.read_summary(path.parent).get("path") == "table"


def laboratory(folder, overlays=()):
    summary = figures.read_summary(folder)
    overlays = [*summary.get("overlay", []), *overlays]
    places = [folder / "test.csv", *map(pathlib.Path, overlays)]
    by_axial_strain = any(map(is_of_table, places))
    own = read_curves(places[0], by_axial_strain)
    runs = [("this test", own, BLUE, "-")]
    for path, colour in zip(places[1:], COLOURS * len(overlays)):
        name = f"{path.resolve().parent.name}/{path.name}" if path.name == "test.csv" else path.stem
        runs.append((name, read_curves(path, by_axial_strain), colour, "--"))
    compresses = summary.get("path") in ("oedometer", "isotropic")
    fig, panels = plt.subplots(2, 2, figsize=(8.0, 6.2))
    q = "signed q [kPa]" if is_cyclic(own[0]) else "q [kPa]"
    shown = [("strain", "q", "strain [%]", q), ("p", "q", "p [kPa]", q),
             ("strain", "volume", "strain [%]", "volumetric strain [%]\n(contraction positive)"),
             ("axial" if compresses else "p", "void_ratio", f"{'axial stress' if compresses else 'p'} [kPa]", "void ratio")]
    at_constant_volume = all(np.nanmax(np.abs(curve["volume"]), initial=0.0) < 1e-6 for curve in own)
    if at_constant_volume:
        shown[2:] = [("strain", "p", "strain [%]", "p [kPa]"), ("strain", "pore", "strain [%]", "pore pressure [kPa]\n(total lateral stress held)")]
    if by_axial_strain:
        shown = [(x, y, "axial strain [%]" if x == "strain" else x_label, y_label) for x, y, x_label, y_label in shown]
    for axes, (x, y, x_label, y_label) in zip(panels.flat, shown):
        for name, curves, colour, dashes in runs:
            if len(curves) > 1:
                for curve in curves:
                    axes.plot(curve[x], curve[y], color=PALE if colour == BLUE else colour, linewidth=0.7, alpha=0.7)
            mean, used = mean_of(curves)
            of_all = "" if used == len(curves) else f" of {len(curves)}"
            label = name if len(curves) == 1 else f"{name}, mean of {used}{of_all}"
            axes.plot(mean[x], mean[y], dashes, color=colour, label=label)
        axes.set(xlabel=x_label, ylabel=y_label)
    if compresses:
        panels[1][1].set_xscale("log")
    mark_states(panels, summary, len(own), at_constant_volume)
    panels[0][0].legend(loc="best")
    fig.suptitle(f"{summary.get('path', 'test').replace('_', ' ').capitalize()} test", fontsize=10)
    return fig


def mark_states(panels, summary, count, at_constant_volume):
    results = summary.get("mean") or {}
    for name, marker in (("peak", "o"), ("phase_transformation", "^"), ("residual", "s")):
        state = results.get(name)
        if not state or summary.get("path") in ("oedometer", "isotropic"):
            continue
        label = name.replace("_", " ")
        if state.get("friction_angle") is not None:
            label += f", {state['friction_angle']:.1f}°"
        style = {"color": BLACK if count == 1 else GREY, "markersize": 4, "zorder": 5, "linestyle": "none"}
        panels[0][0].plot(100.0 * state["strain"], 1e-3 * state["q"], marker, label=label, **style)
        panels[0][1].plot(1e-3 * state["p"], 1e-3 * state["q"], marker, **style)
        panels[1][0].plot(100.0 * state["strain"], 1e-3 * state["p"] if at_constant_volume else 100.0 * state["volumetric_strain"], marker, **style)
