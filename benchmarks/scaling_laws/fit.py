# SPDX-License-Identifier: BSL-1.0
"""Fits of the model of examples/fault_rupture/estimate.hpp to runs."""
import math

import numpy as np

WIDTH, DEPTH = 75.0, 25.0  # of the ground [m]
LIMIT, LOCAL_LIMIT = 0.0025, 0.005  # of a load step's gradient, the usual ones for packings, with a length and without
INTERVAL = 4  # load steps from one evaluation of the tangents to the next


def power_law(x, y):
    """Least squares of log y over log x: factor and exponent."""
    exponent, at_one = np.polyfit(np.log(np.asarray(x, float)), np.log(np.asarray(y, float)), 1)
    return math.exp(at_one), exponent


def positive(design, values):
    """Least squares of relative errors with coefficients that are not negative."""
    design = np.asarray(design, float) / np.asarray(values, float)[:, None]
    columns = list(range(design.shape[1]))
    while True:
        found, *_ = np.linalg.lstsq(design[:, columns], np.ones(len(values)), rcond=None)
        if (found >= 0.0).all():
            full = np.zeros(design.shape[1])
            full[columns] = found
            return full
        del columns[int(np.argmin(found))]


def option(run, name, usual):
    options = run["options"]
    return float(options[options.index(name) + 1]) if name in options else usual


def is_plain(run):
    return "mohr_coulomb" in run["options"]


def length_of(run):
    return option(run, "--length", 0.0 if "--local" in run["options"] else 8.0)


def node_distance(run):
    """Mean distance, on graded meshes that in the strip."""
    return math.sqrt((run["strip_area"] or WIDTH * DEPTH / run["elements"]) * run["elements"] / run["nodes"])


def crowding(run):
    """Strain of a mean point over that on uniform meshes, as in cost_of()."""
    return math.sqrt(max(1.0, WIDTH * DEPTH / run["elements"] / run["strip_area"] / 1.25)) if run["strip_area"] else 1.0


def throws(run):
    """Accepted load steps of the throw."""
    return [step for step in run["history"] if step["accepted"] and step["load_increment"] > 0.0]


def large_throws(run):
    """Those near the limit of the gradient."""
    limit = LIMIT if length_of(run) > 0.0 else LOCAL_LIMIT
    return [step for step in throws(run) if step["max_displacement_gradient"] > 0.5 * limit]


def cpu(run, seconds):
    """CPU time of a part of the run from its wall time on one thread, as if the machine were as fast as the reference (RATE)."""
    return seconds * run["cpu_seconds"] / run["wall_seconds"]


class Model:
    """Constants by the names of costs.json; all times are for a machine whose kernel takes `kernel`."""

    def __init__(self, runs):
        self.runs = runs
        self.sand = {name: run for name, run in runs.items() if not is_plain(run) and not name.startswith(("check", "team"))}
        self.plain = {name: run for name, run in runs.items() if is_plain(run) and not name.startswith("check")}
        self.kernel = float(np.median([run["kernel"] for run in runs.values()]))
        self.constants = {"kernel": self.kernel}
        self.fit_width()
        self.fit_iterations()
        self.fit_strain()
        self.fit_points()
        self.fit_preparation()
        self.fit_outside()
        self.fit_plain()

    def scaled(self, run, seconds):
        return cpu(run, seconds) * self.kernel / run["kernel"]

    def width(self, run):
        return math.hypot(self.constants["width_per_node"] * node_distance(run), self.constants["width_per_length"] * length_of(run))

    def fit_width(self):
        """From large steps: bands are wider in the small ones before, and these are few."""
        rows, values = [], []
        for run in self.sand.values():
            if large := [step["load_increment"] / step["max_displacement_gradient"] for step in large_throws(run)]:
                rows.append([node_distance(run) ** 2, length_of(run) ** 2])
                values.append(np.median(large) ** 2)
        per_node, per_length = np.sqrt(positive(rows, values))
        self.constants.update(width_per_node=per_node, width_per_length=per_length)

    def fit_iterations(self):
        for key, local in (("iterations", True), ("iterations_with_length", False)):
            decades, counts = [], []
            for run in self.sand.values():
                if (length_of(run) == 0.0) != local:
                    continue
                tolerance = option(run, "--tolerance", 1e-2)
                for step in large_throws(run):
                    decades.append(math.log10(step["max_displacement_gradient"] / tolerance))
                    counts.append(step["iterations"])
            slope, at_tolerance = np.polyfit(decades, counts, 1)
            self.constants.update({key: at_tolerance, f"{key}_by_decade": slope})

    def strains(self):
        """Of each step whose answers take more than the least number of DEM steps: width, throw over depth, mean strain over that of the
        ground, time in the points."""
        rows = []
        for run in self.sand.values():
            least, each = option(run, "--min-dem-steps", 20.0 if "--local" in run["options"] else 10.0), option(run, "--strain-per-dem-step", 1e-5 if "--local" in run["options"] else 2e-5)
            for step in throws(run):
                answers = step["dem_steps"] / step["iterations"] / run["elements"]
                if answers > 1.3 * least:
                    strain = each * math.sqrt(answers ** 2 - least ** 2)
                    rows.append((self.width(run), step["throw_over_depth"], strain / crowding(run) / (step["load_increment"] / DEPTH),
                                 step["seconds_in_points"]))
        return rows

    def fit_strain(self):
        """strain = at_metre width^by_width (1 + by_throw throw/depth): the factor of the throw by search, the rest by least squares
        in which steps count as they work."""
        rows = np.array(self.strains())
        weights = np.sqrt(rows[:, 3])
        best = None
        for by_throw in np.arange(0.0, 40.0, 0.5):
            y = np.log(rows[:, 2] / (1.0 + by_throw * rows[:, 1]))
            design = np.stack([np.ones(len(rows)), np.log(rows[:, 0])], axis=1)
            found, *_ = np.linalg.lstsq(design * weights[:, None], y * weights, rcond=None)
            left = float(np.sum((weights * (y - design @ found)) ** 2))
            if best is None or left < best[0]:
                best = (left, math.exp(found[0]), found[1], by_throw)
        _, at_metre, by_width, by_throw = best
        self.constants.update(strain_at_metre=at_metre, strain_by_width=by_width, strain_by_throw=by_throw)

    def fit_points(self):
        """Steps of few and of many iterations tell a run's DEM steps from its tangents; the median of what a tangent takes, in DEM steps,
        then gives the time of a DEM step of each run."""
        ratios = []
        for run in self.sand.values():
            rows = [[step["dem_steps"], run["elements"] / INTERVAL] for step in run["history"]]
            one, tangent = positive(rows, [self.scaled(run, step["seconds_in_points"]) for step in run["history"]])
            if one > 0.0:
                ratios.append(tangent / one)
        tangent = float(np.median(ratios))
        self.dem_step = {name: self.scaled(run, run["in_points"]) / (run["dem_steps"] + tangent * (run["steps"] + 1.0) / INTERVAL * run["elements"])
                         for name, run in self.sand.items()}
        of_grains = [name for name in self.sand if name.startswith("grains")]
        _, exponent = power_law([self.sand[name]["grains"] for name in of_grains], [self.dem_step[name] for name in of_grains])
        logs = [math.log(self.dem_step[name] / run["grains"] ** exponent) for name, run in self.sand.items()]
        mean = np.average(logs, weights=[run["in_points"] for run in self.sand.values()])
        self.constants.update(dem_step=math.exp(mean), dem_step_by_grains=exponent, tangent=tangent)

    def column(self, run):
        """Time in which a column of packings was prepared: all of the run that is not in load steps."""
        columns = option(run, "--packings", 1 if "--local" in run["options"] else 16)
        return self.scaled(run, run["wall_seconds"] - run["in_steps"]) / columns

    def fit_preparation(self):
        grains, each = [], []
        for name, run in self.sand.items():
            if name.startswith("grains"):
                grains.append(run["grains"])
                each.append(self.column(run))
        factor, exponent = power_law(grains, each)
        self.constants.update(column=factor, column_by_grains=exponent)

    def outside(self, run):
        """Time of an iteration outside of the points."""
        return self.scaled(run, run["in_steps"] - run["in_points"]) / run["iterations"]

    def fit_outside(self):
        """Packings with a length give what a pair takes."""
        local = [run for run in (*self.sand.values(), *self.plain.values()) if run["pairs"] == 0]
        factor, exponent = power_law([run["elements"] for run in local], [self.outside(run) for run in local])
        self.constants.update(outside=factor, outside_by_points=exponent)
        pairs, more = [], []
        for run in self.sand.values():
            if run["pairs"] > 0:
                took = self.outside(run)
                pairs.append(run["pairs"] * run["elements"])
                more.append(max(took - factor * run["elements"] ** exponent, 0.02 * took))
        self.constants.update(pair=positive([[count] for count in pairs], more)[0])

    def fit_plain(self):
        """Of runs far enough for a rupture. Iterations without a length and with one have factors of their own and share the power."""
        found = self.constants
        far = [run for run in self.plain.values() if run["throw_over_depth"] > 0.05]
        widths = [math.log(run["throw_over_depth"] * DEPTH / self.width(run)) for run in far]
        local = np.array([length_of(run) == 0.0 for run in far], float)
        design = np.stack([local, 1.0 - local, widths], axis=1)
        (without, with_length, by_throw), *_ = np.linalg.lstsq(design, np.log([run["iterations"] for run in far]), rcond=None)
        found.update(plain_iterations=math.exp(without), plain_iterations_with_length=math.exp(with_length), plain_iterations_by_throw=by_throw)
        rows = [(math.exp(width), (self.outside(run) - found["pair"] * run["pairs"] * run["elements"]) / (found["outside"] * run["elements"] ** found["outside_by_points"]))
                for run, width in zip(far, widths) if run["pairs"] > 0]
        found["plain_outside_with_length"], found["plain_outside_by_throw"] = power_law(*zip(*rows))
        rows, values = [], []
        for run in self.plain.values():
            rows.append([run["iterations"] * run["elements"]])
            values.append(self.scaled(run, run["in_points"]))
        found["plain_answer"] = positive(rows, values)[0]
