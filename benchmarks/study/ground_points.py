# SPDX-License-Identifier: BSL-1.0
"""What the ground does at a place of it over a run's frames: settlements of a level, stress, strain and fabric of the packings around a point."""
import dataclasses

import numpy as np
import scarp_figures as figures
from matplotlib.tri import LinearTriInterpolator, Triangulation

AROUND = 1.0  # [m]: packings whose elements had their centre so near to a point stand for it
QUANTITIES = ["p", "q", "eps_q", "eps_v", "contact_fabric", "particle_fabric"]


@dataclasses.dataclass
class Frame:
    throw: float              # over the depth
    places: np.ndarray        # initial ones of the nodes [m], shape (nodes, 2)
    cells: np.ndarray         # of the soil, shape (cells, 3)
    displacement: np.ndarray  # [m], of the nodes, shape (nodes, 2)
    fields: dict              # of the soil's cells

    @property
    def settlement(self):
        """[m], of the nodes"""
        return -self.displacement[:, 1]


def frame(throw, path):
    grid = figures.read_vtu(path)
    displacement = figures.field(grid.at_nodes, "displacement", path)[:, :2]
    soil = figures.field(grid.at_cells, "region", path) == 0
    names = ["stress", "deviatoric_strain", "void_ratio", "contact_fabric", "particle_fabric"]
    return Frame(throw, grid.points - displacement, grid.cells[soil], displacement,
                 {name: figures.field(grid.at_cells, name, path)[soil] for name in names})


def frames(folder):
    """Of the moving fault, the state at rest before it first."""
    return [frame(throw, path) for throw, path in figures.read_pvd(folder / "fields.pvd") if throw >= 0.0]


def steepest_place(last, first, height, over=4.0):
    """x [m] in the middle of the stretch of a level over which it has settled most unevenly since the first frame: where the rupture crosses it.

    height [m] above bedrock in the initial ground; over [m], the stretch: two widths of the band with a length of 2 m, since neighbouring packings differ
    """
    x = np.linspace(first.places[:, 0].min(), first.places[:, 0].max(), 2001)
    corners = Triangulation(*last.places.T, last.cells)
    settled = LinearTriInterpolator(corners, last.settlement - first.settlement)(x, np.full_like(x, height)).filled(np.nan)
    far = max(1, round(over / (x[1] - x[0])))
    start = int(np.nanargmax(settled[far:] - settled[:-far]))
    return float(0.5 * (x[start] + x[start + far]))


def around(of_run, point):
    """Numbers of the cells around a point [m] of the initial ground; the nearest one alone where none is so near."""
    distance = np.linalg.norm(of_run[0].places[of_run[0].cells].mean(axis=1) - point, axis=1)
    near = np.flatnonzero(distance <= AROUND)
    return near if len(near) else np.array([np.argmin(distance)])


def history(of_run, cells):
    """{quantity: array of (frames, cells)}: p and the reference study's q, (s1 - s3)/2, [Pa], the others as they are; strains since the fault began to move.

    The deviatoric strain is the elements' own, the volume (negative: dilation) that of the packings, whose strain is the mean over the length.
    """
    rest = of_run[0].fields
    found = {name: [] for name in QUANTITIES}
    for one in of_run:
        xx, yy, xy = one.fields["stress"][cells].T
        found["p"].append(-0.5 * (xx + yy))
        found["q"].append(np.hypot(0.5 * (xx - yy), xy))
        found["eps_q"].append(one.fields["deviatoric_strain"][cells] - rest["deviatoric_strain"][cells])
        found["eps_v"].append((rest["void_ratio"][cells] - one.fields["void_ratio"][cells]) / (1.0 + rest["void_ratio"][cells]))
        for name in ("contact_fabric", "particle_fabric"):
            found[name].append(one.fields[name][cells])
    return {name: np.array(values) for name, values in found.items()}
