# SPDX-License-Identifier: BSL-1.0
"""The page of the runs, docs/objectivity.md, and its figure."""
import math
import statistics
import subprocess

import pressure
from generated_sections import rewrite, with_section
from spread import PARTS, measures, ranges, summaries

TITLES = {"x05": "x05 [m]", "x50": "x50 [m]", "x95": "x95 [m]", "width": "width [m]", "dip": "mid-line dip"}


def table(columns, rows):
    return "\n".join("| " + " | ".join(line) + " |" for line in [columns, ["---"] * len(columns), *rows])


def number(value, digits=1):
    return "-" if math.isnan(value) else f"{value:.{digits}f}"


def by_length(output, soil):
    folders = sorted((output / soil).glob("*"), key=lambda folder: -float(folder.name))
    return {float(folder.name): summaries(folder) for folder in folders if folder.is_dir()}


def every_run(found):
    rows = []
    for length, runs in found.items():
        for name, summary in runs.items():
            said = measures(summary)
            rows.append([f"{length:g}", name, str(summary["elements"]), *(number(said[part]) for part in PARTS), str(summary["iterations"]),
                         str(summary["refused_steps"]), number(summary["cpu_seconds"], 0),
                         summary["status"] if summary["status"] == "ok" else f"{summary['status']} at h/H {summary['throw_over_depth']:.4f}"])
    return table(["length [m]", "mesh", "elements", *TITLES.values(), "iterations", "refused", "CPU s", "ends"], rows)


def apart(rows, parts=PARTS):
    found = ranges(rows)
    return [f"{100.0 * found[part]:.0f} %" if part == "width" else number(found[part], 2) for part in parts]


def of_meshes(found):
    rows = [[f"{length:g}", str(len(runs)), *(number(statistics.fmean(values), 2) if values else "-" for values in
             ([said[part] for said in map(measures, runs.values()) if not math.isnan(said[part])] for part in ("x05", "x50", "width", "dip"))),
             *apart([measures(summary) for summary in runs.values()])] for length, runs in found.items()]
    return table(["length [m]", "runs", "mean x05", "mean x50", "mean width", "mean dip", *(f"{part}: apart" for part in PARTS)], rows)


def of_seeds(found):
    """How far meshes are apart for one packing, packings on one mesh."""
    rows = []
    for length, runs in found.items():
        said = {tuple(name.rsplit("-seed", 1)): measures(summary) for name, summary in runs.items()}
        for kind, at in (("meshes, one packing", 1), ("packings, one mesh", 0)):
            groups = {}
            for key, row in said.items():
                groups.setdefault(key[at], []).append(row)
            each = [ranges(rows) for rows in groups.values() if len(rows) > 1]
            if each:
                rows.append([f"{length:g}", kind, str(len(each)),
                             *(f"{100.0 * statistics.fmean(one[part] for one in each):.0f} %" if part == "width"
                               else number(statistics.fmean(one[part] for one in each), 2) for part in PARTS)])
    return table(["length [m]", "apart over", "groups", *PARTS], rows)


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


def of_pressure(output, found):
    """The band's pressure over elements; one mesh of each, seed 1."""
    rows = []
    for length in (0.0, max(found)):
        for name, summary in found.get(length, {}).items():
            folder = output / "dem" / f"{length:g}" / name
            if name.endswith("-seed1") and (folder / "fields").is_dir():
                said = pressure.in_band(folder, summary["k0"])
                rows.append([f"{length:g}", name.removesuffix("-seed1"), f"{said.starved} of {said.deep}", *(number(share, 2) for share in said.shares)])
    levels = [f"at {low:g} to {high:g} m" for low, high in pressure.LEVELS]
    return table(["length [m]", "mesh", "starved elements", *levels], rows)


def limit(found):
    """A straight line through all runs with a length: its value at no length, with the standard error, and that of a parabola, which
    tells how much the line's shape is worth."""
    import numpy as np
    rows = []
    for part in PARTS:
        points = [(length, value) for length in found if length > 0.0 for value in (measures(summary)[part] for summary in found[length].values())
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
                values = [measures(summary)[part] for summary in runs.values()]
                axis.plot([length] * len(values), values, "x" if length == 0.0 else "o", color=colour, ms=4, alpha=0.6,
                          label=part if length == max(found) else None)
        axis.set(title={"mohr_coulomb": "Mohr-Coulomb", "dem": "sand, 100 grains"}[soil], xlabel="intrinsic length [m]; crosses: none")
        axis.grid(alpha=0.3)
    axes[0][0].set(ylabel="x where the surface has settled by\n5, 50, 95 % of the throw [m]")
    axes[0][0].legend()
    drawn.savefig(path, dpi=110)


def write(root, output):
    soils = {soil: found for soil in ("mohr_coulomb", "dem") if (found := by_length(output, soil))}
    path = root / "docs" / "objectivity.md"
    page = path.read_text()
    commit = subprocess.run(["git", "describe", "--always", "--dirty"], cwd=root, capture_output=True, text=True).stdout.strip()
    for soil, found in soils.items():
        first = next(iter(next(iter(found.values())).values()))
        record = first.get("run", {})
        said = f"Commit {record.get('commit', commit)}, {record.get('compiler', '')}, {record.get('processor', '')}."
        parts = [f"`./benchmarks/run mesh_objectivity --part {soil}`. {said}"]
        parts += [of_meshes(found)] if soil == "mohr_coulomb" else [of_seeds(found)]
        if line := limit(found):
            parts += ["For a vanishing length, a straight line through all runs with one:", line]
        page = with_section(page, soil, "\n\n".join(parts))
        page = with_section(page, f"runs of {soil}", every_run(found))
    if runs := summaries(output / "packings"):
        page = with_section(page, "packings", f"`./benchmarks/run mesh_objectivity --part packings`.\n\n{of_packings(runs)}")
    if "dem" in soils:
        page = with_section(page, "pressure", of_pressure(output, soils["dem"]))
    rewrite(path, page)
    if soils:
        figure(root / "docs" / "figures" / "objectivity.png", soils)
