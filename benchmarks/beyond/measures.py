# SPDX-License-Identifier: BSL-1.0
"""What the parts of the page say of a run's summary."""
import json
import math


def summaries(folder):
    return {file.parent.name: json.loads(file.read_text()) for file in folder.glob("*/summary.json")}


def ended(summary):
    return summary["status"] if summary["status"] == "ok" else f"{summary['status']} at h/H {summary['throw_over_depth']:.4f}"


def below_base(summary):
    """Where half of the throw has passed, three quarters of the depth above bedrock [m]."""
    return summary["bands"][-1]["band_x50"]


def width(summary):
    """From where 5 % to where 95 % of the throw has passed at the surface [m]."""
    return summary["surface_x95"] - summary["surface_x05"]


def dip(summary):
    """Of the line from the fault's tip to the middle of the rupture at the surface [degrees]."""
    return math.degrees(summary["mid_line_dip"])
