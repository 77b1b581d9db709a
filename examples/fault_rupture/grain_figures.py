# SPDX-License-Identifier: BSL-1.0
"""Packings of the probes with their force chains, and roses of contact normals and long axes, at a few throws."""

import numpy as np
import scarp_figures as figures
from packing_figures import Rose, draw_grains, force_samples, read_packing, rose_legend
from scarp_figures import BLUE, GREEN, VERMILION, plt

PROBES = {"A": BLUE, "B": VERMILION}


def probe_packings(folder):
    """{probe: [(title, packing)]} of the throws at which they were written."""
    found = {}
    for name in PROBES:
        table = folder / "packings" / f"{name}.csv"
        if not table.is_file():
            continue
        throws = figures.read_csv(table, ["throw_over_depth"])["throw_over_depth"]
        strain = strains_at(folder, name, throws)
        found[name] = [(f"{name}, h/H = {throw:.3g}\nstrain {max(percent, 0.0):.{1 if percent < 9.95 else 0}f} %",
                        read_packing(folder / "packings", f"{name}_{k}"))
                       for k, (throw, percent) in enumerate(zip(throws, strain))]
    if not found:
        raise figures.InputError(f"'{folder / 'packings'}' lists no packing (the run did not write one): run the example")
    return found


def strains_at(folder, name, throws):
    """Deviatoric strain of a probe at these throws [%]"""
    probe = figures.read_csv(folder / f"probe_{name}.csv", ["throw_over_depth", "eps_q"])
    return [100.0 * probe["eps_q"][figures.last_nearest(probe["throw_over_depth"], throw)] for throw in throws]


def panels(found, width, height, gap, **more):
    """Of one size each [inch], a row for each probe, below all of them room for a legend. gap: between two, over their width"""
    columns = max(len(row) for row in found.values())
    tall = height * len(found) + 0.6
    fig, rows = plt.subplots(len(found), columns, figsize=(width * columns, tall), squeeze=False, constrained_layout=False, **more)
    fig.subplots_adjust(left=0.04, right=0.96, bottom=0.65 / tall, top=1.0 - 0.45 / tall, wspace=gap, hspace=0.3)
    for axes in rows.flat:
        axes.set_visible(False)
    for row, (name, packings) in zip(rows, found.items()):
        for axes, (title, packing) in zip(row, packings):
            axes.set_visible(True)
            yield fig, axes, name, title, packing


def packings(folder):
    """Line widths mean the same force everywhere; each packing has its own scale of lengths."""
    found = probe_packings(folder)
    every = [packing for row in found.values() for _, packing in row]
    force = np.concatenate([packing.force for packing in every])
    width, height = 2.3, 2.5
    grain = 72.0 * width / np.sqrt(len(every[0].centres))  # about, in points
    points_per_newton = 0.09 * grain / force.mean() if len(force) else 0.0
    for fig, axes, _, title, packing in panels(found, width, height, 0.06):
        draw_grains(axes, packing, points_per_newton, margin=0.02, fine=0.6)
        axes.set_title(title)
        axes.set_axis_off()
    if len(force):
        samples = force_samples(force, points_per_newton, (0.5, 1.0, 2.0))
        fig.legend(handles=samples, loc="lower center", ncol=len(samples), title="normal force")
    return fig


def roses(folder):
    """Contact normals, the same weighted with their forces, and long axes of the grains where they have some."""
    found = probe_packings(folder)
    drawn = []
    for fig, axes, name, title, packing in panels(found, 2.1, 2.5, 0.5, subplot_kw={"projection": "polar"}):
        normals = Rose(packing.normal, packing.force)
        long = packing.axes[:, 0] > packing.axes[:, 1]
        drawn.append((axes, name, title, normals, Rose(packing.turned[long]) if long.any() else None))
    top = max(rose.top for *_, normals, long in drawn for rose in (normals, long) if rose is not None)
    for axes, name, title, normals, long in drawn:
        normals.draw(axes, top, PROBES[name], title)
        if long is not None:
            long.outline(axes, GREEN)
    rose_legend(fig, None if drawn[0][-1] is None else GREEN)
    return fig
