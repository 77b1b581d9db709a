# SPDX-License-Identifier: BSL-1.0
# The discs of a comparison as spheres of Yade that stay in a plane. Executed within yade_side.py and yade_biaxial.py, which have
# read `given`; the first argument of the command line is a file with rows of x y vx vy r.
import math

O.periodic = True
O.cell.hSize = Matrix3(given["box"][0], 0, 0, 0, given["box"][1], 0, 0, 0, given["thickness"])
angle = math.atan(given["friction"])
material = O.materials.append(FrictMat(density=given["density"], young=1e8, poisson=0.5, frictionAngle=angle))
for line in open(sys.argv[1]):
    x, y, vx, vy, radius = map(float, line.split())
    body = utils.sphere((x, y, given["thickness"] / 2), radius, material=material)
    body.state.blockedDOFs = "zXY"
    body.state.mass = given["density"] * given["thickness"] * math.pi * radius**2
    inertia = body.state.mass * radius**2 / 2
    body.state.inertia = (inertia / 2, inertia / 2, inertia)
    body.state.vel = (vx, vy, 0)
    O.bodies.append(body)


def always(value):
    return MatchMaker(algo="val", val=value)


O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=given["skin"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()],
                    [Ip2_FrictMat_FrictMat_FrictPhys(kn=always(given["stiffness"]), ks=always(given["stiffness"]), frictAngle=always(angle))],
                    [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=given["damping"]),
]
O.dt = given["time_step"]
