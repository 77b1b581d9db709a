# SPDX-License-Identifier: BSL-1.0
"""field_figures.py OUTPUT_DIR: strain, displacement and stress of a plane problem, from the files of a FieldSeries."""

import sys

sys.dont_write_bytecode = True
import numpy as np
import scarp_figures as figures
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.ticker import MaxNLocator
from matplotlib.tri import Triangulation
from PIL import Image
from scarp_figures import BLACK, GREY, VERMILION, plt

STRAIN_COLOURS = "magma_r"
MOST_FRAMES = 40   # of the animation
MOST_CROSSES = 36  # along the ground


def read_plane(path):
    """A grid of the plane."""
    grid = figures.read_vtu(path)
    if grid.points.shape[1] != 2:
        raise figures.InputError(f"'{path}' holds a problem in space (these figures are of the plane): open it in ParaView")
    return grid


def read_steps(folder, shares):
    """[(time, grid, file)] of the steps nearest to these shares of the last time, in order, none twice."""
    series = figures.read_pvd(folder / "fields.pvd")
    last = series[-1][0]
    steps = sorted({min(series, key=lambda step: abs(step[0] - share * last)) for share in shares})
    return [(time, read_plane(path), path) for time, path in steps if time > 0.0 or len(steps) == 1]


def deviatoric_percent(grid, path):
    return 100.0 * figures.field(grid.at_cells, "deviatoric_strain", path)


def colour_limit(strain):
    """A round number that leaves out the few most sheared elements. [%]"""
    finite = strain[np.isfinite(strain)]
    high = np.percentile(finite, 99.0) if finite.size else 0.0
    if not high > 0.0:
        return 1.0
    step = 10.0 ** np.floor(np.log10(high)) / 2.0
    return float(np.ceil(high / step) * step)


def status_note(grid):
    """How many elements do not simply answer "ok"; the numbers are those of core/status.hpp."""
    status = grid.at_cells.get("status", np.zeros(0))
    counts = {"fluid": np.count_nonzero(status == 1), "failed": np.count_nonzero(status > 1)}
    return "".join(f", {count} elements {name}" for name, count in counts.items() if count)


def draw_cells(axes, grid, values, norm, edge=0.15):
    cells = PolyCollection(grid.points[grid.cells], array=values, cmap=STRAIN_COLOURS, norm=norm,
                           edgecolor="#00000055" if edge else "face", linewidth=edge or 0.2)
    axes.add_collection(cells)
    axes.autoscale_view()
    axes.set_aspect("equal")
    axes.grid(False)
    return cells


def triangles_of(grid):
    """Corners of triangles that the cells are cut into, shape (n, 3)."""
    return np.vstack([grid.cells[:, [0, k, k + 1]] for k in range(1, grid.cells.shape[1] - 1)])


def draw_settlement(fig, axes, grid, path, alpha=1.0):
    """Filled contours of the vertical displacement; its own triangulation of each element."""
    settlement = -figures.field(grid.at_nodes, "displacement", path)[:, 1]
    high = max(settlement.max(), 1e-6)
    levels = MaxNLocator(10).tick_values(settlement.min() if settlement.min() < -0.02 * high else 0.0, high)
    levels = levels[np.abs(levels) > 1e-6 * high] if levels[0] < 0.0 else levels  # zero is where nothing happens
    settlement = np.clip(settlement, levels[0], levels[-1])
    mesh = Triangulation(*grid.points.T, triangles_of(grid))
    farthest = np.abs(levels).max()
    colours = {"cmap": "Blues"} if levels[0] >= 0.0 else {"cmap": "RdBu", "norm": Normalize(-farthest, farthest)}  # heave is red
    filled = axes.tricontourf(mesh, settlement, levels=levels, alpha=alpha, **colours)
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


def areas(corners):
    """[m2], of polygons"""
    after = np.roll(corners, -1, axis=1)
    return 0.5 * np.abs(np.sum(corners[..., 0] * after[..., 1] - after[..., 0] * corners[..., 1], axis=1))


class Steps:
    """A quantity of the elements over a run, step by step: a frame for each file of the series, or for as many as are bearable."""

    def __init__(self, folder, quantity=deviatoric_percent):
        """quantity(grid, path): values of the cells"""
        series = [step for step in figures.read_pvd(folder / "fields.pvd") if step[0] >= 0.0]
        if len(series) < 2:
            raise figures.InputError(f"'{folder / 'fields.pvd'}' lists no two steps (nothing has moved yet): let it run on")
        chosen = [series[k] for k in np.unique(np.linspace(0, len(series) - 1, MOST_FRAMES).round().astype(int))]
        self.times = [time for time, _ in chosen]
        self.paths = [path for _, path in chosen]
        self.grids = [read_plane(path) for path in self.paths]
        self.values = [quantity(grid, path) for grid, path in zip(self.grids, self.paths)]

    def animate_strain(self, title, blocks=None):
        """title(time): first words of the title of a frame; blocks: as of animate()"""
        norm = PowerNorm(0.5, 0.0, colour_limit(self.values[-1]))  # the young band is faint beside the old one
        return self.animate(lambda time, strain: f"{title(time)}, largest strain {np.nanmax(strain):.3g} %", norm,
                            "deviatoric strain [%],\nsquare-root scale", blocks)

    def animate(self, title, norm, label, blocks=None, colours=STRAIN_COLOURS):
        """title(time, values): that of a frame; blocks: corners of a body in each frame, shape (4, 2), or None"""
        blocks = blocks or [None] * len(self.grids)
        low, high = (edge([np.asarray(edge(grid.points, axis=0)) for grid in self.grids], axis=0) for edge in (np.min, np.max))
        high[1] = max([high[1], *(block[:, 1].max() for block in blocks if block is not None)])
        margin = 0.02 * (high - low)[0]
        shape = np.clip((high - low)[1] / (high - low)[0], 0.1, 1.0)
        fig, axes = plt.subplots(figsize=(8.0, 1.3 + 6.4 * shape), dpi=100)
        cells = draw_cells(axes, self.grids[0], self.values[0], norm, edge=0.2)
        cells.set_cmap(colours)
        rim = axes.add_collection(LineCollection(outline(self.grids[0]), colors=BLACK, linewidths=0.8))
        axes.set(xlim=(low[0] - margin, high[0] + margin), ylim=(low[1] - margin, high[1] + margin), xlabel="x [m]", ylabel="y [m]")
        fig.colorbar(cells, ax=axes, label=label, extend="max" if norm.vmin == 0.0 else "neither", aspect=12)
        body = None if blocks[0] is None else axes.add_patch(figures.block(blocks[0]))
        frames = []
        for time, grid, values, block in zip(self.times, self.grids, self.values, blocks):
            cells.set_verts(grid.points[grid.cells])
            cells.set_array(values)
            rim.set_segments(outline(grid))
            if body is not None:
                body.set_xy(block)
            axes.set_title(title(time, values), loc="left")
            fig.canvas.draw()
            frames.append(Image.fromarray(np.asarray(fig.canvas.buffer_rgba())[..., :3].copy()))
            fig.set_layout_engine("none")  # nothing moves from the first frame on
        plt.close(fig)
        return figures.Animation(frames, [120] * (len(frames) - 1) + [2500])


def mean_stresses(grid, path, chosen):
    """Places [m], stresses (xx, yy, xy) [Pa] as means over the cells of a coarse grid, weighted by area, and its width [m].
    chosen: which elements count"""
    corners = grid.points[grid.cells[chosen]]
    stress = figures.field(grid.at_cells, "stress", path)[chosen]
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


def draw_crosses(grid, path, chosen, title):
    """Principal stresses as crosses over the settlement, lengths by the root of the stress so that shallow ones are seen.
    title(width): of means over a width [m]
    Returns the figure and its axes."""
    places, stress, width = mean_stresses(grid, path, chosen)
    known = np.isfinite(stress).all(axis=1)
    values, directions = principal(stress[known])
    largest = np.abs(values).max() if values.size else 0.0
    if not largest > 0.0:
        raise figures.InputError(f"'{path}' holds no stress (all is zero): let the run go on")
    half = 0.48 * width * np.sqrt(np.abs(values) / largest)[..., None] * directions
    centre = places[known][:, None, :]
    arms = np.stack([centre - half, centre + half], axis=2).reshape(-1, 2, 2)
    tension = values.reshape(-1) > 0.0
    extent = np.ptp(grid.points, axis=0)
    fig, axes = plt.subplots(figsize=(8.6, 1.35 + 6.6 * np.clip(extent[1] / extent[0], 0.1, 1.0)))
    draw_settlement(fig, axes, grid, path, alpha=0.5)
    axes.add_collection(LineCollection(outline(grid), colors=GREY, linewidths=0.6))
    axes.add_collection(LineCollection(arms[~tension], colors=BLACK, linewidths=0.9))
    axes.add_collection(LineCollection(arms[tension], colors=VERMILION, linewidths=1.3))
    axes.plot([], [], color=BLACK, label=f"compression, up to {largest / 1e3:.0f} kPa, length by its square root")
    axes.plot([], [], color=VERMILION, label=f"tension: {np.count_nonzero(tension)} of {len(tension)}")
    axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=2)
    axes.set(xlabel="x [m]", ylabel="y [m]")
    axes.set_title(title(width), loc="left")
    return fig, axes


def deformation(folder):
    """Deviatoric and volumetric strain on the deformed mesh, and the vertical displacement, at the end."""
    time, grid, path = read_steps(folder, [1.0])[0]
    strain = deviatoric_percent(grid, path)
    volumetric = 100.0 * figures.field(grid.at_cells, "volumetric_strain", path)
    extent = np.ptp(grid.points, axis=0)
    panel = 0.5 + 6.0 * np.clip(extent[1] / extent[0], 0.1, 0.8)
    fig, (upper, middle, lower) = plt.subplots(3, 1, figsize=(7.6, 3 * panel), sharex=True, sharey=True)
    fig.colorbar(draw_cells(upper, grid, strain, Normalize(0.0, colour_limit(strain))), ax=upper, label="deviatoric strain [%]", extend="max",
                 aspect=14)
    upper.set_title(f"Deformed mesh at load factor {time:.3g}, displacements to scale", loc="left")
    upper.set_title(f"largest strain {np.nanmax(strain):.3g} %{status_note(grid)}", loc="right", fontsize=7.5)
    limit = colour_limit(np.abs(volumetric))
    cells = draw_cells(middle, grid, volumetric, Normalize(-limit, limit))
    cells.set_cmap("RdBu")
    fig.colorbar(cells, ax=middle, label="volumetric strain [%],\ncontraction positive", extend="both", aspect=14)
    draw_settlement(fig, lower, grid, path)
    lower.set_title("Vertical displacement", loc="left")
    for axes in (upper, middle, lower):
        axes.set(ylabel="y [m]")
    lower.set(xlabel="x [m]")
    return fig


def strain(folder):
    return Steps(folder).animate_strain(lambda time: f"Load factor {time:.4g}")


def stress_crosses(folder):
    time, grid, path = read_steps(folder, [1.0])[0]
    every = np.ones(len(grid.cells), dtype=bool)
    return draw_crosses(grid, path, every, lambda width: f"Principal stresses at load factor {time:.3g}, means over {width:.2g} m")[0]


if __name__ == "__main__":
    figures.draw_all({"deformation": deformation, "strain": strain, "stress_crosses": stress_crosses})
