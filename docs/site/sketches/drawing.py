# SPDX-License-Identifier: BSL-1.0
"""What the sketches share: axes in units of the drawing, boxes, arrows, dimensions, and PNG files."""
import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[3]
sys.dont_write_bytecode = True
sys.path.insert(0, str(ROOT / "examples" / "shared"))
import scarp_figures as house
from matplotlib.patches import FancyArrowPatch, FancyBboxPatch

plt = house.plt
plt.rcParams.update({"savefig.dpi": 150, "mathtext.fontset": "dejavusans"})


def canvas(width, height, limits, columns=1):
    """A figure of so many inches with axes that are not drawn. limits: (x0, x1, y0, y1) of each."""
    figure, axes = plt.subplots(1, columns, figsize=(width, height), squeeze=False)
    for one in axes[0]:
        one.set(xlim=limits[:2], ylim=limits[2:], aspect="equal")
        one.axis("off")
    return figure, axes[0]


def box(axes, x, y, width, height, text, colour=house.BLUE, size=8.5, filled=True):
    """A rounded box about (x, y) with a text."""
    axes.add_patch(FancyBboxPatch((x - width / 2, y - height / 2), width, height, boxstyle="round,pad=0,rounding_size=0.08",
                                  facecolor=colour + "18" if filled else "none", edgecolor=colour, linewidth=1.1))
    axes.text(x, y, text, ha="center", va="center", fontsize=size, color=house.BLACK, linespacing=1.35)


def arrow(axes, start, end, text="", colour=house.BLACK, at=0.5, shift=(0, 0), bend=0.0, style="-|>", size=8, **text_options):
    axes.add_patch(FancyArrowPatch(start, end, arrowstyle=style, mutation_scale=10, color=colour, linewidth=1.2, shrinkA=0, shrinkB=0,
                                   connectionstyle=f"arc3,rad={bend}"))
    if text:
        place = [a + at * (b - a) + d for a, b, d in zip(start, end, shift)]
        axes.text(*place, text, fontsize=size, color=colour, **{"ha": "center", "va": "center", **text_options})


def dimension(axes, start, end, text, shift=(0, 0)):
    """A line with two heads and a length."""
    arrow(axes, start, end, text, house.GREY, shift=shift, style="<|-|>", size=8)


def save(figure, name):
    path = ROOT / "docs" / "figures" / f"sketch_{name}.png"
    figure.savefig(path, metadata={"Software": None})
    plt.close(figure)
    print(path.relative_to(ROOT), path.stat().st_size)
