# SPDX-License-Identifier: BSL-1.0
"""The Python module responds as the laws say, refuses wrong arrays in words, keeps states through pickles, files and copies, responds to several
threads, and serves as micro simulation. Environment: SCARP_EXAMPLES, beside whose folder the module is (skipped, exit 77, without)."""
import copy
import multiprocessing
import os
import pathlib
import pickle
import shutil
import subprocess
import sys
import tempfile
import threading

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import SLOWER, expect, finish, leave_out, python_module, rejected

module = python_module()
import numpy as np
import scarp


def gradients(count, axial, dim=2):
    values = np.zeros((count, dim, dim))
    values[:, dim - 1, dim - 1] = axial
    return values


# Analytic: plane strain, lambda = E nu / ((1 + nu) (1 - 2 nu)), G = E / (2 (1 + nu)), here 4 MPa each; the strain is exact to its second order.
small, lame = 1e-6, 4e6
for dim in (2, 3):
    points = scarp.MaterialPoints(scarp.linear_elastic(dim=dim, young=1e7, poisson=0.25), np.zeros((3, dim)))
    stresses, tangents, verdicts = points.respond(gradients(3, small, dim), threads=2)
    expected = np.zeros(dim * (dim + 1) // 2)
    expected[:dim] = lame * small
    expected[dim - 1] = 3.0 * lame * small
    expect(np.allclose(stresses, expected, rtol=2 * small, atol=0.0), f"{stresses} is not {expected} in {dim} dimensions")
    expect(np.array_equal(tangents[2].diagonal(), [3.0 * lame] * dim + [lame] * (len(expected) - dim)), f"tangent {tangents[2]}")
    expect(not verdicts["status"].any() and not stresses.flags.owndata, "verdicts are not all ok, or stresses were copied")
    kept = stresses.copy()
    points.respond(gradients(3, 2.0 * small, dim))
    expect(np.array_equal(kept, stresses), "a later response changed earlier stresses")
    points.respond(gradients(3, small, dim))
    points.commit()
    state = points.quantities(1)
    expect(np.allclose([state["p"], state["q"]], [-(dim + 2.0) / dim * lame * small, 2.0 * lame * small], rtol=2 * small, atol=0.0), f"p and q of {expected}: {state}")

points = scarp.MaterialPoints(scarp.linear_elastic(young=1e7, poisson=0.25), np.zeros((3, 2)))
good = gradients(3, small)
rejected(ValueError, "the type float32 (float64", lambda: points.respond(good.astype(np.float32)))
rejected(ValueError, "the shape (3, 2)", lambda: points.respond(good[:, 0]))
rejected(ValueError, "2 displacement gradients are given for 3 points", lambda: points.respond(good[:2]))
rejected(ValueError, "gradient of point 0 is not finite", lambda: points.respond(good * np.nan))
rejected(ValueError, "without a response", points.commit)
rejected(ValueError, "no keyword yung (there are young, poisson", lambda: scarp.linear_elastic(yung=1.0))
for name in ("aspect", "thickness"):
    rejected(ValueError, f"no keyword {name} (there are", lambda: scarp.spheres(**{name: 0.5}))
rejected(ValueError, "no keyword aspect (there are", lambda: scarp.discs(aspect=0.5))
expect(len(set(scarp.reasons)) == len(scarp.reasons) >= 16 and scarp.reasons[15] == "interrupted", f"reasons {scarp.reasons}")
rejected(ValueError, "grains is 4.5 (a value like 400", lambda: scarp.ellipses(grains=4.5))
rejected(ValueError, "void ratio 3", lambda: scarp.discs(grains=40, void_ratio=3.0))
rejected(RuntimeError, "could not be consolidated", lambda: scarp.discs(grains=40, pressure=1e12))
rejected(ZeroDivisionError, "division", lambda: scarp.discs(grains=40, progress=lambda *told: 1 / 0))
rejected(ValueError, "point -2 is named (there are 3 points)", lambda: points.quantities(-2))
rejected(ValueError, "index -4 is given to a point", lambda: scarp.MaterialPoints(scarp.linear_elastic(young=1e6), np.zeros((2, 2)), indices=[0, -4]))
rejected(ValueError, "are no array", lambda: points.respond(None))
rejected(ValueError, "dim is '3' (expected is 2 or 3)", lambda: scarp.mohr_coulomb(dim="3"))
outlier = np.ma.masked_greater(good + np.eye(2) * 1e-9, 0.9 * small)
rejected(ValueError, "displacement gradients are masked", lambda: points.respond(outlier))
rejected(ValueError, "displacement gradients are masked", lambda: points.respond([*outlier]))
rejected(ValueError, "threads are '2'", lambda: scarp.discs(grains=20, threads="2"))
rejected(ValueError, "positions are masked", lambda: scarp.MaterialPoints(scarp.linear_elastic(young=1e6), np.ma.masked_invalid([[0.0, np.nan]])))
expect(np.array_equal(points.respond(np.ma.masked_greater(good, 1.0))[0], points.respond(good)[0]), "a mask of nothing changes the stress")
rejected(ValueError, "point 3 is named (there are 3 points)", lambda: points.quantities(3))

told = []
sand = scarp.ellipses(grains=60, packings=3, threads=2, progress=lambda *words: told.append(words))
expect(told[-1][0] == 3 and told[-1][1] == 3, f"the progress ends with {told[-1]}")
points = scarp.MaterialPoints(sand, np.zeros((4, 2)))
state = points.quantities(1)
expect(abs(state["p"] / 2e5 - 1.0) < 1e-3 and state["q"] < 400.0, f"prepared at 200 kPa: {state}")  # tolerance of the preparation, 1e-3
picture = points.picture(1)
expect(picture["grains"].shape == (60, 6) and len(picture["contacts"]) > 60, f"{len(picture['contacts'])} contacts of 60 grains")
# Love and Weber: p = sum of force times branch over twice the volume, of normal forces alone, the trace of the shear parts being small.
branch, normal, force = picture["contacts"][:, 2:4], picture["contacts"][:, 4:6], picture["contacts"][:, 6]
pressure = np.sum(force * np.sum(branch * normal, axis=1)) / (2.0 * 0.2 * np.linalg.det(picture["cell"]))
expect(abs(pressure / 2e5 - 1.0) < 0.05, f"normal forces give {pressure} Pa")  # shear forces on slanted branches of ellipses: within 5 %


def at_void_ratio(wanted):
    """Small packings may jump over a void ratio: the first seed that does not."""
    for seed in range(1, 9):
        try:
            return scarp.MaterialPoints(scarp.discs(grains=200, void_ratio=wanted, seed=seed), np.zeros((1, 2))).quantities(0)["void_ratio"]
        except ValueError:
            pass
    return 0.0


for wanted in (0.20, 0.19):
    found = at_void_ratio(wanted)
    expect(abs(found - wanted) < 5.01e-4, f"void ratio {found} for {wanted}")
at_rest = scarp.MaterialPoints(scarp.discs(grains=100, pressure=2e4, vertical_pressure=1e5), np.zeros((1, 2))).stresses()[0]
expect(abs(at_rest[1] / -1e5 - 1.0) < 2e-3 and 0.2 < at_rest[0] / at_rest[1] < 1.0, f"K0 compression gives {at_rest}")

with tempfile.TemporaryDirectory() as scratch:
    file = pathlib.Path(scratch) / "own.sand"
    file.write_text("shape = ellipse\ngrains = 60\nfriction = 0.3\npreparation-friction = 0.05\n")
    state = [scarp.MaterialPoints(made, np.zeros((1, 2))).quantities(0) for made in
             (scarp.packing(file, seed=2), scarp.ellipses(grains=60, friction=0.3, preparation_friction=0.05, seed=2))]
    expect(state[0] == state[1], f"a sand's file gives {state[0]}, its keywords {state[1]}")
    file.write_text("viod-ratio = 0.2\n")
    rejected(ValueError, "line 1: a sand has no 'viod-ratio'", lambda: scarp.packing(file))

# A packing of a file has the grains and the law of the sand beside it, but for keywords that are given.
lab = pathlib.Path(os.environ["SCARP_EXAMPLES"]).resolve() / "rve_lab"
if not lab.is_file():
    leave_out("rve_lab is not built")
else:
    with tempfile.TemporaryDirectory() as scratch:
        subprocess.run([lab, "prepare", "--shape", "ellipse", "--grains", "60", "--friction", "0.3", "--output", "made"], cwd=scratch,
                       check=True, capture_output=True, timeout=100)
        file = pathlib.Path(scratch) / "made/packing.packing"
        beside, given, other, usual = (scarp.MaterialPoints(scarp.ellipses(file=file, **more), np.zeros((1, 2))).respond(gradients(1, -5e-3))[0]
                                for more in ({}, {"friction": 0.3}, {"friction": 0.5}, {"friction": 0.55}))
        for more in ({"grains": 100}, {"packings": 2}):
            rejected(ValueError, next(iter(more)), lambda: scarp.ellipses(file=file, **more))
        (pathlib.Path(scratch) / "made/packing.sand").unlink()
        rejected(ValueError, "is not known", lambda: scarp.ellipses(file=file))
    expect(np.array_equal(beside, given), f"the sand beside the file gives {beside}, its friction as keyword {given}")
    expect(not np.array_equal(beside, other) and not np.array_equal(beside, usual), f"other frictions give {other}, {usual}")

# Spheres in space; springs softer than the plane's, for contacts have no thickness.
state = scarp.MaterialPoints(scarp.spheres(grains=60, normal_stiffness=3e5, tangential_stiffness=3e5), np.zeros((1, 3))).quantities(0)
expect(abs(state["p"] / 2e5 - 1.0) < 1e-3 and state["q"] < 800.0 and state["coordination"] > 4.0, f"spheres at 200 kPa: {state}")

serial, _, _ = points.respond(gradients(4, -1e-3), threads=1)
several, _, verdicts = points.respond(gradients(4, -1e-3), threads=2)
expect(np.array_equal(serial, several) and (points.work > 0).all(), "two threads give other bits than one")
points.commit()
expect(np.array_equal(points.stresses(), several), "a commit keeps other stresses than those of the response")
with tempfile.TemporaryDirectory() as scratch:
    file = pathlib.Path(scratch) / "sand.points"
    points.save(file)
    points.save(str(file))
    again = [pickle.loads(pickle.dumps(points)), copy.deepcopy(points), scarp.load(file)]
    damaged = bytearray(file.read_bytes())
    damaged[len(damaged) // 2] ^= 1
    file.write_bytes(damaged)
    rejected(ValueError, "sand.points", lambda: scarp.load(file))
expected = points.respond(gradients(4, -1e-3))[0]
for other in again:
    expect(np.array_equal(other.respond(gradients(4, -1e-3))[0], expected), "a saved state goes on in another way")
again[0].unpack([2], bytearray(points.pack([1])))
rejected(TypeError, "", lambda: again[0].unpack([2], 7))
again[1].copy(2, points, 1)
expect(np.array_equal(again[0].stresses()[2], points.stresses()[1]) and np.array_equal(again[1].stresses()[2], points.stresses()[1]),
       "a packed or copied state is another one")
points.discard()
verdicts = points.respond(np.repeat(np.diag([-0.9, -0.9])[None], 4, axis=0))[2]
expect(scarp.statuses[verdicts["status"][0]] == "failed" and points.report()["worst_point"] == 0, f"{verdicts}")
rejected(ValueError, "a commit would keep it", points.commit)

means = scarp.MaterialPoints(sand, np.array([[0.0, 0.0], [0.5, 0.0]]), volumes=np.ones(2), length=2.0)
uneven = gradients(2, -1e-3)
uneven[1] = 0.0
local = scarp.MaterialPoints(sand, np.array([[0.0, 0.0], [0.5, 0.0]])).respond(uneven)[0]
expect(np.abs(means.respond(uneven)[0][1] - local[1]).max() > 1e3, "points with a length do not see each other")

# While one thread waits for a response without the interpreter's lock, others are refused the same points, and count.
counted, troubles = [0], []
busy = scarp.MaterialPoints(scarp.ellipses(grains=200), np.zeros((40, 2)))
worker = threading.Thread(target=lambda: busy.respond(gradients(40, -5e-3)))
worker.start()
while worker.is_alive():
    counted[0] += 1
    try:
        (busy.stresses if counted[0] % 2 else busy.report)()
    except RuntimeError as trouble:
        troubles.append(f"{counted[0] % 2} {trouble}")
worker.join()
for which in "01":
    expect(any(which == trouble[0] and "serve one at a time" in trouble for trouble in troubles), f"call {which} is not rejected")
expect(counted[0] > 100, f"{counted} rounds during a response")

# The block program of cards, on the processor: sums in another order; saved states go on without it.
usual, block = (scarp.MaterialPoints(scarp.discs(grains=60, device=device), np.zeros((2, 2))) for device in ("none", "threads"))
answers = [points.respond(gradients(2, -1e-3))[0] for points in (usual, block)]
expect(np.abs(answers[0] / answers[1] - 1.0)[:, :2].max() < 1e-6 and not np.array_equal(*answers), f"a device gives {answers[1]}, none {answers[0]}")
usual.commit(), block.commit()
usual.unpack([0], block.pack([0]))
expect(np.array_equal(usual.stresses()[0], block.stresses()[0]), "a state of a device has another stress")
rejected(ValueError, "the device is 'gpu' (none, threads or cuda", lambda: scarp.discs(grains=60, device="gpu"))
rejected(ValueError, "CUDA", lambda: scarp.discs(grains=60, device="cuda"))
expect(scarp.MaterialPoints(scarp.spheres(grains=60, normal_stiffness=3e5, tangential_stiffness=3e5, device="threads"), np.zeros((1, 3))).respond(
    gradients(1, -1e-4, 3))[2]["status"][0] == 0, "spheres do not respond on a device")

# A state is not taken over by points whose law is another: contacts would carry another stress.
held = scarp.MaterialPoints(scarp.discs(grains=60), np.zeros((2, 2)))
for stiff in (scarp.discs(grains=60, normal_stiffness=3e7), scarp.discs(grains=60, friction=0.05)):
    held.respond(gradients(2, -1e-3)), held.commit()
    others = scarp.MaterialPoints(stiff, np.zeros((2, 2)))
    for take in (lambda: others.copy(0, held, 1), lambda: others.unpack([0, 1], held.pack([0, 1]))):
        rejected(ValueError, "another law has made it", take)
same = scarp.MaterialPoints(scarp.discs(grains=60, seed=4), np.zeros((2, 2)))
same.copy(0, held, 1)
same.unpack([1], held.pack([1]))
expect(np.array_equal(same.respond(gradients(2, -1e-3))[0][:1], held.respond(gradients(2, -1e-3))[0][1:]), "a state of one law is not taken over")

# A process that was forked has none of the parent's threads: it starts its own, also through multiprocessing.
forked = scarp.MaterialPoints(sand, np.zeros((5, 2)))
expected = forked.respond(gradients(5, -2e-3), threads=3)[0]


def in_child(pipe):
    pipe.send([forked.respond(gradients(5, -2e-3), threads=threads)[0] for threads in (3, 2)])


here, there = multiprocessing.Pipe()
child = multiprocessing.get_context("fork").Process(target=in_child, args=(there,))
child.start()
expect(here.poll(60) and all(np.array_equal(one, expected) for one in here.recv()), "points do not respond, or otherwise, in a process that was forked")
child.join(20)
expect(child.exitcode == 0, f"a process that was forked does not end: {child.exitcode}")
child.kill()
busy = scarp.MaterialPoints(scarp.discs(grains=60), np.zeros((400, 2)))
worker = threading.Thread(target=lambda: busy.respond(gradients(400, -1e-2)))
worker.start()
while True:
    try:
        len(busy)
    except RuntimeError:
        break
if (process := os.fork()) == 0:
    try:
        busy.respond(gradients(400, 0.0))
    except RuntimeError as trouble:
        os._exit(7 if "fork between responses" in str(trouble) else 1)
    os._exit(2)
expect(os.waitstatus_to_exitcode(os.waitpid(process, 0)[1]) == 7, "points that responded during a fork are not rejected in words")
worker.join()

# Ctrl-C ends work of minutes within a second: of CPU time for each thread, of which a busy machine gives less. A limit of CPU time ends the process where
# it does not. Committed states and later responses stay as they were.
interrupted = f"slower = {SLOWER}" + """
import os, signal, sys, threading, time
import numpy as np, scarp
signal.setitimer(signal.ITIMER_PROF, 60 * slower)
def after(seconds, work, threads=1):
    moments = []
    def interrupt():
        time.sleep(seconds)
        moments.append(time.process_time())
        os.kill(os.getpid(), signal.SIGINT)
    threading.Thread(target=interrupt).start()
    try:
        work()
    except KeyboardInterrupt:
        late = time.process_time() - moments[0]
        if late > threads * slower:
            sys.exit(f"it was interrupted after {late} s of CPU time")
        return
    sys.exit("it was not interrupted")
strain = lambda axial: np.repeat(np.diag([0.0, axial])[None], len(points), axis=0)
for threads, count in ((1, 3000), (3, 3000), (2, 1)):
    slow = {} if count > 1 else dict(strain_per_step=1e-8, max_steps=10**7)
    points = scarp.MaterialPoints(scarp.ellipses(grains=80, **slow), np.zeros((count, 2)))
    points.respond(strain(-1e-5 if count < 2 else 0.0)), points.commit()
    before = points.pack([0])
    other = scarp.loads(points.__reduce__()[1][0])
    after(0.3, lambda: points.respond(strain(-0.15), threads=threads), threads)
    assert points.pack([0]) == before
    if count < 2:
        assert np.array_equal(points.respond(strain(-1e-5))[0], other.respond(strain(-1e-5))[0])
        points.commit()
    try:
        points.commit()
        sys.exit("an interrupted response was committed")
    except ValueError:
        pass
after(0.5, lambda: scarp.discs(grains=100000))
after(0.5, lambda: scarp.spheres(grains=20000, packings=3, threads=2), 2)
sand = scarp.discs(grains=80)
after(0.2, lambda: scarp.MaterialPoints(sand, np.zeros((30000, 2))))
"""
done = subprocess.run([sys.executable, "-B", "-c", interrupted], env={**os.environ, "PYTHONPATH": str(module)}, capture_output=True, text=True,
                      timeout=300 * SLOWER)
expect(done.returncode == 0, f"Ctrl-C in long work: {done.returncode} {done.stderr}")

# An interpreter without NumPy, and one that the module was not built for.
done = subprocess.run([sys.executable, "-S", "-B", "-c", "import scarp"], env={"PYTHONPATH": str(module)}, capture_output=True, text=True, timeout=100)
expect("scarp needs NumPy" in done.stderr, done.stderr)
with tempfile.TemporaryDirectory() as scratch:
    shutil.copytree(module / "scarp", pathlib.Path(scratch) / "scarp", ignore=shutil.ignore_patterns("_points*"))
    (pathlib.Path(scratch) / "scarp/_points.cpython-35m-x86_64-linux-gnu.so").touch()
    done = subprocess.run([sys.executable, "-B", "-c", "import scarp"], env={"PYTHONPATH": scratch}, cwd=scratch, capture_output=True, text=True, timeout=100)
    expect("does not load in Python" in done.stderr and "cpython-35m" in done.stderr, done.stderr)


class Incremental(scarp.MicroSimulation):
    material = sand
    strains = "incremental"


class Total(Incremental):
    strains = "total"


# Plays preCICE's manager: a time step, its repetition from the stored state, the next one; total and incremental strains are one path.
step = np.array([[0.0, 1e-3], [0.0, -1e-3]])
incremental, total = Incremental(5), Total(5)
expect(np.array_equal(incremental.initialize()["stress"], total.initialize()["stress"]), "one id draws two packings")
start = incremental.get_state()
first = incremental.solve({"gradient": step.ravel()}, 0.1)
incremental.set_state(start)
repeated = incremental.solve({"gradient": step.ravel()}, 0.1)
expect(np.array_equal(first["stress"], repeated["stress"]), "a repeated time step has another stress")
total.solve({"gradient": step.ravel()}, 0.1)
incremental = pickle.loads(pickle.dumps(incremental))
second = incremental.solve({"gradient": step.ravel()}, 0.1)["stress"]
whole = (np.eye(2) + step) @ (np.eye(2) + step) - np.eye(2)
same = total.solve({"gradient": whole.ravel()}, 0.1)["stress"]
expect(np.abs(second / same - 1.0).max() < 1e-3, f"{second} incremental, {same} total")  # round-off, which grains enlarge
rejected(ValueError, "4 are expected", lambda: total.solve({"gradient": [0.0] * 9}, 0.1))
rejected(RuntimeError, "take smaller time steps", lambda: total.solve({"gradient": [-0.95, 0.0, 0.0, -0.95]}, 0.1))
rejected(ValueError, "no material", lambda: scarp.MicroSimulation(0))
finish()
