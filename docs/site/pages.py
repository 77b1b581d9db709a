# SPDX-License-Identifier: BSL-1.0
"""pages.py FOLDER API_TAGS: gathers the pages of the site in a folder. Pages of the repository get links that hold there, and names of
classes, concepts and headers link the C++ reference; reference.py writes the others."""
import pathlib
import re
import shutil
import sys
import textwrap
import xml.etree.ElementTree

import reference

ROOT = pathlib.Path(__file__).resolve().parents[2]
KATEX = pathlib.Path("/usr/share/javascript/katex")
# Where pages outside of docs, and folders, are in the site.
MOVED = {"README.md": "index.md", "docs/README.md": "pages.md", "CHANGELOG.md": "changelog.md", "tests/README.md": "tests.md",
         "benchmarks/README.md": "benchmarks.md", "docs/data": "reference/tables.md",
         "docs/reference/output_columns.csv": "reference/columns.md"}


def site_path(source):
    """Place in the site of a file of the repository; None for those that are not in it."""
    return MOVED.get(source) or (source.removeprefix("docs/") if source.startswith("docs/") else None)


def relative(target, page):
    """Link from a page of the site to a file of it."""
    return "../" * page.count("/") + target


def with_links(text, source, page, api):
    """Text of a page with its links as the site needs them. Links to what is not in the site become plain text; the first code span of
    each name that the C++ reference has becomes a link."""
    linked = set()

    def moved(match):
        label, target, anchor = match.groups()
        if re.match(r"[a-z]+:", target):
            return match[0]
        resolved = (ROOT / source).parent.joinpath(target).resolve().relative_to(ROOT).as_posix()
        place = site_path(resolved)
        return f"[{label}]({relative(place, page)}{anchor or ''})" if place else label

    def named(match):
        name = re.match(r"(?:scarp::|include/)?([\w./]+)", match[1])
        address = api.get(name[1].removeprefix("scarp/")) if name else None
        if address is None or match[1] in linked:
            return match[0]
        linked.add(match[1])
        return f"[{match[0]}]({relative('api/' + address, page)})"

    lines = []
    fenced = False
    for line in text.splitlines():
        fenced ^= line.startswith("```")
        if not fenced:
            line = re.sub(r"\[([^\]]*)\]\(([^)\s#]+)(#[^)\s]*)?\)", moved, line)
            if not line.startswith("#"):
                line = with_whole_options(line)
                line = re.sub(r"(?<!\[)`([^`]+)`(?!\])", named, line)
        lines.append(line)
    return "\n".join(lines) + "\n"


def with_tabs(text):
    """Text in which blocks of code in several languages, each right below the one before, are tabs."""
    titles = {"sh": "Command line", "cpp": "C++", "python": "Python"}
    block = rf"^```({'|'.join(titles)})\n(?:(?!```).*\n)*```\n"

    def tabs(match):
        return "\n".join(f'=== "{titles[one[1]]}"\n\n{textwrap.indent(one[0], "    ")}'
                         for one in re.finditer(block, match[0], re.MULTILINE))

    return re.sub(f"(?:{block}){{2,}}", tabs, text, flags=re.MULTILINE)


def with_whole_options(text):
    """Text whose options get a class of their own, so that no line ends within one."""
    return re.sub(r"`(--[\w-]+)`(?!\{)", r"`\1`{.option}", text)


def api_addresses(tags):
    """Page of the C++ reference for each class and concept, by its name, and each header, by its path below include/scarp."""
    addresses = {}
    for compound in xml.etree.ElementTree.parse(tags).getroot():
        name = compound.findtext("name")
        if compound.get("kind") in ("class", "struct", "concept") and "<" not in name:
            addresses[name.removeprefix("scarp::")] = compound.findtext("filename").removesuffix(".html") + ".html"
        elif compound.get("kind") == "file":
            addresses[reference.header_path(compound)] = compound.findtext("filename").removesuffix(".html") + ".html"
    return addresses


def main(folder, tags):
    api = api_addresses(tags)
    if len(api) < 400:
        sys.exit(f"{tags} names {len(api)} classes and headers (at least 400 are expected): see docs/site/Doxyfile")
    sources = [*MOVED, *(path.relative_to(ROOT).as_posix() for path in (ROOT / "docs").rglob("*.md"))]
    for source in sorted({source for source in sources if source.endswith(".md")}):
        page = site_path(source)
        (folder / page).parent.mkdir(parents=True, exist_ok=True)
        (folder / page).write_text(with_tabs(with_links((ROOT / source).read_text(), source, page, api)))
    for page, text in reference.pages(tags, api).items():
        (folder / page).parent.mkdir(parents=True, exist_ok=True)
        (folder / page).write_text(with_whole_options(text))
    shutil.copytree(ROOT / "docs" / "figures", folder / "figures")
    shutil.copytree(ROOT / "docs" / "data", folder / "data")
    shutil.copy(ROOT / "docs" / "CITATION.cff", folder)
    assets = folder / "assets"
    shutil.copytree(KATEX / "fonts", assets / "katex" / "fonts", ignore=shutil.ignore_patterns("*.ttf", "*.woff"))
    for file in (KATEX / "katex.min.css", KATEX / "katex.min.js", KATEX / "contrib" / "auto-render.js"):
        shutil.copy(file, assets / "katex" / file.name)
    for file in ("site.css", "formulas.js"):
        shutil.copy(ROOT / "docs" / "site" / file, assets)


main(pathlib.Path(sys.argv[1]), sys.argv[2])
