# SPDX-License-Identifier: BSL-1.0
"""The page of the runs, docs/objectivity.md, and its figure."""
import json
import math
import statistics

import pressure
from generated_sections import rewrite, rows_on, table, with_section
from runs import HEAD, by_length, number
from spread import PARTS, measures, ranges, summaries

TITLES = dict(zip(PARTS, HEAD[3:]))


def every_run(found):
    return table(HEAD, [[f"{length:g}", name, *run.cells()] for length, runs in found.items() for name, run in runs.items()])


def apart(rows, parts=PARTS):
    found = ranges(rows)
    return [f"{100.0 * found[part]:.0f} %" if part == "width" else number(found[part], 2) for part in parts]


def of_meshes(found):
    rows = [[f"{length:g}", str(len(runs)), *(number(statistics.fmean(values), 2) if values else "-" for values in
             ([run.said[part] for run in runs.values() if not math.isnan(run.said[part])] for part in ("x05", "x50", "width", "dip"))),
             *apart([run.said for run in runs.values()])] for length, runs in found.items()]
    return table(["length [m]", "runs", "mean x05", "mean x50", "mean width", "mean dip", *(f"{part}: apart" for part in PARTS)], rows)


def scatter_within(groups, part):
    """Standard deviation about the groups' means, with as many degrees of freedom as these leave; NaN without any."""
    groups = [[row[part] for row in rows if not math.isnan(row[part])] for rows in groups]
    groups = [values for values in groups if len(values) > 1]
    freedom = sum(len(values) - 1 for values in groups)
    return math.sqrt(sum(statistics.variance(values) * (len(values) - 1) for values in groups) / freedom) if freedom else math.nan


def of_seeds(found):
    """How far meshes scatter for one seed of the packings, seeds on one mesh."""
    rows = []
    for length, runs in found.items():
        for kind, at in (("meshes, one seed", 1), ("seeds, one mesh", 0)):
            groups = {}
            for name, run in runs.items():
                groups.setdefault(name.rsplit("-seed", 1)[at], []).append(run.said)
            groups = [rows for rows in groups.values() if len(rows) > 1]
            if groups:
                rows.append([f"{length:g}", kind, f"{sum(map(len, groups))} in {len(groups)}",
                             *(number(scatter_within(groups, part), 2) for part in PARTS)])
    return table(["length [m]", "scatter over", "runs in groups", *TITLES.values()], rows)


def of_packings(runs):
    """Mean and standard deviation over seeds."""
    groups = {}
    for name, summary in runs.items():
        groups.setdefault(name.rsplit("-seed", 1)[0], []).append(summary)
    rows = []
    for name, group in groups.items():
        said = [measures(summary) for summary in group]

        def scatter(part):
            values = [row[part] for row in said if not math.isnan(row[part])]
            return "-" if len(values) < 2 else f"{statistics.fmean(values):.1f}, {statistics.stdev(values):.1f}"

        rows.append([name, str(len(group)), *(scatter(part) for part in PARTS), number(statistics.fmean(one["iterations"] for one in group), 0),
                     str(sum(one["refused_steps"] for one in group)), number(statistics.median(one["cpu_seconds"] for one in group), 0),
                     number(max(one["peak_memory_bytes"] for one in group) / 1e6, 0)])
    return table(["packings", "seeds", *(f"{title}: mean, scatter" for title in TITLES.values()), "iterations", "refused", "CPU s", "MB"], rows)


def of_pressure(output, page):
    """The band's pressure over elements; one mesh of each, seed 1. Rows of the page stay where there is no new run."""
    rows = {(length, mesh): cells for length, mesh, *cells in rows_on(page, "pressure")}
    for folder in (output / "dem").glob("*/*-seed1/"):
        if (folder / "fields").is_dir() and (folder / "summary.json").is_file():
            said = pressure.in_band(folder, json.loads((folder / "summary.json").read_text())["k0"])
            rows[folder.parent.name, folder.name.removesuffix("-seed1")] = [f"{said.starved} of {said.deep}",
                                                                            *(number(share, 2) for share in said.shares)]
    levels = [f"at {low:g} to {high:g} m" for low, high in pressure.LEVELS]
    ordered = sorted(rows.items(), key=lambda row: (float(row[0][0]), row[0][1]))
    return table(["length [m]", "mesh", "starved elements", *levels], [[*key, *cells] for key, cells in ordered])


def limit(found):
    """A straight line through all runs with a length: its value at no length, with the standard error, and that of a parabola, which
    tells how much the line's shape is worth."""
    import numpy as np
    rows = []
    for part in PARTS:
        points = [(length, value) for length in found if length > 0.0 for value in (run.said[part] for run in found[length].values())
                  if not math.isnan(value)]
        if len({length for length, _ in points}) < 3:
            continue
        x, y = np.array(points).T
        (slope, at_none), covariance = np.polyfit(x, y, 1, cov=True)
        rest = y - slope * x - at_none
        rows.append([part, number(at_none, 2), number(2.0 * math.sqrt(covariance[1, 1]), 2), number(np.polyfit(x, y, 2)[2], 2), number(slope, 3),
                     number(math.sqrt(np.mean(rest ** 2)), 2)])
    return table(["measure", "at no length", "+- (two standard errors)", "by a parabola", "change per metre", "scatter about the line"], rows) if rows else ""


def figure(path, soils):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    drawn, axes = plt.subplots(1, len(soils), figsize=(5.2 * len(soils), 3.8), sharey=True, squeeze=False, layout="constrained")
    for axis, (soil, found) in zip(axes[0], soils.items()):
        for part, colour in (("x05", "tab:blue"), ("x50", "tab:red"), ("x95", "tab:green")):
            for length, runs in found.items():
                values = [run.said[part] for run in runs.values()]
                axis.plot([length] * len(values), values, "x" if length == 0.0 else "o", color=colour, ms=4, alpha=0.6,
                          label=part if length == max(found) else None)
        axis.set(title={"mohr_coulomb": "Mohr-Coulomb", "dem": "sand, 100 grains"}[soil], xlabel="intrinsic length [m]; crosses: none")
        axis.grid(alpha=0.3)
    axes[0][0].set(ylabel="x where the surface has settled by\n5, 50, 95 % of the throw [m]")
    axes[0][0].legend()
    drawn.savefig(path, dpi=110)


def provenance(output, soil):
    """Of the runs that are in the output folder; others stand on the page from before."""
    folders = [folder for folder in (output / soil).glob("*/") if summaries(folder)]
    if not folders:
        return "All rows are of earlier runs."
    record = next(iter(summaries(folders[0]).values())).get("run", {})
    lengths = ", ".join(sorted((folder.name for folder in folders), key=float, reverse=True))
    return (f"Last runs: lengths {lengths}; commit {record.get('commit', 'unknown')}, {record.get('compiler', '')}, {record.get('processor', '')}; "
            "any others are of earlier runs.")


def write(root, output):
    path = root / "docs" / "objectivity.md"
    page = path.read_text()
    soils = {soil: found for soil in ("mohr_coulomb", "dem") if (found := by_length(output, page, soil))}
    for soil, found in soils.items():
        parts = [f"`./benchmarks/run mesh_objectivity --part {soil}`. {provenance(output, soil)}"]
        parts += [of_meshes(found)] if soil == "mohr_coulomb" else [of_seeds(found)]
        if line := limit(found):
            parts += ["For a vanishing length, a straight line through all runs with one:", line]
        page = with_section(page, soil, "\n\n".join(parts))
        page = with_section(page, f"runs of {soil}", every_run(found))
    if runs := summaries(output / "packings"):
        page = with_section(page, "packings", f"`./benchmarks/run mesh_objectivity --part packings`.\n\n{of_packings(runs)}")
    if "dem" in soils:
        page = with_section(page, "pressure", of_pressure(output, page))
    rewrite(path, page)
    if soils:
        figure(root / "docs" / "figures" / "objectivity.png", soils)
