# SPDX-License-Identifier: BSL-1.0
"""plot.py OUTPUT_DIR: settlement of the surface as a map, and strain on the sides of the slab."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import numpy as np
import scarp_figures as figures
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from scarp_figures import BLACK, ORANGE, SKY, plt

FRONT, BACK = (0, 1, 5, 4), (3, 2, 6, 7)  # corners of a hexahedron on its sides along the strike, in VTK's order


def draw_map(fig, axes, folder):
    table = figures.read_csv(folder / "surface.csv", ["x", "y", "settlement"])
    lines = np.unique(table["y"])
    rows = [table["settlement"][table["y"] == y] for y in lines]
    if len(lines) < 2 or any(len(row) != len(rows[0]) for row in rows):
        raise figures.InputError(f"'{folder / 'surface.csv'}' is no grid of lines along the strike: run the example anew")
    across = table["x"][table["y"] == lines[0]]
    shades = axes.pcolormesh(across, lines, np.array(rows), shading="gouraud", cmap="viridis")
    fig.colorbar(shades, ax=axes, label="settlement [m]", aspect=14)
    sections = figures.read_summary(folder).get("sections") or []
    for name, style, colour in (("x05", ":", SKY), ("x50", "-", ORANGE), ("x95", "--", SKY)):
        places = [(figures.finite(section.get(name)), section["y"]) for section in sections]
        places = [place for place in places if place[0] is not None]
        if places:
            axes.plot(*zip(*places), style, color=colour, marker="o", markersize=3,
                      label=f"{int(name[1:])} % of the throw below")
    axes.axvline(0.0, color="white", linewidth=0.8)
    axes.annotate("fault at bedrock", (0.0, lines[-1]), xytext=(3, -9), textcoords="offset points", color="white",
                  fontsize=7)
    axes.legend(loc="lower left", labelcolor="white", fontsize=7, handlelength=3.0)
    axes.grid(False)
    axes.set(aspect="equal", ylabel="along the strike [m]", xlim=(across[0], across[-1]), ylim=(lines[0], lines[-1]))


def side(grid, corners, y):
    """Numbers of the elements on a side of the slab and their outlines there."""
    nodes = grid.cells[:, list(corners)]
    there = np.all(np.isclose(grid.points[nodes][:, :, 1], y), axis=1)
    return there, grid.points[nodes[there]][:, :, [0, 2]]


def slab(folder):
    throw, path = figures.read_pvd(folder / "fields.pvd")[-1]
    grid = figures.read_vtu(path)
    if grid.cells.shape[1] != 8:
        raise figures.InputError(f"'{path}' holds no hexahedra: run the example anew")
    strain = 100.0 * figures.field(grid.at_cells, "deviatoric_strain", path)
    fig, (top, near, far) = plt.subplots(3, 1, figsize=(7.2, 9.0), sharex=True, height_ratios=[1.9, 1, 1])
    draw_map(fig, top, folder)
    top.set_title(f"Settlement of the surface at h/H = {throw:.3g} on the near side", loc="left")
    limit = Normalize(0.0, max(np.quantile(strain, 0.99), 1e-9))
    ends = grid.points[:, 1].min(), grid.points[:, 1].max()
    for axes, corners, y, name in ((near, FRONT, ends[0], "near"), (far, BACK, ends[1], "far")):
        there, outlines = side(grid, corners, y)
        cells = PolyCollection(outlines, array=strain[there], norm=limit, cmap="magma_r", edgecolors="#00000030",
                               linewidths=0.3)
        axes.add_collection(cells)
        axes.set(aspect="equal", ylim=(grid.points[:, 2].min() - 0.5, grid.points[:, 2].max() + 0.5))
        axes.grid(False)
        axes.plot(0.0, 0.0, "^", color=BLACK, markersize=4, clip_on=False)
        axes.set_ylabel("height [m]")
        axes.set_title(f"{name.capitalize()} side, largest strain {strain[there].max():.2g} %", loc="left")
        fig.colorbar(cells, ax=axes, label="deviatoric strain [%]", extend="max", aspect=9)
    far.set_xlabel("across the fault [m]")
    return fig


if __name__ == "__main__":
    figures.draw_all({"fault_slab": slab})
