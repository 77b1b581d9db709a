# SPDX-License-Identifier: BSL-1.0
"""One material point as a micro simulation of preCICE's Micro Manager."""
from __future__ import annotations

from typing import Any, ClassVar, Dict, Optional, Tuple

import numpy as np

from . import _points
from .materials import MaterialPoints
from .meshes import require_unmasked
from .model import Floats


class MicroSimulation:
    """A class of this form is what the manager makes for each of its points, from a file of your own:

        class MicroSimulation(scarp.MicroSimulation):
            material = scarp.ellipses(grains=400, packings=8)
            strains = "total"

    solve({"gradient": H}, dt) returns {"stress": ..., "tangent": ...}: the gradient is that of the displacement, row by row
    (4 numbers in the plane, 9 in space), in the form that `strains` says:
    "incremental": since the last accepted time step, by the places at that time;
    "total": since the start, F = I + H. Then the increment follows by F F0^-1 - I, with F0 of the last accepted time step.

    Coupling iterations repeat a time step. The manager gives the state of its start back by set_state(get_state()) before it repeats one;
    the response of a solve becomes the start of the next one where it has not. Stress and tangent are Cauchy's [Pa], tension positive, in Voigt order with
    engineering shear, row by row. A response that is not acceptable raises RuntimeError: take smaller time steps."""

    material: ClassVar[Optional[_points.Material]] = None
    strains: ClassVar[str] = "total"
    threads: ClassVar[int] = 1

    def __init__(self, sim_id: int) -> None:
        if self.material is None:
            raise ValueError("a MicroSimulation has no material (a subclass gives one): set its class member 'material'")
        if self.strains not in ("total", "incremental"):
            raise ValueError(f"strains are '{self.strains}' (total and incremental are known): choose one")
        self.dim: int = self.material.dim
        self.points = MaterialPoints(self.material, np.zeros((1, self.dim)), indices=[sim_id])
        self.deformation: Floats = np.eye(self.dim)
        self.set_global_id(sim_id)

    def initialize(self) -> Dict[str, Any]:
        """The data of the start, as solve returns them."""
        return {"stress": self.points.stresses()[0], "tangent": self.points.tangents()[0].ravel()}

    def solve(self, macro_data: Dict[str, Any], dt: float) -> Dict[str, Any]:
        """macro_data: {"gradient": numbers row by row}; dt: not used, responses are quasi-static"""
        dim = self.dim
        require_unmasked(macro_data["gradient"], "the gradients")
        gradient = np.asarray(macro_data["gradient"], dtype=float)
        if gradient.size != dim * dim:
            raise ValueError(f"the gradient has {gradient.size} numbers ({dim * dim} are expected): give them row by row")
        whole = np.eye(dim) + gradient.reshape(dim, dim)
        total = whole if self.strains == "total" else whole @ self.deformation
        increment = total @ np.linalg.inv(self.deformation) - np.eye(dim)
        stresses, tangents, verdicts = self.points.respond(increment[None], threads=self.threads)
        if verdicts["status"][0] > 1:
            self.points.discard()
            raise RuntimeError(f"point {self.sim_id} does not respond ({self.points.report()}): take smaller time steps")
        self.points.commit()
        self.deformation = total
        return {"stress": stresses[0], "tangent": tangents[0].ravel()}

    def get_state(self) -> Tuple[bytes, Floats, int]:
        return self.points.pack([0]), self.deformation.copy(), self.sim_id

    def set_state(self, state: Tuple[bytes, Floats, int]) -> None:
        bits, deformation, self.sim_id = state
        self.points.unpack([0], bits)
        self.deformation = deformation.copy()

    def set_global_id(self, sim_id: int) -> None:
        self.sim_id = sim_id

    def get_global_id(self) -> int:
        return self.sim_id
