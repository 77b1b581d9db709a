# SPDX-License-Identifier: BSL-1.0
"""A host in C finds the bits of C++ through C functions and through the UMAT, as Abaqus and as Kratos call it; wrong calls are rejected
with a reason. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import os
import pathlib
import re
import subprocess
import sys

sys.dont_write_bytecode = True
from expectations import expect, finish

FOLDER = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve()
if not (FOLDER / "umat_driver").exists():
    print("skipped: no umat_driver in SCARP_EXAMPLES")
    sys.exit(77)
done = subprocess.run([FOLDER / "umat_driver"], capture_output=True, text=True, timeout=100)
print(done.stdout, end="")
expect(done.returncode == 0, f"umat_driver ends with {done.returncode}")
lines = re.findall(r"^(.*?) {2,}([\d.e+-]+)  (ok|WRONG)$", done.stdout, re.M)
compared = [float(figure) for what, figure, _ in lines if what.endswith("[Pa]")]
expect(len(lines) >= 25 and len(compared) >= 14, f"only {len(lines)} lines, {len(compared)} of them compare stresses")
expect(all(figure == 0.0 for figure in compared), f"C++ and others differ by up to {max(compared, default=1.0)} Pa")
for words in ("STATEV has 3 numbers", "NTENS is 6", "PNEWDT is null", "nowhere.txt", "STATEV was changed", "STRESS is null"):
    expect("umat: " in done.stderr and words in done.stderr, f"the error stream lacks '{words}'")
done = subprocess.run([FOLDER / "points_library"], capture_output=True, text=True, timeout=100)
expect(done.returncode == 0 and done.stdout.count("stress xx") == 2, f"points_library: {done.stdout}{done.stderr}")
symbols = subprocess.run(["nm", "-D", "--defined-only", FOLDER.parent / "lib/libscarp_points.so"], capture_output=True, text=True).stdout
names = {line.split()[-1] for line in symbols.splitlines()}
expect(names and all(re.match(r"scarp_|umat_?$", name) for name in names), f"libscarp_points.so shows {sorted(names)[:5]}")
finish()
