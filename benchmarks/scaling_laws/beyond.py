# SPDX-License-Identifier: BSL-1.0
"""More ranks than there are here, on paper: what each rank repeats against what the points take, and what travels."""
import math

import fit
from generated_sections import table, with_section
from page import digits, outside, predicted, read_lines

RANKS = [2, 4, 8, 16, 32, 64, 128, 256, 512, 1000]
# Assumed of the network: ten gigabits a second, small messages in 30 us; an exchange with all takes log2 of the ranks of these.
BANDWIDTH, LATENCY = 1e9, 30e-6
# [B] of a point, as RankExecutor::share sends them: Response<2> (stress 24, verdict 8) and its inner steps (8) for every answer, and
# for every answer again; tangent (72) and two times the stress (24) once in a load step. Exchanges: two for every answer, three for a step.
ANSWER, STEP = 40.0, 72.0 + 2 * 24.0
AGAIN = 1.0  # rounds of an iteration in which points are asked again, assumed: logs do not have them
STUDY = {"without a length": ("local", ["--local", "--triangles", "7563", "--tolerance", "1e-2", "--least-dem-steps", "5"]),
         "with 8 m": ("length", ["--triangles", "7563", "--strain-per-step", "2e-5", "--unbalanced", "0.1"])}


class Scene:
    """Seconds of an iteration, the mean of a whole run of the study's size."""

    def __init__(self, model, measured, build, name, options):
        guess = predicted(build, {"options": options, "kernel": model.kernel})
        constants = model.constants
        self.triangles, grains = 7616, 400
        self.iterations, self.steps = guess["iterations"], guess["steps"]
        dem_step = constants["dem_step"] * grains ** constants["dem_step_by_grains"]
        self.dem_steps = guess["dem_steps"] / guess["iterations"]
        self.points = dem_step * (self.dem_steps + self.steps / self.iterations * self.triangles * constants["tangent"])
        plain = measured[f"plain-{name}-7616"]
        self.rest = outside(model, measured[f"{name}-7616"])
        self.around = model.scaled(plain, plain["in_points"]) / plain["iterations"]
        self.bytes = self.triangles * (ANSWER * (1.0 + AGAIN) + STEP * self.steps / self.iterations)
        self.exchanges = 2.0 * (1.0 + AGAIN) + 3.0 * self.steps / self.iterations

    @property
    def repeated(self):
        return self.rest + self.around

    def travel(self, ranks):
        return self.bytes / BANDWIDTH + self.exchanges * math.ceil(math.log2(ranks)) * LATENCY

    def efficiency(self, ranks, repeated=None, shared=0.0):
        repeated = self.repeated if repeated is None else repeated
        whole = self.points + self.repeated
        return whole / ranks / ((self.points + shared) / ranks + repeated + self.travel(ranks))


def spread(measured):
    """DEM steps of all answers over those of the longest one, of whole runs: ranks beyond that wait for one answer."""
    rows = []
    for name, run in measured.items():
        if run["dem_steps"] and run["throw_over_depth"] > 0.08 and run["longest"]:
            rows.append([name, str(run["elements"]), digits(run["dem_steps"] / run["longest"]),
                         f"{run['longest'] * run['elements'] / run['dem_steps']:.0f}"])
    return rows


def sections(page, head, model, measured, output, build):
    if not all(f"{kind}{name}-7616" in measured for name in ("local", "length") for kind in ("", "plain-")):
        return page
    scenes = {title: Scene(model, measured, build, *scene) for title, scene in STUDY.items()}
    rows = [[title, str(scene.iterations), f"{scene.dem_steps:.3g}", f"{1e3 * scene.points:.0f}", f"{1e3 * scene.rest:.0f}",
             f"{1e3 * scene.around:.1f}", f"{scene.bytes / 1e3:.0f}", f"{1e3 * scene.travel(64):.1f}",
             f"**{scene.points / scene.repeated:.0f}**"] for title, scene in scenes.items()]
    page = with_section(page, "parts", f"{head} 7616 triangles, 400 grains.\n\n" + table(
        ["scene", "iterations", "DEM steps in one", "points [ms]", "assembly, factors, GMRES, learning [ms]",
         "means, gradients, forces [ms]", "sent [kB]", "travel, 64 ranks [ms]", "ranks at which points are as the repeated part"], rows))
    columns = ["ranks", *(f"{title}" for title in scenes), *(f"{title}, repeated part shared but for MUMPS's factors" for title in scenes)]
    systems = read_lines(output / "systems.jsonl")
    alone = next((row for row in systems if row["ranks"] == 1 and row["elements"] == 7616), None)
    shares = {row["ranks"]: row["busiest"] for row in systems if row["elements"] == 7616}
    rows = []
    for ranks in RANKS:
        row = [str(ranks), *(f"{100.0 * scene.efficiency(ranks):.0f} %" for scene in scenes.values())]
        if alone:
            # Beyond the most ranks that were tried MUMPS's factors are not divided further.
            share = min(share for count, share in shares.items() if count <= ranks)
            factors = (alone["MUMPS factors cpu"] + alone["MUMPS solution cpu"]) * share
            row += [f"{100.0 * scene.efficiency(ranks, factors, max(0.0, scene.repeated - factors)):.0f} %" for scene in scenes.values()]
        rows.append(row)
    page = with_section(page, "efficiency", f"{head}\n\n" + table(columns if alone else columns[:3], rows))
    if waits := spread(measured):
        page = with_section(page, "longest answers", f"{head}\n\n" + table(
            ["run", "triangles", "all DEM steps over those of the longest answers", "longest answer over the mean one"], waits))
    if systems:
        parts = ["assembly", "factors", "solution", "MUMPS factors", "MUMPS solution"]

        def times(row):
            return [f"{1e3 * row[part + ' cpu']:.1f}" for part in parts] if row["ranks"] == 1 else ["-"] * len(parts)

        page = with_section(page, "linear systems", f"{head} CPU times [ms], the least of five.\n\n" + table(
            ["triangles", "unknowns", "ranks", *parts, "busiest rank's share of MUMPS's operations"],
            [[str(row["elements"]), str(row["unknowns"]), str(row["ranks"]), *times(row), f"{100.0 * row['busiest']:.0f} %"]
             for row in systems]))
    return page
