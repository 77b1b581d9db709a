# SPDX-License-Identifier: BSL-1.0
"""User-defined boundary-value problem: a trench is cut into sand of packings on elastic rock, on a mesh from Gmsh. The twin of excavation.cpp."""
import pathlib

import scarp

model = scarp.Model(scarp.read_gmsh(pathlib.Path(__file__).with_name("excavation.msh")))
model.fix(["left", "right"], axis=0)  # rollers
model.fix("bottom", axis=1)
model.gravity(16e3)                                  # [N/m3]
model.surcharge(["surface", "slope", "floor"], 4e3)  # [Pa]
at_rest = model.geostatic(0.5)
model.material("rock", scarp.linear_elastic(young=500e6, poisson=0.25, **at_rest))
# For every depth of the sand a packing that was compressed to the overburden; springs in N/m.
sand = scarp.ground_of_ellipses(normal_stiffness=6e6, tangential_stiffness=6e6, friction=0.55, smallest=4e-3, largest=6e-3, aspect=0.6, grains=200,
                                density=2650.0, thickness=0.2, preparation_friction=0.08, depths=model.depths(), surcharge=at_rest["surcharge"],
                                unit_weight=at_rest["unit_weight"], pressure_floor=at_rest["surcharge"] / 2.0, stiffness_floor=1e-4)
model.material("sand", sand)
analysis = scarp.Analysis(model, tolerance=2e-3, max_iterations=40)
series = scarp.FieldSeries("output/excavation", to=1.0, count=4)
print("excavated  heave of the floor [mm]  base reaction [kN/m]  steps  iterations")
for stage in range(1, 5):
    run = analysis.to(0.25 * stage, fields=series)
    print(f"{run.load:9.2f} {1e3 * analysis.displacement('floor', 1):24.2f} {1e-3 * analysis.reaction('bottom')[1]:21.1f} {run.steps:6} {run.iterations:11}")
share = analysis.reaction("bottom")[1] / -model.dead_load()[1]
print(f"base reaction over weight and surcharge: {share:.5f}")  # it carries what is left above it
assert abs(share - 1.0) <= 2e-3, "the base does not carry it: reduce the tolerance"
