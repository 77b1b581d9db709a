# SPDX-License-Identifier: BSL-1.0
# Yade's side of the comparison, run by Yade itself: yade -n -x -j1 yade_side.py START LAW.json SCENE
# Makes the scene, then obeys `steps N` and `grains FILE` from standard input.
import json
import sys
import time

from yade import utils

given = json.load(open(sys.argv[2]))
exec(compile(open(sys.argv[3]).read(), sys.argv[3], "exec"))
print("ready", flush=True)
for line in sys.stdin:
    command, argument = line.split()
    if command == "steps":
        before = time.process_time()
        O.run(int(argument), True)
        after = time.process_time()
        print(after - before, sum(1 for pair in O.interactions.all(onlyReal=False)), flush=True)
    elif command == "grains":
        # Contacts are of the places before the last move: forces are evaluated once more, without a move.
        O.engines[3].dead = True
        O.run(1, True)
        O.engines[3].dead = False
        stress = getStress()
        with open(argument, "w") as out:
            for body in O.bodies:
                out.write(f"{body.state.pos[0]!r} {body.state.pos[1]!r}\n")
        touching = sum(1 for pair in O.interactions if pair.isReal and pair.phys.normalForce.norm() > 0)
        print(touching, (stress[0, 0] + stress[1, 1]) / 2, flush=True)
