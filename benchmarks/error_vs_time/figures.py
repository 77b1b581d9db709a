# SPDX-License-Identifier: BSL-1.0
"""figures.py OUTPUT_DIR: a log-log figure for every table SUBJECT.csv there, error over CPU time, one panel an answer,
one curve a knob, the front marked, the scatter of the samples as a band from which an error sticks out."""

import csv
import itertools
import math
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[2] / "examples" / "shared"))
import scarp_figures as figures
from matplotlib import ticker
from scarp_figures import plt

COLOURS = [figures.BLUE, figures.VERMILION, figures.GREEN, figures.ORANGE, figures.PURPLE, figures.SKY, "#7F6000",
           "#444444"]
MARKERS = "osD^vP*X<>"
MOST_COLUMNS = 4  # of panels, the legend's included


def style(number):
    return COLOURS[number % len(COLOURS)], MARKERS[number % len(MARKERS)]


def number(cell):
    try:
        return float(cell)
    except ValueError:
        return math.nan


def read(path):
    """{answer: [row]} of a sweep's table, numbers as numbers, rows in order."""
    with open(path, newline="") as stream:
        rows = list(csv.DictReader(stream))
    needed = {"knob", "setting", "answer", "value", "cost", "error", "scatter", "on_front", "new_sample"}
    if not rows or not needed <= set(rows[0]):
        raise figures.InputError(f"'{path}' is no table of a sweep (it lacks columns or rows): run the benchmark anew")
    table = {}
    for row in rows:
        for name in ("value", "cost", "error", "scatter"):
            row[name] = number(row[name])
        table.setdefault(row["answer"], []).append(row)
    return table


def drawable(row):
    return row["cost"] > 0.0 and row["error"] > 0.0 and row["new_sample"] == "0"


def draw_front(axes, rows):
    front = sorted((row["cost"], row["error"]) for row in rows if row["on_front"] == "1" and drawable(row))
    if front:
        axes.step(*zip(*front), where="post", color=figures.BLACK, linewidth=4.0, alpha=0.15, zorder=1, label="front")


def points(rows):
    return [row["cost"] for row in rows], [row["error"] for row in rows]


def draw_knobs(axes, rows, styles):
    grouped = {knob: list(group) for knob, group in itertools.groupby(rows, key=lambda row: row["knob"])}
    for knob, group in grouped.items():
        group = [row for row in group if drawable(row)]
        if not group or knob == "base":
            continue
        colour, marker = styles.setdefault(knob, style(len(styles)))
        if knob == "combined":
            axes.plot(*points(group), ".", color=figures.PALE, zorder=0, label=knob)
            continue
        ordered = all(math.isfinite(row["value"]) for row in group)
        axes.plot(*points(group), marker + ("-" if ordered else ""), color=colour, markersize=4, linewidth=1.0,
                  label=knob)
        if not ordered and len(grouped) == 2:  # beside the base: there is room for names
            for row in group:
                axes.annotate(row["setting"], (row["cost"], row["error"]), xytext=(6, 3), textcoords="offset points",
                              fontsize="small")


def draw_base(axes, rows):
    base = rows[0]
    if not drawable(base):
        return
    axes.plot(base["cost"], base["error"], "o", markersize=11, markerfacecolor="none", markeredgecolor=figures.BLACK,
              label="base setting")
    if base["scatter"] > 0.0:
        axes.axhspan(0.1 * base["scatter"], base["scatter"], color=figures.ORANGE, alpha=0.13, linewidth=0, zorder=0,
                     label="scatter of the samples,\nto a tenth of it")


def draw(path):
    table = read(path)
    lines = math.ceil((len(table) + 1) / MOST_COLUMNS)
    columns = math.ceil((len(table) + 1) / lines)
    fig, panels = plt.subplots(lines, columns, figsize=(3.3 * columns, 3.9 * lines), squeeze=False)
    panels = panels.flatten()
    styles = {}
    for axes, (answer, rows) in zip(panels, table.items()):
        draw_front(axes, rows)
        draw_knobs(axes, rows, styles)
        draw_base(axes, rows)
        axes.set(xscale="log", yscale="log", xlabel="CPU time over the base setting's [-]", title=answer)
        low, high = axes.get_xlim()
        axes.xaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0) if high < 100.0 * low else (1.0,)))
        axes.xaxis.set_major_formatter(ticker.FormatStrFormatter("%g"))
        axes.xaxis.set_minor_locator(ticker.NullLocator())
    for axes in panels[::columns]:
        axes.set_ylabel("error relative to the reference [-]")
    handles = {}
    for axes in panels[:len(table)]:
        for handle, label in zip(*axes.get_legend_handles_labels()):
            handles.setdefault(label, handle)
    for axes in panels[len(table):]:
        axes.axis("off")
    panels[len(table)].legend(handles.values(), handles.keys(), loc="center left", borderaxespad=0.0)
    return fig


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        print(f"usage: {sys.argv[0]} OUTPUT_DIR   (the folder with the tables of error_vs_time)", file=sys.stderr)
        return 2
    status = 0
    for path in sorted(pathlib.Path(sys.argv[1]).glob("*.csv")):
        try:
            figures.save(draw(path), path.with_suffix(".png"))
            print(path.with_suffix(".png"))
        except (figures.InputError, OSError) as trouble:
            print(f"{path.stem}.png is not drawn: {trouble}", file=sys.stderr)
            status = 1
    return status


if __name__ == "__main__":
    sys.exit(main())
