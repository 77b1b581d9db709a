# SPDX-License-Identifier: BSL-1.0
"""What the comparison with the study reads out of frames: where a rupture crosses a level, and which packings stand for a point. Skipped, exit 77,
without NumPy and Matplotlib."""
import pathlib
import sys

sys.dont_write_bytecode = True  # the imports below leave no folders in the sources
root = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(root / "benchmarks" / "study"), str(root / "benchmarks"), str(root / "examples" / "shared"), str(root / "examples" / "fault_rupture")]
try:
    import cases
    import ground_figures
    import numpy as np
    from ground_points import Frame, around, history, steepest_place
except ImportError as missing:
    print(f"skipped: {missing}")
    sys.exit(77)
from types import SimpleNamespace

from expectations import expect, finish


def ground(settlement_at):
    """A layer of 40 x 10 m in triangles that settles as told."""
    x, y = np.meshgrid(np.linspace(-20.0, 20.0, 81), np.linspace(0.0, 10.0, 21))
    places = np.column_stack([x.ravel(), y.ravel()])
    corner = (np.arange(20)[:, None] * 81 + np.arange(80)).ravel()
    cells = np.vstack([np.column_stack([corner, corner + 1, corner + 82]), np.column_stack([corner, corner + 82, corner + 81])])
    displacement = np.column_stack([np.zeros(len(places)), -settlement_at(places)])
    count = len(cells)
    fields = {"stress": np.tile([-1e5, -3e5, 0.0], (count, 1)), "deviatoric_strain": np.full(count, 0.1), "void_ratio": np.full(count, 0.2),
              "contact_fabric": np.zeros(count), "particle_fabric": np.zeros(count)}
    return Frame(0.0, places, cells, displacement, fields)


def dipping(places):
    """A band of 4 m whose middle goes from 0 to -5 m over the height."""
    return np.clip((places[:, 0] + 0.5 * places[:, 1] + 2.0) / 4.0, 0.0, 1.0)


rest, moved = ground(lambda places: np.zeros(len(places))), ground(dipping)
for height in (2.0, 8.0):
    found = steepest_place(moved, rest, height)
    expect(abs(found + 0.5 * height) < 0.1, f"at {height} m the rupture is at {-0.5 * height} m, not at {found}")
before = ground(lambda places: 3.0 * (places[:, 0] > 10.0))
both = ground(lambda places: dipping(places) + 3.0 * (places[:, 0] > 10.0))
expect(abs(steepest_place(both, before, 5.0) + 2.5) < 0.1, "what settled before does not count")

before = [{"measure": "x", "study": "1", "8 m": "2"}, {"measure": "old", "study": "1", "8 m": "3"}]
expect(cases.kept([{"measure": "new", "study": "-", "8 m": None}, {"measure": "x", "study": "-", "8 m": None}], before)
       == [{"measure": "new", "study": "-", "8 m": None}, {"measure": "x", "study": "-", "8 m": "2"}],
       "a value without a run stays as the data file has it, and the rows are the program's")
NO_RUN = {case: "no such run" for case in cases.CASES}
empty = {name: cases.CaseSet(NO_RUN, {}) for name in cases.SETS}
expect(all(set(list(line.values())[2:]) == {None} for line in cases.numbers(empty)), "without runs nothing is told")
told = cases.CaseSet(NO_RUN, {cases.crossing("free", cases.LEVEL): "-10.7", cases.crossing("heavy", cases.LEVEL): "-13.5 +- 0.4"})
expect(told.points == {"A": -10.7}, f"a place of a run that is not there is that of the data file, but for a mean: {told.points}")

near = around([rest], np.array([3.0, 5.0]))
centres = rest.places[rest.cells[near]].mean(axis=1)
expect(len(near) > 10 and np.all(np.linalg.norm(centres - [3.0, 5.0], axis=1) <= 1.0), "packings within a metre stand for a point")
expect(len(around([rest], np.array([100.0, 5.0]))) == 1, "the nearest one does where none is so near")

moved.fields["void_ratio"] = np.full(len(moved.cells), 0.236)
series = history([rest, moved], near)
expect(np.allclose(series["q"], 1e5) and np.allclose(series["p"], 2e5), "q is half of the difference of the principal stresses, p their mean")
expect(np.allclose(series["eps_v"][-1], -0.03) and np.allclose(series["eps_q"][-1], 0.0), "dilation is negative, strains count from the first frame")

# A file from Gmsh may name the footing before the soil.
points = np.array([[0.0, 0.0], [40.0, 0.0], [40.0, 25.0], [0.0, 25.0], [10.0, 26.0], [0.0, 26.0]])
grid = SimpleNamespace(points=points, cells=np.array([[3, 2, 4, 5], [0, 1, 2, 3]]), at_cells={"region": np.array([0.0, 1.0])},
                       at_nodes={"displacement": np.zeros((6, 3))})
expect(ground_figures.layer_depth(grid, "fields") == 25.0, "the soil is the largest region, whatever its number is")

finish()
