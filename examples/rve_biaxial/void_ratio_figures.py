# SPDX-License-Identifier: BSL-1.0
"""Strength, dilation and fabric of many packings over their void ratio, from summary.json."""

import numpy as np
import scarp_figures as figures
from scarp_figures import plt

STUDY_VOID_RATIOS = (0.160, 0.179)
# {void ratio: angle [deg]} of SudoDEM's packings A and G, and their fabrics in the reference study's definition (peak: mean of 0.5 %).
SUDODEM_ANGLES = {("phi_max", 0.005): {0.153: 36.6, 0.173: 33.8}, ("psi_max", 0.05): {0.153: 17.2, 0.173: 14.9},
                  ("psi_secant", None): {0.153: 8.3, 0.173: 6.3}}
SUDODEM_FABRICS = {"contact_fabric": {"start": {0.153: 0.035, 0.173: 0.024}, "peak": {0.153: 0.198, 0.173: 0.209},
                                      "end": {0.153: 0.379, 0.173: 0.322}},
                   "particle_fabric": {"start": {0.153: 0.059, 0.173: 0.067}, "peak": {0.153: 0.085, 0.173: 0.097},
                                       "end": {0.153: 0.515, 0.173: 0.438}}}
MOMENTS = {"start": (figures.GREY, "start"), "peak": (figures.VERMILION, "largest stress ratio"),
           "end": (figures.BLUE, "end of the test")}


def summary_of(folder):
    """\\throws InputError for a run of one packing, over whose void ratio nothing can be drawn."""
    summary = figures.read_summary(folder)
    if len(summary.get("packings", [])) < 2:
        raise figures.InputError(f"'{folder / 'summary.json'}' holds no two packings (a figure over the void ratio "
                                 "needs several): run with more --seeds or a list of --preparation-friction")
    return summary


def angle_of(packing, name, window):
    """[deg] or NaN."""
    if window is None:
        return packing[name]
    found = [peak[name] for peak in packing["peaks"] if peak["window"] == window]
    return found[0] if found else None


def number(value):
    finite = figures.finite(value)
    return np.nan if finite is None else finite


def draw_series(axes, packings, values, colour, label):
    """One dot for each packing, mean and deviation for each friction."""
    void_ratios = np.array([packing["void_ratio"] for packing in packings])
    frictions = np.array([packing["preparation_friction"] for packing in packings])
    values = np.array([number(value) for value in values])
    axes.plot(void_ratios, values, "o", color=colour, markersize=3, alpha=0.45, markeredgewidth=0)
    for k, friction in enumerate(np.unique(frictions)):
        e, value = void_ratios[frictions == friction], values[frictions == friction]
        if len(e) < 2 or not np.isfinite(value).all():
            continue
        axes.errorbar(e.mean(), value.mean(), xerr=e.std(ddof=1), yerr=value.std(ddof=1), color=colour, fmt="s",
                      markersize=5, elinewidth=1.2, zorder=4)
    axes.plot([], [], "s", color=colour, label=label)  # for the legend


def draw_line(axes, summary, name, window, colour):
    """The least-squares line, and a star where it meets the reference study's angle."""
    for line in summary.get("over_void_ratio", []):
        if line["angle"] != name or line.get("window") != window or line["slope"] is None:  # tests that are shorter than the window
            continue
        e = np.array(line["void_ratio_range"])
        axes.plot(e, line["at_zero"] + line["slope"] * e, color=colour, linewidth=1.0)
        place = figures.finite(line["void_ratio_at_study"])
        if place is not None:
            axes.plot(place, line["study"], "*", color=colour, markersize=13, markeredgecolor="white", zorder=6)


def draw_sudodem(axes, points, colour):
    axes.plot(list(points), list(points.values()), "D", color=colour, markersize=6, markeredgecolor=figures.BLACK, zorder=5)


def draw_study(axes, value=None):
    axes.axvspan(*STUDY_VOID_RATIOS, color=figures.PALE, alpha=0.5, linewidth=0, zorder=0, label="study's void ratios")
    if value is not None:
        axes.axhline(value, color=figures.BLACK, linewidth=0.9, linestyle="--", label=f"study: {value}°")


def finish(fig, panels, summary):
    panels[0].plot([], [], "D", color="white", markeredgecolor=figures.BLACK, label="SudoDEM, one packing")
    panels[-1].set_xlabel(f"void ratio after consolidation at {1e-3 * summary['choice']['pressure']:g} kPa [-]")
    for axes in panels:
        axes.legend(loc="upper left", bbox_to_anchor=(1.01, 1.0))
    return fig


def strength(folder):
    summary = summary_of(folder)
    packings = summary["packings"]
    fig, panels = plt.subplots(2, 1, figsize=(6.6, 6.6), sharex=True)
    shown = ((("phi_max", 0.005, figures.GREEN, "window 0.5 %"), ("phi_max", 0.05, figures.BLUE, "window 5 %")),
             (("psi_max", 0.05, figures.BLUE, "window 5 %"), ("psi_secant", None, figures.VERMILION, "secant to the end")))
    for axes, series in zip(panels, shown):
        for name, window, colour, label in series:
            draw_series(axes, packings, [angle_of(packing, name, window) for packing in packings], colour, label)
            draw_line(axes, summary, name, window, colour)
            draw_sudodem(axes, SUDODEM_ANGLES.get((name, window), {}), colour)
    panels[0].plot([], [], "*", color=figures.GREY, markersize=11, label="line meets the reference study")
    for axes, value in zip(panels, (30.8, 6.6)):
        draw_study(axes, value)
    panels[0].set(ylabel="peak friction angle $\\phi_{max}$ [°]", title="Strength and dilation over the void ratio")
    panels[1].set(ylabel="dilation angle $\\psi$ [°]")
    return finish(fig, panels, summary)


def fabric(folder):
    summary = summary_of(folder)
    packings = summary["packings"]
    fig, panels = plt.subplots(2, 1, figsize=(6.6, 6.0), sharex=True)
    for axes, name in zip(panels, ("contact_fabric", "particle_fabric")):
        for moment, (colour, label) in MOMENTS.items():
            draw_series(axes, packings, [packing[name][moment] for packing in packings], colour, label)
            draw_sudodem(axes, SUDODEM_FABRICS[name][moment], colour)
        draw_study(axes)
        axes.set_ylim(bottom=0.0)
    panels[0].set(ylabel="anisotropy of contact normals [-]", title="Fabric over the void ratio")
    panels[1].set(ylabel="anisotropy of long axes [-]")
    return finish(fig, panels, summary)
