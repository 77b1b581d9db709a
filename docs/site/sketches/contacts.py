# SPDX-License-Identifier: BSL-1.0
"""Sketches of grains: signs at a contact and of stress, shapes, forces of the laws from docs/data/law_curves.csv."""
import csv

import numpy as np
from drawing import ROOT, arrow, canvas, house, plt, save
from matplotlib.patches import Circle, Ellipse, Polygon, Rectangle

GRAIN = "#E8D9B5"


def contact(axes):
    """Two overlapping ellipses with branch, normal, overlap, slip and force."""
    first, second = np.array([0.0, 0.0]), np.array([2.55, 0.55])
    axes.add_patch(Ellipse(first, 3.0, 2.1, angle=18, facecolor=GRAIN, edgecolor=house.BLACK, alpha=0.75))
    axes.add_patch(Ellipse(second, 2.6, 1.9, angle=-25, facecolor=GRAIN, edgecolor=house.BLACK, alpha=0.75))
    axes.plot(*np.transpose([first, second]), ".", color=house.BLACK)
    axes.text(-0.25, 0.12, "first", ha="right", fontsize=8)
    axes.text(2.75, 0.6, "second", fontsize=8)
    arrow(axes, first, second, r"branch $l$", house.GREY, at=0.2, shift=(0.1, -0.3))
    normal = np.array([0.995, 0.1])
    tangent = np.array([-normal[1], normal[0]])
    point = np.array([1.42, 0.33])
    arrow(axes, point, point + 1.25 * normal, r"$n$: 1 to 2", house.BLUE, at=1.0, shift=(0.05, -0.28))
    arrow(axes, point, point + 1.25 * tangent, r"$t=(-n_y,n_x)$", house.BLUE, at=1.0, shift=(0.1, 0.16))
    arrow(axes, (2.75, 1.55), (2.75 + 1.0 * normal[0], 1.55 + 1.0 * normal[1]), r"$F_n>0$ on 2", house.VERMILION, shift=(0.1, 0.22))
    arrow(axes, (0.1, 1.45), (-0.9, 1.35), r"$-f$ on 1", house.VERMILION, shift=(0, 0.22))
    arrow(axes, (1.25, -1.05), (1.6, -1.05), style="<|-|>", colour=house.GREEN)
    axes.plot([1.25, 1.25], [-1.15, 0.2], [1.6, 1.6], [-1.15, 0.2], color=house.GREEN, linewidth=0.8, linestyle=":")
    axes.text(1.42, -1.5, r"overlap $u_n>0$", ha="center", fontsize=8, color=house.GREEN)
    arrow(axes, (3.9, -0.45), (3.9, 0.55), r"slip $\Delta s>0$", house.PURPLE, shift=(0.12, 0), ha="left")


def stress(axes):
    """Positive components of the stress on a square, and Voigt order."""
    axes.add_patch(Rectangle((-1, -1), 2, 2, facecolor="#F7F3EC", edgecolor=house.BLACK))
    for axis, sign in ((0, 1), (0, -1), (1, 1), (1, -1)):
        normal = np.zeros(2)
        normal[axis] = sign
        along = sign * np.array([1.0, 0.0] if axis else [0.0, 1.0])
        arrow(axes, 1.06 * normal, 1.75 * normal, colour=house.VERMILION)
        arrow(axes, 1.18 * normal - 0.5 * along, 1.18 * normal + 0.5 * along, colour=house.BLUE)
    axes.text(1.85, 0, r"$\sigma_{xx}$", va="center", color=house.VERMILION)
    axes.text(0, 1.95, r"$\sigma_{yy}$", ha="center", color=house.VERMILION)
    axes.text(1.3, 0.62, r"$\sigma_{xy}$", color=house.BLUE)
    axes.text(0, 0, "tension\npositive", ha="center", va="center", fontsize=8)
    axes.text(0, -2.25, "Voigt: xx, yy, xy", ha="center", fontsize=8)
    axes.text(0, -2.62, "in space: xx, yy, zz, yz, zx, xy", ha="center", fontsize=8)


def signs():
    figure, (left, right) = canvas(8.0, 3.3, (-2.0, 5.6, -2.7, 2.6), columns=2)
    left.set(xlim=(-1.9, 5.4), ylim=(-1.9, 2.3))
    right.set(xlim=(-3.2, 3.2), ylim=(-2.8, 2.4))
    contact(left)
    stress(right)
    return figure


def superellipse(half_x, half_y, exponent):
    angle = np.linspace(0, 2 * np.pi, 400)
    power = lambda value: np.sign(value) * np.abs(value) ** exponent
    return np.column_stack([half_x * power(np.cos(angle)), half_y * power(np.sin(angle))])


def shapes():
    figure, (axes,) = canvas(8.4, 1.75, (-1.2, 18.3, -1.7, 1.9))
    style = {"facecolor": GRAIN, "edgecolor": house.BLACK, "linewidth": 1.0}
    clumps = {"Dumbbell": [(-0.75, 0.0), (0.75, 0.0)], "Trefoil": [(-0.75, -0.433), (0.75, -0.433), (0.0, 0.866)],
              "Quatrefoil": [(-0.7, -0.7), (0.7, -0.7), (0.7, 0.7), (-0.7, 0.7)]}
    axes.add_patch(Circle((0, 0), 0.85, **style))
    axes.text(0, 1.4, "Disc, Sphere", ha="center", fontsize=7.5)
    axes.add_patch(Ellipse((2.5, 0), 2.1, 1.5, angle=20, **style))
    axes.text(2.5, 1.4, "Ellipse", ha="center", fontsize=7.5)
    for k, exponent in enumerate((0.3, 0.7, 1.4)):
        axes.add_patch(Polygon(superellipse(1.0, 0.72, exponent) + [5.2 + 2.4 * k, 0], **style))
        axes.text(5.2 + 2.4 * k, -1.5, rf"$\epsilon={exponent}$", ha="center", fontsize=7.5)
    axes.text(7.6, 1.4, "Superellipse", ha="center", fontsize=7.5)
    for k, discs in enumerate(clumps.values()):
        for disc in discs:
            axes.add_patch(Circle((12.1 + 2.35 * k + 0.55 * disc[0], 0.55 * disc[1]), 0.55, **style))
        axes.text(12.1 + 2.35 * k, -1.5, list(clumps)[k], ha="center", fontsize=7.5)
    axes.text(14.4, 1.4, "Clump", ha="center", fontsize=7.5)
    return figure


def laws():
    lines = (ROOT / "docs" / "data" / "law_curves.csv").read_text().splitlines()[1:]
    rows = list(csv.DictReader(lines))
    figure, (left, right) = plt.subplots(1, 2, figsize=(8.0, 2.9))
    colours = {"LinearFrictional": house.BLUE, "HertzMindlin": house.VERMILION, "CohesiveBond": house.GREEN}
    for law, colour in colours.items():
        for axes, path, along, force in ((left, "normal", "overlap", "normal_force"), (right, "shear", "slip", "shear_force")):
            chosen = [row for row in rows if (row["law"], row["path"]) == (law, path)]
            axes.plot([1e6 * float(row[along]) for row in chosen], [float(row[force]) for row in chosen], color=colour, label=law,
                      linestyle="--" if law == "CohesiveBond" else "-")
    left.set(xlabel="overlap [µm]", ylabel="normal force [N], positive pushes")
    right.set(xlabel="slip [µm], forth, back and forth", ylabel="shear force on the second grain [N]")
    left.legend()
    return figure


save(signs(), "signs")
save(shapes(), "shapes")
save(laws(), "laws")
