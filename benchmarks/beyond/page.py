# SPDX-License-Identifier: BSL-1.0
"""The page of the runs, docs/beyond.md, and its figures."""
import math
import statistics

import calibrated
import grains
from generated_sections import number, rewrite, table, with_section
from measures import below_base, ended, summaries


def place_of(name):
    """Pressure [kPa] and centre [m] of a run's name."""
    pressure, centre = name.split("_")[:2]
    return float(pressure.removesuffix("kPa")), float(centre.removesuffix("m"))


def of_map(found):
    free = below_base(found["free"])
    rows = []
    for name, summary in sorted(((place_of(name), summary) for name, summary in found.items() if name != "free"), key=lambda row: row[0]):
        good = summary["status"] == "ok"
        rows.append([f"{name[0]:g}", f"{name[1]:g}", number(below_base(summary) - free if good else math.nan), number(summary["surface_x50"] if good else math.nan),
                     number(math.degrees(summary["tilt"]), 2), number(summary["settlement"], 2),
                     f"{1e-3 * summary['contact_pressure_min']:.0f}-{1e-3 * summary['contact_pressure_max']:.0f}", ended(summary)])
    return table(["pressure [kPa]", "centre [m]", "diversion at 3/4 of the depth [m]", "surface_x50 [m]", "tilt [degrees]", "settlement [m]",
                  "contact pressure [kPa]", "ends"], rows)


def map_figure(path, found):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    free = found["free"]
    at = {place_of(name): summary for name, summary in found.items() if name != "free" and summary["status"] == "ok"}
    pressures = sorted({place[0] for place in at})
    centres = sorted({place[1] for place in at})

    def grid(value):
        return np.array([[value(at[pressure, centre]) if (pressure, centre) in at else np.nan for centre in centres] for pressure in pressures])

    drawn, axes = plt.subplots(1, 2, figsize=(11.0, 4.0), sharey=True, layout="constrained")
    for axis, values, title, colours in (
            (axes[0], grid(lambda summary: below_base(summary) - below_base(free)), "diversion at 3/4 of the depth [m]\n(negative: towards the foot wall)", "RdBu"),
            (axes[1], grid(lambda summary: math.degrees(summary["tilt"])), "tilt [degrees]\n(positive: towards the hanging wall)", "PuOr_r")):
        most = np.nanmax(np.abs(values))
        shown = axis.pcolormesh(centres, pressures, values, cmap=colours, vmin=-most, vmax=most, shading="nearest")
        for row, pressure in enumerate(pressures):
            for column, centre in enumerate(centres):
                if not np.isnan(values[row, column]):
                    axis.text(centre, pressure, number(values[row, column]), ha="center", va="center", fontsize=7,
                              color="white" if abs(values[row, column]) > 0.65 * most else "black")
        axis.axvline(free["surface_x50"], color="k", lw=1.0, ls="--", label="x50 of the free field")
        axis.set(title=title, xlabel="centre of a footing 10 m wide, x [m]")
        drawn.colorbar(shown, ax=axis)
    axes[0].set(ylabel="bearing pressure [kPa]")
    axes[0].legend(loc="upper left", bbox_to_anchor=(0.0, -0.13), frameon=False, fontsize=8)
    drawn.savefig(path, dpi=110)


def of_friction(found):
    rows = []
    for name, summary in sorted(found.items(), key=lambda row: (row[0].split("_")[0], row[0].endswith("sticking"), row[0])):
        case, base = name.split("_")
        rows.append([case, base, number(math.degrees(summary["tilt"]), 2), number(summary["sideways"], 2), number(summary["settlement"], 2),
                     number(100.0 * summary["pressed_share"], 0), f"{1e-3 * summary['contact_pressure_min']:.0f}-{1e-3 * summary['contact_pressure_max']:.0f}",
                     number(below_base(summary)), number(summary["surface_x50"]), f"{summary['steps']}, {summary['refused_steps']}", f"{summary['support_error']:.1e}",
                     ended(summary)])
    return table(["footing", "base friction", "tilt [degrees]", "sideways [m]", "settlement [m]", "pressed part [%]", "contact pressure [kPa]",
                  "x50 at 3/4 of the depth [m]", "surface_x50 [m]", "steps, refused", "imbalance over weight", "ends"], rows)


def of_dips(found):
    rows = []
    for name, summary in sorted(found.items(), key=lambda row: (row[0].split("_")[0], int(row[0].split("_")[1]))):
        way, dip = name.split("_")
        rows.append([way, dip, *(number(summary[key]) for key in ("surface_x05", "surface_x50", "surface_x95", "outcrop_width", "block_x50")),
                     number(math.degrees(summary["mid_line_dip"])), str(summary["refused_steps"]), ended(summary)])
    return table(["fault", "dip", "x05 [m]", "x50 [m]", "x95 [m]", "width [m]", "the fault's own line [m]", "mid-line's dip", "refused", "ends"], rows)


def dips_figure(path, found):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    drawn, axis = plt.subplots(figsize=(6.2, 4.2), layout="constrained")
    for way, colour in (("normal", "tab:blue"), ("reverse", "tab:red")):
        runs = sorted((int(name.split("_")[1]), summary) for name, summary in found.items() if name.startswith(way) and summary["status"] == "ok")
        dips = [dip for dip, _ in runs]
        axis.plot([summary["surface_x50"] for _, summary in runs], dips, "o-", color=colour, label=f"{way}: x50, and x05 to x95")
        axis.fill_betweenx(dips, [summary["surface_x05"] for _, summary in runs], [summary["surface_x95"] for _, summary in runs], color=colour, alpha=0.15)
    fine = sorted({(dip, summary["block_x50"]) for dip, summary in runs})
    axis.plot([place for _, place in fine], [dip for dip, _ in fine], "k--", lw=1.0, label="the fault's own line")
    axis.set(xlabel="x at the surface [m]; the tip is below 0", ylabel="dip [degrees]", xlim=(-52.0, 23.0))
    axis.legend(fontsize=8)
    axis.grid(alpha=0.3)
    drawn.savefig(path, dpi=110)


def of_packings(found, on_mohr_coulomb):
    groups = {}
    for name, summary in found.items():
        groups.setdefault(name.rsplit("_seed", 1)[0], []).append(summary)
    free = statistics.fmean(below_base(summary) for summary in groups["free"])
    rows = []
    for name, group in sorted(groups.items()):
        if name == "free" or any(summary["status"] != "ok" for summary in group):
            continue
        plain = on_mohr_coulomb.get(name)
        pressure, centre = place_of(name)
        rows.append([f"{pressure:g}", f"{centre:g}", ", ".join(number(below_base(summary) - free) for summary in group),
                     number(below_base(plain) - below_base(on_mohr_coulomb["free"])) if plain else "-",
                     ", ".join(number(math.degrees(summary["tilt"]), 2) for summary in group), number(math.degrees(plain["tilt"]), 2) if plain else "-",
                     ", ".join(f"{summary['refused_steps']}" for summary in group), ", ".join(number(summary["cpu_seconds"], 0) for summary in group),
                     number(plain["cpu_seconds"]) if plain else "-"])
    return table(["pressure [kPa]", "centre [m]", "diversion [m]: packings, two seeds", "Mohr-Coulomb", "tilt [degrees]: packings", "Mohr-Coulomb", "refused",
                  "CPU s: packings", "Mohr-Coulomb"], rows)


def write(root, output):
    path = root / "docs" / "beyond.md"
    figures = root / "docs" / "figures"
    page = path.read_text() if path.exists() else "# Beyond the study\n"
    if len(found := summaries(output / "map")) > 1:
        page = with_section(page, "map", of_map(found))
        map_figure(figures / "beyond_map.png", found)
    if found := summaries(output / "friction"):
        page = with_section(page, "friction", of_friction(found))
    if found := summaries(output / "dips"):
        page = with_section(page, "dips", of_dips(found))
        dips_figure(figures / "beyond_dips.png", found)
    if found := summaries(output / "packings"):
        page = with_section(page, "packings", of_packings(found, summaries(output / "map")))
    if grains.is_whole(found := summaries(output / "grains")):
        page = with_section(page, "grains", grains.of_grains(found))
        page = with_section(page, "effects", grains.of_effects(found))
    if calibrated.is_whole(output):
        page = with_section(page, "calibration", calibrated.of_calibration(output))
        page = with_section(page, "single", calibrated.of_single_parameters(output))
        page = with_section(page, "calibrated", calibrated.of_runs(output))
        calibrated.figure(figures / "beyond_calibrated.png", output)
    rewrite(path, page)
