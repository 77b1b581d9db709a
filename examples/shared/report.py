# SPDX-License-Identifier: BSL-1.0
"""report.py OUTPUT_DIR: report.html of a run, one file that needs no network: what was run, its main numbers, the error budget,
settings, convergence and all figures. An example says what it shows by a `Words` of its own and calls `main`."""

import base64
import dataclasses
import html
import math
import os
import pathlib
import sys
import typing

sys.dont_write_bytecode = True
from run_files import Run, budget_of, is_finished, read_rows, started_at

STYLE = (pathlib.Path(__file__).resolve().parent / "report.css").read_text()
# Whatever stands in the files of a run: nothing is fetched, and nothing runs.
POLICY = "default-src 'none'; img-src data:; style-src 'unsafe-inline'"
IMAGE_TYPES = {".png": "image/png", ".gif": "image/gif"}
NOT_SHOWN_AS_NUMBERS = ("run", "error_budget", "status")


class Number(typing.NamedTuple):
    """A number of summary.json as a reader wants it."""
    key: str
    label: str
    unit: str = ""
    form: str = ".3g"
    factor: float = 1.0
    even_zero: bool = True  # or else zero is left out


@dataclasses.dataclass
class Words:
    """What an example says of its runs."""
    title: typing.Callable = lambda run: f"A run of {run.program}"
    lead: typing.Callable = lambda run: ""     # the scene in a sentence or two
    numbers: tuple = ()                        # of Number; empty: all that the summary has
    figures: dict = dataclasses.field(default_factory=dict)  # name: (title, what is to be seen), in the order of the page


def text(value):
    return html.escape(str(value), quote=True)


def element(tag, inside, **attributes):
    """inside: HTML; attributes: text"""
    said = "".join(f' {name.rstrip("_")}="{text(value)}"' for name, value in attributes.items())
    return f"<{tag}{said}>{inside}</{tag}>"


def table(head, rows, numbers=()):
    """rows: (class, cells) of text; numbers: columns that are"""
    def line(tag, cells):
        return "".join(element(tag, text(cell), **({"class": "number"} if k in numbers else {})) for k, cell in enumerate(cells))
    body = "\n".join(element("tr", line("td", cells), **({"class": kind} if kind else {})) for kind, cells in rows)
    return element("div", f"<table><thead><tr>{line('th', head)}</tr></thead>\n<tbody>{body}</tbody></table>", class_="scroll")


def section(name, title, inside):
    return element("section", f"<h2>{text(title)}</h2>\n{inside}", id=name) if inside else ""


def folded(title, inside):
    return f"<details><summary>{text(title)}</summary>\n{inside}</details>" if inside else ""


def how_it_ended(run):
    """In words; empty for a run that came to its end."""
    if is_finished(run):
        return ""
    state = run.record.get("state") or "unknown"
    why = run.summary.get("status", "") if state in ("finished", "running") else state
    reached = run.number("throw_over_depth")
    ended = "the run has not ended (or was killed)" if state == "running" else f"stopped ({why})"
    return f"INCOMPLETE: {ended}" + (f", at h/H = {reached:.5g}" if reached is not None else "")


def members_outside(run):
    """Members of an ensemble that are outside their error budgets, in words."""
    return [f"seed {member.get('seed')} ({', '.join(member['outside_budget'])})" for member in run.ensemble.get("members", [])
            if isinstance(member, dict) and isinstance(member.get("outside_budget"), dict)]


def verdict(run):
    """How the run, or the members of an ensemble, ended, and whether it is inside its error budget."""
    outside = [f"{name} is {said(part.get('value'), '.2g')}" + (f" (bound {said(part['bound'], '.2g')})" if "bound" in part else "")
               for name, part in budget_of(run).items() if part.get("within") is False]
    ended = how_it_ended(run)
    words = ended or "Finished"
    if outside:
        words += f"{'; ' if ended else ', but '}outside its error budget: {', '.join(outside)}"
    elif budget_of(run):
        words += f", {'so far ' if ended else ''}inside its error budget"
    if run.ensemble:
        outside = members_outside(run)
        if outside:
            words += f"; outside their error budgets: {', '.join(outside)}"
        elif any(isinstance(member, dict) and member.get("status") == "ok" for member in run.ensemble.get("members", [])):
            words += ", all members that ended inside their error budgets"
    return element("p", f"<b>{text(words)}.</b>", class_="verdict bad" if outside or ended else "verdict")


def numbers(run, wanted):
    tiles = []
    if not wanted:
        wanted = [Number(key, key.replace("_", " "), "", ".5g") for key in run.summary if key not in NOT_SHOWN_AS_NUMBERS]
    for one in wanted:
        value = run.number(one.key)
        if value or (value is not None and one.even_zero):
            shown = f"{value * one.factor:{one.form}} {one.unit}".strip()
            tiles.append(f"<div><dt>{text(one.label)}</dt><dd>{text(shown)}</dd></div>")
    return element("dl", "\n".join(tiles), class_="tiles") if tiles else ""


def all_numbers(run):
    rows = [("", (key, value)) for key, value in flat(run.summary) if key.split(".")[0] not in NOT_SHOWN_AS_NUMBERS]
    return folded("All numbers of summary.json", table(("name", "value"), rows, (1,))) if rows else ""


def flat(values, before=""):
    """(name, value) of nested objects and lists."""
    items = values.items() if isinstance(values, dict) else enumerate(values)
    for key, value in items:
        if isinstance(value, (dict, list)):
            yield from flat(value, f"{before}{key}.")
        else:
            yield f"{before}{key}", "not a number" if value is None else value


def said(value, form):
    return format(value, form) if isinstance(value, (int, float)) and not isinstance(value, bool) else "not a number"


def budget(run):
    rows = []
    for name, part in budget_of(run).items():
        within = part.get("within") is not False
        bound = said(part["bound"], ".3g") if "bound" in part else "none"
        rows.append(("" if within else "outside", (name, said(part.get("value"), ".3g"), bound,
                                                   "OUTSIDE" if not within else "inside" if "bound" in part else "", part.get("meaning", ""))))
    return table(("part", "value", "bound", "", "what it is"), rows, (1, 2)) if rows else ""


def settings(run):
    if not run.options:
        return ""
    def differs(name):
        return name in run.defaults and run.options[name] != run.defaults[name]
    changed = [name for name in run.options if differs(name)]
    rows = [("marked" if differs(name) else "", (f"--{name}", value, run.defaults.get(name, "") if differs(name) else ""))
            for name, value in run.options.items()]
    head = ("option", "value", "default")
    marked = [row for row in rows if row[0]]
    known = f"{len(changed)} of {len(rows)} differ from their defaults." if run.defaults else ""
    return (element("p", text(known)) if known else "") + (table(head, marked) if marked else "") + \
        folded("All options", table(head, rows))


def convergence(run):
    """A line for each attempt at a load step: convergence.csv has one for each iteration."""
    attempts = []
    for row in read_rows(run.folder / "convergence.csv"):
        try:
            iteration = int(row["iteration"])
            if iteration == 1 or not attempts:
                attempts.append({"dem": 0, "seconds": 0.0})
            last = attempts[-1]
            last.update(step=row["step"], load=float(row.get("throw_over_depth") or "nan"), iterations=iteration,
                        residual=float(row["residual"]), accepted=row["accepted"] == "1", reason=row.get("reason", ""))
            last["dem"] += int(row.get("dem_steps") or 0)
            last["seconds"] += float(row.get("seconds") or 0.0)
        except (KeyError, ValueError, TypeError):
            return ""
    if not attempts:
        return ""
    refused = sum(not one["accepted"] for one in attempts)
    worst = max((one["residual"] for one in attempts if one["accepted"]), default=math.nan)
    lead = (f"{len(attempts) - refused} accepted and {refused} rejected load steps, "
            f"{sum(one['iterations'] for one in attempts)} iterations; largest residual of an accepted step {worst:.2g}.")
    rows = [("" if one["accepted"] else "outside",
             (one["step"], f"{one['load']:.5f}", one["iterations"], f"{one['residual']:.2e}",
              "accepted" if one["accepted"] else f"rejected ({one['reason']})", one["dem"], f"{one['seconds']:.2f}"))
            for one in attempts]
    head = ("step", "load (h/H)", "iterations", "residual", "", "DEM steps", "seconds")
    return element("p", text(lead)) + folded("Every load step", table(head, rows, (0, 1, 2, 3, 5, 6)))


def figures(run, known):
    """Those that are not older than the run, in the order of `known`."""
    since = started_at(run)
    found = {path.stem: path for path in sorted((run.folder / "figures").glob("*"))
             if path.suffix in IMAGE_TYPES and path.stat().st_mtime >= since}
    ordered = [name for name in known if name in found] + [name for name in found if name not in known]
    shown = []
    for name in ordered:
        title, seen = known.get(name, (name.replace("_", " ").capitalize(), ""))
        data = base64.b64encode(found[name].read_bytes()).decode()
        image = f'<img alt="{text(f"{title}. {seen}".strip())}" src="data:{IMAGE_TYPES[found[name].suffix]};base64,{data}">'
        caption = element("figcaption", f"<b>{text(title)}</b> {text(seen)}")
        shown.append(element("figure", f"{caption}\n{image}", id=f"figure-{name}"))
    return "\n".join(shown)


def member_folders(run):
    return [run.folder / member["folder"] for member in run.ensemble.get("members", [])]


def ensemble(run):
    """Mean and scatter of the measures, and who took part."""
    measures = run.ensemble.get("measures")
    if not isinstance(measures, dict):
        return ""
    def number(one, key):
        return said(one[key] * one.get("factor", 1.0) if isinstance(one.get(key), float) else one.get(key), ".4g")
    rows = [("", (one.get("what", name), number(one, "mean"), number(one, "scatter"), one.get("unit", ""), one.get("count", ""), name))
            for name, one in measures.items() if isinstance(one, dict)]
    links = [element("a", text(member.name), href=f"{member.name}/report.html")
             for member in member_folders(run) if (member / "report.html").is_file()]
    return table(("measure", "mean", "scatter", "", "runs", "key"), rows, (1, 2, 4)) + \
        (element("p", "Pages of the members: " + ", ".join(links)) if links else "")


def page(run, words):
    built = ", ".join(f"{name}: {value}" for name, value in run.build.items())
    when = ", ".join(f"{name} {run.record[name]}" for name in ("started", "changed") if run.record.get(name))
    summary = run.folder / "summary.txt" if run.summary else run.folder / "ensemble.txt"
    printed = folded("What the run printed", element("pre", text(summary.read_text(errors="replace")))) if summary.is_file() else ""
    parts = (("numbers", "Numbers", numbers(run, words.numbers) + all_numbers(run) + printed if not run.ensemble else ""),
             ("ensemble", "Mean and scatter", ensemble(run) + printed if run.ensemble else ""),
             ("budget", "Error budget", budget(run)),
             ("figures", "Figures", figures(run, words.figures)),
             ("convergence", "Convergence", convergence(run)),
             ("settings", "Settings", settings(run)))
    sections = [(name, title, inside) for name, title, inside in parts if inside]
    links = "".join(element("a", text(title), href=f"#{name}") for name, title, _ in sections)
    title = text(words.title(run))
    lead = words.lead(run)
    return f"""<!DOCTYPE html>
<html lang="en">
<head>
<meta charset="utf-8">
<meta name="viewport" content="width=device-width, initial-scale=1">
<meta http-equiv="Content-Security-Policy" content="{text(POLICY)}">
<title>{title}</title>
<link rel="icon" href="data:,">
<style>{STYLE}</style>
</head>
<body>
<main>
<h1>{title}</h1>
{element("p", text(lead)) if lead else ""}
{verdict(run)}
<nav>{links}</nav>
{chr(10).join(section(*one) for one in sections)}
<section id="made"><h2>Made by</h2>
<p class="faint">{text(run.program)}{text(f" ({when})" if when else "")}</p>
<p class="faint">{text(built)}</p></section>
</main>
</body>
</html>
"""


def write(run, words):
    path = run.folder / "report.html"
    partial = path.with_name(f"{path.name}.partial-{os.getpid()}")
    try:
        partial.write_text(page(run, words), encoding="utf-8")
        partial.replace(path)
    finally:
        partial.unlink(missing_ok=True)
    return path


def main(words):
    """Ends the program: 0, 1 when there is no run to tell of or the page cannot be written, 2 for a wrong call."""
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        print(f"usage: {sys.argv[0]} OUTPUT_DIR   (the folder that an example wrote)", file=sys.stderr)
        sys.exit(2)
    run = Run(pathlib.Path(sys.argv[1]))
    if not run.record and not run.summary:
        print(f"no page: '{run.folder}' holds no run.json (no run of an example has begun there): give another folder",
              file=sys.stderr)
        sys.exit(1)
    members = [Run(folder) for folder in member_folders(run) if (folder / "run.json").is_file()]
    try:
        for one in [*members, run]:
            print(write(one, words))
    except OSError as trouble:
        print(f"no page: {trouble}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main(Words())
