# SPDX-License-Identifier: BSL-1.0
"""plot.py OUTPUT_DIR: packings with force chains, roses of contact normals, stress, volume and energies of
`rve_lab prepare` and `rve_lab shear`, curves of `rve_lab test`, data against packings and sensitivities of `rve_lab calibrate`, as far as the folder holds
them.
plot.py OUTPUT_DIR --overlay TABLE.csv...: with these test.csv of other runs, or tables of a laboratory, beside the test.
plot.py TABLE.csv [--compare OTHER.csv] [--picture FILE.png]: stresses of `rve_lab replay`, with those of another
code."""

import argparse
import csv
import itertools
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import numpy as np
import scarp_figures as figures
from laboratory_figure import laboratory
from matplotlib.collections import LineCollection, PolyCollection
from matplotlib.patches import Polygon
from packing_figures import Rose, rose_legend
from scarp_figures import BLACK, BLUE, GREEN, GREY, ORANGE, PURPLE, VERMILION, plt

STATES = {"start": GREY, "peak": VERMILION, "end": BLUE}
COMPONENTS = {"sxx": BLUE, "syy": VERMILION, "sxy": GREEN, "syx": PURPLE}


def outlines(grains, points=48):
    """Boundary of each grain about its centre [mm], shape (grains, points, 2)."""
    t = np.linspace(0.0, 2.0 * np.pi, points, endpoint=False)
    a = grains.get("r", grains.get("a"))[:, None]
    b = grains.get("r", grains.get("b"))[:, None]
    power = grains.get("eps", np.ones(len(a)))[:, None]
    x = a * np.sign(np.cos(t)) * np.abs(np.cos(t)) ** power
    y = b * np.sign(np.sin(t)) * np.abs(np.sin(t)) ** power
    turn = grains.get("angle", np.zeros(len(a)))[:, None]
    return 1e3 * np.stack([x * np.cos(turn) - y * np.sin(turn), x * np.sin(turn) + y * np.cos(turn)], axis=-1)


def read_state(folder, stem):
    grains = figures.read_csv(folder / f"{stem}_particles.csv", ["id", "x", "y"])
    contacts = figures.read_csv(folder / f"{stem}_contacts.csv",
                                ["id1", "nx", "ny", "fnx", "fny", "branch_x", "branch_y"])
    cell = figures.read_csv(folder / f"{stem}_cell.csv", ["a1x", "a1y", "a2x", "a2y"])
    base = 1e3 * np.array([[cell["a1x"][0], cell["a2x"][0]], [cell["a1y"][0], cell["a2y"][0]]])
    if not (np.isfinite(base).all() and np.linalg.det(base) > 0.0):
        raise figures.InputError(f"'{folder / stem}_cell.csv' holds no cell (inverted or NaN): run the example anew")
    return grains, contacts, base


def packing(folder, stem, title):
    grains, contacts, base = read_state(folder, stem)
    inverse = np.linalg.inv(base)
    centres = 1e3 * np.column_stack([grains["x"], grains["y"]])
    corner = np.round(2.0 * ((inverse @ centres.T).T.mean(axis=0) - 0.5)) / 2.0
    home = np.floor((inverse @ centres.T).T - corner)
    centres = centres - home @ base.T
    rim = centres[:, None, :] + outlines(grains)
    start = centres[contacts["id1"].astype(int)]
    branch = 1e3 * np.column_stack([contacts["branch_x"], contacts["branch_y"]])
    force = np.hypot(contacts["fnx"], contacts["fny"])
    corners = (corner + np.array([[0, 0], [1, 0], [1, 1], [0, 1]])) @ base.T
    margin = 0.04 * np.ptp(corners, axis=0).max()
    low, high = corners.min(axis=0) - margin, corners.max(axis=0) + margin

    fig, axes = plt.subplots(figsize=(5.2, 5.4))
    width = 1.4 / force.mean() if len(force) else 0.0
    for shift in itertools.product((-1, 0, 1), repeat=2):
        image = base @ np.array(shift)
        own = not any(shift)
        axes.add_collection(PolyCollection(rim + image, facecolor="#F4E3C1" if own else "#F6F6F6",
                                           edgecolor="#8C7A55" if own else "#DDDDDD", linewidth=0.4,
                                           zorder=2 if own else 1))
        ends = start + image
        seen = np.all((ends > low - 10.0) & (ends < high + 10.0), axis=1)
        axes.add_collection(LineCollection(np.stack([ends, ends + branch], axis=1)[seen], colors=BLUE, capstyle="round",
                                           linewidths=width * force[seen], alpha=0.85, zorder=3))
    axes.add_patch(Polygon(corners, closed=True, fill=False, edgecolor=BLACK, linewidth=1.0, zorder=4))
    axes.set(xlim=(low[0], high[0]), ylim=(low[1], high[1]), aspect="equal", xlabel="x [mm]", ylabel="y [mm]",
             title=f"{title}: {len(centres)} grains, {len(force)} contacts")
    axes.grid(False)
    if len(force):
        for sample in sorted({float(f"{times * force.mean():.1g}") for times in (0.5, 1.0, 2.0)}):
            axes.plot([], [], color=BLUE, linewidth=width * sample, label=f"{sample:g} N")
        axes.legend(loc="upper center", bbox_to_anchor=(0.5, -0.1), ncol=3, title="normal force")
    return fig


def roses(folder, stems):
    """Density of contact directions over 2 pi, 1/(2 pi) where isotropic; weighted with the normal force beside it."""
    fig, rows = plt.subplots(1, len(stems), figsize=(2.6 * len(stems), 3.0), subplot_kw={"projection": "polar"},
                             squeeze=False, constrained_layout=False)
    fig.subplots_adjust(left=0.06, right=0.94, bottom=0.16, top=0.86, wspace=0.45)
    shown = []
    for stem in stems:
        _, contacts, _ = read_state(folder, stem)
        shown.append(Rose(np.arctan2(contacts["ny"], contacts["nx"]), np.hypot(contacts["fnx"], contacts["fny"])))
    top = max(rose.top for rose in shown)
    for axes, stem, rose in zip(rows[0], stems, shown):
        rose.draw(axes, top, STATES.get(stem, GREY), f"{stem}: {rose.count} contacts")
    rose_legend(fig)
    return fig


def path_title(folder, table):
    summary = figures.read_summary(folder)
    return str(summary.get("path", "path")).replace("_", " ")


def is_cyclic(table):
    return np.any(np.diff(table["strain"]) < 0.0)


def signed_deviator(table):
    """A difference of principal stresses that changes sign with the direction of loading, and its label."""
    axial = table["mean_sxx"] - table["mean_syy"]
    shear = table["mean_sxy"] + table["mean_syx"]
    if np.ptp(axial) > np.ptp(shear):
        return "axial minus lateral stress", axial
    return "twice the shear stress", shear


def curve(folder):
    stresses = [f"mean_s{component}" for component in ("xx", "xy", "yx", "yy")]
    table = figures.read_csv(folder / "path.csv", ["strain", "mean_p", "mean_q", "volumetric_strain", *stresses])
    fig, (stress, volume) = plt.subplots(2, 1, figsize=(5.2, 6.0), sharex=True, height_ratios=(3, 2))
    strain = 100.0 * table["strain"]
    ratio = table["mean_q"] / table["mean_p"]
    if not is_cyclic(table):
        peak = np.nanargmax(ratio)
        stress.plot(strain[peak], 1e-3 * table["mean_q"][peak], "o", color=VERMILION, zorder=5,
                    label=f"largest q/p: {ratio[peak]:.3f}")
    if is_cyclic(table):
        label, signed = signed_deviator(table)
        stress.plot(strain, 1e-3 * signed, color=BLUE, label=label)
    else:
        stress.plot(strain, 1e-3 * table["mean_q"], color=BLUE, label="q, difference of principal stresses")
    stress.plot(strain, 1e-3 * table["mean_p"], color=GREY, label="p, mean pressure")
    volume.plot(strain, 100.0 * table["volumetric_strain"], color=BLUE)
    volume.axhline(0.0, color=BLACK, linewidth=0.8)
    stress.set(ylabel="stress [kPa], means over rows", title=path_title(folder, table).capitalize())
    stress.margins(y=0.25 if is_cyclic(table) else 0.12)
    volume.set(xlabel="strain along the path [%]", ylabel="volumetric strain [%]\n(contraction positive)")
    if np.ptp(table["volumetric_strain"]) < 1e-9:
        volume.set_ylim(-0.1, 0.1)
    stress.legend(loc="best")
    return fig


def energies(folder):
    names = {"stored": ("stored in contacts", BLUE), "contact_loss": ("lost in sliding contacts", ORANGE),
             "damping_loss": ("lost in damping", PURPLE), "kinetic": ("kinetic", GREEN)}
    table = figures.read_csv(folder / "path.csv", ["step", "strain", "work_in", "energy_gap", *names])
    travelled = 100.0 * np.concatenate([[0.0], np.cumsum(np.abs(np.diff(table["strain"])))])
    fig, axes = plt.subplots(figsize=(5.2, 3.6))
    # Layers above zero and below it apart: the stored energy may fall below that of the start.
    up, down = np.zeros(len(travelled)), np.zeros(len(travelled))
    for name, (label, colour) in names.items():
        rise, fall = np.maximum(table[name], 0.0), np.minimum(table[name], 0.0)
        axes.fill_between(travelled, up, up + rise, color=colour, alpha=0.75, linewidth=0.0, label=label)
        axes.fill_between(travelled, down, down + fall, color=colour, alpha=0.75, linewidth=0.0)
        up, down = up + rise, down + fall
    axes.plot(travelled, table["work_in"], color=BLACK, linewidth=1.2, label="work done on the cell")
    gap = np.abs(table["energy_gap"]).max() / max(np.abs(table["work_in"]).max(), 1e-300)
    axes.set(xlabel="strain travelled [%]", ylabel="energy since the start [J]",
             title=f"Energies, {path_title(folder, table)}: largest gap {100.0 * gap:.2g} % of the work")
    axes.legend(loc="upper left")
    return fig


def replayed(table_path, other_path):
    columns = ["strain", *COMPONENTS]
    table = figures.read_csv(table_path, columns)
    other = figures.read_csv(other_path, columns) if other_path else None
    fig, rows = plt.subplots(2 if other else 1, 1, figsize=(5.6, 6.2 if other else 3.8), sharex=True, squeeze=False,
                             height_ratios=(3, 2) if other else None)
    stress = rows[0][0]
    for name, colour in COMPONENTS.items():
        dashes = (0, (3, 2)) if name == "syx" else "-"
        stress.plot(100.0 * table["strain"], -1e-3 * table[name], color=colour, linestyle=dashes, label=name)
        if other:
            stress.plot(100.0 * other["strain"][::8], -1e-3 * other[name][::8], "o", color=colour, markersize=2.6,
                        markerfacecolor="none", markeredgewidth=0.7)
    if other:
        stress.plot([], [], "o", color=GREY, markersize=3, markerfacecolor="none", label=str(pathlib.Path(other_path.resolve().parent.name) / other_path.name))
        within = other["strain"] <= (1.0 + 1e-4) * table["strain"].max()  # steps may be integrated differently
        pressure = abs(other["sxx"][0] + other["syy"][0]) / 2.0
        for name, colour in COMPONENTS.items():
            ours = np.interp(other["strain"][within], table["strain"], table[name])
            error = 100.0 * (ours - other[name][within]) / pressure
            rows[1][0].plot(100.0 * other["strain"][within], error, color=colour, linewidth=1.0,
                            linestyle=(0, (3, 2)) if name == "syx" else "-",
                            label=f"{name}: rms {np.sqrt(np.mean(error**2)):.3f} %")
        rows[1][0].set(ylabel="difference [% of the\nconfining stress]")
        rows[1][0].margins(y=0.25)
        rows[1][0].legend(loc="lower left", ncol=2)
    rows[-1][0].set(xlabel="strain [%]")
    stress.set(ylabel="stress [kPa], compression positive", title=f"Replay: {table_path.name}")
    stress.legend(loc="best", ncol=2)
    return fig


def observations(folder):
    """Rows of calibration.csv: [(name, {column: number})]."""
    with open(folder / "calibration.csv", newline="") as file:
        return [(row.pop("name"), {name: float(cell) for name, cell in row.items()}) for row in csv.DictReader(file)]


def calibration(folder):
    # Without rows where no seed that was not used has a packing.
    curve = figures.read_csv(folder / "curve.csv", ["axial_strain", "sine", "volumetric_strain"], may_be_empty=True)
    angle = lambda sine: np.degrees(np.arcsin(np.clip(sine, -1.0, 1.0)))
    panels = {"sine of friction angle": ("mobilised friction angle [degrees]", angle, "sine"),
              "volumetric strain": ("volumetric strain [%]\n(contraction positive)", lambda strain: 100.0 * strain, "volumetric_strain")}
    rows = observations(folder)
    fig, axes = plt.subplots(2, 1, figsize=(5.4, 6.0), sharex=True, height_ratios=(3, 2))
    for panel, (name, (label, shown, column)) in zip(axes, panels.items()):
        panel.plot(100.0 * curve["axial_strain"], shown(curve[column]), color=BLUE, linewidth=1.0, label="packings of seeds not used")
        table = [row for of, row in rows if of == name]
        if table:
            x, wanted, value, scatter = (np.array([row[key] for row in table]) for key in ("axial_strain", "wanted", "value", "scatter"))
            panel.plot(100.0 * x, shown(wanted), "o", color=BLACK, markersize=4, markerfacecolor="none", label="data")
            panel.errorbar(100.0 * x, shown(value), yerr=np.abs(shown(value + scatter) - shown(value)), fmt=".", color=VERMILION, markersize=4,
                           elinewidth=0.8, label="packings that were fitted")
        panel.set(ylabel=label)
        panel.margins(y=0.15)
    said = []
    for name, row in rows:
        if row["axial_strain"] == 0.0:
            said.append(f"{name}: {row['wanted']:.4g} wanted, {row['value']:.4g} ± {row['scatter']:.2g}")
            if name.endswith("-friction"):
                axes[0].axhline(row["wanted"], color=BLACK, linewidth=0.8, linestyle=(0, (4, 3)))
    axes[0].set(title="\n".join(["Data and packings", *said]))
    axes[-1].set(xlabel="axial strain [%]")
    axes[0].legend(loc="best")
    return fig


def sensitivities(folder):
    """Change of each target from one bound of a parameter to the other, over its scatter; of a table's column the root mean square."""
    rows = observations(folder)
    names = list(dict.fromkeys(name for name, _ in rows))
    parameters = [key for key in rows[0][1] if key.startswith("per range of ")]
    fig, axes = plt.subplots(figsize=(5.4, 1.2 + 0.35 * len(names) * len(parameters)))
    for k, (key, colour) in enumerate(zip(parameters, itertools.cycle([BLUE, VERMILION, GREEN, ORANGE, PURPLE]))):
        sizes = [np.sqrt(np.mean([(row[key] / max(row["scatter"], 1e-12)) ** 2 for of, row in rows if of == name])) for name in names]
        axes.barh(np.arange(len(names)) + (k - 0.5 * (len(parameters) - 1)) * 0.8 / len(parameters), sizes, 0.8 / len(parameters), color=colour,
                  label=key.removeprefix("per range of "))
    axes.axvline(1.0, color=BLACK, linewidth=0.8)
    axes.set(yticks=range(len(names)), yticklabels=names, xscale="log", xlabel="change over the range of the parameter / scatter",
             title="Sensitivities: below 1 the data do not determine a parameter")
    axes.invert_yaxis()
    axes.legend(loc="best")
    return fig


def folder_figures(folder, overlays):
    """{name: draw} of what the folder holds."""
    found = {}
    if (folder / "packing_particles.csv").is_file():
        found["packing"] = lambda folder: packing(folder, "packing", "Prepared packing")
    stems = [stem for stem in STATES if (folder / f"{stem}_contacts.csv").is_file()]
    for stem in stems:
        found[stem] = lambda folder, stem=stem: packing(folder, stem, stem.capitalize())
    if stems:
        found["roses"] = lambda folder: roses(folder, stems)
    if (folder / "calibration.csv").is_file():
        found.update({"calibration": calibration, "sensitivities": sensitivities})
    if (folder / "path.csv").is_file():
        found.update({"curve": curve, "energies": energies})
    if (folder / "test.csv").is_file():
        found["test"] = lambda folder: laboratory(folder, overlays)
    return found


def draw_replay(arguments):
    picture = arguments.picture or arguments.place.with_suffix(".png")
    try:
        figures.save(replayed(arguments.place, arguments.compare), picture)
        print(picture)
    except (figures.InputError, OSError) as trouble:
        print(f"{picture} is not drawn: {trouble}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("place", type=pathlib.Path, help="output folder, or the table of a replay")
    parser.add_argument("--compare", type=pathlib.Path, help="another code's table with the same columns")
    parser.add_argument("--overlay", nargs="+", default=[], help="tables beside the test of a folder")
    parser.add_argument("--picture", type=pathlib.Path, help="of a replay (default: beside the table)")
    given = parser.parse_args()
    if given.place.is_dir():
        sys.argv = [sys.argv[0], str(given.place)]
        figures.draw_all(folder_figures(given.place, given.overlay))
    draw_replay(given)
