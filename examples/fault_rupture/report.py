# SPDX-License-Identifier: BSL-1.0
"""report.py OUTPUT_DIR: report.html of a fault rupture or of an ensemble of them."""

import math
import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import report as page

DEGREES = 180.0 / math.pi
NUMBERS = (
    page.Number("throw_over_depth", "throw over depth reached, h/H", "", ".4f"),
    page.Number("surface_x50", "half of the throw has passed at x", "m", ".2f"),
    page.Number("surface_x05", "5 % of the throw has passed at x", "m", ".2f"),
    page.Number("surface_x95", "95 % of the throw has passed at x", "m", ".2f"),
    page.Number("surface_mean", "mean of the settlement profile, at x", "m", ".2f"),
    page.Number("dilated_area", "dilated area of the ground", "m2", ".2f"),
    page.Number("fault_line_x50", "the fault's own line comes out at x", "m", ".2f"),
    page.Number("rupture_dip", "dip from the tip to the middle", "degrees", ".1f", DEGREES),
    page.Number("surface_slope_max", "steepest slope of the surface", "%", ".1f", 100.0),
    page.Number("settlement_footwall_over_throw", "far footwall, settlement over throw", "", ".4f"),
    page.Number("settlement_hanging_wall_over_throw", "far hanging wall, settlement over throw", "", ".4f"),
    page.Number("k0", "K0 before faulting, mean", "", ".3f"),
    page.Number("void_ratio_min", "void ratio before faulting, least", "", ".3f"),
    page.Number("void_ratio_max", "void ratio before faulting, largest", "", ".3f"),
    page.Number("tilt", "tilt of the footing to the hanging wall", "degrees", ".3f", DEGREES),
    page.Number("settlement", "settlement of the footing", "m", ".3f"),
    page.Number("contact_pressure_max", "largest pressure on its base", "kPa", ".0f", 1e-3),
    page.Number("contact_share", "contact share of its base", "%", ".0f", 100.0),
    page.Number("max_accepted_residual", "largest residual of an accepted step", "", ".2e"),
    page.Number("steps", "accepted load steps", "", ".0f"),
    page.Number("rejected_steps", "rejected load steps", "", ".0f"),
    page.Number("dem_steps", "DEM steps", "million", ".3g", 1e-6, False),
    page.Number("cpu_seconds", "processor time", "s", ".4g"),
    page.Number("wall_seconds", "wall time", "s", ".4g"),
    page.Number("peak_memory_bytes", "memory, at most", "MB", ".0f", 1e-6),
)
FIGURES = {
    "rupture": ("The rupture", "Deviatoric strain on the deforming mesh, from rest to the last throw."),
    "deformation": ("Deformed ground", "Deviatoric strain with the probes, and settlement with the middle of the band, at the last throw."),
    "strain_development": ("How the band grows", "Deviatoric strain at an eighth, a quarter, half and the whole of the throw."),
    "surface": ("Surface", "Settlement of the surface at several throws, and where the rupture comes out. Without dilation "
                "the mean of the profile would lie on the fault's line at the mean height of both sides; the dilated area over the throw shifts it."),
    "stress_crosses": ("Principal stresses", "Crosses along the principal directions at the last throw, over the settlement."),
    "probes": ("Response at the probes", "Deviatoric stress and volumetric strain against deviatoric strain."),
    "fabric": ("Fabric at the probes", "Anisotropy of contact normals and long axes against deviatoric strain."),
    "probe_packings": ("Packings at the probes", "Grains with force chains; a line is as wide as the normal force."),
    "probe_roses": ("Directions at the probes", "Contact normals, the same weighted with their forces, and long axes of the grains."),
    "footing": ("Footing", "Settlement, tilt and pressures over the throw."),
    "base_pressure": ("Pressure on the base", "Contact pressure along the footing's base at a few throws."),
    "excess_pressure": ("Excess pore pressure", "At half of the throw, at its end and at the end of the run; suction is red."),
    "pressures": ("Excess pore pressure over the throw", "Means of the elements' corners; suction is red. The last frame is the end of the run."),
    "water": ("Pore water over time", "Least and largest excess pressure, volumes of water and vapour, and the surface, over time."),
    "packing": ("A packing at the start", "One of the packings as it was prepared, with force chains."),
    "convergence": ("Convergence", "Residuals of all iterations, and DEM steps, over the throw."),
    "effort": ("Effort", "What the load steps cost, and which points are slow or unwell."),
    "ensemble": ("Ensemble", "Surfaces of the members, their mean, and one standard deviation."),
}
SOILS = {"mohr_coulomb": "Mohr-Coulomb soil", "elastic": "elastic soil"}


def ground(run):
    if run.option("soil", "dem") != "dem":
        return SOILS.get(run.option("soil"), run.option("soil"))
    return f"sand, a packing of {run.option('grains')} ellipses at every point"


def structure(run):
    if run.option("case", "free") == "free":
        return "level ground"
    return f"ground with a {run.option('case')} {run.option('footing')} footing"


def title(run):
    kind = "Reverse" if run.option("reverse") == "true" else "Normal"
    soil = SOILS.get(run.option("soil"), "packings of grains")
    several = f", seeds {run.option('seeds')}" if run.ensemble else ""
    return f"{kind} fault below {structure(run)}: {soil}{several}"


def lead(run):
    elements = run.number("elements")
    mesh = f"{elements:.0f} elements ({run.summary.get('element')})" if elements else f"elements {run.option('element')}"
    length = run.option("length", "0")
    seen = "no intrinsic length" if length in ("", "0") else f"an intrinsic length of {length} m"
    return (f"A fault that dips at {run.option('dip')} degrees moves below {structure(run)}, {run.option('depth')} m deep, to a throw of "
            f"{run.option('throw-over-depth')} of the depth. The ground is {ground(run)}, {mesh}, {seen}.")


if __name__ == "__main__":
    page.main(page.Words(title, lead, NUMBERS, FIGURES))
