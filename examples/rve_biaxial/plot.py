# SPDX-License-Identifier: BSL-1.0
"""plot.py OUTPUT_DIR: the packing and the drained biaxial test, in the manner of the reference study's fig. 1; with several
packings strength, dilation and fabric over their void ratio."""

import itertools
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import numpy as np
import packing_figures
import scarp_figures as figures
import void_ratio_figures
from scarp_figures import plt

STUDY_FRICTION_ANGLE = 30.8  # [deg], read off the reference study's fig. 1b by its authors, sec. 3.1
STUDY_PRESSURE = 2e5  # [Pa]


def packing(folder):
    return packing_figures.draw_packing(folder, "Packing after isotropic consolidation")


def is_at_study_pressure(summary):
    """Whether the reference study's numbers are of the test's stress level."""
    choice = summary.get("choice")
    return isinstance(choice, dict) and choice.get("pressure") == STUDY_PRESSURE


def stress_ratio_at(friction_angle):
    """Major over minor principal stress at the friction angle [deg]: the reference study's eq. 8 solved for the ratio."""
    sine = np.sin(np.radians(friction_angle))
    return (1.0 + sine) / (1.0 - sine)


def runs_of(table):
    """{preparation friction: one table for each seed, points in order of axial strain}"""
    found = {}
    pairs = np.column_stack([table["preparation_friction"], table["seed"]])
    for friction, seed in np.unique(pairs, axis=0):
        rows = np.flatnonzero((pairs[:, 0] == friction) & (pairs[:, 1] == seed))
        rows = rows[np.argsort(table["axial_strain"][rows], kind="stable")]
        found.setdefault(friction, []).append({name: values[rows] for name, values in table.items()})
    return found


def on_one_grid(runs, quantity):
    """Axial strain and one line of values for each run, as far as all of them have come."""
    first = max(run["axial_strain"][0] for run in runs)
    last = min(run["axial_strain"][-1] for run in runs)
    strain = np.linspace(first, last, 400)
    return strain, np.array([np.interp(strain, run["axial_strain"], quantity(run)) for run in runs])


def smoothed_angle(summary, friction):
    """What summary.json says about the peak friction angle with the run's own smoothing, or nothing."""
    choice = summary.get("choice", {}).get("smoothing")
    for packings in summary.get("preparation_frictions", []):
        for entry in packings["windows"]:
            angle = {key: figures.finite(value) for key, value in entry["phi_max"].items()}
            if packings["preparation_friction"] == friction and entry["window"] == choice and angle["mean"] is not None:
                spread = f" ± {angle['standard_deviation']:.1f}" if angle["standard_deviation"] else ""
                return f", {angle['mean']:.1f}{spread}° (window {100.0 * choice:g} %)"
    return ""


def draw_runs(axes, runs, quantity, colour, label, alone):
    """Mean of the packings; each of them where they are `alone`, else a band of one standard deviation."""
    strain, values = on_one_grid(runs, quantity)
    if alone:
        for run in runs:
            axes.plot(100.0 * run["axial_strain"], quantity(run), color=figures.SKY, linewidth=0.6)
        axes.plot([], [], color=figures.SKY, linewidth=0.6, label="one packing")
    elif len(runs) > 1:
        spread = values.std(axis=0, ddof=1)
        axes.fill_between(100.0 * strain, values.mean(axis=0) - spread, values.mean(axis=0) + spread, color=colour,
                          alpha=0.2, linewidth=0)
    axes.plot(100.0 * strain, values.mean(axis=0), color=colour, linewidth=2.0 if alone else 1.5, label=label)


def biaxial(folder):
    table = figures.read_csv(folder / "biaxial.csv", ["preparation_friction", "seed", "axial_strain",
                                                      "volumetric_strain", "axial_stress", "lateral_stress"])
    with np.errstate(divide="ignore", invalid="ignore"):
        table["stress_ratio"] = table["axial_stress"] / table["lateral_stress"]
    groups = runs_of(table)
    summary = figures.read_summary(folder)
    colours = [figures.BLUE, figures.GREEN, figures.ORANGE, figures.VERMILION, figures.PURPLE, figures.GREY]
    fig, (stress, volume) = plt.subplots(2, 1, figsize=(5.6, 6.6), sharex=True, height_ratios=(3, 2))
    for (friction, runs), colour in zip(groups.items(), itertools.cycle(colours)):
        label = f"preparation friction {friction:g}{smoothed_angle(summary, friction)}"
        draw_runs(stress, runs, lambda run: run["stress_ratio"], colour, label, len(groups) == 1)
        draw_runs(volume, runs, lambda run: 100.0 * run["volumetric_strain"], colour, None, len(groups) == 1)
    if is_at_study_pressure(summary):
        stress.axhline(stress_ratio_at(STUDY_FRICTION_ANGLE), color=figures.BLACK, linewidth=0.9, linestyle="--",
                       label=f"study's peak friction angle, {STUDY_FRICTION_ANGLE}°")
    volume.axhline(0.0, color=figures.BLACK, linewidth=0.8)
    stress.set(ylabel="axial over lateral stress [-]", title="Drained biaxial compression")
    stress.margins(y=0.08)
    volume.set(xlabel="axial strain [%]", ylabel="volumetric strain [%]\n(contraction positive)")
    volume.legend(*stress.get_legend_handles_labels(), loc="upper center", bbox_to_anchor=(0.5, -0.25))
    return fig


if __name__ == "__main__":
    drawn = {"packing": packing, "biaxial": biaxial}
    folder = pathlib.Path(sys.argv[1]) if len(sys.argv) == 2 else None
    summary = figures.read_summary(folder) if folder else {}
    if len(summary.get("packings", [])) > 1 and is_at_study_pressure(summary):  # they compare with others at this pressure
        drawn.update(strength=void_ratio_figures.strength, fabric=void_ratio_figures.fabric)
    figures.draw_all(drawn)
