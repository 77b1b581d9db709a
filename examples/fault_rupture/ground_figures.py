# SPDX-License-Identifier: BSL-1.0
"""The ground of a fault rupture: its layer, an animation of the rupture, and principal stresses."""

import field_figures
import footing_figures
import numpy as np
import scarp_figures as figures


def rupture(folder):
    """Deviatoric strain on the deforming mesh over the run."""
    run = field_figures.Steps(folder)
    depth = layer_depth(run.grids[0], run.paths[0])
    summary, surface = figures.read_summary(folder), surface_level(run.grids[0], run.paths[0])
    blocks = [footing_figures.corners(folder, summary, throw, surface) for throw in run.times]
    return run.animate_strain(lambda throw: f"h/H = {throw:.4f}, throw {throw * depth:.2f} m", blocks)


def soil_of(grid, path):
    """Which cells are soil: those of the largest region."""
    region = figures.field(grid.at_cells, "region", path).astype(int)
    return region == np.argmax(np.bincount(region, field_figures.areas(grid.points[grid.cells])))


def layer_depth(grid, path):
    """[m], of the soil before it moved"""
    initial = grid.points - figures.field(grid.at_nodes, "displacement", path)[:, :2]
    return float(np.ptp(initial[grid.cells[soil_of(grid, path)], 1]))


def surface_level(grid, path):
    """y of the soil's surface before it moved [m]"""
    initial = grid.points - figures.field(grid.at_nodes, "displacement", path)[:, :2]
    return float(np.max(initial[grid.cells[soil_of(grid, path)], 1]))


def stress_crosses(folder):
    """Principal stresses of the soil at the end, and a footing."""
    throw, grid, path = field_figures.read_steps(folder, [1.0])[0]
    fig, axes = field_figures.draw_crosses(grid, path, soil_of(grid, path),
                                           lambda width: f"Principal stresses at h/H = {throw:.3g}, means over {width:.2g} m")
    footing_figures.draw_block(axes, folder, figures.read_summary(folder), throw, surface_level(grid, path))
    return fig
