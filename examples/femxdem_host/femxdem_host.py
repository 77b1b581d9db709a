# SPDX-License-Identifier: BSL-1.0
"""What does FEMxDEM's finite element host, escript, cost when scarp's packings respond? A biaxial test of 8 quadratic elements."""
import argparse
import os
import pathlib
import platform
import sys
import time

ESCRIPT = "/usr/lib/python3-escript"  # where Debian puts it; its libraries are looked up when a process starts
if f"{ESCRIPT}/lib" not in os.environ.get("LD_LIBRARY_PATH", ""):
    paths = {name: os.pathsep.join([folder, *filter(None, [os.environ.get(name)])])
             for name, folder in (("PYTHONPATH", ESCRIPT), ("LD_LIBRARY_PATH", f"{ESCRIPT}/lib"))}
    os.execve(sys.executable, [sys.executable, *sys.argv], {**os.environ, **paths, "OMP_NUM_THREADS": "1"})

import numpy as np
import scarp
from esys.escript import Function, FunctionOnBoundary, Scalar, Tensor, Tensor4, Vector, grad, integrate, whereZero
from esys.escript.linearPDEs import LinearPDE, SolverOptions
from esys.finley import Rectangle

WIDTH, TALL, COLUMNS, LINES = 0.05, 0.1, 2, 4
VOIGT = np.array([[0, 2], [2, 1]])  # place of xx, yy, xy


class Seconds(dict):
    """CPU time of this process by what it was spent on."""

    def take(self, what, call, *words):
        start = time.process_time()
        found = call(*words)
        self[what] = self.get(what, 0.0) + time.process_time() - start
        return found


def to_points(values, empty):
    """Values of the points in their order as data of the finite element program."""
    for number, value in enumerate(values.tolist()):
        empty.setValueOfDataPoint(number, value)
    return empty


class Specimen:
    """Smooth platens, a pressure on the sides; the increment of a step is balanced at its end, on the moved mesh."""

    def __init__(self, points, pressure):
        self.points, self.seconds, self.iterations = points, Seconds(), 0
        self.domain = Rectangle(l0=WIDTH, l1=TALL, n0=COLUMNS, n1=LINES, order=2, integrationOrder=2)
        self.pde = LinearPDE(self.domain, numEquations=2, numSolutions=2)
        self.pde.getSolverOptions().setSolverMethod(SolverOptions.DIRECT)
        place, side = self.domain.getX(), FunctionOnBoundary(self.domain).getX()
        bottom, self.top = whereZero(place[1]), whereZero(place[1] - TALL)
        self.held = (bottom + self.top) * [0, 1] + bottom * whereZero(place[0] - WIDTH / 2.0) * [1, 0]
        self.loads = (whereZero(side[0]) - whereZero(side[0] - WIDTH)) * [pressure, 0.0]
        self.tangents, self.stresses = points.tangents(), points.stresses()

    def gradients(self, moved):
        """Of the displacement since the step's start by the places then: grad is by those of now, F = (I - grad)^-1."""
        by_now = np.array(grad(moved, Function(self.domain)).toListOfTuples())
        return np.linalg.inv(np.eye(2) - by_now) - np.eye(2)

    def step(self, lowering, tolerance, most=100):
        start = self.domain.getX()
        moved = Vector(0.0, start.getFunctionSpace())
        for iteration in range(1, most + 1):
            self.seconds.take("transfer", self.set_pde, lowering if iteration == 1 else 0.0)
            change = self.seconds.take("escript", self.pde.getSolution)
            moved += change
            self.seconds.take("escript", self.domain.setX, start + moved)
            gradients = self.seconds.take("transfer", self.gradients, moved)
            self.stresses, self.tangents, verdicts = self.seconds.take("packings", self.points.respond, gradients)
            self.iterations += 1
            if verdicts["status"].max() > 1:
                raise RuntimeError(f"a point does not respond ({self.points.report()}): take smaller steps")
            if size(change) <= tolerance * size(moved):
                self.points.commit()
                return iteration
        raise RuntimeError(f"the step is not balanced after {most} iterations: take smaller steps")

    def set_pde(self, lowering):
        functions = Function(self.domain)
        moduli = self.tangents[:, VOIGT[:, :, None, None], VOIGT[None, None]]
        self.pde.setValue(A=to_points(moduli, expanded(Tensor4(0.0, functions))),
                          X=-to_points(self.stresses[:, VOIGT], expanded(Tensor(0.0, functions))),
                          y=self.loads, q=self.held, r=self.top * [0.0, -lowering])

    def mean_stress(self):
        """Volume average of the vertical stress [Pa]."""
        stress = to_points(self.stresses[:, 1], expanded(Scalar(0.0, Function(self.domain))))
        return integrate(stress) / integrate(Scalar(1.0, Function(self.domain)))


def expanded(data):
    data.expand()
    return data


def size(displacement):
    return float(np.sqrt(integrate(displacement[0] ** 2 + displacement[1] ** 2)))


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--grains", type=int, default=400, help="discs of each packing")
    parser.add_argument("--steps", type=int, default=4)
    parser.add_argument("--strain", type=float, default=1e-3, help="axial, of a step")
    parser.add_argument("--pressure", type=float, default=2e5, help="around [Pa]")
    parser.add_argument("--tolerance", type=float, default=1e-2, help="of the last displacement, over all of the step")
    given = parser.parse_args()
    print(f"Python {platform.python_version()}, NumPy {np.__version__}, escript in {ESCRIPT}; scarp {scarp.build['version']}, "
          f"{scarp.build['instruction_set']}")
    sand = scarp.discs(grains=given.grains, pressure=given.pressure, preparation_friction=0.0)
    count = 4 * COLUMNS * LINES
    specimen = Specimen(scarp.MaterialPoints(sand, np.zeros((count, 2))), given.pressure)
    begun = time.process_time()
    for step in range(1, given.steps + 1):
        iterations = specimen.step(given.strain * TALL, given.tolerance)
        print(f"strain {step * given.strain:.4f}: {iterations} iterations, mean vertical stress {specimen.mean_stress() / 1e3:.2f} kPa")
    whole = time.process_time() - begun
    parts = ", ".join(f"{what} {seconds / given.steps:.3f}" for what, seconds in specimen.seconds.items())
    print(f"{specimen.iterations * count} evaluations; CPU s per load step: {whole / given.steps:.3f} ({parts}); "
          f"{1e3 * specimen.seconds['packings'] / specimen.iterations / count:.2f} ms of packings per evaluation")
    stored = (pathlib.Path(__file__).resolve().parents[2] / "docs" / "peers.md").read_text().splitlines()
    print("docs/peers.md has, of another packing:", *(line for line in stored if line.startswith(("| program | CPU s per", "| Yade FEMxDEM |", "| scarp | 0."))), sep="\n")


if __name__ == "__main__":
    try:
        main()
    except (ValueError, RuntimeError) as trouble:
        sys.exit(f"femxdem_host: {trouble}")
