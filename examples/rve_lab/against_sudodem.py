# SPDX-License-Identifier: BSL-1.0
"""against_sudodem.py FOLDER --scatter BIAXIAL.csv [--picture FILE.png]: FOLDER/A.csv and FOLDER/G.csv of `rve_lab
replay` beside SudoDEM's own tests of the same packings (tests/reference/sudodem). Prints the differences of stress ratio
and volumetric strain over the sample standard deviation of `rve_biaxial`'s packings, prepared with the same friction."""

import argparse
import pathlib
import sys

sys.dont_write_bytecode = True
here = pathlib.Path(__file__).resolve()
sys.path.insert(0, str(here.parents[1] / "shared"))
import numpy as np
import scarp_figures as figures
from scarp_figures import BLACK, BLUE, PALE, VERMILION, plt

REFERENCE = here.parents[2] / "tests" / "reference" / "sudodem"
FRICTIONS = {"A": 0.10, "G": 0.15}  # during consolidation
STRAINS = np.arange(1, 61) * 5e-4   # of SudoDEM's rows
SHOWN = (0.001, 0.0025, 0.005, 0.01, 0.015, 0.02, 0.025, 0.03)


def at_strains(axial, *quantities):
    return [np.interp(STRAINS, axial, quantity) for quantity in quantities]


def sudodem(name):
    """Stress ratio and volumetric strain; its strains are positive in extension."""
    table = figures.read_csv(REFERENCE / f"{name}_biaxial.csv", ["ey", "ex", "sxx", "syy"])
    return at_strains(-table["ey"], table["syy"] / table["sxx"], -table["ex"] - table["ey"])


def replayed(path):
    table = figures.read_csv(path, ["strain", "Fxx", "Fyy", "sxx", "syy"])
    if table["strain"][-1] < STRAINS[-1] - 1e-9:
        raise figures.InputError(f"'{path}' ends at strain {table['strain'][-1]:g} ({STRAINS[-1]} is wanted): replay on")
    return at_strains(-np.log(table["Fyy"]), table["syy"] / table["sxx"], -np.log(table["Fxx"] * table["Fyy"]))


def packings(path, friction):
    """Stress ratios and volumetric strains of all packings with this preparation friction."""
    table = figures.read_csv(path, ["preparation_friction", "seed", "axial_strain", "axial_stress", "lateral_stress",
                                    "volumetric_strain"])
    found = []
    mine = np.isclose(table["preparation_friction"], friction)
    for seed in np.unique(table["seed"][mine]):
        run = {name: values[mine & (table["seed"] == seed)] for name, values in table.items()}
        found.append(at_strains(run["axial_strain"], run["axial_stress"] / run["lateral_stress"],
                                run["volumetric_strain"]))
    if len(found) < 2:
        raise figures.InputError(f"'{path}' holds {len(found)} packings of preparation friction {friction} (a scatter "
                                 "needs two): run rve_biaxial with it")
    return np.array(found).swapaxes(0, 1)


def report(name, quantity, ours, theirs, scatter, factor, unit):
    error = ours - theirs
    ratio = error / scatter
    late = STRAINS > 0.00075
    print(f"\n{name}, {quantity}: rms {factor * np.sqrt(np.mean(error**2)):.4f}{unit}, largest "
          f"{factor * np.abs(error).max():.4f}{unit}; over the scatter: rms {np.sqrt(np.mean(ratio**2)):.2f}, largest "
          f"{np.abs(ratio).max():.2f} at {100.0 * STRAINS[np.abs(ratio).argmax()]:.2f} %, from 0.1 % on "
          f"{np.abs(ratio[late]).max():.2f}")
    print("  strain [%]   SudoDEM      here   difference   scatter   difference/scatter")
    for strain in SHOWN:
        k = np.abs(STRAINS - strain).argmin()
        print(f"  {100.0 * strain:10.2f} {factor * theirs[k]:9.4f} {factor * ours[k]:9.4f} {factor * error[k]:12.4f} "
              f"{factor * scatter[k]:9.4f} {ratio[k]:20.2f}")


def draw(cases):
    fig, rows = plt.subplots(2, 2, figsize=(7.2, 5.4), sharex=True, sharey="row")
    for column, (name, (ours, theirs, scatter)) in enumerate(cases.items()):
        for axes, k, factor in ((rows[0][column], 0, 1.0), (rows[1][column], 1, 100.0)):
            axes.fill_between(100.0 * STRAINS, factor * (theirs[k] - scatter[k]), factor * (theirs[k] + scatter[k]),
                              color=PALE, linewidth=0, label="SudoDEM ± seed scatter here")
            axes.plot(100.0 * STRAINS, factor * theirs[k], "o", color=BLACK, markersize=2.6, label="SudoDEM")
            axes.plot(100.0 * STRAINS, factor * ours[k], color=(BLUE, VERMILION)[column], label="the same packing here")
        rows[0][column].set_title(f"{name}, prepared with friction {FRICTIONS[name]:.2f}")
        rows[1][column].legend(loc="lower right")
        rows[1][column].set_xlabel("axial strain [%]")
    rows[0][0].set_ylabel("axial over lateral stress [-]")
    rows[1][0].set_ylabel("volumetric strain [%]\n(contraction positive)")
    return fig


parser = argparse.ArgumentParser(description=__doc__)
parser.add_argument("folder", type=pathlib.Path)
parser.add_argument("--scatter", type=pathlib.Path, required=True)
parser.add_argument("--picture", type=pathlib.Path)
given = parser.parse_args()
try:
    cases = {}
    for name, friction in FRICTIONS.items():
        ours, theirs = replayed(given.folder / f"{name}.csv"), sudodem(name)
        scatter = packings(given.scatter, friction).std(axis=1, ddof=1)
        cases[name] = ours, theirs, scatter
        report(name, "stress ratio", ours[0], theirs[0], scatter[0], 1.0, "")
        report(name, "volumetric strain [%]", ours[1], theirs[1], scatter[1], 100.0, " %")
    if given.picture:
        figures.save(draw(cases), given.picture)
        print(f"\n{given.picture}")
except (figures.InputError, OSError) as trouble:
    print(trouble, file=sys.stderr)
    sys.exit(1)
