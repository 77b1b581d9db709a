# SPDX-License-Identifier: BSL-1.0
"""Mohr-Coulomb ground calibrated on the scene's grains: drained biaxial tests of rve_biaxial, and K0 of the scene's own packings.

The tests: 400 grains, ten seeds, 200 kPa, the vertical stress halfway down the ground (4 kPa + 15.68 kN/m3 x 12.5 m), preparation friction 0.12,
which puts one packing prepared straight at that pressure into the middle of the void ratios that the scene has over its depth (docs/rve.md).
"""
import csv
import json
import math
import statistics
import subprocess
import sys

from common import example, fault_rupture, run_once

GRAINS = 400
SEEDS = 10
PRESSURE = 2e5  # [Pa]
PREPARATION_FRICTION = 0.12
WINDOW = 0.05  # axial strain
STRAIN = 0.2  # axial, at the end
POISSON = 0.25  # of the scene's ground without packings


def run(output):
    """The tests, and the scene's ground at rest, unless they have been.
    output: folder of all runs of the benchmark, as below"""
    run_once([fault_rupture(), "--grains", GRAINS, "--length", 8, "--overconsolidation-ratio", 1, "--throw-over-depth", 1e-5, "--frames", 1, "--threads", 1],
             output / "calibration" / "at_rest")
    folder = output / "calibration" / "biaxial"
    if not (folder / "summary.json").exists():
        command = [example("rve_biaxial"), "--grains", GRAINS, "--seeds", SEEDS, "--pressure", PRESSURE, "--preparation-friction", PREPARATION_FRICTION,
                   "--strain", STRAIN, "--smoothing", WINDOW, "--output", folder, "--overwrite"]
        done = subprocess.run([str(word) for word in command], capture_output=True, text=True)
        if done.returncode != 0:
            sys.exit(f"{' '.join(map(str, command))} ended with {done.returncode}:\n{done.stderr[-2000:]}")


def tests(output):
    """Rows of every seed's test, as numbers."""
    found = {}
    with open(output / "calibration" / "biaxial" / "biaxial.csv", newline="") as file:
        for row in csv.DictReader(file):
            found.setdefault(row["seed"], []).append({name: float(value) for name, value in row.items()})
    return list(found.values())


def mobilised(rows):
    """Friction angle of the mean stresses of some rows [degrees]."""
    axial = sum(row["axial_stress"] for row in rows)
    lateral = sum(row["lateral_stress"] for row in rows)
    return math.degrees(math.asin((axial - lateral) / (axial + lateral)))


def young_modulus(rows):
    """From the secant to half of the largest deviatoric stress; in plane strain with a constant lateral stress its slope is E/(1 - nu^2) [Pa]."""
    half = 0.5 * max(row["axial_stress"] - row["lateral_stress"] for row in rows)
    first = next(row for row in rows if row["axial_stress"] - row["lateral_stress"] >= half)
    return (1.0 - POISSON**2) * (first["axial_stress"] - first["lateral_stress"]) / first["axial_strain"]


def plastic_shear(row, modulus):
    """Difference of the principal strains less its elastic part."""
    stress = row["axial_stress"] - row["lateral_stress"]
    return row["axial_strain"] - row["lateral_strain"] - stress * (1.0 + POISSON) / modulus


def softening_strain(all_rows, peak_strain, peak, residual, modulus):
    """Plastic shear strain of the straight fall from peak to residual that has the same area above the residual angle as the mean of
    the tests from their peak on."""
    area = 0.0
    for rows in all_rows:
        after = [row for row in rows if row["axial_strain"] >= peak_strain]
        strains = [plastic_shear(row, modulus) for row in after]
        angles = [mobilised([row]) - residual for row in after]
        area += sum(0.5 * (b + a) * (t - s) for a, b, s, t in zip(angles, angles[1:], strains, strains[1:]))
    return 2.0 * area / len(all_rows) / (peak - residual)


def volume_gained(rows):
    """Logarithmic, from the largest contraction to the end."""
    return max(row["volumetric_strain"] for row in rows) - rows[-1]["volumetric_strain"]


def falling_volume(dilation, strain):
    """Volume that Mohr-Coulomb ground gains while its dilation [degrees] falls to zero over a plastic shear strain, in plane strain: the
    integral of sin(psi)."""
    angle = math.radians(dilation)
    return strain * (1.0 - math.cos(angle)) / angle


def dilation_for(volume, strain):
    """The angle [degrees] from which ground gains so much."""
    low, high = 0.0, 90.0
    for _ in range(50):
        middle = 0.5 * (low + high)
        low, high = (middle, high) if falling_volume(middle, strain) < volume else (low, middle)
    return low


def by_volume(output):
    """The calibrated options, but the dilation that gains as much volume as the tests."""
    options, sources = calibrated(output)
    return {**options, "peak-dilation-angle": dilation_for(statistics.fmean(sources["volume"]), options["softening-strain"])}


def calibrated(output):
    """The options of fault_rupture by their names, and what they come from: angles of each packing, volume gained by it."""
    found, at_rest = (json.loads((output / "calibration" / name / "summary.json").read_text()) for name in ("biaxial", "at_rest"))
    all_rows = tests(output)
    peaks = [next(peak for peak in packing["peaks"] if peak["window"] == WINDOW) for packing in found["packings"]]
    residuals = [mobilised([row for row in rows if row["axial_strain"] > STRAIN - WINDOW]) for rows in all_rows]
    moduli = [young_modulus(rows) for rows in all_rows]
    peak, residual, modulus = statistics.fmean(one["phi_max"] for one in peaks), statistics.fmean(residuals), statistics.fmean(moduli)
    peak_strain = statistics.fmean(one["phi_max_axial_strain"] for one in peaks)
    options = {"peak-friction-angle": peak, "peak-dilation-angle": statistics.fmean(one["psi_max"] for one in peaks), "residual-friction-angle": residual,
               "softening-strain": softening_strain(all_rows, peak_strain, peak, residual, modulus), "young-modulus": modulus,
               "k0": at_rest["k0"]}
    return options, {"peak-friction-angle": [one["phi_max"] for one in peaks], "peak-dilation-angle": [one["psi_max"] for one in peaks],
                     "residual-friction-angle": residuals, "young-modulus": moduli, "void ratio": [rows[0]["void_ratio"] for rows in all_rows],
                     "volume": [volume_gained(rows) for rows in all_rows]}


def rows(output):
    """Each parameter by calibration, by the volume gained, and of the packings: mean and standard deviation over the seeds."""
    options, sources = calibrated(output)
    of_volume = by_volume(output)
    spread = {name: {"packings, mean": statistics.fmean(values), "packings, deviation": statistics.stdev(values)} for name, values in sources.items()}
    return [{"parameter": name, "calibrated": options.get(name), "dilation by the volume gained": of_volume.get(name), **spread.get(name, {})}
            for name in dict.fromkeys([*options, *sources])]
