# SPDX-License-Identifier: BSL-1.0
"""cases.py: the three cases beside the reference study, from the runs in output/study_*: docs/data/study_cases.csv, study_runs.csv and three figures.
Run by `benchmarks/study/run cases`; where a run is missing the data file keeps its value."""
import dataclasses
import json
import math
import pathlib
import sys

sys.dont_write_bytecode = True
REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(REPOSITORY / "benchmarks"), str(REPOSITORY / "examples" / "shared")]
import numpy as np
import case_figures
import ground_points
from common import data_folder, measures, origin, read_table, write_table

OUTPUT = REPOSITORY / "output"
FIGURES = REPOSITORY / "docs" / "figures"
CASES = ["free", "heavy", "light"]
# Height of the points A and B above bedrock [m], 4 m below the surface.
LEVEL = 21.0
DEPTH = 25.0  # of the soil [m]
SETS = {f"{length} m": {case: f"study_{case}_{length}" for case in CASES} for length in (1, 2)}
# The same with a rigid base that may slide and lift in the place of one that sticks.
FRICTIONAL = {f"{length} m": {case: f"study_{case}_{length}_frictional" for case in ("heavy", "light")} for length in (1, 2)}


@dataclasses.dataclass
class Run:
    summary: dict
    frames: list


def run_of(name):
    """None where it has not been run to its end."""
    folder = OUTPUT / name
    if not (folder / "summary.json").is_file():
        return None
    summary = json.loads((folder / "summary.json").read_text())
    return Run(summary, ground_points.frames(folder)) if summary["status"] == "ok" else None


def number(cell):
    """Of a cell of a table; NaN for one that is empty or holds a mean with its deviation."""
    try:
        return float(cell)
    except (TypeError, ValueError):
        return math.nan


def crossing(case, height):
    return f"{case}: the rupture {DEPTH - height:g} m below the surface [m]"


class CaseSet:
    """Three cases with the same packings, mesh and length; A and B are those of this set.

    said: {measure: what the data file has of this set}, for places in runs that are not there
    """

    def __init__(self, names, said):
        self.cases = names.keys()
        self.said = said
        self.runs = {case: run for case, name in names.items() if (run := run_of(name)) is not None}
        self.points = {}
        for point, case in (("A", "free"), ("B", "heavy")):
            place = self.crossed(case, LEVEL)
            if not math.isnan(place):
                self.points[point] = place
        self.histories = {}
        for case, run in self.runs.items():
            for point, x in self.points.items():
                cells = ground_points.around(run.frames, np.array([x, LEVEL]))
                self.histories[case, point] = ground_points.history(run.frames, cells)

    def crossed(self, case, height):
        """Where the rupture crosses a level [m]."""
        if case not in self.runs:
            return number(self.said.get(crossing(case, height)))
        frames = self.runs[case].frames
        return ground_points.steepest_place(frames[-1], frames[0], height)

    def diverted(self, case, height):
        """How far a footing moves the crossing [m]; NaN where neither case has been run: rounded places have no rounded difference."""
        if not self.runs.keys() & {case, "free"}:
            return math.nan
        return self.crossed(case, height) - self.crossed("free", height)

    def of(self, case, measure):
        return measure(self.runs[case].summary) if case in self.runs else math.nan

    def at(self, case, point, measure):
        """measure: of {quantity: mean over the packings around the point, by frame}"""
        if (case, point) not in self.histories:
            return math.nan
        return float(measure({name: values.mean(axis=1) for name, values in self.histories[case, point].items()}))


def at_strain(name, strain):
    def value(series):
        grown = np.maximum.accumulate(series["eps_q"])
        return np.interp(strain, grown, series[name]) if grown[-1] >= strain else math.nan
    return value


def last(name):
    return lambda series: series[name][-1]


def peak(name):
    return lambda series: series[name].max()


def upper_band(summary):
    return summary["bands"][-1]["band_x50"]


def degrees(name):
    return lambda summary: math.degrees(summary[name])


def rows():
    """(what, the reference study's number, digits, of a set)"""
    for case in ("free", "heavy", "light"):
        for share in ("05", "50", "95"):
            said = {"free": {"05": "-12.5: \"starts to deflect\""}}.get(case, {}).get(share, "")
            yield f"{case}: surface x{share} [m]", said, 1, lambda one, case=case, share=share: one.of(case, lambda summary: summary[f"surface_x{share}"])
    for case, said in (("free", ""), ("heavy", "at the footing's left edge, -15.5"), ("light", "at the footing's left edge, -15.5")):
        for below in (4.0, 1.0):
            yield crossing(case, DEPTH - below), said, 1, lambda one, case=case, below=below: one.crossed(case, DEPTH - below)
    for case in ("heavy", "light"):
        for below in (4.0, 1.0):
            yield (f"{case}: its diversion there, {below:g} m below [m]", "", 1,
                   lambda one, case=case, below=below: one.diverted(case, DEPTH - below))
        yield (f"{case}: diversion of x50 at 3/4 of the depth [m]", "", 1,
               lambda one, case=case: one.of(case, upper_band) - one.of("free", upper_band))
        yield f"{case}: tilt [degrees]", "", 2, lambda one, case=case: one.of(case, degrees("tilt"))
        yield f"{case}: settlement [m]", "", 2, lambda one, case=case: one.of(case, lambda summary: summary["settlement"])
    yield "K0 before faulting", "about 0.4", 3, lambda one: one.of("free", lambda summary: summary["k0"])
    yield "least void ratio over the depth", "0.160", 3, lambda one: one.of("free", lambda summary: summary["void_ratio_min"])
    yield "largest", "0.179", 3, lambda one: one.of("free", lambda summary: summary["void_ratio_max"])
    yield "x of A [m]", "\"in the band\" of the free field", 1, lambda one: one.points.get("A", math.nan)
    yield "x of B [m]", "in the band below footings", 1, lambda one: one.points.get("B", math.nan)
    yield "A, free: F_c at the start", "0.05", 2, lambda one: one.at("free", "A", lambda series: series["contact_fabric"][0])
    yield "A, free: F_p at the start", "0.03", 2, lambda one: one.at("free", "A", lambda series: series["particle_fabric"][0])
    for strain, said in ((0.04, "0.6"), (0.14, "0.6, then rising")):
        yield f"A, free: F_c at eps_q {100 * strain:.0f} %", said, 2, lambda one, strain=strain: one.at("free", "A", at_strain("contact_fabric", strain))
    yield "A, free: F_p at the end", "0.32", 2, lambda one: one.at("free", "A", last("particle_fabric"))
    yield "A, free: largest (s1 - s3)/2 [kPa]", "", 0, lambda one: 1e-3 * one.at("free", "A", peak("q"))
    yield "A, free: q at the end over the largest", "about 0 near eps_q 20 %", 2, lambda one: one.at("free", "A", lambda series: series["q"][-1] / series["q"].max())
    yield "A, free: eps_q at the end [%]", "beyond 20", 0, lambda one: 100 * one.at("free", "A", last("eps_q"))
    yield "A, free: eps_v at the end [%]", "beyond -6", 1, lambda one: 100 * one.at("free", "A", last("eps_v"))
    yield "B, free: eps_q at the end [%]", "below 9", 0, lambda one: 100 * one.at("free", "B", last("eps_q"))
    for case, strength in (("light", "30"), ("heavy", "42")):
        yield f"A, {case}: largest (s1 - s3)/2 [kPa]", strength, 0, lambda one, case=case: 1e-3 * one.at(case, "A", peak("q"))
        yield f"A, {case}: q at the end over the largest", "unloads", 2, lambda one, case=case: one.at(case, "A", lambda series: series["q"][-1] / series["q"].max())
        yield f"A, {case}: eps_q at the end [%]", "small", 0, lambda one, case=case: 100 * one.at(case, "A", last("eps_q"))
        yield f"A, {case}: eps_v at the end [%]", "within 0.12", 1, lambda one, case=case: 100 * one.at(case, "A", last("eps_v"))
    for case, volume, strain in (("light", "beyond -6", ""), ("heavy", "beyond -10", "beyond 25")):
        yield f"B, {case}: eps_q at the end [%]", strain, 0, lambda one, case=case: 100 * one.at(case, "B", last("eps_q"))
        yield f"B, {case}: eps_v at the end [%]", volume, 1, lambda one, case=case: 100 * one.at(case, "B", last("eps_v"))
        yield (f"B, {case}: q at the end over the largest", "about 0" if case == "heavy" else "", 2,
               lambda one, case=case: one.at(case, "B", lambda series: series["q"][-1] / series["q"].max()))


def kept(lines, before):
    """Lines of a table by their first cells; a cell that is None stays as the data file has it."""
    said = {row["measure"]: row for row in before}
    return [{column: said.get(line["measure"], {}).get(column) if value is None else value for column, value in line.items()} for line in lines]


def column(one, measure, digits):
    """A measure of a set; None where it needs a case that was not run."""
    value = measure(one)
    if math.isnan(value):
        return "-" if one.cases == one.runs.keys() else None
    return f"{value:.{digits}f}"


def numbers(sets):
    """Lines of the comparison with the reference study."""
    return [{"measure": what, "study": said, **{name: column(one, measure, digits) for name, one in sets.items()}} for what, said, digits, measure in rows()]


def base_rows(case):
    """(what, digits, of a set) of a footing"""
    yield "tilt [degrees]", 2, lambda one: one.of(case, degrees("tilt"))
    yield "settlement [m]", 2, lambda one: one.of(case, lambda summary: summary["settlement"])
    yield "least pressure on the base [kPa]", 0, lambda one: one.of(case, lambda summary: 1e-3 * summary["contact_pressure_min"])
    yield "largest pressure [kPa]", 0, lambda one: one.of(case, lambda summary: 1e-3 * summary["contact_pressure_max"])
    yield "the rupture 1 m below the surface [m]", 1, lambda one: one.crossed(case, 24.0)
    yield "surface x50 [m]", 1, lambda one: one.of(case, lambda summary: summary["surface_x50"])


def bases(tied, frictional):
    """Lines of both kinds of bases."""
    columns = {f"{name}{base}": one for name in tied for base, one in (("", tied[name]), (", frictional", frictional[name]))}
    return [{"measure": f"base, {case}: {what}", **{name: column(one, measure, digits) for name, one in columns.items()}}
            for case in ("heavy", "light") for what, digits, measure in base_rows(case)]


def main():
    before = read_table(data_folder() / "study_cases.csv")
    sets = {name: CaseSet(names, {row["measure"]: row.get(name) for row in before}) for name, names in SETS.items()}
    frictional = {name: CaseSet(names, {}) for name, names in FRICTIONAL.items()}
    if not any(one.runs for one in [*sets.values(), *frictional.values()]):
        sys.exit("no run of the study is in output/ (the data files stay as they are): run one first, ./benchmarks/study/run free_2")
    said = origin("./benchmarks/study/run cases", ("g++",), "what belongs to runs that were not there is of earlier commits")
    write_table("study_cases", kept([*numbers(sets), *bases(sets, frictional)], before), said)
    runs = [{"run": title.format(case=case, name=name), **measures(run.summary)}
            for title, group in (("{case}, {name}", sets), ("{case}, frictional, {name}", frictional))
            for name, one in group.items() for case, run in one.runs.items()]
    if runs:
        write_table("study_runs", runs, said, key=("run",))
    case_figures.write(FIGURES, sets, LEVEL)


if __name__ == "__main__":
    main()
