# SPDX-License-Identifier: BSL-1.0
# Biaxial compression by Yade's FEMxDEM, in one process: yade -n -x -j1 yade_biaxial.py START LAW.json TABLE SCENE
# The element code is Yade's own (yade.FEMxDEM), escript's finite elements solve; this file gives mesh, packing and loads.
import json
import pathlib
import sys
import time
import types

import yade
from yade import utils

given = json.load(open(sys.argv[2]))
exec(compile(open(sys.argv[4]).read(), sys.argv[4], "exec"))
O.run(100, True)  # a scene without contacts has no stiffness
O.save("0.yade.gz")

# What FEMxDEM wants to import as "yadeimport" is the Yade that runs it.
stand_in = types.ModuleType("yadeimport")
stand_in.Omega, stand_in.utils = yade.Omega, utils
sys.modules["yadeimport"] = stand_in
sys.path.insert(0, str(pathlib.Path(list(yade.__path__)[0]) / "FEMxDEM"))
import msFEM2D


class OneProcess:
    """In the place of a pool of processes."""

    answers = 0

    def map(self, work, items):
        items = list(items)
        if work.__name__ == "shear2D":
            OneProcess.answers += len(items)
        return [work(item) for item in items]

    def close(self):
        pass


msFEM2D.get_pool = lambda **options: OneProcess()
from esys.escript import Function, FunctionOnBoundary, Scalar, integrate, whereZero
from esys.finley import Rectangle

columns, lines = given["elements"]
width, tall = given["specimen"]
domain = Rectangle(l0=width, l1=tall, n0=columns, n1=lines, order=2, integrationOrder=2)
problem = msFEM2D.MultiScale(domain=domain, ng=4 * columns * lines, rtol=given["tolerance"], verbose=False)
place, side = domain.getX(), FunctionOnBoundary(domain).getX()
bottom, top = whereZero(place[1]), whereZero(place[1] - tall)
held = bottom * [0, 1] + top * [0, 1] + bottom * whereZero(place[0] - width / 2) * [1, 1]
pressure = (whereZero(side[0]) - whereZero(side[0] - width)) * [given["confining"], 0]
with open(sys.argv[3], "w") as table:
    for step in range(given["steps"]):
        before, answers = time.process_time(), OneProcess.answers
        problem.initialize(f=pressure, specified_u_mask=held, specified_u_val=top * [0, -given["strain"] * tall])
        problem.solve(iter_max=100)
        seconds = time.process_time() - before
        current = problem.getDomain()
        mean = integrate(problem.getCurrentStress()) / integrate(Scalar(1, Function(current)))
        table.write(f"{seconds!r} {OneProcess.answers - answers} {float(mean[1, 1])!r}\n")
