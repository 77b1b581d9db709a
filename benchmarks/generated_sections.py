# SPDX-License-Identifier: BSL-1.0
"""Sections of a page that a program writes, between the lines <!-- NAME --> and <!-- end of NAME -->, and their tables."""

import re
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


def rewrite(path, page):
    """Replaces the file at once, so that an interruption leaves the old page."""
    partial = path.with_suffix(".partial")
    partial.write_text(page)
    partial.replace(path)


def table(columns, rows):
    """Markdown of rows of words."""
    return "\n".join("| " + " | ".join(line) + " |" for line in [columns, ["---"] * len(columns), *rows])
