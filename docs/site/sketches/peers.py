# SPDX-License-Identifier: BSL-1.0
"""Bars of the comparison with other codes: their CPU time over that of scarp, from docs/data/peers_*.csv."""
import csv

from drawing import ROOT, house, plt, save

DATA = ROOT / "docs" / "data"


def rows(name):
    return list(csv.DictReader((DATA / f"peers_{name}.csv").read_text().splitlines()[1:]))


def time_of(row):
    """Median time per grain and step [ns]."""
    return float(next(value for name, value in row.items() if name.startswith("ns per grain") and "median" in name))


def ratios(name, peer, what):
    """[(label, ratio with the machine's own instructions, ratio with AVX2)] for each number of grains."""
    times = {(row["grains"], row["program"]): time_of(row) for row in rows(name)}
    sizes = list(dict.fromkeys(grains for grains, _ in times))
    return [(f"{peer}: DEM step, {grains} {what}",
             *(times[grains, peer] / times[grains, f"scarp, {level}"] for level in ("native", "x86-64-v3"))) for grains in sizes]


def chart():
    biaxial = {row["program"]: float(row["CPU time per load step [s]"]) for row in rows("biaxial")}
    bars = [*ratios("lammps", "LAMMPS", "spheres"), *ratios("yade", "Yade", "discs"),
            ("FEMxDEM (Yade): load step, 32 packings", biaxial["Yade"] / biaxial["scarp"], None)]
    figure, axes = plt.subplots(figsize=(7.2, 2.9))
    for line, (_, native, avx2) in enumerate(bars):
        two = avx2 is not None
        for value, shift, colour in ((native, -0.2 if two else 0.0, house.BLUE), (avx2, 0.2, house.SKY)):
            if value is None:
                continue
            axes.barh(line + shift, value - 1.0, 0.38, left=1.0, color=colour,
                      label={house.BLUE: "scarp with the machine's instructions", house.SKY: "scarp with AVX2"}[colour] if line == 0 else None)
            axes.text(value * 1.05, line + shift, f"{value:.1f}" if value < 10 else f"{value:.0f}", va="center", fontsize=7.5)
    axes.set_yticks(range(len(bars)), [name for name, _, _ in bars])
    values = [value for bar in bars for value in bar[1:] if value is not None]
    axes.set(xscale="log", xlim=(min(1.0, 0.8 * min(values)), 1.8 * max(values)), xlabel="CPU time of the other code over that of scarp, one thread")
    axes.set_xticks([1, 2, 5, 10, 20, 50, 100], ["1", "2", "5", "10", "20", "50", "100"])
    axes.minorticks_off()
    axes.invert_yaxis()
    axes.grid(axis="y", visible=False)
    axes.legend(loc="upper right")
    return figure


save(chart(), "peers")
