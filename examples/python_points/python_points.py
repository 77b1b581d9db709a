# SPDX-License-Identifier: BSL-1.0
"""How does Python call packings as materials? A drained biaxial test by NumPy, the same path in C++, and where the time goes."""
import argparse
import csv
import pathlib
import platform
import subprocess
import sys
import time

import matplotlib
import numpy as np
import scarp

matplotlib.use("Agg")
from matplotlib import pyplot as plt


class Path:
    """Points with all gradients that they responded to, and the time that they took."""

    def __init__(self, points, threads):
        self.points, self.threads, self.seconds, self.rows, self.stresses = points, threads, 0.0, [], []

    def respond(self, gradients, tangents=False):
        start = time.perf_counter()
        stresses, moduli, verdicts = self.points.respond(gradients, threads=self.threads, tangents=tangents)
        self.seconds += time.perf_counter() - start
        self.rows.append(np.concatenate([[0.0], gradients.ravel()]))
        self.stresses.append(stresses)
        return stresses, moduli, verdicts

    def commit(self):
        self.points.commit()
        self.rows[-1][0] = 1.0


def step(path, axial, pressure, lateral, most=30):
    """One increment: the axial gradient is given, the lateral one (changed in place) holds sigma_xx at the pressure [Pa].
    Returns the stresses [Pa] and the number of responses."""
    gradients = np.zeros((len(lateral), 2, 2))
    gradients[:, 1, 1] = axial
    slope = path.points.tangents()[:, 0, 0]
    before = None
    for responses in range(1, most + 1):
        gradients[:, 0, 0] = lateral
        stresses, _, verdicts = path.respond(gradients)
        if verdicts["status"].max() > 1:
            raise RuntimeError(f"a point does not respond ({path.points.report()}): take smaller steps")
        missing = -pressure - stresses[:, 0]
        if np.abs(missing).max() <= 1e-3 * pressure:
            return stresses, responses
        if before is not None:  # the secant, as far as it is one
            moved, changed = lateral - before[0], before[1] - missing
            secant = np.divide(changed, moved, out=np.zeros_like(moved), where=moved != 0.0)
            slope = np.where(secant > 0.05 * slope, secant, slope)
        before = lateral.copy(), missing
        lateral += np.where(np.abs(missing) <= 1e-4 * pressure, 0.0, missing / slope)
    raise RuntimeError(f"sigma_xx misses {np.abs(missing).max():.4g} Pa after {most} responses: take smaller steps")


def test(path, given):
    """Rows of axial strain, then per point q/p, volumetric strain (contraction positive), and the iterations. Strains are logarithmic."""
    count = len(path.points)
    lateral = np.zeros(count)
    strains = np.zeros((2, count))
    rows = [(0.0, quotient(path.points.stresses()), strains.sum(axis=0), 0)]
    axial = np.expm1(-given.step)
    for number in range(1, round(given.strain / given.step) + 1):
        stresses, responses = step(path, axial, given.pressure, lateral)
        path.commit()
        strains -= np.log1p([lateral, np.full(count, axial)])
        rows.append((number * given.step, quotient(stresses), strains.sum(axis=0), responses))
    return rows


def different_points(sand, count):
    """A point for each packing: indices decide which one is drawn, so those of enough points are tried."""
    tried = scarp.MaterialPoints(sand, np.zeros((20 * count, 2)))
    _, indices = np.unique([tried.quantities(k)["void_ratio"] for k in range(len(tried))], return_index=True)
    return scarp.MaterialPoints(sand, np.zeros((len(indices), 2)), indices=indices.tolist())


def quotient(stresses):
    """q/p of the stresses."""
    q = np.hypot(stresses[:, 0] - stresses[:, 1], 2.0 * stresses[:, 2])
    return q / -(stresses[:, 0] + stresses[:, 1]) * 2.0


def in_cpp(path, start, folder):
    """The largest difference [Pa] from the stresses of the same points and gradients in C++, and the seconds that it took."""
    program = pathlib.Path(scarp.__file__).resolve().parents[1] / "same_path"
    np.concatenate(path.rows).tofile(folder / "path.bin")
    said = subprocess.run([program, start, folder / "path.bin", folder / "stresses.bin", str(path.threads)], check=True,
                          capture_output=True, text=True).stdout
    theirs = np.fromfile(folder / "stresses.bin").reshape(np.shape(path.stresses))
    return np.abs(theirs - np.array(path.stresses)).max(), float(said)


def draw(rows, picture, file, lab):
    strain = 100.0 * np.array([row[0] for row in rows])
    figure, (stress, volume, packing) = plt.subplots(1, 3, figsize=(10.0, 3.2), layout="constrained")
    stress.plot(strain, [row[1] for row in rows], color="#0072B2", linewidth=0.8)
    volume.plot(strain, 100.0 * np.array([row[2] for row in rows]), color="#0072B2", linewidth=0.8)
    if lab:
        stress.plot(100.0 * lab["strain"], lab["mean_q"] / lab["mean_p"], color="#D55E00", linestyle="--", label="rve_lab")
        volume.plot(100.0 * lab["strain"], 100.0 * lab["volumetric_strain"], color="#D55E00", linestyle="--")
        stress.legend()
    stress.set(xlabel="axial strain [%]", ylabel="q/p [-]")
    volume.set(xlabel="axial strain [%]", ylabel="volumetric strain [%]\n(contraction positive)")
    for x, y, a, b, along, across in picture["grains"]:
        packing.add_patch(matplotlib.patches.Ellipse((x, y), 2 * a, 2 * b, angle=np.degrees(np.arctan2(across, along)), facecolor="#D8D8D8"))
    places, forces = picture["contacts"][:, :4], picture["contacts"][:, 6]
    lines = np.stack([places[:, :2], places[:, :2] + places[:, 2:]], axis=1)
    packing.add_collection(matplotlib.collections.LineCollection(lines, linewidths=3.0 * forces / forces.max(), colors="#0072B2"))
    packing.set_aspect("equal")
    packing.autoscale_view()
    packing.set(xlabel="point 0 at the end, force chains", xticks=[], yticks=[])
    figure.savefig(file, dpi=160)


def numbers(path):
    """Of rve_lab, whose strain is the axial one."""
    with open(path, newline="") as file:
        rows = list(csv.DictReader(file))
    return {name: np.array([float(row[name]) for row in rows]) for name in ("strain", "mean_p", "mean_q", "volumetric_strain")}


def main():
    parser = argparse.ArgumentParser(description=__doc__)
    parser.add_argument("--grains", type=int, default=400)
    parser.add_argument("--packings", type=int, default=4, help="of different seeds, a point each")
    parser.add_argument("--seed", type=int, default=1)
    parser.add_argument("--pressure", type=float, default=2e5, help="isotropic at first, lateral in the test [Pa]")
    parser.add_argument("--strain", type=float, default=0.05, help="axial, logarithmic")
    parser.add_argument("--step", type=float, default=1e-3, help="of the axial strain")
    parser.add_argument("--threads", type=int, default=2)
    parser.add_argument("--lab", type=pathlib.Path, help="folder of rve_lab prepare and shear: its packing in a point, its path drawn beside")
    parser.add_argument("--output", type=pathlib.Path, default=pathlib.Path("output/python_points"))
    given = parser.parse_args()
    given.output.mkdir(parents=True, exist_ok=True)
    print(f"Python {platform.python_version()}, NumPy {np.__version__}, matplotlib {matplotlib.__version__}; scarp {scarp.build['version']}, "
          f"{scarp.build['compiler']} {scarp.build['compiler_version']}, {scarp.build['instruction_set']}")
    begun = time.perf_counter()
    if given.lab:
        sand = scarp.ellipses(file=str(given.lab / "packing.packing"))
    else:
        sand = scarp.ellipses(grains=given.grains, packings=given.packings, seed=given.seed, pressure=given.pressure, threads=given.threads,
                              progress=lambda done, total, what: print(f"  prepared {done} of {total}: {what}"))
    prepared = time.perf_counter() - begun
    points = different_points(sand, 1 if given.lab else given.packings)
    start = given.output / "start.points"
    points.save(str(start))
    path = Path(points, given.threads)
    begun = time.perf_counter()
    rows = test(path, given)
    whole = time.perf_counter() - begun
    difference, seconds = in_cpp(path, start, given.output)

    peaks = np.max([row[1] for row in rows], axis=0)
    print(f"largest q/p of each point: {', '.join(f'{peak:.4f}' for peak in peaks)}; {points.quantities(0)}")
    print(f"{len(rows) - 1} steps, {len(path.rows)} responses of {len(points)} points: {path.seconds:.3f} s in respond, "
          f"{whole - path.seconds:.3f} s in Python ({100.0 * (1.0 - path.seconds / whole):.1f} %), preparation {prepared:.2f} s")
    print(f"the same path in C++: {seconds:.3f} s, stresses differ by {difference} Pa")
    lab = numbers(given.lab / "path.csv") if given.lab else None
    if lab:
        ours = np.interp(lab["strain"], [row[0] for row in rows], [row[1][0] for row in rows])
        print(f"rve_lab: q/p of point 0 differs by {np.sqrt(np.mean((ours - lab['mean_q'] / lab['mean_p']) ** 2)):.4f} (root mean square)")
    with open(given.output / "biaxial.csv", "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(["axial_strain", "responses", *(f"{name}_{k}" for name in ("q_over_p", "volumetric_strain") for k in range(len(points)))])
        table.writerows([strain, responses, *ratios, *volumes] for strain, ratios, volumes, responses in rows)
    draw(rows, points.picture(0), given.output / "biaxial.png", lab)
    print(given.output / "biaxial.png")
    return 0 if difference == 0.0 else 1


if __name__ == "__main__":
    try:
        sys.exit(main())
    except (ValueError, RuntimeError, OSError) as trouble:
        sys.exit(f"python_points: {trouble}")
