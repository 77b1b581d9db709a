# SPDX-License-Identifier: BSL-1.0
"""plot.py OUTPUT_DIR: how the specimen fails, and the forces on the way."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import numpy as np
import scarp_figures as figures
from matplotlib.collections import PolyCollection
from matplotlib.colors import Normalize
from scarp_figures import BLUE, GREY, VERMILION, plt

SHARES = (0.6, 0.8, 1.0)  # of the test, one panel each


def read_steps(folder):
    """[(axial strain, grid, file)] of the steps nearest to these shares of the test so far, none twice."""
    series = figures.read_pvd(folder / "fields.pvd")
    last = series[-1][0]
    steps = sorted({min(series, key=lambda step: abs(step[0] - share * last)) for share in SHARES})
    return [(strain, figures.read_vtu(path), path) for strain, path in steps]


def draw_cells(axes, grid, values, colours, most, least=0.0):
    """In the deformed configuration [mm]."""
    cells = PolyCollection(1e3 * grid.points[grid.cells], array=values, cmap=colours, norm=Normalize(least, most),
                           edgecolor="#00000040", linewidth=0.15)
    axes.add_collection(cells)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.grid(False)
    axes.set_xlabel("x [mm]")
    return cells


def band(folder):
    steps = read_steps(folder)
    strains = [100.0 * figures.field(grid.at_cells, "deviatoric_strain", path) for _, grid, path in steps]
    most = max(np.percentile(strains[-1], 99.0), 1e-9)
    fig, panels = plt.subplots(1, len(steps), figsize=(2.3 * len(steps) + 0.6, 4.4), sharex=True, sharey=True,
                               squeeze=False)
    for axes, (axial, grid, _), strain in zip(panels[0], steps, strains):
        cells = draw_cells(axes, grid, strain, "magma_r", most)
        axes.set_title(f"axial strain {100.0 * axial:.1f} %")
    panels[0, 0].set_ylabel("y [mm]")
    fig.colorbar(cells, ax=panels, label="deviatoric strain [%]", shrink=0.7, extend="max")
    return fig


def curve(folder):
    table = figures.read_csv(folder / "table.csv", ["axial_strain", "top_force", "mean_sxx", "mean_syy"])
    strain = 100.0 * table["axial_strain"]
    fig, (stress, force) = plt.subplots(1, 2, figsize=(7.0, 2.8))
    stress.plot(strain, -1e-3 * table["mean_syy"], color=VERMILION, label="axial")
    stress.plot(strain, -1e-3 * table["mean_sxx"], color=GREY, label="lateral")
    stress.set(xlabel="axial strain [%]", ylabel="mean compressive stress [kPa]", ylim=(0.0, None))
    stress.legend()
    force.plot(strain, 1e-3 * table["top_force"], color=BLUE)
    force.set(xlabel="axial strain [%]", ylabel="force of the top platen [kN]", ylim=(0.0, None))
    return fig


def undrained(folder):
    """Strength and excess pressure over the strain, and the paths of effective and total stress."""
    table = figures.read_csv(folder / "table.csv", ["axial_strain", "mean_sxx", "mean_syy", "mean_excess_pressure"])
    strain = 100.0 * table["axial_strain"]
    deviator = 1e-3 * (table["mean_sxx"] - table["mean_syy"])
    mean = -5e-4 * (table["mean_sxx"] + table["mean_syy"])
    excess = 1e-3 * table["mean_excess_pressure"]
    fig, (course, path) = plt.subplots(1, 2, figsize=(7.0, 2.8))
    course.plot(strain, deviator, color=VERMILION, label="q, axial less lateral stress")
    course.plot(strain, excess, color=BLUE, label="mean excess pore pressure")
    course.set(xlabel="axial strain [%]", ylabel="stress [kPa]")
    path.plot(mean, deviator, color=VERMILION, label="effective")
    path.plot(mean + excess, deviator, color=GREY, label="total, less the water at rest")
    path.set(xlabel="mean compressive stress [kPa]", ylabel="q [kPa]", xlim=(0.0, None), ylim=(0.0, None))
    for axes in (course, path):
        axes.legend()
    return fig


def excess_pressure(folder):
    """Strain and excess pressure of the elements in the last picture. Within the specimen pressures differ little."""
    axial, path = figures.read_pvd(folder / "fields.pvd")[-1]
    grid = figures.read_vtu(path)
    strain = 100.0 * figures.field(grid.at_cells, "deviatoric_strain", path)
    pressure = figures.field(grid.at_nodes, "excess_pore_pressure", path)[grid.cells].mean(axis=1)
    mean = pressure.mean()
    fig, panels = plt.subplots(1, 2, figsize=(6.4, 4.2), sharex=True, sharey=True)
    drawn = (draw_cells(panels[0], grid, strain, "magma_r", max(np.percentile(strain, 99.0), 1e-9)),
             draw_cells(panels[1], grid, pressure - mean, "viridis", pressure.max() - mean, pressure.min() - mean))
    labels = "deviatoric strain [%]", f"excess pore pressure less its mean of {1e-3 * mean:.1f} kPa [Pa]"
    for axes, cells, label in zip(panels, drawn, labels):
        axes.set_title(f"axial strain {100.0 * axial:.1f} %")
        fig.colorbar(cells, ax=axes, label=label, shrink=0.7)
    panels[0].set_ylabel("y [mm]")
    return fig


def figures_of(folder):
    """Water has figures of its own."""
    chosen = {"band": band, "curve": curve}
    table = folder / "table.csv"
    if table.is_file() and "mean_excess_pressure" in table.read_text().partition("\n")[0]:
        chosen |= {"undrained": undrained, "excess_pressure": excess_pressure}
    return chosen


figures.draw_all(figures_of(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
