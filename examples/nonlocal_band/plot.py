# SPDX-License-Identifier: BSL-1.0
"""Draws load curves and shear strains of the specimens that nonlocal_band --output wrote: plot.py <folder>"""

import pathlib
import sys

import matplotlib.pyplot as plt

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import scarp_figures as figures  # noqa: E402

COLOURS = [figures.SKY, figures.ORANGE, figures.BLACK]
STYLES = ["-", "--", ":"]


def runs(folder):
    """Rows of (length, [(cells, name), ...]) of what a folder holds, local first."""
    found = {}
    for path in folder.glob("shear_*_*.csv"):
        _, cells, length = path.stem.split("_")
        found.setdefault(float(length), []).append((int(cells), f"{cells}_{length}"))
    if not found:
        raise figures.InputError(f"no shear_*.csv in '{folder}' (no run wrote there): run nonlocal_band --output")
    return [(length, sorted(found[length])) for length in sorted(found)]


def bands(folder):
    rows = runs(folder)
    columns = max(len(meshes) for _, meshes in rows)
    fig = plt.figure(figsize=(2.9 + 1.5 * columns, 2.8 * len(rows)))
    grid = fig.add_gridspec(len(rows), columns + 1, width_ratios=[2.2] + [1.0] * columns)
    top = 0.0
    for row, (length, meshes) in enumerate(rows):
        title = f"$l$ = {length:g} m" if length else "local"
        load = fig.add_subplot(grid[row, 0])
        for k, (cells, name) in enumerate(meshes):
            table = figures.read_csv(folder / f"load_{name}.csv", ["settlement [m]", "pressure [Pa]"])
            load.plot(1e3 * table["settlement [m]"], 1e-3 * table["pressure [Pa]"], STYLES[k % 3],
                      color=COLOURS[k % 3], label=f"{cells} cells")
            top = max(top, 1e-3 * table["pressure [Pa]"].max())
            view = fig.add_subplot(grid[row, k + 1])
            points = figures.read_csv(folder / f"shear_{name}.csv", ["x [m]", "y [m]", "shear strain"])
            shades = view.tripcolor(points["x [m]"], points["y [m]"], points["shear strain"], shading="gouraud",
                                    cmap="viridis", vmin=0.0, vmax=0.15)
            view.set(aspect="equal", xticks=[], yticks=[], xlim=(0.0, 1.0), ylim=(0.0, 2.0),
                     title=f"{cells} cells")
            view.grid(False)
        fig.colorbar(shades, ax=fig.axes[-len(meshes):], shrink=0.8, label="shear strain [-]", extend="max")
        load.set(xlabel="settlement [mm]", ylabel="mean pressure on the top [kPa]", title=title)
        load.legend(loc="lower right")
    for axes in fig.axes:
        if axes.get_xlabel().startswith("settlement"):
            axes.set_ylim(0.0, 1.05 * top)
    return fig


if __name__ == "__main__":
    figures.draw_all({"nonlocal_band": bands})
