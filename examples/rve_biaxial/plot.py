# SPDX-License-Identifier: BSL-1.0
"""plot.py OUTPUT_DIR: the packing and the drained biaxial test, in the manner of the study's fig. 1."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
import numpy as np
import scarp_figures as figures
from scarp_figures import plt

STUDY_FRICTION_ANGLE = 30.8  # [deg], read off the study's fig. 1b by its authors, sec. 3.1


def packing(folder):
    return figures.draw_packing(folder, "Packing after isotropic consolidation")


def stress_ratio_at(friction_angle):
    """Major over minor principal stress at the friction angle [deg]: the study's eq. 8 solved for the ratio."""
    sine = np.sin(np.radians(friction_angle))
    return (1.0 + sine) / (1.0 - sine)


def friction_angle_at(stress_ratio):
    """[deg], the study's eq. 8"""
    return np.degrees(np.arcsin((stress_ratio - 1.0) / (stress_ratio + 1.0)))


def runs_of(table):
    """One table for each seed, points in order of axial strain."""
    seeds = table.get("seed", np.zeros(len(table["axial_strain"])))
    for seed in np.unique(seeds):
        rows = np.flatnonzero(seeds == seed)
        rows = rows[np.argsort(table["axial_strain"][rows], kind="stable")]
        yield {name: values[rows] for name, values in table.items()}


def mean_curve(runs, quantity):
    """Mean over the seeds, as far as all of them have come."""
    first = max(run["axial_strain"][0] for run in runs)
    last = min(run["axial_strain"][-1] for run in runs)
    strain = np.linspace(first, last, 400)
    return strain, np.mean([np.interp(strain, run["axial_strain"], quantity(run)) for run in runs], axis=0)


def smoothed_angle(summary):
    """What summary.json says about the peak friction angle with the run's own smoothing, or None."""
    choice = summary.get("choice", {}).get("smoothing")
    for entry in summary.get("windows", []):
        angle = {key: figures.finite(value) for key, value in entry.get("phi_max", {}).items()}
        if entry.get("window") == choice and angle.get("mean") is not None:
            spread = f" ± {angle['standard_deviation']:.1f}" if angle.get("standard_deviation") else ""
            return f"smoothed over {100.0 * choice:g} % strain: {angle['mean']:.1f}{spread}°"
    return None


def biaxial(folder):
    table = figures.read_csv(folder / "biaxial.csv",
                             ["axial_strain", "volumetric_strain", "axial_stress", "lateral_stress"])
    with np.errstate(divide="ignore", invalid="ignore"):
        table["stress_ratio"] = table["axial_stress"] / table["lateral_stress"]
    runs = list(runs_of(table))
    fig, (stress, volume) = plt.subplots(2, 1, figsize=(5.2, 6.2), sharex=True, height_ratios=(3, 2))
    for axes, quantity in ((stress, lambda run: run["stress_ratio"]),
                           (volume, lambda run: 100.0 * run["volumetric_strain"])):
        for k, run in enumerate(runs):
            axes.plot(100.0 * run["axial_strain"], quantity(run), color=figures.SKY, linewidth=0.6,
                      label="one packing" if k == 0 else None)
        strain, mean = mean_curve(runs, quantity)
        axes.plot(100.0 * strain, mean, color=figures.BLUE, linewidth=2.2, label=f"mean of {len(runs)}")
        if axes is stress and np.isfinite(mean).any():
            peak = np.nanargmax(mean)
            angle = friction_angle_at(mean[peak])
            axes.plot(100.0 * strain[peak], mean[peak], "o", color=figures.VERMILION, zorder=5,
                      label=f"peak of the mean: {mean[peak]:.2f} ({angle:.1f}°)")
    smoothed = smoothed_angle(figures.read_summary(folder))
    if smoothed is not None:
        stress.plot([], [], " ", label=smoothed)
    stress.axhline(stress_ratio_at(STUDY_FRICTION_ANGLE), color=figures.BLACK, linewidth=0.9, linestyle="--",
                   label=f"study's peak friction angle, {STUDY_FRICTION_ANGLE}°")
    volume.axhline(0.0, color=figures.BLACK, linewidth=0.8)
    stress.set(ylabel="axial over lateral stress [-]", title="Drained biaxial compression")
    volume.set(xlabel="axial strain [%]", ylabel="volumetric strain [%]\n(contraction positive)")
    stress.legend(loc="lower right")
    return fig


if __name__ == "__main__":
    figures.draw_all({"packing": packing, "biaxial": biaxial})
