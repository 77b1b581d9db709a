# SPDX-License-Identifier: BSL-1.0
"""What the comparisons with other DEM codes share: our side, the check that both compute the same, batches in turns, tables."""
import argparse
import json
import math
import pathlib
import statistics
import subprocess
import sys

here = pathlib.Path(__file__).resolve().parent
root = here.parent.parent
sys.path.insert(0, str(here.parent))
from common import origin, quick, write_table  # noqa: F401: both sides of each comparison take these from here


def in_shell(command):
    subprocess.run(["bash", "-c", f"source '{root}/.ci/set_up.sh' && {command}"], check=True, stdout=sys.stderr)


try:
    import numpy
except ImportError:
    in_shell("install_missing python3-numpy")
    import numpy

# Our side is built for this machine, the same with wider moves, and for AVX2.
LEVELS = {"native": "native", "x86-64-v3": "x86-64-v3"}
# What both must have in common after the steps of the check, for which grains are stirred so that contacts slide and open.
CHECK_STEPS, CHECK_SPEED = 60, 1.0
TOLERANCES = {"displacement": 0.03, "contacts": 5e-3, "stress": 2e-3}
BATCH_SECONDS = 0.1  # of the peer


class Different(Exception):
    """Both sides do not compute the same."""


def build(targets):
    in_shell('configure release g++ -D SCARP_BUILD_BENCHMARKS=ON -D SCARP_BUILD_VERIFICATION=ON > /dev/null && '
             f'cmake --build "$repository/build/release" --target {targets} --parallel "$jobs"')


def install(packages):
    try:
        in_shell(f'install_missing "${{build_packages[@]}}" {packages}')
    except subprocess.CalledProcessError:
        sys.exit(f"{sys.argv[0]}: {packages} could not be installed (see above): install it, or do without this comparison")


def set_up(packages, program):
    """Installs the peer, builds our side. Exits with a clear message when the peer is not to be had."""
    install(packages)
    if subprocess.run(["which", program], capture_output=True).returncode != 0:
        sys.exit(f"{sys.argv[0]}: there is no program '{program}' (of {packages}): put it on the PATH")
    build(" ".join(f"our_steps_{level}" for level in LEVELS))


def our_program(level):
    return root / "build" / "release" / "benchmarks" / f"our_steps_{level}"


def parser_of(description, sizes):
    parser = argparse.ArgumentParser(description=description, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--grains", type=int, nargs="+", default=sizes, metavar="N", help=f"default {sizes}")
    parser.add_argument("--rounds", type=int, default=25, metavar="N", help="batches of each program, in turns (default 25)")
    parser.add_argument("--quick", action="store_true", help="one size, three batches, to output/quick")
    return parser


def arguments(parser):
    given = parser.parse_args()
    if min(given.grains) < 50 or max(given.grains) > 100000:
        parser.error(f"--grains {' '.join(map(str, given.grains))}: take numbers from 50 to 100000")
    if given.rounds < 1:
        parser.error(f"--rounds {given.rounds}: take one at least")
    if quick():
        given.grains, given.rounds = given.grains[:1], 3
    return given


class State:
    """A packing that `our_steps make` has written: positions of grains at rest, radii, a box along the axes, the law."""

    def __init__(self, path):
        lines = path.read_text().splitlines()
        head = lines[0].split()
        self.path, self.dim, self.grains = path, int(head[0]), int(head[1])
        self.density, self.thickness, self.stiffness, self.friction = map(float, head[2:])
        *box, self.time_step = map(float, lines[1].split())
        self.box = numpy.array(box)
        rows = numpy.array([[float(word) for word in line.split()] for line in lines[2:]])
        self.position, self.radius = rows[:, :self.dim], rows[:, self.dim]

    def nearest(self, apart):
        """Vectors between points in the periodic box."""
        return apart - self.box * numpy.round(apart / self.box)

    def write_for_yade(self, start, law, velocities, skin, damping=0.0, **more):
        """Rows x y vx vy r, and the rest as JSON."""
        numpy.savetxt(start, numpy.column_stack([self.position % self.box, velocities, self.radius]), fmt="%.17g")
        law.write_text(json.dumps({"box": self.box.tolist(), "density": self.density, "thickness": self.thickness,
                                   "stiffness": self.stiffness, "friction": self.friction, "time_step": self.time_step,
                                   "skin": skin * self.radius.max(), "damping": damping, **more}))


def made(kind, grains, folder):
    path = folder / f"{kind}{grains}.txt"
    subprocess.run([str(our_program("native")), "make", kind, str(grains), str(path)], check=True)
    return State(path)


class Served:
    """A program that obeys commands on its standard input."""

    def __init__(self, command, **options):
        self.process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True, **options)

    def tell(self, command):
        try:
            self.process.stdin.write(command + "\n")
            self.process.stdin.flush()
        except BrokenPipeError:
            sys.exit(f"{sys.argv[0]}: {self.process.args[0]} ended before '{command}' (its message is above, if it gave one)")

    def line(self):
        answer = self.process.stdout.readline()
        if not answer:
            sys.exit(f"{sys.argv[0]}: {self.process.args[0]} ended with {self.process.wait()} in the middle of a run")
        return answer.strip()

    def close(self):
        self.process.stdin.close()
        self.process.stdout.read()
        self.process.wait()


class Ours(Served):
    def __init__(self, level, kind, state, speed, folder):
        super().__init__([str(our_program(level)), "run", kind, str(state.path), repr(speed), repr(state.time_step)])
        self.title, self.state, self.folder, self.lists = f"scarp, {LEVELS[level]}", state, folder, 0
        self.build = self.line()

    def ask(self, command):
        self.tell(command)
        return self.line()

    def start(self):
        """Velocities half a time step before the start, accelerations at the start."""
        self.ask(f"start {self.folder / 'start.txt'}")
        rows, dim = numpy.loadtxt(self.folder / "start.txt"), self.state.dim
        return rows[:, dim:2 * dim], rows[:, 2 * dim:]

    def steps(self, count):
        """CPU seconds."""
        nanoseconds, self.near_pairs, lists = map(int, self.ask(f"steps {count}").split())
        self.lists += lists
        return nanoseconds * 1e-9

    def grains(self):
        contacts, stress, self.sliding = map(float, self.ask(f"grains {self.folder / 'grains.txt'}").split())
        rows, dim = numpy.loadtxt(self.folder / "grains.txt"), self.state.dim
        return rows[:, :dim], contacts, stress


def compare(state, ours, peer):
    """Runs both from the same state; what they agree in. A comparison of different physics would be worth nothing."""
    ours.steps(CHECK_STEPS)
    peer.steps(CHECK_STEPS)
    (our_places, our_contacts, our_stress), (places, contacts, stress) = ours.grains(), peer.grains()
    moved = state.nearest(our_places - state.position)
    apart = state.nearest(places - our_places)
    found = {"displacement": math.sqrt((apart ** 2).sum() / (moved ** 2).sum()),
             "contacts": abs(contacts / our_contacts - 1.0), "stress": abs(stress / our_stress - 1.0)}
    print(f"{state.grains} grains, {CHECK_STEPS} steps: {json.dumps(found)}", file=sys.stderr)
    for what, tolerance in TOLERANCES.items():
        if not found[what] <= tolerance:
            raise Different(f"{state.grains} grains after {CHECK_STEPS} steps: {what} of {peer.title} differs from ours by {found[what]:.2g} "
                            f"(tolerance {tolerance}): not the same physics, so times were not compared")
    return {"rms displacement [m]": math.sqrt((moved ** 2).sum(1).mean()), "difference of it": found["displacement"], "contacts": our_contacts,
            "peer's contacts": contacts, "mean stress [kPa]": our_stress / 1e3, "peer's mean stress [kPa]": stress / 1e3, "sliding share": ours.sliding}


def in_turns(programs, rounds):
    """CPU seconds per step of each batch, of each program. All make the same steps."""
    peer = programs[-1]
    peer.steps(100)
    each = max(peer.steps(200) / 200, 1e-9)
    count = max(20, round(BATCH_SECONDS / each))
    for program in programs[:-1]:
        program.steps(300)
        program.lists = 0
    seconds = {program.title: [] for program in programs}
    for _ in range(rounds):
        for program in programs:
            seconds[program.title].append(program.steps(count) / count)
    return seconds, count


def rows_of_times(state, programs, seconds, agreement, settings):
    """A row for each program; agreement: columns of `compare`."""
    peer = programs[-1]
    rows = []
    for program in programs:
        found = seconds[program.title]
        per_grain = [1e9 * value / state.grains for value in found]
        row = {"grains": state.grains, "program": program.title, "near pairs": program.near_pairs, "ns per grain and step, median": statistics.median(per_grain),
               "least": min(per_grain), "ns per near pair and step, median": statistics.median(found) * 1e9 / program.near_pairs}
        if program is peer:
            row["settings"] = settings
        else:
            row["peer over ours, medians"] = statistics.median(seconds[peer.title]) / statistics.median(found)
            row["peer over ours, least"] = min(seconds[peer.title]) / min(found)
        rows.append({**row, **agreement})
    return rows
