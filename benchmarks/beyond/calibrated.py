# SPDX-License-Identifier: BSL-1.0
"""Mohr-Coulomb ground of the study's angles and calibrated, beside packings: the sections of the page and their figure."""
import csv
import math
import statistics

import calibration
import grains
from generated_sections import number, spread, table
from measures import below_base, dip, ended, summaries, width

CASES = ("free", "heavy", "light")
SOILS = {"packings": "packings", "study": "Mohr-Coulomb, the study's angles", "calibrated": "Mohr-Coulomb, calibrated",
         "volume": "the same, dilation by the volume gained"}
COLOURS = {"packings": "black", "study": "tab:blue", "calibrated": "tab:red", "volume": "tab:orange"}


def folders(output, soil, case):
    """Of the runs of all seeds, in their order."""
    if soil != "packings":
        return [output / "calibrated" / f"{soil}_{case}"]
    start = output / "grains" / grains.name_of(grains.STUDY, "seed") if case == "free" else output / "calibrated" / f"packings_{case}_seed"
    return sorted(start.parent.glob(f"{start.name}*"))


def groups_of(output):
    """{(soil, case): summaries of all seeds}"""
    found = {**summaries(output / "calibrated"), **summaries(output / "grains")}
    return {(soil, case): [found[folder.name] for folder in folders(output, soil, case) if folder.name in found] for soil in SOILS for case in CASES}


def is_whole(output):
    return all(groups_of(output).values()) and (output / "calibration" / "biaxial" / "biaxial.csv").exists()


def parameters(summary):
    """Of a run on Mohr-Coulomb ground, by their options."""
    options = summary["run"]["options"]
    peak, dilation = float(options["peak-friction"]), float(options["peak-dilation"])
    return {"peak-friction": peak, "peak-dilation": dilation, "residual-friction": float(options["residual-friction"] or peak - 0.8 * dilation),
            **{name: float(options[name]) for name in ("strain-to-residual", "young-modulus", "k0")}}


def of_calibration(output):
    groups = groups_of(output)
    soils = [parameters(groups[soil, "free"][0]) for soil in SOILS if soil != "packings"]
    _, sources = calibration.calibrated(output)
    rows = [[what, *(number(values[name] * scale, digits) for values in soils), spread([value * scale for value in sources.get(name, [])], digits)]
            for what, name, scale, digits in (("peak friction [degrees]", "peak-friction", 1, 1), ("peak dilation [degrees]", "peak-dilation", 1, 1),
                                              ("residual friction [degrees]", "residual-friction", 1, 1),
                                              ("plastic shear strain to residual", "strain-to-residual", 1, 3),
                                              ("Young's modulus [MPa]", "young-modulus", 1e-6, 1), ("K0", "k0", 1, 3))]
    rows.append(["volume gained [%]", *(number(100 * calibration.falling_volume(values["peak-dilation"], values["strain-to-residual"])) for values in soils),
                 spread([100 * value for value in sources["volume"]])])
    rows.append(["void ratio", *["-"] * len(soils), spread(sources["void ratio"], 3)])
    return table(["", "the study's", "calibrated", "dilation by the volume gained", "packings, mean and deviation"], rows)


def of_single_parameters(output):
    """The free field with the study's angles and one calibrated parameter: how far its places move [m]."""
    found = summaries(output / "calibrated")
    measures = {"x05": lambda run: run["surface_x05"], "x50": lambda run: run["surface_x50"], "x95": lambda run: run["surface_x95"], "width": width}
    rows = []
    for name, run in [(name.removeprefix("only_").replace("-", " "), found[name]) for name in sorted(found) if name.startswith("only_")] + [
            ("all of them", found["calibrated_free"])]:
        rows.append([name, *(number(measure(run) - measure(found["study_free"])) for measure in measures.values()), ended(run)])
    return table(["calibrated alone", *(f"change of {name} [m]" for name in measures), "ends"], rows)


def of_runs(output):
    groups = groups_of(output)
    rows = []
    for case in CASES:
        cost = statistics.fmean(run["cpu_seconds"] for run in groups["packings", case])
        for soil, title in SOILS.items():
            runs, free = groups[soil, case], groups[soil, "free"]
            footing = case != "free"
            of_footing = [spread([math.degrees(run["tilt"]) for run in runs], 2), spread([run["settlement"] for run in runs], 2),
                          spread([below_base(run) - below_base(bare) for run, bare in zip(runs, free)])] if footing else ["-"] * 3
            own_cost = statistics.fmean(run["cpu_seconds"] for run in runs)
            rows.append([case, title, *(spread([run[key] for run in runs]) for key in ("surface_x05", "surface_x50", "surface_x95")),
                         spread(map(width, runs)), spread(map(dip, runs)), *of_footing, ", ".join(str(run["refused_steps"]) for run in runs),
                         number(own_cost, 0 if own_cost > 20 else 1), number(cost / own_cost, 0 if cost > 3 * own_cost else 1),
                         ", ".join(sorted({ended(run) for run in runs}))])
    return table(["case", "soil", "x05 [m]", "x50 [m]", "x95 [m]", "width [m]", "mid-line's dip", "tilt [degrees]", "settlement [m]",
                  "diversion at 3/4 of the depth [m]", "refused", "CPU s", "packings' CPU over its own", "ends"], rows)


def last_profile(folder):
    """x [m] and settlement [m] of the surface at the end."""
    with open(folder / "surface.csv", newline="") as file:
        rows = list(csv.DictReader(file))
    return [tuple(float(row[name]) for name in ("x_initial", "settlement")) for row in rows if row["throw_over_depth"] == rows[-1]["throw_over_depth"]]


def figure(path, output):
    import matplotlib
    matplotlib.use("Agg")
    import matplotlib.pyplot as plt
    import numpy as np
    groups = groups_of(output)
    drawn, (strength, surface) = plt.subplots(1, 2, figsize=(10.0, 3.8), layout="constrained")
    ours = parameters(groups["calibrated", "free"][0])
    all_rows = calibration.tests(output)
    angles = np.array([[calibration.mobilised([row]) for row in rows] for rows in all_rows])
    strains = np.mean([[calibration.plastic_shear(row, ours["young-modulus"]) for row in rows] for rows in all_rows], axis=0)
    strength.plot(strains, angles.mean(axis=0), color=COLOURS["packings"], lw=1.2, label="drained biaxial tests, mean and deviation")
    strength.fill_between(strains, angles.mean(axis=0) - angles.std(axis=0, ddof=1), angles.mean(axis=0) + angles.std(axis=0, ddof=1),
                          color=COLOURS["packings"], alpha=0.15)
    for soil in ("study", "calibrated"):
        values = parameters(groups[soil, "free"][0])
        strength.plot([0.0, values["strain-to-residual"], max(strains.max(), values["strain-to-residual"])],
                      [values["peak-friction"], values["residual-friction"], values["residual-friction"]], color=COLOURS[soil], label=SOILS[soil])
    strength.set(xlabel="plastic shear strain", ylabel="mobilised friction angle [degrees]", ylim=(10.0, None))
    strength.legend(fontsize=8, loc="lower right")
    for soil, title in SOILS.items():
        for k, folder in enumerate(folders(output, soil, "free")):
            places, settlements = zip(*last_profile(folder))
            surface.plot(places, settlements, color=COLOURS[soil], lw=1.0 if soil == "packings" else 1.6, alpha=0.7 if soil == "packings" else 1.0,
                         label=title + (", three seeds" if soil == "packings" else "") if k == 0 else None)
    surface.set(xlabel="x [m]; the tip is below 0", ylabel="settlement of the surface [m]", title="free field, h/H = 0.085", ylim=(3.3, -0.1))
    surface.legend(fontsize=8, loc="lower left")
    for axis in (strength, surface):
        axis.grid(alpha=0.3)
    drawn.savefig(path, dpi=90)
    plt.close(drawn)
