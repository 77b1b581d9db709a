# SPDX-License-Identifier: BSL-1.0
"""Sections of a page that a program writes, between the lines <!-- NAME --> and <!-- end of NAME -->, and their tables."""

import math
import re
import statistics
import sys


def with_section(page, name, text):
    """The page with this section replaced, or added at its end under a title when it has none.
    Exits when one of the two lines was lost."""
    first, last = f"<!-- {name} -->", f"<!-- end of {name} -->"
    block = f"{first}\n{text}\n{last}"
    if page.count(first) != page.count(last) or page.count(first) > 1:
        sys.exit(f"the page has no pair of lines '{first}', '{last}' (one was lost): mend the page")
    if first not in page:
        return f"{page.rstrip()}\n\n## {name}\n\n{block}\n"
    return re.sub(re.escape(first) + ".*?" + re.escape(last), lambda _: block, page, flags=re.DOTALL)


def rows_on(page, section):
    """Cells of the rows of a table in a section of the page, without its two head lines."""
    found = re.search(f"<!-- {re.escape(section)} -->(.*?)<!-- end of", page, re.DOTALL)
    lines = [line for line in found.group(1).splitlines() if line.startswith("|")] if found else []
    return [[cell.strip() for cell in line.strip("|").split("|")] for line in lines[2:]]


def rewrite(path, page):
    """Replaces the file at once, so that an interruption leaves the old page."""
    partial = path.with_suffix(".partial")
    partial.write_text(page)
    partial.replace(path)


def table(columns, rows):
    """Markdown of rows of words."""
    return "\n".join("| " + " | ".join(line) + " |" for line in [columns, ["---"] * len(columns), *rows])


def number(value, digits=1):
    return "-" if value is None or math.isnan(value) else f"{round(value, digits) + 0.0:.{digits}f}"  # + 0: no minus before zero


def spread(values, digits=1, digits_of_deviation=None):
    """Mean +- sample standard deviation of what is known, in words."""
    known = [value for value in values if not math.isnan(value)]
    if len(known) < 2:
        return number(known[0], digits) if known else "-"
    return f"{number(statistics.fmean(known), digits)} +- {number(statistics.stdev(known), digits if digits_of_deviation is None else digits_of_deviation)}"
