# SPDX-License-Identifier: BSL-1.0
"""plot.py OUTPUT_DIR: the figures of a fault rupture, in the manner of the reference study's figs. 1a, 3, 5 and 6."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import convergence_figures
import ensemble_figures
import footing_figures
import grain_figures
import ground_figures
import numpy as np
import packing_figures
import scarp_figures as figures
import water_figures
from field_figures import colour_limit, deviatoric_percent, draw_cells, draw_settlement, read_steps, status_note, triangles_of
from matplotlib.colors import Normalize, PowerNorm
from matplotlib.patheffects import withStroke
from matplotlib.tri import Triangulation
from scarp_figures import BLACK, BLUE, GREEN, GREY, VERMILION, plt

# Of the free field of the reference study, sec. 4.1 [m]: shown where a run repeats its site.
STUDY_OUTCROP = -12.5
CENTRIFUGE_OUTCROP = -9.8
PROBES = {"A": BLUE, "B": VERMILION}


def packing(folder):
    return packing_figures.draw_packing(folder, "Packing of an integration point")


def read_probe(folder, name):
    return figures.read_csv(folder / f"probe_{name}.csv", ["throw_over_depth", "eps_q", "eps_v", "q", "contact_fabric",
                                                           "particle_fabric", "void_ratio"])


def read_probes(folder):
    """{name: table} of the probes that can be read; says why another one cannot, fails when none can."""
    tables = {}
    troubles = []
    for name in PROBES:
        try:
            tables[name] = read_probe(folder, name)
        except figures.InputError as trouble:
            troubles.append(trouble)
    if not tables:
        raise troubles[0]
    for trouble in troubles:
        print(f"a probe is left out: {trouble}", file=sys.stderr)
    return tables


def probe_place(folder, name, throw, grid):
    """Centre [m] of the one element that shows the probe's void ratio and fabric at this throw, else None."""
    try:
        probe = read_probe(folder, name)
    except figures.InputError:
        return None
    row = figures.last_nearest(probe["throw_over_depth"], throw)
    if not np.isclose(probe["throw_over_depth"][row], throw, rtol=1e-9, atol=1e-12):
        return None
    alike = np.ones(len(grid.cells), dtype=bool)
    for quantity in ("void_ratio", "contact_fabric", "particle_fabric"):
        if quantity not in grid.at_cells:
            return None
        alike &= np.isclose(grid.at_cells[quantity], probe[quantity][row], rtol=1e-6, atol=0.0)
    place = grid.points[grid.cells[alike]].mean(axis=1)
    return place[0] if len(place) == 1 else None


def draw_bands(axes, summary, bedrock, depth):
    """Where half of the offset has passed at three levels and at the surface, in places before the fault moved; widths across."""
    places = [(band.get("band_x50"), bedrock + band["height_over_depth"] * depth, band.get("band_across"))
              for band in summary.get("bands") or []]
    places.append((summary.get("surface_x50"), bedrock + depth, None))
    places = [place for place in places if figures.finite(place[0]) is not None]
    if not places:
        return
    axes.plot([x for x, _, _ in places], [y for _, y, _ in places], "o--", color=VERMILION, markersize=4, linewidth=1.0,
              label="half of the offset (before the fault moved), and the band's width across")
    for x, y, width in places:
        if figures.finite(width) is not None:
            axes.annotate(f"{width:.1f} m", (x, y), xytext=(8, -3), textcoords="offset points", color=VERMILION,
                          path_effects=[withStroke(linewidth=2.0, foreground="white")])
    axes.legend(loc="lower left", fontsize=7)


def draw_layers(axes, summary, grid, depths):
    """Where another sand begins; depths: of the nodes before they moved [m]"""
    tops = summary.get("layer_tops", [])
    if tops:
        axes.tricontour(Triangulation(*grid.points.T, triangles_of(grid)), depths, levels=tops, colors=BLACK, linestyles="dashdot", linewidths=1.1)
        axes.plot([], [], "-.", color=BLACK, linewidth=1.1, label="top of another sand")


def tip_of(summary):
    """x of the fault's tip [m]"""
    return float(summary.get("run", {}).get("options", {}).get("tip", 0.0))


def draw_fault(axes, summary, bedrock, depth):
    """The fault's own line through the soil, along which a rigid hanging wall would rupture it, from the tip at rest."""
    tip = tip_of(summary)
    block = figures.finite(summary.get("fault_line_x50"))
    if block is not None:
        axes.plot([tip, block], [bedrock, bedrock + depth], ":", color=BLACK, linewidth=1.3, label="line of the fault",
                  path_effects=[withStroke(linewidth=2.6, foreground="white")])
    axes.plot(tip, bedrock, "^", color="white", markeredgecolor=BLACK, markersize=7, label="tip of the fault in bedrock", clip_on=False, zorder=5)


def deformation(folder):
    throw, grid, path = read_steps(folder, [1.0])[0]
    strain = deviatoric_percent(grid, path)
    fig, (upper, lower) = plt.subplots(2, 1, figsize=(7.6, 5.8), sharex=True, sharey=True)
    cells = draw_cells(upper, grid, strain, Normalize(0.0, colour_limit(strain)))
    fig.colorbar(cells, ax=upper, label="deviatoric strain [%]", extend="max", aspect=14)
    for name in PROBES:
        place = probe_place(folder, name, throw, grid)
        if place is not None:
            upper.plot(*place, "o", markersize=5, color="white", markeredgecolor=PROBES[name], markeredgewidth=1.6)
            upper.annotate(name, place, xytext=(6, 4), textcoords="offset points", color=PROBES[name], weight="bold",
                           path_effects=[withStroke(linewidth=2.0, foreground="white")])
    summary, depth = figures.read_summary(folder), layer_depth(folder)
    heights = (grid.points[:, :2] - figures.field(grid.at_nodes, "displacement", path)[:, :2])[:, 1]
    bedrock = float(np.min(heights))
    for number, edge in enumerate(zip(*summary.get("strip_edges", []))):
        upper.plot(np.array(edge, dtype=float), np.linspace(bedrock, bedrock + depth, len(edge)), "--", color=GREY, linewidth=0.9, label=None if number else "strip of small elements")
    draw_fault(upper, summary, bedrock, depth)
    draw_layers(upper, summary, grid, bedrock + depth - heights)
    upper.legend(loc="lower left", fontsize=7)
    upper.set_ylabel("y [m]")
    upper.set_title(f"Deformed mesh at h/H = {throw:.3g}, displacements to scale", loc="left")
    upper.set_title(f"largest strain {np.nanmax(strain):.3g} %{status_note(grid)}", loc="right", fontsize=7.5)
    draw_settlement(fig, lower, grid, path)
    for axes in (upper, lower):
        footing_figures.draw_block(axes, folder, summary, throw, bedrock + depth)
    lower.set(xlabel="x [m]", ylabel="y [m]")
    draw_bands(lower, summary, bedrock, depth)
    lower.set_title("Vertical displacement", loc="left")
    return fig


def strain_development(folder):
    steps = read_steps(folder, [1 / 8, 1 / 4, 1 / 2, 1])
    limit = colour_limit(deviatoric_percent(*steps[-1][1:]))
    norm = PowerNorm(0.5, 0.0, limit)  # the young band is faint beside the old one
    fig, panels = plt.subplots(len(steps), 1, figsize=(6.4, 0.6 + 2.0 * len(steps)), sharex=True, squeeze=False)
    for axes, (throw, grid, path) in zip(panels[:, 0], steps):
        cells = draw_cells(axes, grid, deviatoric_percent(grid, path), norm, edge=0.0)
        footing_figures.draw_block(axes, folder, figures.read_summary(folder), throw, ground_figures.surface_level(grid, path))
        axes.set(ylabel="y [m]", title=f"h/H = {throw:.3g}")
    panels[-1, 0].set_xlabel("x [m]")
    fig.colorbar(cells, ax=panels[:, 0], label="deviatoric strain [%], square-root scale", extend="max", aspect=35)
    return fig


def surface_profiles(table):
    """[(h/H, x [m], settlement [m])] of about six throws, spread evenly, the last one among them."""
    throws = np.unique(table["throw_over_depth"])
    throws = throws[throws > 0.0]
    if throws.size == 0:
        raise figures.InputError("'surface.csv' holds no throw above zero (the fault has not moved yet): let it run on")
    shown = {int(np.argmin(np.abs(throws - share * throws[-1]))) for share in np.linspace(1 / 6, 1, 6)}
    for throw in throws[sorted(shown)]:
        rows = np.flatnonzero(table["throw_over_depth"] == throw)
        rows = rows[np.argsort(table["x_initial"][rows], kind="stable")]
        gaps = np.flatnonzero(table["joined"][rows][1:] == 0) + 1  # no line is drawn across them
        yield throw, np.insert(table["x"][rows], gaps, np.nan), np.insert(table["settlement"][rows], gaps, np.nan)


def outcrop_marks(axes, summary):
    marks = [(figures.finite(summary.get("outcrop_x")), VERMILION, "-", "outcrop here, last throw"),
             (figures.finite(summary.get("steepest_x")), GREEN, "-.", "steepest slope here, last throw"),
             (figures.finite(summary.get("surface_mean")), GREEN, "-", "mean of the profile, last throw"),
             *((figures.finite(summary.get(f"surface_x{share}")), BLUE, line, f"{int(share)} % of the throw has passed here")
               for share, line in (("05", ":"), ("50", "-"), ("95", ":"))),
             (figures.finite(summary.get("fault_line_x50")), BLACK, "-.", "the fault's own line")]
    if summary.get("repeats_study") is True:
        marks += [(STUDY_OUTCROP, BLACK, "--", "reference study, free field: starts to deflect"),
                  (CENTRIFUGE_OUTCROP, GREY, ":", "centrifuge, as the reference study states it")]
    return [axes.axvline(x, color=colour, linestyle=line, linewidth=1.1, label=f"{text}: {x:.1f} m")
            for x, colour, line, text in marks if x is not None]


def layer_depth(folder):
    """[m], of the first region before it moved"""
    _, grid, path = read_steps(folder, [0.0])[0]
    return ground_figures.layer_depth(grid, path)


def surface(folder):
    table = figures.read_csv(folder / "surface.csv", ["throw_over_depth", "x_initial", "x", "settlement", "joined"])
    profiles = list(surface_profiles(table))
    summary = figures.read_summary(folder)
    depth = layer_depth(folder)
    fig, (upper, lower) = plt.subplots(2, 1, figsize=(7.0, 6.6), sharex=True)
    colours = plt.get_cmap("viridis_r")(np.linspace(0.15, 1.0, len(profiles)))
    lines = []
    for colour, (throw, x, settlement) in zip(colours, profiles):
        lines += upper.plot(x, settlement / depth, ".-", color=colour, markersize=3, label=f"h/H = {throw:.3g}{water_figures.drainage(folder, throw)}")
        lower.plot(x, settlement / (throw * depth), ".-", color=colour, markersize=3)
    marks = outcrop_marks(lower, summary) + footing_figures.draw_extent(lower, summary)
    outcrop_marks(upper, summary)
    footing_figures.draw_extent(upper, summary)
    for axes in (upper, lower):
        axes.invert_yaxis()
    tip = tip_of(summary)
    upper.secondary_xaxis("top", functions=(lambda x: (x - tip) / depth, lambda ratio: tip + ratio * depth)).set_xlabel("x/H from the tip [-]")
    upper.set_ylabel("settlement over depth of layer [-]")
    lower.set(xlabel="x [m]", ylabel="settlement over throw [-]")
    upper.legend(handles=lines, loc="lower left")
    lower.legend(handles=marks, loc="upper center", bbox_to_anchor=(0.5, -0.16), ncol=2)
    return fig


def probes(folder):
    fig, (stress, volume) = plt.subplots(2, 1, figsize=(5.4, 6.0), sharex=True)
    for name, probe in read_probes(folder).items():
        strain = 100.0 * probe["eps_q"]
        line = {"color": PROBES[name], "linestyle": "-" if name == "A" else "--"}
        stress.plot(strain, 1e-3 * probe["q"], label=f"{name}, to h/H = {probe['throw_over_depth'][-1]:.3g}", **line)
        volume.plot(strain, 100.0 * probe["eps_v"], **line)
        for axes, values in ((stress, 1e-3 * probe["q"]), (volume, 100.0 * probe["eps_v"])):
            axes.plot(strain[-1], values[-1], "o", color=PROBES[name], markersize=4)
    volume.axhline(0.0, color=BLACK, linewidth=0.8)
    stress.set(ylabel="deviatoric stress q [kPa]", title="Response at the probes")
    stress.set_ylim(bottom=min(0.0, stress.get_ylim()[0]))
    volume.set(xlabel="deviatoric strain [%]", ylabel="volumetric strain [%]\n(contraction positive)")
    stress.legend()
    return fig


def fabric(folder):
    fig, axes = plt.subplots(figsize=(5.4, 3.8), layout="constrained")
    for name, probe in read_probes(folder).items():
        strain = 100.0 * probe["eps_q"]
        axes.plot(strain, probe["contact_fabric"], color=PROBES[name], label=f"{name}: contact normals, Fc")
        axes.plot(strain, probe["particle_fabric"], "--", color=PROBES[name], label=f"{name}: long axes, Fp")
    axes.set(xlabel="deviatoric strain [%]", ylabel="fabric anisotropy [-]", title="Fabric at the probes",
             ylim=(0.0, None))
    axes.legend(ncol=2, loc="upper center", bbox_to_anchor=(0.5, -0.16))
    return fig


def figures_of(folder):
    """Those that the files of a run have something for: analytic soils have no packing, free fields no footing. An ensemble's members
    are runs in folders of their own."""
    if (folder / "ensemble.json").exists():
        return {"ensemble": ensemble_figures.ensemble}
    chosen = {"deformation": deformation, "strain_development": strain_development, "surface": surface,
              "rupture": ground_figures.rupture, "stress_crosses": ground_figures.stress_crosses,
              "probes": probes, "convergence": convergence_figures.convergence,
              "effort": convergence_figures.effort}
    if (folder / "packing_grains.csv").exists():
        chosen |= {"packing": packing, "fabric": fabric}
    if any((folder / "packings" / f"{name}.csv").exists() for name in PROBES):
        chosen |= {"probe_packings": grain_figures.packings, "probe_roses": grain_figures.roses}
    if (folder / "footing.csv").exists():
        chosen |= {"footing": footing_figures.footing, "base_pressure": footing_figures.base_pressure}
    if water_figures.has_begun(folder):
        chosen |= {"excess_pressure": water_figures.excess_pressure, "pressures": water_figures.pressures, "water": water_figures.water}
    return chosen


if __name__ == "__main__":
    figures.draw_all(figures_of(pathlib.Path(sys.argv[1] if len(sys.argv) > 1 else ".")))
