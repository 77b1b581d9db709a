# SPDX-License-Identifier: BSL-1.0
"""Sketches of the fault scene and of the measures of a rupture; numbers are the defaults of FaultMesh, FaultScene and `fault_rupture`."""
import numpy as np
from drawing import arrow, canvas, dimension, house, save
from matplotlib.patches import Rectangle

LEFT, RIGHT, DEPTH = -52.0, 23.0, 25.0


def scene():
    figure, (axes,) = canvas(8.4, 4.1, (-65, 36, -14, 37))
    axes.add_patch(Rectangle((LEFT, 0), RIGHT - LEFT, DEPTH, facecolor="#F7F3EC", edgecolor=house.BLACK))
    axes.add_patch(Rectangle((-15.5, DEPTH), 10, 1.4, facecolor=house.SKY, edgecolor=house.BLACK))
    axes.text(-10.5, DEPTH + 6.6, "footing, 10 m,\n37 or 91 kPa", ha="center", va="center", fontsize=8)
    for x in (-13.5, -10.5, -7.5):
        arrow(axes, (x, DEPTH + 4.2), (x, DEPTH + 1.6), colour=house.SKY)
    for x in np.arange(LEFT + 3, RIGHT, 6.0):
        if not -19 < x < -3:
            arrow(axes, (x, DEPTH + 2.6), (x, DEPTH + 0.3), colour=house.GREY)
    axes.text(10, DEPTH + 4.3, "surcharge 4 kPa", ha="center", fontsize=8, color=house.GREY)
    for x in np.arange(LEFT, -0.5, 2.6):
        axes.plot([x, x + 1.3], [-1.5, 0], color=house.BLACK, linewidth=0.7)
    for y in np.arange(0.5, DEPTH, 2.6):
        axes.plot([LEFT - 1.5, LEFT], [y - 1.3, y], color=house.BLACK, linewidth=0.7)
    for x in np.arange(8, RIGHT + 1, 5.0):
        arrow(axes, (x, -0.4), (x + 2.2, -0.4 - 2.2 * np.sqrt(3)), colour=house.VERMILION)
    for y in np.arange(4, DEPTH, 7.0):
        arrow(axes, (RIGHT + 0.5, y), (RIGHT + 2.7, y - 2.2 * np.sqrt(3)), colour=house.VERMILION)
    axes.plot([-0.0, 6.9], [0, -12], color=house.BLACK, linewidth=1.0, linestyle="-.")
    axes.plot(0, 0, "o", color=house.BLACK, markersize=5)
    axes.text(-0.8, 1.0, "tip (0, 0)", ha="right", fontsize=8)
    angle = np.linspace(-np.pi / 3, 0, 30)
    axes.plot(6 * np.cos(angle), 6 * np.sin(angle), color=house.BLACK, linewidth=0.8)
    axes.text(2.0, -6.5, "dip 60°", fontsize=8, va="center", ha="right")
    axes.text(-27, -4.0, "footwall: bottom and left side fixed", ha="center", fontsize=8)
    axes.text(10.5, -8.5, "hanging wall: bottom and right side\nslide down the fault; vertical part $h$", fontsize=8, color=house.VERMILION, va="center")
    for name, x, y in (("A", -3.5, 6.0), ("B", -20.0, 12.0)):
        axes.plot(x, y, "s", color=house.PURPLE, markersize=5)
        axes.text(x - 1.2, y, name, ha="right", va="center", fontsize=9, color=house.PURPLE)
    axes.text(-19, 9.3, "A, B: default probes", ha="center", fontsize=8, color=house.PURPLE)
    axes.text(-38, 14.5, r"soil, $\gamma=15.68$ kN/m³" + "\na packing at every integration point", ha="center", va="center", fontsize=8)
    dimension(axes, (LEFT, -10.5), (0, -10.5), "52 m", shift=(0, 1.4))
    dimension(axes, (0, 35), (RIGHT, 35), "23 m", shift=(0, -1.4))
    dimension(axes, (LEFT - 4, 0), (LEFT - 4, DEPTH), "H = 25 m", shift=(-4.8, 0))
    arrow(axes, (31, -2), (34, -2), "x", at=1.0, shift=(-0.6, -1.4))
    arrow(axes, (31, -2), (31, 2), "y", at=1.0, shift=(-1.0, -0.8))
    return figure


def profile(x):
    """Settlement over the throw of an imagined profile with a long tail towards the footwall."""
    return 1.0 / (1.0 + np.exp(-(x + 11.0) / 2.6)) ** 0.8


def measures():
    figure, (axes,) = canvas(8.4, 3.0, (-36, 17, -14.5, 4.5))
    x = np.linspace(-33, 9, 1000)
    share = profile(x)
    scale = -9.0
    axes.fill_between(x, scale * share, scale * 1.35, color="#F7F3EC", linewidth=0)
    axes.plot(x, scale * share, color=house.BLACK, linewidth=1.8)
    axes.plot([-33, 9], [0, 0], color=house.GREY, linestyle=":", linewidth=1.0)
    for part, name in ((0.05, "x05"), (0.5, "x50"), (0.95, "x95")):
        at = x[np.argmax(share >= part)]
        axes.plot([at, at], [1.2, scale * part], color=house.BLUE, linewidth=0.9, linestyle="--")
        axes.plot(at, scale * part, "o", color=house.BLUE, markersize=4.5)
        axes.text(at, 1.5, name, ha="center", fontsize=8.5, color=house.BLUE)
    slope = np.gradient(share, x)
    steepest = np.argmax(slope)
    start = x[steepest] - share[steepest] / slope[steepest]
    end = start + 1.0 / slope[steepest]
    axes.plot([start, end], [0, scale], color=house.VERMILION, linewidth=1.2)
    axes.plot(start, 0, "^", color=house.VERMILION, markersize=6)
    axes.text(start + 0.6, 0.4, "outcrop_x", ha="left", fontsize=8.5, color=house.VERMILION)
    dimension(axes, (start, -10.4), (end, -10.4), "outcrop_width", shift=(0, -0.8))
    mean = 9 - np.trapz(share, x)
    axes.plot([-33, mean, mean, 9], [0, 0, scale, scale], color=house.GREEN, linewidth=1.1, linestyle="-.")
    axes.text(mean + 0.4, -1.4, "mean: the same area\nbelow one step", fontsize=8, color=house.GREEN, va="center")
    dimension(axes, (11, 0), (11, scale), "throw $h$", shift=(2.0, 0))
    axes.text(-32.5, -2.4, "footwall", fontsize=8)
    axes.text(4.2, -8.2, "hanging wall", fontsize=8)
    arrow(axes, (0, -13.9), (0, -12.6), "above the tip, x = 0", shift=(0.5, -0.1), ha="left")
    return figure


save(scene(), "fault")
save(measures(), "measures")
