# SPDX-License-Identifier: BSL-1.0
"""What becomes of the pressure in the band: the last field of a run against the overburden."""
import pathlib
import sys

import numpy as np

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples" / "shared"))
import scarp_figures

SURCHARGE, UNIT_WEIGHT, DEPTH = 4e3, 15.68e3, 25.0  # [Pa], [N/m3], [m] of the reference study
LEAST_DEPTH = 3.0  # [m], below which a packing without pressure is no matter of the surface
STARVED = 0.1  # of the pressure at rest
IN_BAND = 0.1  # deviatoric strain
LEVELS = [(LEAST_DEPTH, 10.0), (10.0, 17.0), (17.0, DEPTH)]  # depths [m]


def in_band(folder, k0):
    """Columns of the last state in a run's folder: how many deep elements have lost their pressure, mean pressure in the band over that at
    rest by depth; none where there is no band. k0: horizontal over vertical stress at rest"""
    grid = scarp_figures.read_vtu(sorted((pathlib.Path(folder) / "fields").glob("step_*.vtu"))[-1])
    at_rest = grid.points - grid.at_nodes["displacement"][:, :2]
    depth = DEPTH - at_rest[grid.cells].mean(axis=1)[:, 1]
    stress = grid.at_cells["stress"]
    share = -(stress[:, 0] + stress[:, 1]) / 2.0 / ((1.0 + k0) / 2.0 * (SURCHARGE + UNIT_WEIGHT * depth))
    deep = depth > LEAST_DEPTH
    band = grid.at_cells["deviatoric_strain"] > IN_BAND
    levels = {(low, high): band & (depth >= low) & (depth < high) for low, high in LEVELS}
    return {"deep elements": int(np.sum(deep)), "without pressure": int(np.sum(deep & (share < STARVED))),
            **{f"pressure in the band over that at rest, {low:g} to {high:g} m": float(share[level].mean()) if level.any() else None
               for (low, high), level in levels.items()}}
