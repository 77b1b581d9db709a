# SPDX-License-Identifier: BSL-1.0
"""[nightly] getfem with points of the Python module: an irregular mesh reproduces uniform strain, and cubes find the stress of one point.
Environment: SCARP_EXAMPLES, beside whose folder the module is (skipped, exit 77, without it or without python3-getfem)."""
import importlib.util
import os
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
from expectations import expect, finish

module = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve().parent / "python"
if not list(module.glob("scarp/_points*")) or not importlib.util.find_spec("getfem"):
    print("skipped: no Python module or no getfem (build python_points, install python3-getfem)")
    sys.exit(77)
script = pathlib.Path(__file__).resolve().parents[2] / "examples/getfem_points/getfem_points.py"
done = subprocess.run([sys.executable, script, "--grains", "60"], capture_output=True, text=True, timeout=100,
                      env=dict(os.environ, PYTHONPATH=str(module), PYTHONDONTWRITEBYTECODE="1"))
print(done.stdout, end="")
expect(done.returncode == 0, f"getfem_points ends with {done.returncode}: {done.stderr[-300:]}")
differences = [float(share) for share in re.findall(r"points differ by (\S+) of it", done.stdout)]
# Round-off, of packings magnified by their responses.
expect(len(differences) == 2 and differences[0] < 1e-12 and differences[1] < 1e-9, f"patch tests: {differences}")
(soil, soil_alone), (spheres, spheres_alone) = (map(float, pair) for pair in
                                                re.findall(r"cube: axial stress (\S+) kPa, one point alone (\S+) kPa", done.stdout))
# Analytic: 200 kPa (1 + sin phi) / (1 - sin phi) of 30 degrees; six digits are printed.
expect(abs(soil + 600.0) < 2e-3 and abs(soil_alone + 600.0) < 2e-3, f"Mohr-Coulomb fails at {soil} and {soil_alone} kPa")
# The shear stresses of a packing that is not quite isotropic spread the points: measured 0.2 % of the mean.
expect(-spheres > 300.0 and abs(spheres / spheres_alone - 1.0) < 0.01, f"spheres carry {spheres} kPa in the cube, {spheres_alone} kPa alone")
finish()
