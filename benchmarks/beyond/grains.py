# SPDX-License-Identifier: BSL-1.0
"""Grains of other aspect and friction below a free field: their runs, and the sections of the page."""
import itertools
import statistics

from generated_sections import table
from measures import dip, ended, number, spread, width

ASPECTS = (1.0, 0.75, 0.5)  # width over length
FRICTIONS = (0.3, 0.55)
STUDY = (0.75, 0.55)
KINDS = tuple(itertools.product(ASPECTS, FRICTIONS))
MEASURES = {"K0": (lambda run: run["k0"], 3), "x05 [m]": (lambda run: run["surface_x05"], 1), "x50 [m]": (lambda run: run["surface_x50"], 1),
            "x95 [m]": (lambda run: run["surface_x95"], 1), "width [m]": (width, 1), "mid-line's dip [degrees]": (dip, 1)}


def name_of(aspect, friction, seed):
    return f"aspect{aspect}_friction{friction}_seed{seed}"


def runs(seeds):
    """(name, options); the study's grains first. Densest and loosest: only the ground at rest, of packings that are prepared without friction
    and with the grains' own."""
    for aspect, friction in sorted(KINDS, key=lambda kind: kind != STUDY):
        kind = [] if (aspect, friction) == STUDY else ["--grain-aspect", aspect, "--grain-friction", friction]
        for seed in seeds:
            yield name_of(aspect, friction, seed), [*kind, "--seed", seed]
        for state, preparation in (("densest", 0.0), ("loosest", friction)):
            yield name_of(aspect, friction, state), [*kind, "--preparation-friction", preparation, "--throw-over-depth", 1e-5]


def of_kind(found, aspect, friction):
    """Runs of all seeds."""
    start = name_of(aspect, friction, "")
    return [summary for name, summary in sorted(found.items()) if name.startswith(start) and name[len(start):].isdigit()]


def relative_density(found, aspect, friction):
    """(e_max - e)/(e_max - e_min) of mean void ratios over the ground's points, for each seed."""
    dense, loose = (found[name_of(aspect, friction, state)]["void_ratio"] for state in ("densest", "loosest"))
    return [(loose - run["void_ratio"]) / (loose - dense) for run in of_kind(found, aspect, friction)]


def of_grains(found):
    rows = []
    for aspect, friction in KINDS:
        group = of_kind(found, aspect, friction)
        rows.append([f"{aspect}", f"{friction}", number(statistics.fmean(run["void_ratio"] for run in group), 3),
                     f"{min(run['void_ratio_min'] for run in group):.3f}-{max(run['void_ratio_max'] for run in group):.3f}",
                     number(statistics.fmean(relative_density(found, aspect, friction)), 2),
                     *(spread(map(measure, group), digits) for measure, digits in MEASURES.values()),
                     ", ".join(f"{run['refused_steps']}" for run in group), ", ".join(number(run["cpu_seconds"], 0) for run in group),
                     ", ".join(sorted({ended(run) for run in group}))])
    return table(["aspect", "friction", "void ratio, mean", "over the ground", "relative density", *MEASURES, "refused", "CPU s", "ends"], rows)


def change(found, measure, first, second):
    """Mean over pairs of kinds of the difference second - first, in words, with its standard error from the scatter of the seeds."""
    values = [[[measure(run) for run in of_kind(found, *kind)] for kind in kinds] for kinds in zip(first, second)]
    shift = statistics.fmean(statistics.fmean(after) - statistics.fmean(before) for before, after in values)
    variance = sum(statistics.variance(seeds) / len(seeds) for pair in values for seeds in pair) / len(values) ** 2
    return shift, variance**0.5


def scatter(found, measure):
    """Standard deviation over seeds, pooled over all kinds of grains."""
    return statistics.fmean(statistics.variance(map(measure, of_kind(found, *kind))) for kind in KINDS) ** 0.5


def of_effects(found):
    changes = {"aspect 0.75 to 1.0": ([(0.75, friction) for friction in FRICTIONS], [(1.0, friction) for friction in FRICTIONS]),
               "aspect 0.75 to 0.5": ([(0.75, friction) for friction in FRICTIONS], [(0.5, friction) for friction in FRICTIONS]),
               "friction 0.55 to 0.3": ([(aspect, 0.55) for aspect in ASPECTS], [(aspect, 0.3) for aspect in ASPECTS])}
    rows = []
    for what, (first, second) in changes.items():
        cells = []
        for measure, digits in MEASURES.values():
            shift, error = change(found, measure, first, second)
            cells.append(f"{'+' if shift > 0 else ''}{number(shift, digits)} +- {number(error, digits)} ({number(abs(shift) / scatter(found, measure))})")
        rows.append([what, *cells])
    rows.append(["standard deviation over seeds", *(number(scatter(found, measure), digits) for measure, digits in MEASURES.values())])
    return table(["change", *MEASURES], rows)


def is_whole(found):
    return all(len(of_kind(found, *kind)) > 1 and all(name_of(*kind, state) in found for state in ("densest", "loosest")) for kind in KINDS)
