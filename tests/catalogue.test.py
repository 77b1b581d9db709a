# SPDX-License-Identifier: BSL-1.0
"""The catalogues in docs/reference name every contact law, shape, element, solver and provider with its parameters and their defaults: each header of these
rooms is on its page or a helper, each section has all headings, and each parameter of its class stands there. docs/reference/output_columns.csv
has the columns and keys that the sources of each file write, and no others; docs/messages.md has messages that exist, and each reason of a status."""
import collections
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
HEADINGS = [{"What"}, {"Header"}, {"Template"}, {"Formula", "Size"}, {"Parameters", "Formula"}, {"Limits"}, {"Cost"}, {"See"}]
PAGES = {"contact": "contact_laws", "shape": "shapes", "element": "elements", "solver": "solvers", "constitutive": "providers", "rve": "providers"}
# Headers that define concepts or serve others.
HELPERS = {
    "constitutive/constitutive_provider", "constitutive/hydraulic", "constitutive/unwrap", "rve/stored_packing", "contact/contact_law", "contact/coulomb", "contact/law_checks",
    "shape/converged_contact", "shape/minimum_translation", "shape/particle_shape", "shape/round_grain", "shape/superellipse_contact",
    "shape/support_contact", "shape/support_integrals", "element/map", "element/mid_sides", "element/quadrature_rules", "element/reference_element",
    "solver/equilibrium_problem", "solver/problem", "solver/linear_system", "solver/linearised_step", "solver/make_problem", "solver/step_report", "solver/work_balance"}
TYPES = "double|int|bool|Law|Rule|Damping|Provider|Source|IsotropicElasticity|StrengthType|InitialStress|Boundary|Tangent|Umat\\*|std::string"
PARAMETER = re.compile(rf"^  (?:\[\[\w+\]\] )?(?:{TYPES}|std::\w+<[^;]*>) (\w+)(?: =\s+([^;]+)|\{{[^;]*\}})?;", re.M)
faults = []
checked = {"parameters": 0, "columns": 0, "messages": 0}
least = {"parameters": 30, "columns": 200, "messages": 15}  # of each; fewer mean that this test looks in the wrong place


def parameters(header, name):
    """[(name, default)] of the public data members of a struct, nothing of a class; None where the header has neither."""
    body = re.search(rf"^(struct|class)(?: SCARP_EXPORT)? {name}\b[^;]*?\{{\n(.*?)^\}};", header, re.M | re.S)
    if body is None:
        return None
    return PARAMETER.findall(body[2].split(" private:")[0]) if body[1] == "struct" else []


for room, page in PAGES.items():
    text = (ROOT / "docs" / "reference" / f"{page}.md").read_text()
    for stem in sorted(path.stem for path in (ROOT / "include" / "scarp" / room).glob("*.hpp")):
        if f"`scarp/{room}/{stem}.hpp`" not in text and f"{room}/{stem}" not in HELPERS:
            faults.append(f"docs/reference/{page}.md lacks scarp/{room}/{stem}.hpp: write a section, or list it in HELPERS")
for page in sorted(set(PAGES.values())):
    text = (ROOT / "docs" / "reference" / f"{page}.md").read_text()
    for name, section in re.findall(r"^## `(\w+)`\n(.*?)(?=^## |\Z)", text, re.M | re.S):
        where = f"docs/reference/{page}.md, {name}"
        found = re.findall(r"^- \*\*(\w+):\*\* \S", section, re.M)
        if len(found) != len(HEADINGS) or not all(one in allowed for one, allowed in zip(found, HEADINGS)):
            faults.append(f"{where}: the headings are {', '.join(found)}; take those of the other sections")
        path = re.search(r"^- \*\*Header:\*\* `(scarp/\w+/\w+\.hpp)`", section, re.M)
        header = ROOT / "include" / path[1] if path else ROOT
        members = parameters(header.read_text() if header.is_file() else "", name)
        if members is None:
            faults.append(f"{where}: the header that it names does not define it")
        for member, default in members or []:
            checked["parameters"] += 1
            default = default.replace("'", "")
            is_set = re.fullmatch(r"[\d.e+-]+|true", default) and default not in ("0", "0.0")
            expected = f"`{member} = {default}`" if is_set else f"`{member}`"
            if expected not in section:
                faults.append(f"{where}: {expected} is missing")

# Output files and the sources that write them.
PROGRAMS = ("fault_rupture", "biaxial_specimen", "retaining_wall", "rve_lab")
WRITES = re.compile(r"\b(CsvTable|CsvLog|VtuFields) \w+\(?[;({]|\b(?:CsvTable|CsvLog)\(\{|\bwrite_json\(")
NO_TABLES = {"io/csv.hpp", "io/json.hpp", "examples/shared/write_json.hpp",  # definitions
             # write what others made
             *(f"examples/fault_rupture/{name}" for name in ("run_scene.cpp", "ensemble_runs.hpp", "sensitivity.cpp"))}
# Keys that a source reads or leaves out.
READ = {"examples/fault_rupture/ensemble.cpp": {"bands", "bearing_pressure", "cpu_seconds", "depth", "elements", "error_budget", "footing_centre", "footing_width", "parts", "within", "fault_line_x50", "grains_per_rve", "height_over_depth", "peak_memory_bytes",
                                       "share_of_time_in_points", "share_of_time_outside_points", "threads", "tolerance", "wall_seconds"},
        "examples/shared/run_options.hpp": {"cells", "columns", "elements", "grains", "mesh", "packings", "rows", "seeds", "size"}}
STRING = r'(?:"[^"]*"|measure_\.name)'


def place(source):
    """Path of a source that the page names, a header below include/scarp."""
    return next((path for path in (ROOT / "include" / "scarp" / source, ROOT / source) if path.exists()), None)


def written(source):
    """Names of the columns and keys that a source writes: lists of strings, and strings that begin a pair or index an object; not of files."""
    text = re.sub(r"//[^\n]*", "", place(source).read_text())
    names = {name for found in re.findall(rf"\{{\s*({STRING}(?:,\s*{STRING})+)\s*[}},]", text) for name in re.findall(STRING, found)}
    names |= set(re.findall(r'(?:\{|emplace_back\(|push_back\(|\.add\(|\[)\s*("[^"]+")\s*[,\])]', text))
    names |= {f'"{tensor}{a}{b}"' for tensor in re.findall(r'add_tensor\(row, "(\w+)"', text) for a in "xy" for b in "xy"}
    names = {name for name in names if not re.search(r"\.\w+\"$", name)}
    return {"throw_over_depth" if name == "measure_.name" else name.strip('"') for name in names} - READ.get(source, set())


listed = collections.defaultdict(set)
with open(ROOT / "docs" / "reference" / "output_columns.csv", newline="") as table:
    for row in csv.DictReader(table):
        listed[row["files"], row["sources"]] |= set(row["names"].split("; "))
described = {source for _, sources in listed for source in sources.split(", ")}
for (files, sources), names in listed.items():
    if lost := [source for source in sources.split(", ") if place(source) is None]:
        faults.append(f"docs/reference/output_columns.csv, {files}: there is no {', '.join(lost)}")
        continue
    made = set().union(*(written(source) for source in sources.split(", ")))
    checked["columns"] += len(names)
    for what, difference in (("lacks", made - names), ("has, but the sources do not write,", names - made)):
        if difference:
            faults.append(f"docs/reference/output_columns.csv, {files}: {what} {', '.join(sorted(difference))}")
for folder in ("include/scarp", "examples/shared", *(f"examples/{program}" for program in PROGRAMS)):
    for path in (ROOT / folder).rglob("*.[ch]pp"):
        source = path.relative_to(ROOT).as_posix().removeprefix("include/scarp/")
        if WRITES.search(path.read_text()) and source not in described | NO_TABLES:
            faults.append(f"docs/reference/output_columns.csv: no row is from {source}, which writes a file")

# Messages: each literal text is in a source, whatever values stand between its parts, and each reason of a status has a remedy.
LIBRARY_MESSAGES = {"The following arguments were not expected"}  # of CLI11
page = (ROOT / "docs" / "messages.md").read_text()
code = "".join(path.read_text() for folder in ("include", "examples", ".ci") for path in sorted((ROOT / folder).rglob("*"))
               if path.suffix in (".hpp", ".cpp", ".sh") and "output" not in path.parts)
reasons = set(re.findall(r"^  (\w+)(?: = \d+)?,? +///<", re.search(r"enum class Reason.*?\};", code, re.S)[0], re.M)) - {"none"}
code = re.sub(r"(?m)(?:^|(?<=[\s;,(){}]))//[^\n]*", "", code)  # a message that a comment alone has is none
code = re.sub(r'"\s*"', "", code)  # strings in several pieces
messages = [name for line in re.findall(r"^- ((?:`[^`]+`(?:, )?)+): ", page, re.M) for name in re.findall(r"`([^`]+)`", line) if not re.fullmatch(r"[a-z_]+", name)]
checked["messages"] = len(messages)
for message in messages:
    for piece in (piece.strip(" '(),:") for piece in message.split("...")):
        if len(piece) > 5 and piece not in code and message not in LIBRARY_MESSAGES:
            faults.append(f"docs/messages.md: no source has '{piece}'")
for reason in sorted(reasons - set(re.findall(r"`(\w+)`", page))):
    faults.append(f"docs/messages.md: there is no remedy for the reason {reason}")
for what, count in checked.items():
    if count < least[what]:
        faults.append(f"only {count} {what} found ({least[what]} are expected): this test looks in the wrong place")
print(", ".join(f"{count} {what}" for what, count in checked.items()) + f", {len(faults)} faults")
sys.exit("\n".join(faults) or None)
