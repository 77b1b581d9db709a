# SPDX-License-Identifier: BSL-1.0
"""What the runs of length_convergence come to at the length of a real shear band: columns of a run, fits over the length, intervals, figures.

The mean of the settlement profile is a constant plus the dilated area over the throw h (docs/grounds.md). A part of this area is from before
localisation. That of the band is its volume, proportional to the length L, times its volumetric strain, which grows with its shear strain, proportional
to h / L, to the critical state. With a volumetric strain that fades as an exponential this is the form `band`,
    A / h = a + b u (1 - exp(-1 / u)), u = L / L0:
linear in L for L << L0, where all of the band is critical, and independent of L for L >> L0. L0 is at least 1 m, where the band, some two lengths wide,
has a shear strain near 1, more than any soil here needs to become critical. `power`, a + b L^p with p from 0.5 to 1.5, and `line`, a + b L, through the
shortest lengths alone, assume less. Edges and median of the profile are apart from its mean by widths of the band and have the same forms.

All of it is for small elements: the error of linear triangles is proportional to the square of their size over the length, with a factor that the
pattern decides and that is either the same for all lengths or proportional to them.
"""
import itertools
import math

import numpy as np
import scarp_figures as figures
from common import ROOT, data_folder, measures
from scarp_figures import plt

DEPTH, DIP = 25.0, math.radians(60.0)  # [m], of the scene
LIMITS = {0.3: "centrifuge", 0.1: "ten grains"}  # lengths [m] of real bands
DRAWS, SEED = 500, 1
PLACES = {"x05 [m]": figures.BLUE, "x50 [m]": figures.VERMILION, "x95 [m]": figures.GREEN, "mean [m]": figures.BLACK}
AREA = "dilated area over throw [m]"
QUANTITIES = [*PLACES, AREA, "rupture dip [deg]", "reaction [MN/m]"]
WIDTHS = [f"width at {level} of the height [m]" for level in ("1/4", "1/2", "3/4")]
CRITICAL = ["critical strain [%]", "critical volume [%]"]
SOILS = {"sand": "Sand", "fontainebleau": "Fontainebleau", "mohr_coulomb": "Mohr-Coulomb"}
SHOWN = {"fontainebleau": ("8", "4", "2")}  # lengths of the page's table
FORMS = {"band": lambda x: (u := x / np.geomspace(1.0, 200.0, 93)[:, None]) * (1.0 - np.exp(-1.0 / u)),
         "power": lambda x: x ** np.linspace(0.5, 1.5, 21)[:, None],
         "line": lambda x: x[None, :]}
# Least and largest number of the shortest lengths that a form is fitted to: one more than it has parameters, and where it
# holds for short lengths alone two.
TAKEN = {"band": (4, 100), "power": (4, 5), "line": (3, 4)}
SIZE_POWERS = (0.0, 1.0)  # of the length, in the error by the size of elements
GRADED = 6.0  # [m], below which fault_rupture refines its mesh by itself
DEFAULT_SIZE = 0.41  # of elements over the length on graded meshes: their longest side
SIZES = {"finer": 0.31, "finest": 0.205, "quad8": 0.58}  # of others
UNIFORM_SIZES = {"finer": 1.9}  # [m]


def size_of(mesh, length):
    """Longest side of a triangle in the band, or side of a rectangle [m]."""
    return SIZES.get(mesh, DEFAULT_SIZE) * length if length < GRADED else UNIFORM_SIZES.get(mesh, 2.5)


def critical_state(folder):
    """Deviatoric strain and growth of volume [%] where the volume at probe A has grown by 95 % of its most; none where it has not levelled off well
    before the end of the run."""
    table = figures.read_csv(folder / "probe_A.csv", ["throw_over_depth", "eps_q", "eps_v"])
    since = table["throw_over_depth"] >= 0.0
    strain, growth = (factor * (values[since] - values[since][0]) for factor, values in ((100.0, table["eps_q"]), (-100.0, table["eps_v"])))
    at = int(np.argmax(growth >= 0.95 * growth.max()))
    return (strain[at], growth.max()) if growth.max() > 0.0 and strain[at] < 0.7 * strain[-1] else (None, None)


def columns_of(folder, summary):
    known = {"triangles": summary["elements"], **measures(summary)}
    known["residual"] = summary["tolerance"]
    if summary["status"] == "ok":
        known |= {"mean [m]": summary["surface_mean"], AREA: summary["dilated_area"] / (DEPTH * summary["throw_over_depth"]),
                  "reaction [MN/m]": 1e-6 * summary["reaction"] if "reaction" in summary else None, "strip margin [m]": summary.get("strip_margin"),
                  **dict(zip(WIDTHS, (band["band_width"] for band in summary["bands"]))), **dict(zip(CRITICAL, critical_state(folder)))}
    return {name: known.get(name) for name in ("triangles", "h/H", *QUANTITIES, *WIDTHS, "strip margin [m]", *CRITICAL, "residual", "steps", "refused", "iterations",
                                               "DEM steps [million]", "CPU time [s]", "memory [MB]", "status", "error budget", "commit")}


def fit(form, lengths, values, weights):
    """Least squares of a + b g(L) over the g of a form. \\return the fitted function"""
    share = weights / weights.sum()
    basis = FORMS[form](lengths)
    shift, mean = basis @ share, values @ share
    centred = basis - shift[:, None]
    slope = centred @ (share * (values - mean)) / (centred**2 @ share)
    best = int(np.argmin((values - mean - slope[:, None] * centred) ** 2 @ share))
    return lambda at: mean + slope[best] * (FORMS[form](np.asarray(at, float))[best] - shift[best])


def drawn(lengths, sizes, values, patterns, seeds, at, size):
    """What the quantity may be at other lengths, shape (draws, lengths), on elements of a size of the first pattern.

    sizes: of elements, over the length. values: of a length on small elements, plus an error by their size and pattern, plus a deviation by seed, plus
    the rest. Each draw takes the values at the lengths and the errors by their scatter, a deviation of seeds that all lengths share (Student's t), one
    of the forms, and how many of the lengths it is fitted to.
    """
    random = np.random.default_rng(SEED)
    there = np.unique(lengths)
    of_pattern, of_seed = (np.eye(int(level.max()) + 1)[level] for level in (np.unique(factor, return_inverse=True)[1] for factor in (patterns, seeds)))
    start, count = len(there) + of_pattern.shape[1], of_seed.shape[1]

    def solved(power):
        by_size = (sizes**2 * lengths**power)[:, None] * of_pattern
        design = np.hstack([lengths[:, None] == there, by_size, of_seed[:, :-1] - of_seed[:, -1:]]).astype(float)
        inverse = np.linalg.pinv(design.T @ design)
        found = inverse @ design.T @ values
        free = len(values) - np.linalg.matrix_rank(design)
        variance = np.sum((values - design @ found) ** 2) / free if free else 0.0
        return found, math.sqrt(variance) * np.linalg.cholesky(inverse[:start, :start]), 1.0 / np.diag(inverse)

    solutions = {power: solved(power) for power in SIZE_POWERS}
    result = np.full((DRAWS, len(at)), np.nan)
    for one in result:
        power = random.choice(SIZE_POWERS)
        found, scatter, weights = solutions[power]
        taken = found[:start] + scatter @ random.standard_normal(start)
        by_size = taken[len(there)]
        if count > 1:
            deviations = [*found[start:], -found[start:].sum()]
            taken += np.std(deviations, ddof=1) / math.sqrt(count) * random.standard_t(count - 1)
        form = random.choice(list(FORMS))
        least, most = (min(bound, len(there)) for bound in TAKEN[form])
        n = int(random.integers(least, most + 1))
        one[:] = fit(form, there[:n], taken[:n], weights[:n])(at) + by_size * size**2 * np.asarray(at) ** power
    return result


def usable(rows, soil):
    """Rows of runs that reached the throw."""
    return [row for row in rows if row["soil"] == soil and row["status"] == "ok"]


def triangles(rows):
    return [row for row in rows if row["mesh"] != "quad8"]


def size_over_length(row):
    length = float(row["length [m]"])
    return size_of(row["mesh"], length) / length


def extrapolates(rows):
    """Whether the error by the size of elements is known, and there are lengths enough for every form."""
    meshes = {(row["length [m]"], size_over_length(row)) for row in triangles(rows)}
    lengths = {length for length, _ in meshes}
    return len(meshes) > len(lengths) >= max(least for least, _ in TAKEN.values())


def column(rows, name):
    return np.array([figures.number(row.get(name, "")) for row in rows])


def of_rows(rows, name, at, size=0.0):
    """size: of elements, over the length"""
    rows = [row for row in triangles(rows) if row.get(name)]
    if not rows:
        return np.full((1, len(at)), np.nan)
    patterns = ["diagonal" if row["mesh"] in ("right", "left") else "crossed" for row in rows]
    return drawn(column(rows, "length [m]"), np.array([size_over_length(row) for row in rows]), column(rows, name), patterns,
                 [row.get("seed", "") for row in rows], at, size)


def limits(rows):
    """Median and 95 % interval of each quantity at the lengths of real bands, for small elements."""
    found = []
    for soil in SOILS:
        known = usable(rows, soil)
        for name in QUANTITIES if extrapolates(known) else []:
            for at, values in zip(LIMITS, of_rows(known, name, list(LIMITS)).T):
                low, middle, high = map(float, np.percentile(values, [2.5, 50.0, 97.5]))
                found.append({"soil": soil, "quantity": name, "length [m]": at, "value": middle, "low": low, "high": high, "runs": len(known),
                              "lengths": len({row["length [m]"] for row in known}), "seeds": len({row.get("seed", "") for row in known}),
                              "meshes": len({row["mesh"] for row in known})})
    return found


def of_elements(rows):
    """What the default's elements change, for the main job and the shortest length: median and 95 % interval."""
    found = []
    for soil, name in itertools.product(SOILS, PLACES):
        known = usable(rows, soil)
        if not extrapolates(known):
            continue
        lengths = [1.0, 2.0]
        small, usual = (of_rows(known, name, lengths, size) for size in (0.0, DEFAULT_SIZE))  # the same draws
        for at, errors in zip(lengths, (usual - small).T):
            low, middle, high = map(float, np.percentile(errors, [2.5, 50.0, 97.5]))
            found.append({"soil": soil, "quantity": name, "length [m]": at, "size over length": DEFAULT_SIZE, "error": middle, "low": low, "high": high})
    return found


def held_out(rows):
    """What the fits without the runs of the shortest length give there on the crossed mesh, beside the mean of these runs."""
    found = []
    for soil, name in itertools.product(SOILS, [*PLACES, AREA]):
        known = [row for row in usable(rows, soil) if row.get(name)]
        lengths = column(known, "length [m]")
        others = [row for row, length in zip(known, lengths) if length > lengths.min()]
        runs = [row for row in known if float(row["length [m]"]) == lengths.min() and row["mesh"] == "crossed"]
        if not runs or not extrapolates(others):
            continue
        low, middle, high = map(float, np.percentile(of_rows(others, name, [lengths.min()], size_over_length(runs[0]))[:, 0], [2.5, 50.0, 97.5]))
        found.append({"soil": soil, "quantity": name, "length [m]": lengths.min(), "value": middle, "low": low, "high": high,
                      "of the runs": float(np.mean(column(runs, name))), "runs": len(others)})
    return found


def page(rows):
    """Rows of the table of docs/length.md: means over seeds and meshes, with the deviation of the mean place."""
    shown = [*PLACES, AREA, WIDTHS[1], "rupture dip [deg]", "CPU time [s]"]
    digits = [1, 1, 1, 2, 2, 1, 1, 0]
    for soil, title in SOILS.items():
        known = usable(rows, soil)
        for length in [length for length in SHOWN.get(soil, ("8", "4", "2", "1")) if any(row["length [m]"] == length for row in known)]:
            here = [row for row in known if row["length [m]"] == length]
            cells = [f"{np.nanmean(column(here, name)):.{n}f}" for name, n in zip(shown, digits)]
            if len(here) > 1:
                cells[3] += f" +- {np.std(column(here, 'mean [m]'), ddof=1):.2f}"
            yield f"| {title} | {length} | {len(here)} | " + " | ".join(cells) + " |"
        extrapolated = {(row["quantity"], row["length [m]"]): row for row in limits(known)}
        for at in LIMITS if extrapolates(known) else []:
            cells = [f"{row['value']:.{n}f} ({row['low']:.{n}f} to {row['high']:.{n}f})" if (row := extrapolated.get((name, at))) else "-"
                     for name, n in zip(shown, digits)]
            yield f"| {title} | {at:g}, extrapolated | - | " + " | ".join(cells) + " |"


def ticks(axes, name, places):
    """A logarithmic axis with these."""
    axis = {"x": axes.xaxis, "y": axes.yaxis}[name]
    axes.set(**{f"{name}scale": "log"})
    axis.set_ticks(places, labels=[f"{place:g}" for place in places])
    axis.set_ticks([], minor=True)


def over_length(rows):
    """For each soil a column: places, and widths of the band."""
    soils = [soil for soil in SOILS if usable(rows, soil)]
    of_places, axes = plt.subplots(1, len(soils), figsize=(3.9 * len(soils) + 0.6, 4.2), sharey=True, squeeze=False)
    of_widths, width_axes = plt.subplots(1, len(soils), figsize=(3.2 * len(soils) + 0.6, 3.6), sharey=True, squeeze=False)
    for soil, axis, width_axis in zip(soils, axes[0], width_axes[0]):
        known = usable(rows, soil)
        lengths, throw = column(known, "length [m]"), DEPTH * column(known, "h/H").mean()
        grid = np.geomspace(min(LIMITS), np.unique(lengths)[:4][-1], 40)  # as far as all forms are fitted
        for name, colour in PLACES.items():
            if not extrapolates(known):
                axis.plot(lengths, column(known, name), "o-", color=colour, markersize=3.5, linewidth=0.7)
                continue
            low, middle, high = np.percentile(of_rows(known, name, grid), [2.5, 50.0, 97.5], axis=0)
            axis.plot(lengths, column(known, name), "o", color=colour, markersize=3.5, alpha=0.7)
            axis.plot(grid, middle, color=colour, label=name.removesuffix(" [m]"))
            axis.fill_between(grid, low, high, color=colour, alpha=0.15, linewidth=0)
        axis.axhline(-(DEPTH - throw / 2.0) / math.tan(DIP), color=figures.GREY, linestyle="--", label="mean without dilation: the fault's own line")
        for at, what in LIMITS.items():
            axis.axvline(at, color=figures.PALE, zorder=0)
            axis.annotate(what, (at, 0.02), (2, 0), xycoords=("data", "axes fraction"), textcoords="offset points", fontsize=7, rotation=90)
        ticks(axis, "x", [0.1, 0.3, 1, 2, 4, 8])
        axis.set(title=SOILS[soil], xlabel="nonlocal length [m]")
        for name, colour in zip(WIDTHS, (figures.BLUE, figures.VERMILION, figures.GREEN)):
            width_axis.plot(lengths, column(known, name), "o", color=colour, markersize=3.5, label=name.removesuffix(" [m]"))
        width_axis.plot([0.5, 8.0], [0.5, 8.0], color=figures.GREY, linestyle="--", label="the length itself")
        ticks(width_axis, "x", [0.5, 1, 2, 4, 8])
        ticks(width_axis, "y", [0.5, 1, 2, 5, 10, 20])
        width_axis.set(title=SOILS[soil], xlabel="nonlocal length [m]")
    axes[0][0].set(ylabel="x at the surface [m]; the tip is at 0", ylim=(-27.0, 9.0))
    width_axes[0][0].set(ylabel="width of the band along a level [m]")
    axes[0][-1].legend(loc="upper left", title="points: runs, lines: limit of small elements")
    width_axes[0][-1].legend(loc="upper left")
    return of_places, of_widths


def write_figures(rows):
    folder = ROOT / "docs" / "figures" if data_folder() == ROOT / "docs" / "data" else data_folder()
    for name, figure in zip(("length_places", "length_widths"), over_length(rows)):
        figures.save(figure, folder / f"{name}.png")
        print(folder / f"{name}.png")
