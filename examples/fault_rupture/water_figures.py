# SPDX-License-Identifier: BSL-1.0
"""Figures of pore water in the ground of a fault: excess pressures, and what they do over time."""

import numpy as np
import scarp_figures as figures
from field_figures import Steps, outline, read_plane, triangles_of
from matplotlib.collections import LineCollection
from matplotlib.colors import Normalize
from matplotlib.tri import Triangulation
from scarp_figures import BLACK, BLUE, GREEN, GREY, VERMILION, plt


def has_begun(folder):
    """Whether the fault has moved in ground with water."""
    path = folder / "water.csv"
    return path.exists() and bool((figures.read_csv(path, ["time"])["time"] > 0.0).any())


def end_of_throw(folder):
    """Load factor from which the bedrock rests."""
    return figures.read_csv(folder / "water.csv", ["throw_over_depth"])["throw_over_depth"][-1]


def drainage(folder, time):
    """What a step after the end of the throw is told by, behind h/H."""
    return " and drainage" if has_begun(folder) and time > end_of_throw(folder) * (1.0 + 1e-6) else ""


def pressures(folder):
    """Excess pore pressure of the elements over the run, an animation."""
    throw = end_of_throw(folder)
    run = Steps(folder, lambda grid, path: 1e-3 * figures.field(grid.at_nodes, "excess_pore_pressure", path)[grid.cells].mean(axis=1))
    most = max(*(np.abs(values).max() for values in run.values), 1e-3)

    def title(time, values):
        rested = ", water drains" if time > throw * (1.0 + 1e-6) else ""
        return f"h/H = {min(time, throw):.4f}{rested}: {values.min():.3g} to {values.max():.3g} kPa"

    return run.animate(title, Normalize(-most, most), "excess pore pressure [kPa]", colours="RdBu")


def excess_pressure(folder):
    """Excess pore pressure over the ground at half of the throw, at its end, and at the end of the run."""
    throw = end_of_throw(folder)
    series = [step for step in figures.read_pvd(folder / "fields.pvd") if step[0] > 0.0]
    places = [np.argmin([abs(time - wanted) for time, _ in series]) for wanted in (throw / 2, throw, 2 * throw)]
    grids = [(series[k], read_plane(series[k][1])) for k in np.unique(places)]
    values = [1e-3 * figures.field(grid.at_nodes, "excess_pore_pressure", path) for (_, path), grid in grids]
    most = max(*(np.abs(pressure).max() for pressure in values), 1e-3)
    fig, panels = plt.subplots(len(grids), 1, figsize=(6.4, 0.6 + 2.0 * len(grids)), sharex=True, squeeze=False)
    for axes, ((time, _), grid), pressure in zip(panels[:, 0], grids, values):
        mesh = Triangulation(*grid.points.T, triangles_of(grid))
        filled = axes.tricontourf(mesh, pressure, levels=np.linspace(-most, most, 15), cmap="RdBu", norm=Normalize(-most, most))
        axes.add_collection(LineCollection(outline(grid), colors=GREY, linewidths=0.6))
        axes.set(ylabel="y [m]", aspect="equal",
                 title=f"Excess pore pressure, h/H = {min(time, throw):.3g}{drainage(folder, time)}: {pressure.min():.3g} to {pressure.max():.3g} kPa")
        axes.grid(False)
    panels[-1, 0].set_xlabel("x [m]")
    fig.colorbar(filled, ax=panels[:, 0], label="excess pore pressure [kPa]", aspect=35)
    return fig


def water(folder):
    """Excess pressures, volumes of water and what the surface does, over the time since the fault began to move."""
    table = figures.read_csv(folder / "water.csv", ["time", "throw_over_depth", "excess_pressure_min", "excess_pressure_max", "expelled",
                                                    "vapour", "surface_x50", "settlement"])
    moving = table["time"] > 0.0
    time = table["time"][moving]
    curves = {name: values[moving] for name, values in table.items()}
    end = time[np.argmax(curves["throw_over_depth"])]
    fig, (pressure, volume, surface) = plt.subplots(3, 1, figsize=(5.6, 6.6), sharex=True)
    pressure.plot(time, 1e-3 * curves["excess_pressure_max"], color=BLUE, label="largest")
    pressure.plot(time, 1e-3 * curves["excess_pressure_min"], color=VERMILION, label="least")
    pressure.set(ylabel="excess pore pressure [kPa]", xscale="log")
    volume.plot(time, curves["expelled"], color=BLUE, label="water that has left")
    volume.plot(time, curves["vapour"], color=VERMILION, label="vapour")
    volume.set(ylabel="volume [m³ per m]")
    surface.plot(time, curves["surface_x50"], color=GREEN, label="half of the throw")
    surface.set(xlabel="time since the fault began to move [s]", ylabel="x [m]")
    if np.isfinite(curves["settlement"]).any():
        footing = surface.twinx()
        footing.plot(time, curves["settlement"], color=BLUE)
        footing.set_ylabel("settlement of the footing [m]", color=BLUE)
        footing.grid(False)
    for axes in (pressure, volume, surface):
        axes.axvline(end, color=BLACK, linestyle=":", linewidth=0.9, label="end of the throw")
        axes.legend(fontsize=7)
    return fig
