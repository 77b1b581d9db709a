# SPDX-License-Identifier: BSL-1.0
"""Rows of preparations.csv by preparation, and where they lie against the study."""
import csv
import math
import statistics

STUDY_K0 = (0.38, 0.42)  # "around 0.4"
STUDY_VOID_RATIO = (0.160, 0.179)
KEPT_FROM = 20e3  # [Pa], a metre deep: above, the packing remembers its isotropic start
TESTED_AT = 200e3  # [Pa]
PARAMETERS = ["path", "isotropic_pressure", "isotropic_friction", "share", "share_friction", "vertical_friction", "preload", "held_ratio", "laid",
              "fastest"]


class Preparation:
    def __init__(self, parameters):
        self.path = parameters["path"]
        self.parameters = {name: float(parameters[name]) for name in PARAMETERS[1:]}
        self.packings = {}  # {overburden: {seed: row}}

    def add(self, row):
        arrived = self.packings.setdefault(float(row["overburden"]), {})
        if row["status"] == "ok":
            arrived[row["seed"]] = row

    def overburdens(self):
        return sorted(self.packings)

    def seeds(self):
        """That arrived at every depth."""
        if not self.packings:
            return []
        return sorted(set.intersection(*(set(packings) for packings in self.packings.values())), key=int)

    def values(self, column, overburden):
        found = (float(self.packings[overburden][seed][column]) for seed in self.seeds()) if overburden in self.packings else ()
        return [value for value in found if math.isfinite(value)]

    def mean(self, column, overburden):
        values = self.values(column, overburden)
        return statistics.fmean(values) if values else math.nan

    def friction(self):
        return f"{self.parameters['isotropic_friction']:g}"

    def choice(self):
        """What sets this preparation apart from others of its path."""
        has = self.parameters
        if self.path == "one isotropic packing":
            return f"at {has['isotropic_pressure'] / 1e3:g} kPa"
        if "friction" in self.path and has["share"] == 0.0:
            return f"vertical friction {has['vertical_friction']:g}"
        if "preloaded" in self.path:
            return f"{has['preload']:g} times"
        if has["share"] > 0.0:
            return f"share {has['share']:g}"
        if self.path == "laid grains":
            return f"F_p of the cloud {abs(has['laid']):g}, {'level' if has['laid'] > 0 else 'upright'}"
        return ""

    def held(self):
        return self.parameters["held_ratio"] > 0.0

    def is_scene(self):
        return self.path == "one-dimensional" and self.parameters["isotropic_friction"] == 0.09

    def is_candidate(self):
        return self.path.startswith("candidate")

    def kept(self):
        return [overburden for overburden in self.overburdens() if overburden >= KEPT_FROM]

    def has_k0(self):
        return self._means_within("k0", STUDY_K0)

    def has_void_ratio(self):
        return self._means_within("void_ratio", STUDY_VOID_RATIO)

    def inside(self):
        """Packings with both at every depth."""
        def within(column, bounds, seed):
            return all(bounds[0] <= round(float(self.packings[o][seed][column]), 3) <= bounds[1] for o in self.kept())
        return sum(within("k0", STUDY_K0, seed) and within("void_ratio", STUDY_VOID_RATIO, seed) for seed in self.seeds())

    def _means_within(self, column, bounds):
        return bool(self.seeds()) and all(bounds[0] <= round(self.mean(column, o), 3) <= bounds[1] for o in self.kept())


def read(path):
    """In the order of the table, which has all seeds of one preparation apart."""
    found = {}
    with open(path, newline="") as stream:
        for row in csv.DictReader(stream):
            found.setdefault(tuple(row[name] for name in PARAMETERS), Preparation(row)).add(row)
    return list(found.values())
