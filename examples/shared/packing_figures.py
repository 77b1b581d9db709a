# SPDX-License-Identifier: BSL-1.0
"""Packings of discs and ellipses with their force chains, and roses of directions, from the tables that io/packings writes."""

import itertools
import typing

import numpy as np
from matplotlib.collections import EllipseCollection, LineCollection
from matplotlib.patches import Polygon
from scarp_figures import BLACK, BLUE, GREY, InputError, plt, read_csv


class Packing(typing.NamedTuple):
    """Lengths in mm, places wrapped into the cell."""
    base: np.ndarray     # columns are base vectors
    corner: np.ndarray   # of the cell, in base vectors
    centres: np.ndarray  # shape (grains, 2)
    axes: np.ndarray     # half axes, shape (grains, 2)
    turned: np.ndarray   # of the long axes [rad]
    start: np.ndarray    # first centre of each contact that carries, shape (contacts, 2)
    branch: np.ndarray   # from there to the second one
    normal: np.ndarray   # direction of its normal [rad]; NaN in tables without
    force: np.ndarray    # normal force [N]

    def outline(self):
        return (self.corner + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])) @ self.base.T


def read_packing(folder, stem="packing"):
    grains = read_csv(folder / f"{stem}_grains.csv", ["x", "y", "a", "b", "cos", "sin"])
    contacts = read_csv(folder / f"{stem}_contacts.csv", ["x1", "y1", "x2", "y2", "normal_force"], may_be_empty=True)
    cell = read_csv(folder / f"{stem}_cell.csv", ["a1x", "a1y", "a2x", "a2y"])
    base = 1e3 * np.array([[cell["a1x"][0], cell["a2x"][0]], [cell["a1y"][0], cell["a2y"][0]]])
    if not (np.isfinite(base).all() and np.linalg.det(base) > 0.0):
        raise InputError(f"'{folder / stem}_cell.csv' holds no cell (inverted or NaN): run the example anew")
    centres = 1e3 * np.column_stack([grains["x"], grains["y"]])
    relative = np.linalg.solve(base, centres.T).T
    corner = np.round(2.0 * (relative.mean(axis=0) - 0.5)) / 2.0  # cells start at the origin or are centred there
    centres = centres - np.floor(relative - corner) @ base.T
    carrying = contacts["normal_force"] > 0.0
    start = 1e3 * np.column_stack([contacts["x1"], contacts["y1"]])[carrying]
    branch = 1e3 * np.column_stack([contacts["x2"], contacts["y2"]])[carrying] - start
    start = start - np.floor(np.linalg.solve(base, start.T).T - corner) @ base.T
    unknown = np.full(len(carrying), np.nan)
    normal = np.arctan2(contacts.get("ny", unknown), contacts.get("nx", unknown))[carrying]
    return Packing(base, corner, centres, 1e3 * np.column_stack([grains["a"], grains["b"]]),
                   np.arctan2(grains["sin"], grains["cos"]), start, branch, normal, contacts["normal_force"][carrying])


def draw_grains(axes, packing, points_per_newton, margin=0.03, fine=1.0):
    """Grains and chains in the periodic cell with its neighbours around. fine: factor of the line widths of the outlines"""
    outline = packing.outline()
    images = [packing.base @ np.array(shift) for shift in itertools.product((-1, 0, 1), repeat=2)]
    for image in images:
        own = not image.any()
        axes.add_collection(EllipseCollection(
            2.0 * packing.axes[:, 0], 2.0 * packing.axes[:, 1], np.degrees(packing.turned), units="xy",
            offsets=packing.centres + image, offset_transform=axes.transData, zorder=2 if own else 1,
            facecolor="#F4E3C1" if own else "#F5F5F5", edgecolor="#8C7A55" if own else "#DADADA", linewidth=0.4 * fine))
    frame = axes.add_patch(Polygon(outline, closed=True, fill=False, edgecolor=BLACK, linewidth=fine, zorder=4))
    for image in images:
        ends = packing.start + image
        chains = LineCollection(np.stack([ends, ends + packing.branch], axis=1), colors=BLUE, capstyle="round",
                                linewidths=points_per_newton * packing.force, zorder=3)
        axes.add_collection(chains)
        chains.set_clip_path(frame)  # a chain that leaves the cell comes in again on the other side
    margin *= np.ptp(outline, axis=0).max()
    axes.set(xlim=(outline[:, 0].min() - margin, outline[:, 0].max() + margin),
             ylim=(outline[:, 1].min() - margin, outline[:, 1].max() + margin), aspect="equal")
    axes.grid(False)


def force_samples(force, points_per_newton, times=(1.0, 2.0, 4.0)):
    """Lines for a legend: round forces and their widths."""
    samples = sorted({float(f"{factor * force.mean():.1g}") for factor in times}) if len(force) else []
    return [plt.Line2D([], [], color=BLUE, linewidth=points_per_newton * sample, label=f"{sample:g} N") for sample in samples]


def draw_packing(folder, title, stem="packing"):
    """Grains with force chains, their widths proportional to the normal force, in the periodic cell; lengths in mm."""
    packing = read_packing(folder, stem)
    fig, axes = plt.subplots(figsize=(5.2, 5.2))
    points_per_newton = 1.0 / packing.force.mean() if len(packing.force) else 0.0
    draw_grains(axes, packing, points_per_newton)
    axes.set(xlabel="x [mm]", ylabel="y [mm]",
             title=f"{title}: {len(packing.centres)} grains, {len(packing.force)} contacts")
    if len(packing.force):
        axes.legend(handles=force_samples(packing.force, points_per_newton), loc="upper center", bbox_to_anchor=(0.5, -0.1),
                    ncol=3, title="normal force")
    return fig


class Rose:
    """Density of directions that count both ways, over 2 pi; 1/(2 pi) where all are alike."""

    def __init__(self, angles, force=None):
        """angles [rad]; force [N]: weights of a second density"""
        self.bins = np.linspace(-np.pi, np.pi, 37 if len(angles) >= 400 else 19)  # few directions, wide bins
        both = np.concatenate([angles, angles + np.where(angles > 0.0, -np.pi, np.pi)])
        self.count = len(angles)
        self.density = self.of(both, None)
        self.weighted = None if force is None else self.of(both, np.tile(force, 2))
        self.top = max(self.density.max(), 0.0 if self.weighted is None else self.weighted.max())

    def of(self, angles, weights):
        counts = np.histogram(angles, self.bins, weights=weights)[0]
        return counts / max(counts.sum(), 1e-300) / np.diff(self.bins)

    def draw(self, axes, top, colour, title):
        """axes: polar; top: largest density of those that are compared"""
        axes.bar(self.bins[:-1], self.density, width=np.diff(self.bins), align="edge", color=colour, alpha=0.6,
                 edgecolor="white", linewidth=0.4)
        if self.weighted is not None:
            self.draw_line(axes, self.weighted, BLACK)
        axes.plot(np.linspace(0, 2 * np.pi, 90), np.full(90, 0.5 / np.pi), color=BLACK, linewidth=0.7, linestyle=":")
        axes.set(ylim=(0.0, 1.05 * top), yticklabels=[], xticks=np.radians(np.arange(0, 360, 45)), title=title)
        axes.tick_params(pad=0)

    def outline(self, axes, colour):
        """Over another rose."""
        self.draw_line(axes, self.density, colour)

    def draw_line(self, axes, density, colour):
        middles = (self.bins[:-1] + self.bins[1:]) / 2.0
        axes.plot(np.append(middles, middles[0] + 2.0 * np.pi), np.append(density, density[0]), color=colour, linewidth=1.1)


def rose_legend(fig, colour_of_axes=None):
    """colour_of_axes: of the long axes' outline, where there is one"""
    marks = {"contact normals": plt.Rectangle((0, 0), 1, 1, color=GREY, alpha=0.6),
             "weighted with the normal force": plt.Line2D([], [], color=BLACK)}
    if colour_of_axes is not None:
        marks["long axes of the grains"] = plt.Line2D([], [], color=colour_of_axes)
    marks["isotropic"] = plt.Line2D([], [], color=BLACK, linestyle=":", linewidth=0.7)
    fig.legend(list(marks.values()), list(marks), loc="lower center", ncol=len(marks))
