# SPDX-License-Identifier: BSL-1.0
"""Figures of how the load steps converged and what they cost."""

import numpy as np
import scarp_figures as figures
from matplotlib.ticker import MaxNLocator, NullFormatter
from scarp_figures import BLACK, BLUE, GREEN, ORANGE, SKY, VERMILION, plt


def attempts_of(table):
    """Row slices of the attempts at load steps: another step, or iterations counted anew, is another attempt."""
    starts = np.flatnonzero((np.diff(table["step"]) != 0) | (np.diff(table["iteration"]) <= 0)) + 1
    bounds = [0, *starts, len(table["step"])]
    return [slice(first, end) for first, end in zip(bounds, bounds[1:])]


def residual_tolerance(summary):
    known = (figures.finite(summary.get(key)) for key in ("residual_tolerance", "tolerance"))
    return next((value for value in known if value is not None and value > 0.0), None)


def convergence(folder):
    table = figures.read_csv(folder / "convergence.csv",
                             ["step", "throw_over_depth", "iteration", "residual", "accepted", "dem_steps"])
    tolerance = residual_tolerance(figures.read_summary(folder))
    attempts = attempts_of(table)
    accepted = np.array([table["accepted"][attempt].max() > 0.0 for attempt in attempts])
    count = np.arange(1, len(table["step"]) + 1)
    packings = table["dem_steps"].any()
    heights = (3, 2, 2) if packings else (3, 2)
    fig, (residual, effort, *work) = plt.subplots(len(heights), 1, figsize=(7.6, sum(heights)), height_ratios=heights)

    for attempt, good in zip(attempts, accepted):
        residual.plot(count[attempt], table["residual"][attempt], ".-", linewidth=0.6, markersize=2.5,
                      color=SKY if good else VERMILION)
    ends = np.array([attempt.stop - 1 for attempt in attempts])
    residual.plot(count[ends[accepted]], table["residual"][ends[accepted]], "o", color=BLUE, markersize=3,
                  label="accepted")
    if not accepted.all():
        residual.plot(count[ends[~accepted]], table["residual"][ends[~accepted]], "x", color=VERMILION, markersize=5,
                      label="not accepted")
    if tolerance is not None:
        residual.axhline(tolerance, color=BLACK, linestyle="--", linewidth=1.0, label=f"tolerance {tolerance:g}")
    residual.set(yscale="log", xlabel="iterations since the start", ylabel="force residual [-]")
    residual.yaxis.set_major_formatter("{x:g}")
    residual.yaxis.set_minor_formatter(NullFormatter())
    residual.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=3, title="Convergence of the load steps",
                    title_fontsize=9)

    throw = table["throw_over_depth"][ends]
    iterations = np.array([attempt.stop - attempt.start for attempt in attempts])
    effort.plot(throw[accepted], iterations[accepted], ".", color=BLUE)
    effort.plot(throw[~accepted], iterations[~accepted], "x", color=VERMILION)
    effort.set(ylabel="iterations per\nload step [-]", ylim=(0.0, None))
    effort.yaxis.set_major_locator(MaxNLocator(integer=True))
    last = effort
    if packings:
        last, = work
        last.plot(table["throw_over_depth"], 1e-6 * np.cumsum(table["dem_steps"]), color=GREEN)
        last.set(ylabel="DEM steps so far [million]", ylim=(0.0, None))
        last.sharex(effort)
    last.set_xlabel("throw over depth of layer, h/H [-]")
    return fig


def values(lines, *path):
    """Of every line what is found under these keys, one below the other."""
    found = lines
    for key in path:
        found = [line[key] for line in found]
    return np.array(found, dtype=float)


def effort(folder):
    lines = figures.read_json_lines(folder / "convergence.jsonl")
    steps = [line for line in lines if line["kind"] == "step"]
    iterations = [line for line in lines if line["kind"] == "iteration"]
    if not steps:
        raise figures.InputError("'convergence.jsonl' holds no load step (the run has not come so far): let it run on")
    throw = values(steps, "throw_over_depth")
    accepted = values(steps, "accepted") > 0.0
    packings = values(steps, "dem_steps").any()
    marks = (("fluid", SKY, "o"), ("not_converged", ORANGE, "^"), ("failed", VERMILION, "x"))
    unwell = [mark for mark in marks if values(iterations, "points", mark[0]).any()]
    panels = (2 if packings else 0) + bool(unwell) + 1
    fig, grid = plt.subplots(panels, 1, figsize=(7.6, 2.05 * panels), sharex=True, squeeze=False)
    *others, time = grid[:, 0]

    def draw_steps(axes, amounts, good, refused, label):
        axes.plot(throw[accepted], amounts[accepted], ".", color=good, label=label)
        if not accepted.all():
            axes.plot(throw[~accepted], amounts[~accepted], "x", color=refused, markersize=4, label="not accepted")

    at = values(iterations, "throw_over_depth")
    if packings:
        work, slow, *others = others
        draw_steps(work, values(steps, "dem_steps"), BLUE, VERMILION, "accepted")
        work.set(ylabel="DEM steps per\nload step [-]")
        work.set_yscale("log", nonpositive="mask")
        work.legend(title="Cost of the load steps", title_fontsize=9, loc="lower center", bbox_to_anchor=(0.5, 1.0), ncol=2)

        all_steps = values(iterations, "dem_steps")
        most = np.array([sum(point["dem_steps"] for point in line["slowest"]) for line in iterations])
        busy = all_steps > 0.0
        slow.plot(at[busy], 100.0 * most[busy] / all_steps[busy], ".", color=GREEN, markersize=3)
        slow.set(ylabel="DEM steps of the five\nslowest points [%]", ylim=(0.0, None))
    else:
        grid[0, 0].set_title("Cost of the load steps", fontsize=9)

    for panel in others:
        for name, colour, mark in unwell:
            count = values(iterations, "points", name)
            panel.plot(at[count > 0], count[count > 0], mark, color=colour, markersize=3, label=name.replace("_", " "))
        panel.set(ylabel="points that are\nnot ok [-]", ylim=(0.0, None))
        panel.yaxis.set_major_locator(MaxNLocator(integer=True))
        panel.legend(loc="upper left", ncol=3)

    inside = values(steps, "seconds_in_points")
    outside = values(steps, "seconds") - inside
    share = 100.0 * outside.sum() / (inside + outside).sum()
    draw_steps(time, inside, BLUE, BLUE, "in material points")
    draw_steps(time, outside, ORANGE, ORANGE, f"outside them, {share:.2g} % of all")
    time.set(xlabel="throw over depth of layer, h/H [-]", ylabel="wall time per\nload step [s]", yscale="log")
    time.legend(loc="upper center", bbox_to_anchor=(0.5, -0.3), ncol=4)
    return fig
