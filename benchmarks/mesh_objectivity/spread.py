# SPDX-License-Identifier: BSL-1.0
"""What the runs of a folder say, and how far they are apart."""
import json
import math

# What meshes that resolve a length may differ by.
BARS = {"x50": 1.0, "x05": 2.0, "width": 0.10, "dip": 2.0}
PARTS = ["x05", "x50", "x95", "width", "dip"]


def measures(summary):
    """Places and width [m], dip of the mid-line [degrees]; NaN where a run has stopped early."""
    def of(key):
        value = summary.get(key)
        return math.nan if value is None or summary["status"] != "ok" else value

    return {"x05": of("surface_x05"), "x50": of("surface_x50"), "x95": of("surface_x95"), "width": of("outcrop_width"),
            "dip": math.degrees(of("mid_line_dip"))}


def summaries(folder):
    return {file.parent.name: json.loads(file.read_text()) for file in sorted(folder.glob("*/summary.json"))}


def ranges(rows):
    """Largest less least of each part over runs; of the width over its mean."""
    found = {}
    for part in PARTS:
        values = [row[part] for row in rows if not math.isnan(row[part])]
        apart = max(values) - min(values) if values else math.nan
        found[part] = apart / (sum(values) / len(values)) if part == "width" and values else apart
    return found


def judge(folder):
    """Prints the ranges beside their bars. \return 1 where one is passed or a run has stopped"""
    rows = {name: measures(summary) for name, summary in summaries(folder).items()}
    for name, row in rows.items():
        print(name, " ".join(f"{part} {row[part]:.2f}" for part in PARTS))
    found = ranges(rows.values())
    bad = [part for part, bar in BARS.items() if not found[part] <= bar]
    bad += [name for name, row in rows.items() if math.isnan(row["x50"])]
    print("apart by", " ".join(f"{part} {value:.3f}" for part, value in found.items()), "-", f"too far: {bad}" if bad else "as they may be")
    return 1 if bad else 0
