# SPDX-License-Identifier: BSL-1.0
"""Grains of other aspect and friction below a free field: their runs, and the sections of the page."""
import itertools
import statistics

from generated_sections import number, spread, table
from measures import dip, ended, width

ASPECTS = (1.0, 0.75, 0.5)  # width over length
FRICTIONS = (0.3, 0.55)
STUDY = (0.75, 0.55)
KINDS = tuple(itertools.product(ASPECTS, FRICTIONS))
MEASURES = {"K0": (lambda run: run["k0"], 3), "x05 [m]": (lambda run: run["surface_x05"], 1), "x50 [m]": (lambda run: run["surface_x50"], 1),
            "x95 [m]": (lambda run: run["surface_x95"], 1), "width [m]": (width, 1), "mid-line's dip [degrees]": (dip, 1)}


def name_of(kind, run):
    """run: seed1 and so on, densest or loosest"""
    return f"aspect{kind[0]}_friction{kind[1]}_{run}"


def runs(seeds):
    """(name, options). Densest and loosest: only the ground at rest, of packings that are prepared almost without friction (without any, some
    do not come to rest at 2 kPa) and with the grains' own."""
    kinds = {(aspect, friction): ["--grain-aspect", aspect, "--grain-friction", friction] for aspect, friction in KINDS}
    for kind, options in kinds.items():
        for state, preparation in (("densest", 0.03), ("loosest", kind[1])):
            yield name_of(kind, state), [*options, "--preparation-friction", preparation, "--throw-over-depth", 1e-5]
    for seed in seeds:
        for kind, options in kinds.items():
            yield name_of(kind, f"seed{seed}"), [*options, "--seed", seed]


def of_kind(found, kind):
    """Runs of all seeds."""
    return [summary for name, summary in sorted(found.items()) if name.startswith(name_of(kind, "seed"))]


def relative_density(found, kind):
    """(e_max - e)/(e_max - e_min) of mean void ratios over the ground's points, for each seed."""
    dense, loose = (found[name_of(kind, state)]["void_ratio"] for state in ("densest", "loosest"))
    return [(loose - run["void_ratio"]) / (loose - dense) for run in of_kind(found, kind)]


def of_grains(found):
    rows = []
    for kind in KINDS:
        group = of_kind(found, kind)
        rows.append([f"{kind[0]}", f"{kind[1]}", number(statistics.fmean(run["void_ratio"] for run in group), 3),
                     f"{min(run['void_ratio_min'] for run in group):.3f}-{max(run['void_ratio_max'] for run in group):.3f}",
                     number(statistics.fmean(relative_density(found, kind)), 2),
                     *(spread(map(measure, group), digits) for measure, digits in MEASURES.values()),
                     ", ".join(f"{run['refused_steps']}" for run in group), ", ".join(number(run["cpu_seconds"], 0) for run in group),
                     ", ".join(sorted({ended(run) for run in group}))])
    return table(["aspect", "friction", "void ratio, mean", "over the ground", "relative density", *MEASURES, "refused", "CPU s", "ends"], rows)


def change(found, measure, first, second):
    """Mean over pairs of kinds of the difference second - first, in words, with its standard error from the scatter of the seeds."""
    values = [[[measure(run) for run in of_kind(found, kind)] for kind in kinds] for kinds in zip(first, second)]
    shift = statistics.fmean(statistics.fmean(after) - statistics.fmean(before) for before, after in values)
    variance = sum(statistics.variance(seeds) / len(seeds) for pair in values for seeds in pair) / len(values) ** 2
    return shift, variance**0.5


def scatter(found, measure):
    """Standard deviation over seeds, pooled over all kinds of grains."""
    return statistics.fmean(statistics.variance(map(measure, of_kind(found, kind))) for kind in KINDS) ** 0.5


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
    return all(len(of_kind(found, kind)) > 1 and all(name_of(kind, state) in found for state in ("densest", "loosest")) for kind in KINDS)
