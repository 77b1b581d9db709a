# SPDX-License-Identifier: BSL-1.0
"""How does getfem take packings as its material? Patch tests on an irregular mesh, and cubes of soil and of spheres in triaxial compression."""
import argparse
import math
import subprocess
import sys

import getfem
import numpy as np
import scarp

VOIGT = np.array([[0, 5, 4], [5, 1, 3], [4, 3, 2]])  # place of xx, yy, zz, yz, zx, xy
UNIT = np.eye(3)
PRESSURE, FRICTION = 2e5, math.radians(30.0)  # all around [Pa], of Mohr-Coulomb soil
STRAIN, STEPS = 0.01, 10  # of the cubes, axial
FLOOR = 1e-3  # of the first tangents, added to all: flowing soil has singular ones


class Cube:
    """1 m wide, of linear tetrahedra with a point in each, under a pressure all around; a step is balanced in the shape at its end."""

    def __init__(self, material, tolerance, pressure):
        lines = np.linspace(0.0, 1.0, 4)
        mesh = getfem.Mesh("regular simplices", lines, lines, lines, "noised")
        self.space, self.rule = getfem.MeshFem(mesh, 3), getfem.MeshIm(mesh, getfem.Integ("IM_TETRAHEDRON(1)"))
        self.space.set_classical_fem(1)
        self.points = scarp.MaterialPoints(material, np.zeros((mesh.nbcvs(), 3)))
        self.floor = FLOOR * self.points.tangents()
        self.places, self.moved = self.space.basic_dof_nodes()[:, ::3].T, np.zeros(self.space.nbdof())
        self.start = self.now = self.deformations()
        self.tolerance, self.pressure, self.iterations = tolerance, pressure, 0

    def deformations(self):
        model = getfem.Model("real")
        model.add_fem_variable("u", self.space)
        model.set_variable("u", self.moved)
        return UNIT + np.moveaxis(model.interpolation("Grad_u", getfem.MeshImData(self.rule, -1, [3, 3])).reshape(3, 3, -1, order="F"), -1, 0)

    def assembled(self, order, form, values):
        """values[n, ...]: of the points; getfem has their first index fastest."""
        data = getfem.MeshImData(self.rule, -1, list(values.shape[1:]))
        return getfem.asm_generic(self.rule, order, form, -1, "u", 1, self.space, self.moved, "values", 0, data, np.moveaxis(values, 0, -1).ravel(order="F"))

    def forces_and_stiffness(self, stresses, tangents):
        """By nominal stresses less those of the pressure, and their derivatives."""
        whole, back, volumes = stresses[:, VOIGT] + self.pressure * UNIT, np.linalg.inv(self.now), np.linalg.det(self.now)
        moduli = (tangents + self.floor)[:, VOIGT[:, :, None, None], VOIGT[None, None]] + np.einsum("ik,njl->nijkl", UNIT, whole)
        return (self.assembled(1, "values:Grad_Test_u", np.einsum("n,nij,nJj->niJ", volumes, whole, back)),
                self.assembled(2, "(values:Grad_Test2_u):Grad_Test_u", np.einsum("n,nijkl,nJj,nLl->niJkL", volumes, moduli, back, back)).full())

    def step(self, held, change):
        """held: which numbers of nodes and axes are given a change [m] of their displacement. -> stresses of the points [Pa]"""
        free, change = ~held.ravel(), np.where(held, change, 0.0).ravel()
        forces, stiffness = self.forces_and_stiffness(self.points.stresses(), self.points.tangents())
        for _ in range(100):
            change[free] = -np.linalg.solve(stiffness[np.ix_(free, free)], (forces + stiffness[:, ~free] @ change[~free])[free])
            self.moved += change
            change[:] = 0.0
            self.now = self.deformations()
            stresses, tangents, verdicts = self.points.respond(self.now @ np.linalg.inv(self.start) - UNIT)
            self.iterations += 1
            if verdicts["status"].max() > 1:
                raise RuntimeError(f"a point does not respond ({self.points.report()}): take smaller steps")
            forces, stiffness = self.forces_and_stiffness(stresses, tangents)
            if np.linalg.norm(forces[free]) <= self.tolerance * np.linalg.norm(forces[~free]):
                self.points.commit()
                self.start = self.now
                return stresses
        raise RuntimeError("a step is not balanced after 100 iterations: take smaller steps")


def alone(material, tolerance):
    """-> axial stress [Pa] of one point between smooth platens, with the pressure on its sides"""
    point = scarp.MaterialPoints(material, np.zeros((1, 3)))
    floor = FLOOR * point.tangents()
    for step in range(STEPS):
        gradient = np.diag([0.0, 0.0, -1.0 / (STEPS / STRAIN - step)])[None]
        for _ in range(100):
            stresses, tangents, _ = point.respond(gradient)
            apart = stresses[0, :2] + PRESSURE
            if np.abs(apart).max() <= tolerance * PRESSURE:
                break
            gradient[0, [0, 1], [0, 1]] -= np.linalg.solve((tangents + floor)[0, :2, :2], apart)
        point.commit()
    return stresses[0, 2]


def check(name, material, tolerance):
    """Moves the surface of a cube by a linear field; compresses another one between smooth platens. Prints what one point alone differs by."""
    gradient = 5e-3 * np.array([[0.5, 0.2, -0.4], [0.3, 0.6, 0.1], [0.2, -0.5, -2.0]])
    cube = Cube(material, tolerance, 0.0)
    surface = ((cube.places < 1e-9) | (cube.places > 1.0 - 1e-9)).any(axis=1, keepdims=True)
    stresses = cube.step(np.repeat(surface, 3, axis=1), cube.places @ gradient.T)
    own = scarp.MaterialPoints(material, np.zeros((1, 3))).respond(gradient[None])[0]
    print(f"{name}, patch test: axial stress {own[0, 2] / 1e3:.3f} kPa, points differ by {np.abs(stresses - own).max() / np.abs(own).max():.1e} of it")
    cube = Cube(material, tolerance, PRESSURE)
    held = cube.places < 1e-9
    held[:, 2] |= cube.places[:, 2] > 1.0 - 1e-9
    for _ in range(STEPS):
        axial = cube.step(held, np.where(cube.places > 0.5, -STRAIN / STEPS, 0.0))[:, 2] / 1e3
    print(f"{name}, cube: axial stress {axial.mean():.3f} kPa, one point alone {alone(material, tolerance) / 1e3:.3f} kPa, points of the cube spread over "
          f"{np.ptp(axial):.3f} kPa; {cube.iterations} iterations of {len(cube.points)} points")


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--grains", type=int, default=100, help="spheres of each packing")
    given = parser.parse_args()
    version = subprocess.run(["dpkg-query", "-W", "-f", "${Version}", "python3-getfem"], capture_output=True, text=True)
    print(f"getfem {version.stdout}, NumPy {np.__version__}; scarp {scarp.build['version']}, {scarp.build['instruction_set']}")
    check("Mohr-Coulomb", scarp.mohr_coulomb(dim=3, young=8e7, poisson=0.25, friction=FRICTION, dilation=0.0, surcharge=PRESSURE), 1e-12)
    print(f"closed form: {-PRESSURE * math.tan(math.pi / 4.0 + FRICTION / 2.0) ** 2 / 1e3:.3f} kPa")
    check("spheres", scarp.spheres(grains=given.grains, pressure=PRESSURE, normal_stiffness=3e5, tangential_stiffness=3e5), 1e-3)


if __name__ == "__main__":
    try:
        main()
    except (ValueError, RuntimeError) as trouble:
        sys.exit(f"getfem_points: {trouble}")
