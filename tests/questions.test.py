# SPDX-License-Identifier: BSL-1.0
"""Readers find what they look for: each question of docs/data/reader_questions.csv is answered within two pages and 600 words. A reader begins at a
page of the table's column `start`, reads it down to the column `link`, if there is one, then the linked page from its top, or from the section that the link names, down
to the column `last_words`. `--write` writes the counted pages and words into the table."""
import csv
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
TABLE = ROOT / "docs" / "data" / "reader_questions.csv"
WORDS = 600
STALE = 60  # words by which a count of the table may differ from the page's
LEAST = 34  # questions
HEAD = "# tests/questions.test.py --write, the commit of this file, any machine; words are read in order, code and tables included"


def slug(heading):
    """Anchor of a heading, as GitHub and the site make it."""
    return re.sub(r"[-\s]+", "-", re.sub(r"[^\w\s-]", "", heading.lower()).strip())


def section(text, anchor):
    """Text of a page from the heading of an anchor on; None where there is none."""
    for match in re.finditer(r"^#+ (.*)$", text, re.M):
        if slug(match[1]) == anchor:
            return text[match.start():]
    return None


def words_to(text, end):
    """Words of a text up to the end of a phrase; None where it does not hold the phrase."""
    place = text.find(end)
    return None if place < 0 else len(text[:place + len(end)].split())


def cost(row):
    """(pages, words, None) of the way to an answer, or (0, 0, what is missing)."""
    start = ROOT / row["start"]
    text = start.read_text()
    if not row["link"]:
        read = words_to(text, row["last_words"])
        return (1, read, None) if read else (0, 0, f"{row['start']} does not hold '{row['last_words']}'")
    before = words_to(text, f"]({row['link']})")
    if before is None:
        return 0, 0, f"{row['start']} does not link {row['link']}"
    file, _, anchor = row["link"].partition("#")
    target = start.parent / file
    text = target.read_text() if target.is_file() else ""
    text = section(text, anchor) if anchor else text
    after = words_to(text or "", row["last_words"])
    return (2, before + after, None) if after else (0, 0, f"{row['link']} does not hold '{row['last_words']}'")


with TABLE.open() as file:
    rows = list(csv.DictReader(line for line in file if not line.startswith("#")))
faults = [] if len(rows) >= LEAST else [f"only {len(rows)} questions of {LEAST}"]
for row in rows:
    pages, words, missing = cost(row)
    if missing:
        faults.append(f"'{row['question']}': {missing}")
        continue
    if words > WORDS:
        faults.append(f"'{row['question']}' takes {words} words (at most {WORDS})")
    if "--write" not in sys.argv and abs(words - int(row["words"] or 0)) > STALE:
        faults.append(f"'{row['question']}' takes {words} words, the table has {row['words']}: run tests/questions.test.py --write")
    row["pages"], row["words"] = pages, words
if "--write" in sys.argv:
    with TABLE.open("w") as file:
        print(HEAD, file=file)
        writer = csv.DictWriter(file, rows[0].keys(), lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
counts = sorted(int(row["words"] or 0) for row in rows)
print(f"{len(rows)} questions, {counts[len(counts) // 2]} words (median), {counts[-1]} at most, {len(faults)} faults")
sys.exit("\n".join(faults) or None)
