# SPDX-License-Identifier: BSL-1.0
"""Sketches of the method: levels of the scheme, load step, rooms of the library."""
import numpy as np
from drawing import arrow, box, canvas, house, save
from matplotlib.patches import Ellipse, Polygon


def mesh(axes):
    """A sheared layer of triangles with one integration point marked."""
    def place(i, j):
        return 0.62 * i + 0.12 * j * (i > 2), 0.62 * j - 0.22 * max(i - 2, 0)
    for i in range(5):
        for j in range(3):
            for corners in (((i, j), (i + 1, j), (i, j + 1)), ((i + 1, j), (i + 1, j + 1), (i, j + 1))):
                axes.add_patch(Polygon([place(*corner) for corner in corners], facecolor="#F7F3EC", edgecolor=house.GREY, linewidth=0.9))
                axes.plot(*np.mean([place(*corner) for corner in corners], axis=0), ".", color=house.GREY, markersize=3)
    axes.plot(*np.mean([place(3, 1), place(4, 1), place(3, 2)], axis=0), "o", color=house.VERMILION, markersize=6)
    axes.text(1.6, 2.25, "mesh", ha="center", fontsize=10, weight="bold")
    axes.text(1.6, -1.05, r"equilibrium: $r(u)=f^{int}-f^{ext}=0$", ha="center", fontsize=8)


def packing(axes, x, y):
    """A sheared periodic cell of ellipses."""
    random = np.random.default_rng(4)
    shear = np.array([[1.0, 0.25], [0.0, 0.96]])
    for i in range(6):
        for j in range(6):
            at = shear @ (np.array([i + 0.5 * (j % 2), j]) * 0.42 - 1.05 + 0.03 * random.standard_normal(2))
            axes.add_patch(Ellipse((x + at[0], y + at[1]), 0.43, 0.34, angle=random.uniform(0, 180), facecolor="#E8D9B5", edgecolor=house.BLACK, linewidth=0.7))
    corners = [shear @ np.array(corner) for corner in ((-1.15, -1.2), (1.35, -1.2), (1.35, 1.3), (-1.15, 1.3))]
    axes.add_patch(Polygon([(x + a, y + b) for a, b in corners], fill=False, edgecolor=house.BLUE, linewidth=1.4, linestyle="--"))
    axes.text(x + 0.1, 2.25, "packing (RVE)", ha="center", fontsize=10, weight="bold")
    axes.text(x + 0.1, -1.05, "explicit DEM steps in a periodic cell", ha="center", fontsize=8)


def scheme():
    figure, (axes,) = canvas(8.4, 3.1, (-0.3, 11.2, -1.3, 2.6))
    mesh(axes)
    box(axes, 5.4, 0.7, 1.9, 1.5, "material point\n\ncommitted state\ntrial state", house.VERMILION)
    packing(axes, 9.4, 0.65)
    arrow(axes, (3.3, 1.25), (4.4, 1.25), r"$G=\partial\Delta u/\partial x$", shift=(0, 0.25))
    arrow(axes, (4.4, 0.15), (3.3, 0.15), r"$\sigma,\;D$", shift=(0, -0.25), colour=house.VERMILION)
    arrow(axes, (6.4, 1.25), (7.9, 1.25), r"$L=\ln(I+G)$", shift=(0, 0.25))
    arrow(axes, (7.75, 0.15), (6.4, 0.15), r"$\sigma=-\frac{1}{V}\sum f\otimes l$", shift=(0, -0.32), colour=house.VERMILION)
    return figure


def load_step():
    figure, (axes,) = canvas(8.4, 4.3, (0, 12.6, 0, 6.4))
    steps = [(2, "1 start\ntangents, stiffness, factors"), (6.3, "2 prediction\nmotion of the step before"), (10.6, "3 plan\nDEM steps of each point")]
    for x, text in steps:
        box(axes, x, 5.6, 3.5, 1.0, text)
    arrow(axes, (3.75, 5.6), (4.55, 5.6))
    arrow(axes, (8.05, 5.6), (8.85, 5.6))
    box(axes, 10.6, 3.6, 3.5, 1.2, "4 response of all points\nfrom committed states\n(packings)", house.VERMILION)
    box(axes, 6.3, 3.6, 3.5, 1.0, "5 residual\nof forces and of packings")
    box(axes, 2, 3.6, 3.5, 1.0, "6 correction\ntangents learn, new factors")
    arrow(axes, (10.6, 5.1), (10.6, 4.2))
    arrow(axes, (8.85, 3.6), (8.05, 3.6))
    arrow(axes, (4.55, 3.6), (3.75, 3.6), "above", shift=(0, 0.22))
    axes.plot([2, 2, 10.6], [3.1, 2.35, 2.35], color=house.BLACK, linewidth=1.2)
    arrow(axes, (10.6, 2.35), (10.6, 3.0), "next iterate", shift=(-2.4, -0.5))
    box(axes, 6.3, 0.75, 3.5, 1.0, "7 accepted: commit, observe\nlarger or smaller increment", house.GREEN)
    axes.plot([6.3, 6.3], [3.1, 2.45], color=house.BLACK, linewidth=1.2)
    arrow(axes, (6.3, 2.25), (6.3, 1.25), "within tolerance", shift=(1.1, -0.02))
    box(axes, 10.6, 0.75, 3.5, 1.0, "rejected: nothing to undo\nhalve the increment", house.ORANGE)
    axes.plot([11.8, 11.8], [3.0, 2.0], color=house.ORANGE, linewidth=1.2)
    arrow(axes, (11.8, 2.0), (11.8, 1.25), "fails", colour=house.ORANGE, shift=(0.4, 0.1))
    arrow(axes, (4.55, 0.75), (0.15, 0.75), "next load step", shift=(0.5, 0.22), style="-")
    axes.plot([0.15, 0.15], [0.75, 5.6], color=house.BLACK, linewidth=1.2)
    arrow(axes, (0.15, 5.6), (0.25, 5.6))
    return figure


ROOMS = [
    ("application", ["fault"], "ready scenes over a fault", house.PURPLE),
    ("a run", ["budget", "observe", "run"], "errors, output, checkpoints", house.GREY),
    ("equilibrium", ["solver"], "problems, load steps, iterations, executors", house.BLUE),
    ("continuum", ["bvp", "points"], "assembly, loads, interfaces; batches of points", house.BLUE),
    ("materials", ["rve", "constitutive"], "packings as providers; laws and adaptors", house.VERMILION),
    ("grains", ["io/packings", "homogenise", "cuda", "dem"], "stress and tangent of a packing; time stepping", house.VERMILION),
    ("parts", ["io/gmsh", "io", "mesh", "element", "contact", "shape"], "elements, contact laws, grain shapes, files", house.GREEN),
    ("base", ["tensor", "simd", "core"], "tensors, packs of numbers, verdicts, errors", house.BLACK)]


def rooms():
    figure, (axes,) = canvas(8.4, 3.6, (0, 14.4, 0, 6.0))
    for line, (kind, names, purpose, colour) in enumerate(ROOMS):
        y = 5.6 - 0.72 * line
        axes.text(1.6, y, kind, ha="right", va="center", fontsize=8.5, color=house.GREY)
        width = 7.6 / len(names)
        for k, name in enumerate(names):
            box(axes, 1.8 + width * (k + 0.5), y, width - 0.12, 0.52, name, colour, size=7.5)
        axes.text(9.55, y, purpose, va="center", fontsize=7.5)
    arrow(axes, (0.12, 5.8), (0.12, 0.35), "may include", shift=(0.2, 0), rotation=90, colour=house.GREY)
    return figure


save(scheme(), "scheme")
save(load_step(), "load_step")
save(rooms(), "rooms")
