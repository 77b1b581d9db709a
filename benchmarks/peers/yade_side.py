# SPDX-License-Identifier: BSL-1.0
# Yade's side of the comparison, run by Yade itself: yade -n -x -j1 yade_side.py START LAW.json
# START: rows of x y vx vy r. Then it obeys `steps N`, `grains FILE` from standard input.
import json
import math
import sys
import time

given = json.load(open(sys.argv[2]))
rows = [[float(word) for word in line.split()] for line in open(sys.argv[1])]
height = given["thickness"]
O.periodic = True
O.cell.hSize = Matrix3(given["box"][0], 0, 0, 0, given["box"][1], 0, 0, 0, height)
material = O.materials.append(FrictMat(density=given["density"], young=1e8, poisson=0.5, frictionAngle=math.atan(given["friction"])))
for x, y, vx, vy, radius in rows:
    body = utils.sphere((x, y, height / 2), radius, material=material)
    body.state.blockedDOFs = "zXY"
    body.state.mass = given["density"] * height * math.pi * radius**2
    inertia = 0.5 * body.state.mass * radius**2
    body.state.inertia = (0.5 * inertia, 0.5 * inertia, inertia)
    body.state.vel = (vx, vy, 0)
    O.bodies.append(body)
spring = lambda: MatchMaker(algo="val", val=given["stiffness"])
physics = Ip2_FrictMat_FrictMat_FrictPhys(kn=spring(), ks=spring(), frictAngle=MatchMaker(algo="val", val=math.atan(given["friction"])))
O.engines = [
    ForceResetter(),
    InsertionSortCollider([Bo1_Sphere_Aabb()], verletDist=given["skin"]),
    InteractionLoop([Ig2_Sphere_Sphere_ScGeom()], [physics], [Law2_ScGeom_FrictPhys_CundallStrack()]),
    NewtonIntegrator(damping=0),
]
O.dt = given["time_step"]
O.trackEnergy = False
print("ready", flush=True)
for line in sys.stdin:
    command, argument = line.split()
    if command == "steps":
        before = time.process_time()
        O.run(int(argument), True)
        after = time.process_time()
        print(after - before, len([1 for pair in O.interactions.all(onlyReal=False)]), flush=True)
    elif command == "grains":
        # Contacts are of the places before the last move: one more evaluation of the forces, then no move.
        moved = [body.state.pos for body in O.bodies]
        O.engines[3].dead = True
        O.run(1, True)
        O.engines[3].dead = False
        stress = getStress()
        with open(argument, "w") as out:
            for x, y, _ in moved:
                out.write(f"{x!r} {y!r}\n")
        touching = sum(1 for pair in O.interactions if pair.isReal and pair.phys.normalForce.norm() > 0)
        print(touching, (stress[0, 0] + stress[1, 1]) / 2, flush=True)
