# SPDX-License-Identifier: BSL-1.0
"""No tolerance of doctest's own Approx, which is absolute for numbers below one; no refusal that is tested by its type alone."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
WRONG = {r"doctest::Approx\(": "takes tolerances that are absolute for small numbers: use samples::Approx",
         r"CHECK_THROWS\(|CHECK_THROWS_AS\([^;]*(?:InputError|FileError|FolderError|CheckpointError)\);":
         "passes with any refusal on the way: name the quantity and its value by CHECK_REFUSED or samples::message_of"}

faults = []
files = 0
for folder in ("tests", "benchmarks"):
    for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
        files += 1
        text = path.read_text()
        for pattern, why in WRONG.items():
            for match in re.finditer(pattern, text):
                line = text[:match.start()].count("\n") + 1
                if "///" not in text.splitlines()[line - 1]:
                    faults.append(f"{path.relative_to(ROOT)}:{line}: {match[0].splitlines()[0]} {why}")
if files < 100:
    faults.append(f"only {files} files found: this test looks in the wrong place")
sys.exit("\n".join(faults) or None)
