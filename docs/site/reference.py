# SPDX-License-Identifier: BSL-1.0
"""Pages of the site that are made from the code: command line, statuses and exit codes, headers with their classes, columns of output, tables of numbers."""
import ast
import csv
import os
import pathlib
import re
import subprocess
import sys
import xml.etree.ElementTree

ROOT = pathlib.Path(__file__).resolve().parents[2]
PROGRAMS = pathlib.Path(os.environ.get("SCARP_EXAMPLES", ROOT / "build" / "release" / "examples"))


def examples():
    """Name and purpose of every example, as `./examples/run` lists them."""
    listed = subprocess.run([ROOT / "examples" / "run"], capture_output=True, text=True, check=True).stdout
    return re.findall(r"^  (\w+) +(.*)$", listed, re.M)


def has_options(name):
    """Whether a program reads options: others would compute when they are called with --help."""
    folder = ROOT / "examples" / name
    sources = [*folder.glob("*.[ch]pp")] if folder.is_dir() else [ROOT / "examples" / "tutorials" / f"{name}.cpp"]
    return any("CLI::App" in source.read_text() for source in sources)


def arguments(script):
    """Options of a script that argparse reads, as entries of a list of definitions."""
    found = []
    for node in ast.walk(ast.parse(script.read_text())):
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Attribute) and node.func.attr == "add_argument":
            given = {word.arg: ast.unparse(word.value) for word in node.keywords}
            default = f"default `{given['default']}`" if "default" in given else ""
            about = plain(ast.literal_eval(given.get("help", "''")))
            described = f"{about} ({default})" if about and default else about or default or "&nbsp;"
            found.append(f"`{ast.literal_eval(node.args[0])}`\n:   {described}\n")
    return found


def help_text(*command):
    done = subprocess.run([*command, "--help"], capture_output=True, text=True, timeout=20)
    return done.stdout if done.returncode == 0 else None


def entries(text):
    """Options, positionals and subcommands of a help text of CLI11: pairs of head and description."""
    found = []
    for line in text.splitlines():
        if head := re.match(r"  (\S.*?)(?:\s{2,}(.*))?$", line):
            found.append([head[1], head[2] or ""])
        elif found and (more := re.match(r"\s{10,}(\S.*)$", line)):
            found[-1][1] = f"{found[-1][1]} {more[1]}".strip()
    return found


def option(head, description):
    """An option as an entry of a list of definitions."""
    name, _, kind = head.partition(" ")
    kind, *conditions = re.split(r" ?(?=Excludes: |Needs: )", kind)
    kind, _, default = kind.rpartition("=") if "=" in kind else (kind, "", "")
    first, _, bounds = kind.partition(":")
    details = [(bounds or first).strip(), f"default `{default}`" if default else "",
               *(re.sub(r"(-[\w-]+)", r"`\1`", condition[:1].lower() + condition[1:]) for condition in conditions)]
    details = "; ".join(detail for detail in details if detail)
    return f"`{name.replace(',', '`, `')}`\n:   {plain(description)}{f' ({details})' if details else ''}\n"


def options(printed):
    """Entries of all options but --help and --version.
    Ends the program for a help text in another form than CLI11's."""
    if len(entries(printed)) < 2:
        sys.exit(f"no options were found in a help text (that of CLI11 is expected): {printed[:200]}")
    return [option(*entry) for entry in entries(printed) if not entry[0].startswith(("-h,--help", "--version"))]


def plain(text):
    """Text that Markdown must not take for markup."""
    return re.sub(r"([\\*_<>\[\]|`])", r"\\\1", text)


def sentence(text):
    return plain(text[:1].upper() + text[1:]) + ("" if text.endswith((".", "?")) else ".")


def command_line():
    text = ["# Command line", "", "Every example and its options, as `./examples/run NAME --help` prints them. `--help` and `--version` are left out.", ""]
    for name, purpose in examples():
        text += [f"## {name}", "", sentence(purpose), ""]
        script = ROOT / "examples" / name / f"{name}.py"
        if script.exists() or not has_options(name):
            text += [f"`./examples/run {name}`", "", *(arguments(script) if script.exists() else []), ""]
            continue
        program = PROGRAMS / name
        printed = help_text(program) if program.exists() else None
        if printed is None:
            text += [f"The program was not built with this site: `./examples/run {name} --help` prints its options.", ""]
            continue
        rest, _, commands = printed.partition("\nSubcommands:\n")
        text += options(rest)
        for command, about in entries(commands):
            text += ["", f"### {name} {command}", "", sentence(about), ""]
            text += options(help_text(program, command))
        text.append("")
    return "\n".join(text)


def enumerators(kind):
    """Name and meaning of the values of an enumeration of core/status.hpp."""
    header = (ROOT / "include" / "scarp" / "core" / "status.hpp").read_text()
    body = re.search(rf"enum class {kind} [^{{]*\{{(.*?)\}};", header, re.S)[1]
    found = re.findall(r"^ *(\w+)(?: = \d+)?,? *(?:///< (.*))?$", body, re.M)
    if unexplained := [name for name, meaning in found if not meaning]:
        sys.exit(f"values of {kind} without a meaning: {', '.join(unexplained)}: write it in core/status.hpp")
    return found


def users(reason):
    """Headers that report a reason, by their path below include/scarp."""
    folder = ROOT / "include" / "scarp"
    return [path.relative_to(folder).as_posix() for path in sorted(folder.rglob("*.hpp"))
            if path.name != "status.hpp" and re.search(rf"Reason::{reason}\b", path.read_text())]


def statuses(api):
    codes = re.search(r"^\| exit code .*?(?=^\n)", (ROOT / "docs" / "checkpoints.md").read_text() + "\n", re.M | re.S)[0]
    text = ["# Statuses, reasons and exit codes", "", "What a response, a load step or a run can end with. [Messages](../messages.md) has what to do.",
            "", "## Statuses", "", "| status | meaning |", "|---|---|"]
    text += [f"| `{name}` | {meaning} |" for name, meaning in enumerators("Status")]
    text += ["", "## Reasons", "", "| reason | meaning | reported by |", "|---|---|---|"]
    for name, meaning in enumerators("Reason"):
        headers = ", ".join(f"[`{path}`](../api/{api[path]})" for path in users(name) if path in api) if name != "none" else ""
        text.append(f"| `{name}` | {meaning} | {headers} |")
    return "\n".join([*text, "", "## Exit codes of the examples", "", codes])


def header_path(compound):
    """Path below include/scarp of a header that Doxygen names in its tags."""
    return (compound.findtext("path") + compound.findtext("name")).rpartition("include/scarp/")[2]


def headers(tags, api):
    """Every public header by room, with the classes and concepts that it declares."""
    rooms = re.findall(r"\\defgroup (\w+) (\S+): (.*?) \*/", (ROOT / "docs" / "site" / "rooms.dox").read_text())
    text = ["# C++ headers", "", "Classes and concepts of each header. [The C++ reference](../api/index.html) has their members, and a search of names.", ""]
    files = {}
    for compound in xml.etree.ElementTree.parse(tags).getroot():
        if compound.get("kind") == "file":
            path = header_path(compound)
            declared = [entry.text.removeprefix("scarp::") for entry in [*compound.findall("class"), *compound.findall("concept")]]
            files[path] = sorted({name for name in declared if name in api and "::" not in name})
    if missing := sorted({path.rpartition("/")[0] for path in files} - {room for _, room, _ in rooms}):
        sys.exit(f"rooms without a group (each needs one): {', '.join(missing)}: add them to docs/site/rooms.dox")
    for group, room, about in rooms:
        text += [f"## {room}", "", f"[{about}](../api/group__{group.replace('_', '__')}.html)", ""]
        for path in sorted(path for path in files if path.rpartition("/")[0] == room):
            names = ", ".join(f"[`{name}`](../api/{api[name]})" for name in files[path])
            text.append(f"- [`scarp/{path}`](../api/{api[path]}){': ' + names if names else ''}")
        text.append("")
    return "\n".join(text)


def tables():
    text = ["# Tables of numbers", "", "The first line of each file names command, commit and machine.", ""]
    for file in sorted((ROOT / "docs" / "data").glob("*.csv")):
        text.append(f"- [{file.name}](../data/{file.name}): {plain(file.read_text().splitlines()[0].lstrip('# '))}")
    return "\n".join(text) + "\n"


def columns():
    """Columns and keys of the output files, a table for each file."""
    text = ["# Columns of output files", "", "Every column and key, by program and file. [Output files](output.md) lists what the programs write.", ""]
    with open(ROOT / "docs" / "reference" / "output_columns.csv", newline="") as table:
        rows = list(csv.DictReader(table))
    for row, before in zip(rows, [{}, *rows]):
        if row["program"] != before.get("program"):
            text += ["", f"## `{row['program']}`"]
        if (row["program"], row["files"]) != (before.get("program"), before.get("files")):
            files = re.sub(r"[*/\w]+[.][a-z]+", r"`\g<0>`", row["files"])
            text += ["", f"### {files}", "", "| name | unit | positive | meaning |", "|---|---|---|---|"]
        names = ", ".join(f"`{name}`" for name in row["names"].split("; "))
        text.append(f"| {names} | {row['unit']} | {row['positive']} | {plain(row['meaning'])} |")
    return "\n".join(text) + "\n"


def pages(tags, api):
    """Text of each page, by its path in the site. Programs are those in SCARP_EXAMPLES, by default build/release/examples."""
    return {"reference/command_line.md": command_line(), "reference/statuses.md": statuses(api), "reference/api.md": headers(tags, api),
            "reference/columns.md": columns(), "reference/tables.md": tables()}
