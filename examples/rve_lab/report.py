# SPDX-License-Identifier: BSL-1.0
"""report.py OUTPUT_DIR: report.html of a test, a path or a calibration of rve_lab."""

import pathlib
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "shared"))
import report as page

NUMBERS = (page.Number("peak_friction_angle", "peak friction angle", "degrees", ".1f"),
           page.Number("residual_friction_angle", "residual friction angle", "degrees", ".1f"),
           page.Number("peak_dilation_angle", "peak dilation angle", "degrees", ".1f"),
           page.Number("E50", "Young's modulus E50", "MPa", ".3g", 1e-6),
           page.Number("G0", "shear modulus G0", "MPa", ".3g", 1e-6),
           page.Number("largest_friction_angle", "largest friction angle", "degrees", ".1f"),
           page.Number("strain_at_largest_friction", "at the strain", "%", ".2f", 100.0),
           page.Number("misfit", "misfit", "standard errors"),
           page.Number("misfit_on_other_seeds", "on other seeds", "standard errors"),
           page.Number("points", "packings or points", "", ".0f"),
           page.Number("grains", "grains", "", ".0f"))

if __name__ == "__main__":
    page.main(page.Words(numbers=NUMBERS))
