# SPDX-License-Identifier: BSL-1.0
"""Reads what the examples write (CSV, JSON, VTU, PVD) and holds what their figures share."""

import base64
import csv
import json
import multiprocessing
import os
import pathlib
import signal
import sys
import typing
import xml.etree.ElementTree as xml

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon
from PIL import Image

# Colours that stay apart for colour-blind readers [Okabe & Ito 2008, "Color Universal Design"].
BLUE, VERMILION, GREEN, ORANGE, SKY, PURPLE = "#0072B2", "#D55E00", "#009E73", "#E69F00", "#56B4E9", "#CC79A7"
BLACK, GREY, PALE = "#222222", "#8A8A8A", "#D8D8D8"

plt.rcParams.update({
    "figure.constrained_layout.use": True, "savefig.dpi": 160,
    "font.size": 9, "axes.titlesize": 9, "axes.labelsize": 9, "legend.fontsize": 8, "legend.frameon": False,
    "axes.spines.top": False, "axes.spines.right": False, "axes.grid": True, "axes.axisbelow": True,
    "grid.color": "#E6E6E6", "grid.linewidth": 0.6, "lines.linewidth": 1.5, "axes.unicode_minus": True,
})


class InputError(Exception):
    """The figure cannot be drawn; the text is one line: "problem (why): suggestion"."""


def require_file(path):
    if not path.is_file():
        raise InputError(f"there is no '{path}' (the run did not write it, or has not come so far): run the example")


def number(cell):
    """A table's cell as a number, true and false as 1 and 0, no number as NaN."""
    try:
        return float(cell)
    except ValueError:
        return {"true": 1.0, "false": 0.0}.get(cell.strip().lower(), np.nan)


def read_csv(path, columns, may_be_empty=False):
    """Table with a header line -> {column: array}; a last line that an interruption cut off is left out."""
    require_file(path)
    text = path.read_text()
    lines = text[: text.rfind("\n") + 1].splitlines()
    header = next(csv.reader(lines[:1]), [])
    missing = [name for name in columns if name not in header]
    if missing:
        raise InputError(f"'{path}' has no column '{missing[0]}' (it has: {', '.join(header)}): run the example anew")
    rows = list(csv.reader(lines[1:]))
    for line, row in enumerate(rows, start=2):
        if len(row) != len(header):
            raise InputError(f"'{path}', line {line}, has {len(row)} cells (its header has {len(header)}): run anew")
    if not rows and not may_be_empty:
        raise InputError(f"'{path}' holds no rows (the run has not come so far): let it run on")
    return {name: np.array([number(row[k]) for row in rows]) for k, name in enumerate(header)}


def read_json_lines(path):
    """[object] of a file with one JSON object a line; a last line that an interruption cut off is left out."""
    require_file(path)
    text = path.read_text()
    try:
        return [json.loads(line) for line in text[: text.rfind("\n") + 1].splitlines()]
    except ValueError as trouble:
        raise InputError(f"'{path}' holds a line that is no JSON ({trouble}): run the example anew") from None


def read_summary(folder):
    """What the run said about itself, empty while it has not finished."""
    path = folder / "summary.json"
    try:
        summary = json.loads(path.read_text()) if path.is_file() else {}
        return summary if isinstance(summary, dict) else {}
    except ValueError as trouble:
        raise InputError(f"'{path}' is no JSON ({trouble}): run the example anew") from None


def finite(value):
    """The value when it is a finite number, else None."""
    is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
    return float(value) if is_number and np.isfinite(value) else None


def last_nearest(values, wanted):
    """Index of the last of the values that are nearest to the wanted one: a throw of 0 has many rows before the fault moves."""
    return len(values) - 1 - np.argmin(np.abs(values - wanted)[::-1])


class Grid(typing.NamedTuple):
    points: np.ndarray  # [m], shape (nodes, 2), of hexahedra (nodes, 3)
    cells: np.ndarray   # node numbers of the corners, shape (cells, 3) or (cells, 4), of hexahedra (cells, 8)
    at_nodes: dict
    at_cells: dict


def read_vtu(path):
    """An unstructured grid of triangles, quadrilaterals or linear hexahedra as io/vtu.hpp writes it."""
    require_file(path)
    try:
        root = xml.parse(path).getroot()
        order = "<" if root.get("byte_order") == "LittleEndian" else ">"
        kinds = {"Float64": "f8", "Int32": "i4", "UInt8": "u1"}

        def array(item):
            data = base64.b64decode(item.text)
            length = int(np.frombuffer(data, order + "u8", 1)[0])
            if len(data) != 8 + length:
                raise ValueError(f"array '{item.get('Name')}' is cut off")
            values = np.frombuffer(data, order + kinds[item.get("type")], offset=8)
            components = int(item.get("NumberOfComponents", 1))
            return values if components == 1 else values.reshape(-1, components)

        piece = root.find("UnstructuredGrid/Piece")
        arrays = {part.tag: {item.get("Name"): array(item) for item in part} for part in piece}
        offsets = arrays["Cells"]["offsets"]
        if np.all(arrays["Cells"]["types"] == 12) and len(offsets):
            return Grid(arrays["Points"]["Points"], arrays["Cells"]["connectivity"].reshape(-1, 8), arrays["PointData"],
                        arrays["CellData"])
        nodes = int(offsets[0]) if len(offsets) else 0
        if nodes not in (3, 4, 6, 8) or np.any(np.diff(offsets) != nodes):
            raise ValueError("its cells are not all triangles or all quadrilaterals")
        corners = nodes if nodes < 6 else nodes // 2
        return Grid(arrays["Points"]["Points"][:, :2], arrays["Cells"]["connectivity"].reshape(-1, nodes)[:, :corners],
                    arrays["PointData"], arrays["CellData"])
    except (xml.ParseError, ValueError, KeyError, TypeError, AttributeError, IndexError) as trouble:
        raise InputError(f"'{path}' cannot be read ({trouble}): run the example anew") from None


def read_pvd(path):
    """[(time, file)] of the files that are there, in the order of the series."""
    require_file(path)
    try:
        items = xml.parse(path).getroot().findall("Collection/DataSet")
        series = [(float(item.get("timestep")), path.parent / item.get("file")) for item in items]
    except (xml.ParseError, ValueError, TypeError) as trouble:
        raise InputError(f"'{path}' cannot be read ({trouble}): run the example anew") from None
    series = [(time, file) for time, file in series if file.is_file()]
    if not series:
        raise InputError(f"'{path}' lists no file that is there (the run has not come so far): let it run on")
    return series


def field(values, name, path):
    if name not in values:
        raise InputError(f"'{path}' has no field '{name}' (it has: {', '.join(values)}): run the example anew")
    return values[name]


def block(corners):
    """A rigid body's patch. corners: shape (n, 2)"""
    return Polygon(corners, facecolor=PALE, edgecolor=BLACK, linewidth=0.8, zorder=4)


class Animation(typing.NamedTuple):
    frames: list        # of PIL.Image, all of one size
    milliseconds: list  # that each is shown


LARGEST_ANIMATION = 3_000_000  # [bytes]


def write_animation(animation, path):
    """A GIF with one palette for all frames, smaller when it would be too large."""
    frames = animation.frames
    while True:
        samples = [frames[0], frames[len(frames) // 2], frames[-1]]
        palette = Image.fromarray(np.vstack([np.asarray(frame) for frame in samples])).quantize(128)
        drawn = [frame.quantize(palette=palette, dither=0) for frame in frames]
        drawn[0].save(path, format="GIF", save_all=True, append_images=drawn[1:], duration=animation.milliseconds, loop=0,
                      optimize=False)
        if path.stat().st_size <= LARGEST_ANIMATION or frames[0].width < 200:
            return
        frames = [frame.resize((frame.width * 3 // 4, frame.height * 3 // 4)) for frame in frames]


def save(fig, path):
    """A figure, or an Animation."""
    path.parent.mkdir(exist_ok=True)
    partial = path.with_name(f"{path.name}.partial-{os.getpid()}")
    try:
        if isinstance(fig, Animation):
            write_animation(fig, partial)
        else:
            fig.savefig(partial, format="png")
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
        if not isinstance(fig, Animation):
            plt.close(fig)


def draw_one(name):
    """The file of a figure, or why it is not drawn."""
    folder = pathlib.Path(sys.argv[1])
    try:
        drawn = to_draw[name](folder)
        path = folder / "figures" / f"{name}.{'gif' if isinstance(drawn, Animation) else 'png'}"
        save(drawn, path)
        return path
    except (InputError, OSError) as trouble:
        plt.close("all")
        return f"figure '{name}' is not drawn: {trouble}"


to_draw = {}  # is there before processes begin, which take it over


def draw_all(figures):
    """figures: {name: function(folder) -> figure or Animation}. Draws each that can be drawn into OUTPUT_DIR/figures/, with a process for each
    core, and ends the program: 0 when all were drawn, 1 when some could not be, 2 for a wrong call."""
    if len(sys.argv) != 2:
        print(f"usage: {sys.argv[0]} OUTPUT_DIR   (the folder that the example wrote)", file=sys.stderr)
        sys.exit(2)
    folder = pathlib.Path(sys.argv[1])
    if not folder.is_dir():
        print(f"there is no folder '{folder}' (nothing to draw): give the one that the example wrote", file=sys.stderr)
        sys.exit(2)
    to_draw.update(figures)
    status = 0
    jobs = max(1, min(os.cpu_count() or 1, len(figures)))
    with multiprocessing.get_context("fork").Pool(jobs, signal.signal, (signal.SIGINT, signal.SIG_IGN)) as pool:
        for done in pool.imap(draw_one, figures):
            if isinstance(done, pathlib.Path):
                print(done, flush=True)
            else:
                print(done, file=sys.stderr)
                status = 1
    sys.exit(status)
