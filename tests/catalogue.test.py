# SPDX-License-Identifier: BSL-1.0
"""The catalogues in docs/reference name every contact law, shape, element and solver with its parameters and their defaults: each header of these
rooms is on its page or a helper, each section has all headings, and each parameter of its class stands there."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
HEADINGS = [{"What"}, {"Header"}, {"Template"}, {"Formula", "Size"}, {"Parameters", "Formula"}, {"Limits"}, {"Cost"}, {"See"}]
PAGES = {"contact": "contact_laws", "shape": "shapes", "element": "elements", "solver": "solvers"}
# Headers that define concepts or serve others.
HELPERS = {
    "contact/contact_law", "contact/coulomb", "contact/law_checks", "shape/converged_contact", "shape/minimum_translation", "shape/particle_shape",
    "shape/round_grain", "shape/superellipse_contact", "shape/support_contact", "element/map", "element/mid_sides", "element/quadrature_rules",
    "element/reference_element", "solver/equilibrium_problem", "solver/free_system", "solver/ground_stiffness", "solver/incremental_problem",
    "solver/linear_solver", "solver/linearised_step", "solver/make_problem", "solver/step_report", "solver/work_balance"}
PARAMETER = re.compile(r"^  (?:double|int|bool|Law|Rule|Damping|std::\w+<[^;]*>) (\w+)(?: = ([^;]+)|\{[^;]*\})?;", re.M)
faults = []
checked = 0


def parameters(header, name):
    """[(name, default)] of the public data members of a struct, nothing of a class; None where the header has neither."""
    body = re.search(rf"^(struct|class)(?: SCARP_EXPORT)? {name}\b[^;]*?\{{\n(.*?)^\}};", header, re.M | re.S)
    if body is None:
        return None
    return PARAMETER.findall(body[2].split(" private:")[0]) if body[1] == "struct" else []


for room, page in PAGES.items():
    text = (ROOT / "docs" / "reference" / f"{page}.md").read_text()
    headers = {path.stem: path.read_text() for path in (ROOT / "include" / "scarp" / room).glob("*.hpp")}
    for stem in sorted(headers):
        if f"`scarp/{room}/{stem}.hpp`" not in text and f"{room}/{stem}" not in HELPERS:
            faults.append(f"docs/reference/{page}.md lacks scarp/{room}/{stem}.hpp: write a section, or list it in HELPERS")
    for name, section in re.findall(r"^## `(\w+)`\n(.*?)(?=^## |\Z)", text, re.M | re.S):
        where = f"docs/reference/{page}.md, {name}"
        found = re.findall(r"^- \*\*(\w+):\*\* \S", section, re.M)
        if len(found) != len(HEADINGS) or not all(one in allowed for one, allowed in zip(found, HEADINGS)):
            faults.append(f"{where}: the headings are {', '.join(found)}; take those of the other sections")
        stem = re.search(rf"`scarp/{room}/(\w+)\.hpp`", section)
        members = parameters(headers.get(stem[1], "") if stem else "", name)
        if members is None:
            faults.append(f"{where}: the header that it names does not define it")
        for member, default in members or []:
            checked += 1
            is_set = re.fullmatch(r"[\d.e+-]+|true", default) and default not in ("0", "0.0")
            expected = f"`{member} = {default}`" if is_set else f"`{member}`"
            if expected not in section:
                faults.append(f"{where}: {expected} is missing")
if checked < 30:
    faults.append(f"only {checked} parameters found: this test looks in the wrong place")
print(f"{checked} parameters, {len(faults)} faults")
sys.exit("\n".join(faults) or None)
