# SPDX-License-Identifier: BSL-1.0
"""figures.py OUTPUT_DIR: K0, void ratio and fabric of every preparation in preparations.csv, as docs/figures/preparations.png and as the
tables of docs/preparations.md between its two marks. A quick run leaves both as they are."""

import json
import math
import pathlib
import statistics
import sys

sys.dont_write_bytecode = True
root = pathlib.Path(__file__).resolve().parents[2]
sys.path[:0] = [str(root / "benchmarks"), str(root / "benchmarks" / "compile"), str(root / "examples" / "shared")]
import groups
import scarp_figures as figures
from generated_sections import rewrite, spread, table, with_section
from groups import KEPT_FROM, STUDY_K0, STUDY_VOID_RATIO, TESTED_AT
from provenance import head_of
from scarp_figures import plt

STUDY_CONTACT_FABRIC = 0.05
COLOURS = {"one-dimensional": figures.BLACK, "one-dimensional, ten times slower": figures.BLACK, "low friction to the end": figures.SKY,
           "falling friction": figures.SKY, "rising friction": figures.BLUE,
           "rising friction from 0.5 kPa": figures.BLUE, "preloaded": figures.VERMILION, "preloaded from 0.5 kPa": figures.VERMILION,
           "isotropic share": figures.GREEN, "isotropic share at low friction": figures.GREEN, "one isotropic packing": figures.GREY,
           "candidate: rising friction": figures.BLUE, "candidate: preloaded": figures.VERMILION, "candidate: isotropic share": figures.GREEN,
           "candidate: held ratio": figures.PURPLE, "held ratio": figures.PURPLE, "held ratio from the mean stress": figures.PURPLE, "laid grains": figures.ORANGE}
MARKERS = {"rising friction from 0.5 kPa": "s", "preloaded from 0.5 kPa": "s", "one-dimensional, ten times slower": "x", "falling friction": "v", "isotropic share at low friction": "^",
           "held ratio from the mean stress": "^"}


def correlation(some, others):
    varied = len(set(some)) > 1 and len(set(others)) > 1
    return f"{statistics.correlation(some, others):.2f}" if varied else "-"


def draw(path, preparations):
    drawn, (ratios, fabrics, names) = plt.subplots(1, 3, figsize=(10.5, 4.2), width_ratios=[4, 4, 2])
    ratios.add_patch(plt.Rectangle((STUDY_VOID_RATIO[0], STUDY_K0[0]), STUDY_VOID_RATIO[1] - STUDY_VOID_RATIO[0], STUDY_K0[1] - STUDY_K0[0],
                                   facecolor="#FFE45C", edgecolor=figures.BLACK, zorder=0.5, label="the study's"))
    fabrics.axvspan(*STUDY_K0, color="#FFE45C", alpha=0.5, zorder=0.5)
    fabrics.axhline(STUDY_CONTACT_FABRIC, color=figures.BLACK, linewidth=0.8, linestyle="--")
    named = set()
    for made in preparations:
        colour, marker = COLOURS[made.path], "*" if made.is_candidate() else MARKERS.get(made.path, "o")
        size = 11 if made.is_candidate() else 4
        depth = [o for o in made.overburdens() if o >= KEPT_FROM and made.values("k0", o)]
        if not depth:
            continue
        ratios.plot([made.mean("void_ratio", o) for o in depth], [made.mean("k0", o) for o in depth], color=colour,
                    linewidth=2.0 if made.is_candidate() else 0.7, alpha=1.0 if made.is_candidate() else 0.4)
        ratios.plot(made.mean("void_ratio", TESTED_AT), made.mean("k0", TESTED_AT), marker, color=colour, markersize=size,
                    label=None if made.path in named else made.path)
        fabrics.plot(made.mean("k0", TESTED_AT), made.mean("contact_fabric", TESTED_AT), marker, color=colour, markersize=size)
        named.add(made.path)
    ratios.set(xlabel="void ratio", ylabel="K0", xlim=(0.12, 0.23), ylim=(0.25, 0.85))
    fabrics.set(xlabel="K0 at 200 kPa", ylabel="contact fabric at 200 kPa", xlim=(0.25, 0.85), ylim=(0.0, None))
    names.axis("off")
    names.legend(*ratios.get_legend_handles_labels(), loc="center left")
    drawn.savefig(path, dpi=100)
    plt.close(drawn)


def of_all(preparations):
    rows = []
    for made in preparations:
        arrived = len(made.seeds())
        rows.append([made.path, made.friction(), made.choice(), *(spread(made.values("k0", o), 3) for o in (4e3, 20e3, 100e3, 200e3, 396e3)),
                     spread(made.values("void_ratio", 4e3), 3), spread(made.values("void_ratio", 396e3), 3),
                     spread(made.values("coordination", TESTED_AT), 2), spread(made.values("contact_fabric", TESTED_AT), 3),
                     spread(made.values("particle_fabric", TESTED_AT), 3),
                     ("**both**" if made.has_k0() else "e") if made.has_void_ratio() else ("K0" if made.has_k0() else "-"),
                     f"{made.inside()} of {arrived}"])
    return table(["path", "friction of the isotropic part", "choice", "K0 at 4 kPa", "20 kPa", "100 kPa", "200 kPa", "396 kPa", "e at 4 kPa",
                  "e at 396 kPa", "contacts", "F_c", "F_p", "means inside", "packings inside"], rows)


def of_tests(preparations):
    rows = []
    for made in preparations:
        narrow = made.values("narrow_friction_angle", TESTED_AT)
        if not narrow:
            continue
        wide = made.values("friction_angle", TESTED_AT)
        sine = math.sin(math.radians(statistics.fmean(narrow)))
        rows.append([made.path, made.friction(), made.choice(), spread(made.values("k0", TESTED_AT), 3),
                     spread(made.values("elastic_k0", TESTED_AT), 3), spread(narrow, 1), spread(wide, 1),
                     spread(made.values("dilation_angle", TESTED_AT), 1), f"{1.0 - sine:.3f}", f"{(1.0 - sine) / (1.0 + sine):.3f}"])
    return table(["path", "friction of the isotropic part", "choice", "K0", "elastic K0", "phi_max, window 0.5 %", "5 %", "psi, secant", "1 - sin phi",
                  "Rankine's active"], rows)


def of_strains(preparations):
    rows = [[made.path, made.friction(), spread([100.0 * v for v in made.values("lateral_strain", 396e3)], 2),
             spread([100.0 * v for v in made.values("vertical_strain", 396e3)], 2)] for made in preparations if made.held()]
    return table(["path", "friction of the isotropic part", "lateral strain at 396 kPa [%]", "vertical strain [%]"], rows)


def of_clouds(made):
    """What the clouds of one preparation owe to chance, at 200 kPa."""
    k0, others = made.values("k0", TESTED_AT), {}
    for name, column in (("void ratio", "void_ratio"), ("contacts", "coordination"), ("F_c", "contact_fabric"), ("F_p", "particle_fabric"),
                         ("F_p along the horizontal", "level_particle_fabric")):
        others[name] = made.values(column, TESTED_AT)
    rows = [[name, spread(values, 3), correlation(k0, values)] for name, values in others.items()]
    few = [k for k, fabric in zip(k0, others["F_p"]) if fabric < 0.05]
    text = table(["at 200 kPa", "mean +- deviation", "correlation with K0"], [["K0", spread(k0, 3), "1"], *rows])
    return (f"{text}\n\nK0 from {min(k0):.3f} to {max(k0):.3f}; of the {len(few)} clouds with F_p below 0.05: {spread(few, 3)}.")


def section(run, preparations):
    scene = next(made for made in preparations if made.is_scene())
    return "\n\n".join([
        f"{head_of('./benchmarks/run preparations', ['g++'])} {run['seeds']} clouds of {run['grains']} grains, {run['cpu_seconds'] / 60:.0f} CPU "
        f"minutes. Mean +- standard deviation over the clouds.",
        "### The scene's preparation and the candidates", of_all([scene, *(made for made in preparations if made.is_candidate())]),
        "### Biaxial tests at 200 kPa", of_tests(preparations),
        "### All preparations", of_all(preparations),
        "![K0 and contact fabric of all preparations](figures/preparations.png)",
        "### Strains where the stress ratio is held", of_strains(preparations),
        "### The clouds of the scene's preparation", of_clouds(scene)])


def main():
    if len(sys.argv) != 2 or not (pathlib.Path(sys.argv[1]) / "run.json").is_file():
        print(f"usage: {sys.argv[0]} OUTPUT_DIR   (which ./benchmarks/run preparations wrote)", file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    run = json.loads((folder / "run.json").read_text())
    preparations = groups.read(folder / "preparations.csv")
    if run["quick"]:
        draw(folder / "preparations.png", preparations)
        return 0
    draw(root / "docs" / "figures" / "preparations.png", preparations)
    page = root / "docs" / "preparations.md"
    rewrite(page, with_section(page.read_text(), "preparations", section(run, preparations)))
    return 0


if __name__ == "__main__":
    sys.exit(main())
