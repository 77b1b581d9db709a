# SPDX-License-Identifier: BSL-1.0
"""report.py OUTPUT_DIR: report.html of a run, one file that needs no network: what was run, its main numbers, the error budget,
settings, convergence and all figures. An example says what it shows by a `Words` of its own and calls `main`."""

import base64
import csv
import dataclasses
import datetime
import html
import json
import math
import os
import pathlib
import sys
import typing

sys.dont_write_bytecode = True

STYLE = """
:root { color-scheme: light dark; --text: #1d2329; --faint: #5c6670; --ground: #fbfbf9; --card: #ffffff; --line: #dcdfe2;
  --good: #00704f; --bad: #b3261e; --link: #005a9c; --marked: #fff4d6; }
@media (prefers-color-scheme: dark) { :root { --text: #e4e7ea; --faint: #9ba5af; --ground: #15181b; --card: #1e2226; --line: #363c42;
  --good: #5cc9a3; --bad: #ff8a80; --link: #7cc0f4; --marked: #40371c; } }
* { box-sizing: border-box; }
body { margin: 0; background: var(--ground); color: var(--text); font: 16px/1.5 system-ui, sans-serif; }
main { max-width: 62rem; margin: 0 auto; padding: 1.2rem 1rem 3rem; }
h1 { font-size: 1.6rem; line-height: 1.2; margin: 0 0 .4rem; } h2 { font-size: 1.2rem; margin: 2.2rem 0 .6rem; }
p { margin: .4rem 0; } .faint { color: var(--faint); font-size: .9rem; overflow-wrap: anywhere; }
nav { display: flex; flex-wrap: wrap; gap: .2rem 1rem; margin: .8rem 0; } a { color: var(--link); }
.verdict { border-left: .35rem solid var(--good); background: var(--card); padding: .5rem .8rem; margin: .9rem 0; }
.verdict.bad { border-color: var(--bad); } .verdict b { color: var(--good); } .verdict.bad b { color: var(--bad); }
.tiles { display: grid; grid-template-columns: repeat(auto-fill, minmax(10.5rem, 1fr)); gap: .6rem; margin: 0; }
.tiles div { background: var(--card); border: 1px solid var(--line); border-radius: .4rem; padding: .5rem .7rem; }
.tiles dt { color: var(--faint); font-size: .85rem; line-height: 1.3; }
.tiles dd { margin: 0; font-size: 1.15rem; font-variant-numeric: tabular-nums; overflow-wrap: anywhere; }
.scroll { overflow-x: auto; } table { border-collapse: collapse; width: 100%; font-size: .9rem; }
th, td { text-align: left; padding: .25rem .6rem; border-bottom: 1px solid var(--line); vertical-align: top; }
th { color: var(--faint); font-weight: 600; } td.number, th.number { text-align: right; white-space: nowrap; }
td.number { font-variant-numeric: tabular-nums; } tr.outside td { color: var(--bad); font-weight: 600; }
#budget td:last-child { min-width: 14rem; } tr.marked td { background: var(--marked); } code, pre { font-size: .85rem; } pre { overflow-x: auto; }
details { margin: .8rem 0; } summary { cursor: pointer; }
figure { margin: 1.4rem 0; } figure img { display: block; max-width: 100%; height: auto; margin: 0 auto; background: #fff;
  border-radius: .4rem; padding: .4rem; border: 1px solid var(--line); }
figcaption { font-size: .9rem; margin-bottom: .4rem; } figcaption b { font-size: 1rem; }
"""
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


@dataclasses.dataclass
class Words:
    """What an example says of its runs."""
    title: typing.Callable = lambda run: f"A run of {run.program}"
    lead: typing.Callable = lambda run: ""     # the scene in a sentence or two
    numbers: tuple = ()                        # of Number; empty: all that the summary has
    figures: dict = dataclasses.field(default_factory=dict)  # name: (title, what is to be seen), in the order of the page


class Run:
    """What the files of an output folder say; whatever is missing is empty."""

    def __init__(self, folder):
        self.folder = folder
        self.record = newest_record(folder)
        self.summary = read_json(folder / "summary.json")
        self.ensemble = read_json(folder / "ensemble.json")
        own = self.summary.get("run") if isinstance(self.summary.get("run"), dict) else {}
        self.program = str(self.record.get("program") or own.get("program") or folder.resolve().name)
        self.options = words_of(self.record.get("options") or own.get("options"))
        self.defaults = words_of(self.record.get("defaults"))
        told = {name: value for name, value in own.items() if isinstance(value, str)}
        self.build = words_of(self.record.get("build")) or {name: value for name, value in told.items()
                                                           if name not in ("program", "identity", "started")}

    def number(self, key):
        value = self.summary.get(key)
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        return float(value) if is_number and math.isfinite(value) else None

    def option(self, name, otherwise=""):
        return self.options.get(name, otherwise)


def read_json(path):
    try:
        value = json.loads(path.read_text())
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def newest_record(folder):
    records = sorted(folder.glob("run*.json"), key=lambda path: path.stat().st_mtime)
    return read_json(records[-1]) if records else {}


def words_of(lines):
    return {str(name): str(value) for name, value in lines.items()} if isinstance(lines, dict) else {}


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


def is_finished(run):
    return run.record.get("state", "finished") == "finished" and run.summary.get("status", "ok") == "ok"


def budget_of(run):
    budget = run.summary.get("error_budget")
    parts = budget.get("parts") if isinstance(budget, dict) else None
    return {name: part for name, part in parts.items() if isinstance(part, dict)} if isinstance(parts, dict) else {}


def how_it_ended(run):
    """In words; empty for a run that came to its end."""
    if is_finished(run):
        return ""
    state = run.record.get("state") or "unknown"
    why = run.summary.get("status", "") if state in ("finished", "running") else state
    reached = run.number("throw_over_depth")
    ended = "the run has not ended (or was killed)" if state == "running" else f"stopped ({why})"
    return f"INCOMPLETE: {ended}" + (f", at h/H = {reached:.5g}" if reached is not None else "")


def verdict(run):
    """How the run ended, and whether it is inside its error budget."""
    outside = [f"{name} is {said(part.get('value'), '.2g')}" + (f" (bound {said(part['bound'], '.2g')})" if "bound" in part else "")
               for name, part in budget_of(run).items() if part.get("within") is False]
    ended = how_it_ended(run)
    words = ended or "Finished"
    if outside:
        words += f"{'; ' if ended else ', but '}outside its error budget: {', '.join(outside)}"
    elif budget_of(run):
        words += ", inside its error budget"
    return element("p", f"<b>{text(words)}.</b>", class_="verdict bad" if outside or ended else "verdict")


def numbers(run, wanted):
    tiles = []
    if not wanted:
        wanted = [Number(key, key.replace("_", " "), "", ".5g") for key in run.summary if key not in NOT_SHOWN_AS_NUMBERS]
    for one in wanted:
        value = run.number(one.key)
        if value is not None:
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
                                                   "inside" if within else "OUTSIDE", part.get("meaning", ""))))
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


def read_rows(path):
    """Rows of a table, without a last one that is cut off."""
    try:
        whole = path.read_text()
    except OSError:
        return []
    return list(csv.DictReader(whole[: whole.rfind("\n") + 1].splitlines()))


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
    lead = (f"{len(attempts) - refused} accepted and {refused} refused load steps, "
            f"{sum(one['iterations'] for one in attempts)} iterations; largest residual of an accepted step {worst:.2g}.")
    rows = [("" if one["accepted"] else "outside",
             (one["step"], f"{one['load']:.5f}", one["iterations"], f"{one['residual']:.2e}",
              "accepted" if one["accepted"] else f"refused ({one['reason']})", one["dem"], f"{one['seconds']:.2f}"))
            for one in attempts]
    head = ("step", "load (h/H)", "iterations", "residual", "", "DEM steps", "seconds")
    return element("p", text(lead)) + folded("Every load step", table(head, rows, (0, 1, 2, 3, 5, 6)))


def started_at(run):
    try:
        return datetime.datetime.fromisoformat(str(run.record.get("started")).replace("Z", "+00:00")).timestamp()
    except ValueError:
        return 0.0


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


def ensemble(run):
    """Mean and scatter of the measures, and who took part."""
    measures = run.ensemble.get("measures")
    if not isinstance(measures, dict):
        return ""
    rows = [("", (name, *(said(one.get(key), ".4g") for key in ("mean", "scatter")), one.get("count", "")))
            for name, one in measures.items() if isinstance(one, dict)]
    links = [element("a", text(path.parent.name), href=f"{path.parent.name}/report.html")
             for path in sorted(run.folder.glob("seed_*/report.html"))]
    return table(("measure", "mean", "scatter", "runs"), rows, (1, 2, 3)) + \
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
{verdict(run) if not run.ensemble else ""}
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
    try:
        print(write(run, words))
    except OSError as trouble:
        print(f"no page: {trouble}", file=sys.stderr)
        sys.exit(1)


if __name__ == "__main__":
    main(Words())
