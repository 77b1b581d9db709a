# SPDX-License-Identifier: BSL-1.0
"""Figures 3 to 5 of the reference study by our runs."""
import numpy as np
from matplotlib.collections import PolyCollection
from matplotlib.colors import PowerNorm
from PIL import Image
from scarp_figures import BLACK, BLUE, GREEN, GREY, ORANGE, VERMILION, plt

COLOURS = {"free": BLUE, "light": GREEN, "heavy": VERMILION}
DEPTH = 25.0           # [m]
FOOTING_THROW = 1.99 / DEPTH  # of the reference study's fig. 4
THROWS = [0.028, 0.057, 0.085]
SHOWN = "1 m"          # length of the runs in the figures
OTHERS = {"2 m": "--"}  # beside it in the free field
MOST_STRAIN = 120.0    # of the colours [%]


def saved(drawn, path):
    """256 colours are enough for a page, and a third of the bytes."""
    drawn.savefig(path, dpi=110)
    plt.close(drawn)
    Image.open(path).convert("RGB").quantize().save(path, optimize=True)


def nearest(frames, throw):
    return min(frames, key=lambda frame: abs(frame.throw - throw))


def draw_strain(axes, frame, high):
    moved = frame.places + frame.displacement
    cells = PolyCollection(moved[frame.cells], array=100.0 * frame.fields["deviatoric_strain"], cmap="magma_r", norm=PowerNorm(0.5, 0.0, high),
                           edgecolor="face", linewidth=0.2)
    axes.add_collection(cells)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.grid(False)
    return cells


def surface(frames, throw):
    """Places [m] and settlement over throw of the surface's nodes."""
    first, frame = frames[0], nearest(frames, throw)
    top = np.flatnonzero(first.places[:, 1] > DEPTH - 1e-6)
    top = top[np.argsort(first.places[top, 0])]
    return first.places[top, 0], (frame.settlement - first.settlement)[top] / (frame.throw * DEPTH)


def mark(axes, points, level):
    for name, x in points.items():
        axes.plot(x, level, "o", color=BLACK, markersize=3)
        axes.annotate(name, (x, level), (2, 3), textcoords="offset points", fontsize=8)


def free_field(sets, level):
    """After the reference study's fig. 3."""
    one = sets[SHOWN]
    frames = one.runs["free"].frames
    drawn, (top, low) = plt.subplots(2, 1, figsize=(7.6, 6.2), height_ratios=[1.0, 1.1])
    cells = draw_strain(top, frames[-1], MOST_STRAIN)
    mark(top, one.points, level)
    drawn.colorbar(cells, ax=top, label="deviatoric strain [%]", extend="max", aspect=14)
    top.set(title="free field, h/H = 0.085", xlabel="x [m]", ylabel="y [m]")
    for throw, colour in zip(THROWS, (GREY, ORANGE, BLUE)):
        low.plot(*surface(frames, throw), color=colour, label=f"{SHOWN}, h/H = {nearest(frames, throw).throw:.3f}")
    for name, style in OTHERS.items():
        if "free" in sets[name].runs:
            low.plot(*surface(sets[name].runs["free"].frames, THROWS[-1]), style, color=BLACK, linewidth=1.0, label=f"{name}, h/H = 0.085")
    low.axvline(-12.5, color=GREEN, linewidth=0.8, label="the reference study's outcrop, -12.5 m")
    low.invert_yaxis()
    low.set(xlabel="x [m]", ylabel="settlement of the surface over the throw")
    low.legend()
    return drawn


def footings(sets, level):
    """After the reference study's fig. 4."""
    one = sets[SHOWN]
    cases = [case for case in ("heavy", "light") if case in one.runs]
    drawn, rows = plt.subplots(len(cases), 1, figsize=(7.6, 3.0 * len(cases)), squeeze=False)
    for axes, case in zip(rows[:, 0], cases):
        frame = nearest(one.runs[case].frames, FOOTING_THROW)
        cells = draw_strain(axes, frame, MOST_STRAIN)
        mark(axes, one.points, level)
        axes.plot([-15.5, -5.5], [DEPTH + 0.6] * 2, color=COLOURS[case], linewidth=3, solid_capstyle="butt")
        drawn.colorbar(cells, ax=axes, label="deviatoric strain [%]", extend="max", aspect=14)
        axes.set(title=f"{case} footing, h = {frame.throw * DEPTH:.2f} m (bar: where the footing stood)", xlabel="x [m]", ylabel="y [m]")
    return drawn


def over_strain(sets, quantities):
    """A row for each of (name, label, factor), columns A and B: means of the packings around each point, and one deviation among them."""
    one = sets[SHOWN]
    drawn, rows = plt.subplots(len(quantities), 2, figsize=(7.6, 2.7 * len(quantities)), sharex="col", squeeze=False)
    for column, point in zip(rows.T, ("A", "B")):
        for axes, (name, label, factor) in zip(column, quantities):
            for case, colour in COLOURS.items():
                if (case, point) not in one.histories:
                    continue
                series = one.histories[case, point]
                strain, values = 100.0 * series["eps_q"].mean(axis=1), factor * series[name]
                axes.plot(strain, values.mean(axis=1), color=colour, label=case)
                axes.fill_between(strain, values.mean(axis=1) - values.std(axis=1), values.mean(axis=1) + values.std(axis=1), color=colour, alpha=0.12, linewidth=0)
            axes.set_ylabel(label)
        column[0].set_title(f"{point}, x = {one.points[point]:.1f} m" if point in one.points else point, loc="left")
        column[-1].set_xlabel("deviatoric strain [%]")
    rows[0, 0].legend()
    return drawn


def write(folder, sets, level):
    """Those whose runs are there."""
    runs = sets[SHOWN].runs.keys()
    if "free" in runs:
        saved(free_field(sets, level), folder / "study_free.png")
    if {"heavy", "light"} <= runs:
        saved(footings(sets, level), folder / "study_footings.png")
    if runs == COLOURS.keys():
        saved(over_strain(sets, [("q", "(s1 - s3)/2 [kPa]", 1e-3), ("eps_v", "volumetric strain [%]", 100.0)]), folder / "study_stress.png")
