# SPDX-License-Identifier: BSL-1.0
"""The ground of a fault rupture: its strain and settlement, an animation of the rupture, and principal stresses."""

import footing_figures
import numpy as np
import scarp_figures as figures
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import PowerNorm
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
from PIL import Image
from scarp_figures import BLACK, GREY, VERMILION, plt

STRAIN_COLOURS = "magma_r"
MOST_FRAMES = 40   # of the animation
MOST_CROSSES = 36  # along the ground


def read_steps(folder, shares):
    """[(h/H, grid, file)] of the steps nearest to these shares of the last throw, in order, none twice."""
    series = figures.read_pvd(folder / "fields.pvd")
    last = series[-1][0]
    steps = sorted({min(series, key=lambda step: abs(step[0] - share * last)) for share in shares})
    return [(throw, figures.read_vtu(path), path) for throw, path in steps if throw > 0.0 or len(steps) == 1]


def deviatoric_percent(grid, path):
    return 100.0 * figures.field(grid.at_cells, "deviatoric_strain", path)


def colour_limit(strain):
    """A round number that leaves out the few most sheared elements at the fault tip. [%]"""
    finite = strain[np.isfinite(strain)]
    high = np.percentile(finite, 99.0) if finite.size else 0.0
    if not high > 0.0:
        return 1.0
    step = 10.0 ** np.floor(np.log10(high)) / 2.0
    return float(np.ceil(high / step) * step)


def draw_cells(axes, grid, values, norm, edge=0.15):
    cells = PolyCollection(grid.points[grid.cells], array=values, cmap=STRAIN_COLOURS, norm=norm,
                           edgecolor="#00000055" if edge else "face", linewidth=edge or 0.2)
    axes.add_collection(cells)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.grid(False)
    return cells


def draw_settlement(fig, axes, grid, path, alpha=1.0):
    """Filled contours of the vertical displacement; its own triangulation of each element."""
    settlement = -figures.field(grid.at_nodes, "displacement", path)[:, 1]
    corners = grid.cells.shape[1]
    triangles = np.vstack([grid.cells[:, [0, k, k + 1]] for k in range(1, corners - 1)])
    high = max(settlement.max(), 1e-6)
    levels = MaxNLocator(10).tick_values(settlement.min() if settlement.min() < -0.02 * high else 0.0, high)
    levels = levels[np.abs(levels) > 1e-6 * high] if levels[0] < 0.0 else levels  # zero is where nothing happens
    settlement = np.clip(settlement, levels[0], levels[-1])
    mesh = Triangulation(*grid.points.T, triangles)
    filled = axes.tricontourf(mesh, settlement, levels=levels, cmap="Blues", alpha=alpha)
    lines = [level for level in levels if 1e-6 * high < abs(level) and settlement.min() < level < settlement.max()]
    if lines:
        axes.tricontour(mesh, settlement, levels=lines, colors=BLACK, linewidths=0.4)
    fig.colorbar(filled, ax=axes, label="settlement [m]", aspect=14)
    axes.set_aspect("equal")
    axes.grid(False)


def outline(grid):
    """Edges that belong to one element, shape (edges, 2, 2)."""
    ends = np.stack([grid.cells, np.roll(grid.cells, -1, axis=1)], axis=-1).reshape(-1, 2)
    _, first, count = np.unique(np.sort(ends, axis=1), axis=0, return_index=True, return_counts=True)
    return grid.points[ends[first[count == 1]]]


def rupture(folder):
    """Deviatoric strain on the deforming mesh over the run, a frame for each file of the series, or for as many as are bearable."""
    series = [step for step in figures.read_pvd(folder / "fields.pvd") if step[0] >= 0.0]
    if len(series) < 2:
        raise figures.InputError(f"'{folder / 'fields.pvd'}' lists no two throws (the fault has not moved yet): let it run on")
    chosen = [series[k] for k in np.unique(np.linspace(0, len(series) - 1, MOST_FRAMES).round().astype(int))]
    grids = [(throw, figures.read_vtu(path), path) for throw, path in chosen]
    strains = [deviatoric_percent(grid, path) for _, grid, path in grids]
    depth = layer_depth(*grids[0][1:])
    low, high = (edge([np.asarray(edge(grid.points, axis=0)) for _, grid, _ in grids], axis=0) for edge in (np.min, np.max))
    summary, surface = figures.read_summary(folder), surface_level(*grids[0][1:])
    blocks = [footing_figures.corners(folder, summary, throw, surface) for throw, _, _ in grids]
    high[1] = max([high[1], *(block[:, 1].max() for block in blocks if block is not None)])
    margin = 0.02 * (high - low)[0]
    shape = np.clip((high - low)[1] / (high - low)[0], 0.1, 1.0)
    fig, axes = plt.subplots(figsize=(8.0, 1.3 + 6.4 * shape), dpi=100)
    norm = PowerNorm(0.5, 0.0, colour_limit(strains[-1]))  # the young band is faint beside the old one
    cells = draw_cells(axes, grids[0][1], strains[0], norm, edge=0.2)
    rim = axes.add_collection(LineCollection(outline(grids[0][1]), colors=BLACK, linewidths=0.8))
    axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), xlabel="x [m]", ylabel="y [m]")
    fig.colorbar(cells, ax=axes, label="deviatoric strain [%],\nsquare-root scale", extend="max", aspect=12)
    footing = footing_figures.draw_block(axes, folder, summary, grids[0][0], surface)
    frames = []
    for (throw, grid, _), strain, block in zip(grids, strains, blocks):
        cells.set_verts(grid.points[grid.cells])
        cells.set_array(strain)
        rim.set_segments(outline(grid))
        if footing is not None:
            footing.set_xy(block)
        axes.set_title(f"h/H = {throw:.4f}, throw {throw * depth:.2f} m, largest strain {np.nanmax(strain):.3g} %", loc="left")
        fig.canvas.draw()
        frames.append(Image.fromarray(np.asarray(fig.canvas.buffer_rgba())[..., :3].copy()))
        fig.set_layout_engine("none")  # nothing moves from the first frame on
    plt.close(fig)
    return figures.Animation(frames, [120] * (len(frames) - 1) + [2500])


def areas(corners):
    """[m2], of polygons"""
    after = np.roll(corners, -1, axis=1)
    return 0.5 * np.abs(np.sum(corners[..., 0] * after[..., 1] - after[..., 0] * corners[..., 1], axis=1))


def soil_of(grid, path):
    """Which cells are soil: those of the largest region."""
    region = figures.field(grid.at_cells, "region", path).astype(int)
    return region == np.argmax(np.bincount(region, areas(grid.points[grid.cells])))


def layer_depth(grid, path):
    """[m], of the soil before it moved"""
    initial = grid.points - figures.field(grid.at_nodes, "displacement", path)[:, :2]
    return float(np.ptp(initial[grid.cells[soil_of(grid, path)], 1]))


def surface_level(grid, path):
    """y of the soil's surface before it moved [m]"""
    initial = grid.points - figures.field(grid.at_nodes, "displacement", path)[:, :2]
    return float(np.max(initial[grid.cells[soil_of(grid, path)], 1]))


def mean_stresses(grid, path):
    """Places [m], stresses (xx, yy, xy) [Pa] as means over the cells of a coarse grid, weighted by area, and its width [m]; soil only."""
    soil = soil_of(grid, path)
    corners = grid.points[grid.cells[soil]]
    stress = figures.field(grid.at_cells, "stress", path)[soil]
    area = areas(corners)
    centre = corners.mean(axis=1)
    low = corners.min(axis=(0, 1))
    width = np.ptp(corners[..., 0]) / MOST_CROSSES
    column = np.floor((centre - low) / width).astype(int)
    _, bin_of = np.unique(column[:, 0] * 100_000 + column[:, 1], return_inverse=True)
    weight = np.bincount(bin_of, area)
    mean = [np.bincount(bin_of, area * values) / weight for values in (*centre.T, *stress.T)]
    return np.column_stack(mean[:2]), np.column_stack(mean[2:]), width


def principal(stress):
    """Principal values, shape (n, 2), the larger pressure first, and their directions, shape (n, 2, 2)."""
    tensors = np.empty((len(stress), 2, 2))
    tensors[:, 0, 0], tensors[:, 1, 1] = stress[:, 0], stress[:, 1]
    tensors[:, 0, 1] = tensors[:, 1, 0] = stress[:, 2]
    values, vectors = np.linalg.eigh(tensors)  # ascending: the larger pressure is the more negative one
    return values, np.swapaxes(vectors, 1, 2)


def stress_crosses(folder):
    """Principal stresses at the end as crosses over the settlement, lengths by the root of the stress so that shallow ones are seen."""
    throw, grid, path = read_steps(folder, [1.0])[0]
    places, stress, width = mean_stresses(grid, path)
    known = np.isfinite(stress).all(axis=1)
    values, directions = principal(stress[known])
    largest = np.abs(values).max() if values.size else 0.0
    if not largest > 0.0:
        raise figures.InputError(f"'{path}' holds no stress (all is zero): let the run go on")
    half = 0.48 * width * np.sqrt(np.abs(values) / largest)[..., None] * directions
    centre = places[known][:, None, :]
    arms = np.stack([centre - half, centre + half], axis=2).reshape(-1, 2, 2)
    tension = values.reshape(-1) > 0.0
    fig, axes = plt.subplots(figsize=(8.6, 3.0))
    draw_settlement(fig, axes, grid, path, alpha=0.5)
    axes.add_collection(LineCollection(outline(grid), colors=GREY, linewidths=0.6))
    footing_figures.draw_block(axes, folder, figures.read_summary(folder), throw, surface_level(grid, path))
    axes.add_collection(LineCollection(arms[~tension], colors=BLACK, linewidths=0.9))
    axes.add_collection(LineCollection(arms[tension], colors=VERMILION, linewidths=1.3))
    axes.plot([], [], color=BLACK, label=f"compression, up to {largest / 1e3:.0f} kPa, length by its square root")
    axes.plot([], [], color=VERMILION, label=f"tension: {np.count_nonzero(tension)} of {len(tension)}")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=2)
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.set_title(f"Principal stresses at h/H = {throw:.3g}, means over {width:.2g} m", loc="left")
    return fig
