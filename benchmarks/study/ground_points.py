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


def half_place(last, first, height, share=0.5):
    """x [m] at which a level of the ground has first settled by a share of the throw since the first frame, from the foot wall's side.

    height [m] above bedrock; the throw is what the level settles most.
    """
    corners = Triangulation(*last.places.T, last.cells)
    x = np.linspace(last.places[:, 0].min(), last.places[:, 0].max(), 2000)
    settled = LinearTriInterpolator(corners, last.settlement - first.settlement)(x, np.full_like(x, height))
    wanted = share * settled[-1]
    after = int(np.argmax(settled >= wanted))
    return float(np.interp(wanted, settled[after - 1:after + 1], x[after - 1:after + 1]))


def around(of_run, point):
    """Numbers of the cells around a point [m] of the initial ground; the nearest one alone where none is so near."""
    distance = np.linalg.norm(of_run[0].places[of_run[0].cells].mean(axis=1) - point, axis=1)
    near = np.flatnonzero(distance <= AROUND)
    return near if len(near) else np.array([np.argmin(distance)])


def history(of_run, cells):
    """{quantity: array of (frames, cells)}: p, q [Pa], the others as they are; strains since the fault began to move.

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
