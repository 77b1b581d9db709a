# SPDX-License-Identifier: BSL-1.0
"""What runs came to: from their summaries or, where these are gone, from the page that they wrote."""
import dataclasses
import math

from generated_sections import rows_on
from spread import PARTS, measures, summaries

HEAD = ["length [m]", "mesh", "elements", "x05 [m]", "x50 [m]", "x95 [m]", "width [m]", "mid-line dip", "iterations", "refused", "CPU s", "ends"]


def number(value, digits=1):
    return "-" if math.isnan(value) else f"{value:.{digits}f}"


@dataclasses.dataclass
class Run:
    elements: str
    said: dict  # places and width [m], dip [degrees], by PARTS
    iterations: str
    refused: str
    cpu_seconds: str
    ends: str

    @staticmethod
    def of_summary(summary):
        ends = summary["status"] if summary["status"] == "ok" else f"{summary['status']} at h/H {summary['throw_over_depth']:.4f}"
        return Run(str(summary["elements"]), measures(summary), str(summary["iterations"]), str(summary["refused_steps"]),
                   number(summary["cpu_seconds"], 0), ends)

    @staticmethod
    def of_cells(cells):
        said = {part: math.nan if cell == "-" else float(cell) for part, cell in zip(PARTS, cells[1:])}
        return Run(cells[0], said, *cells[1 + len(PARTS):])

    def cells(self):
        return [self.elements, *(number(self.said[part], 2) for part in PARTS), self.iterations, self.refused, self.cpu_seconds, self.ends]


def by_length(output, page, soil):
    """{length: {name: Run}}, longest lengths first: what the output folder has and, of other runs, what the page says."""
    found = {}
    for length, name, *cells in rows_on(page, f"runs of {soil}"):
        found.setdefault(float(length), {})[name] = Run.of_cells(cells)
    for folder in (output / soil).glob("*/"):
        new = {name: Run.of_summary(summary) for name, summary in summaries(folder).items()}
        if new:
            found.setdefault(float(folder.name), {}).update(new)
    return {length: dict(sorted(found[length].items())) for length in sorted(found, reverse=True)}
