# SPDX-License-Identifier: BSL-1.0
"""The pages read plainly: short sentences with few numbers, short tables, terms of the field, noun phrases as headings."""
import pathlib
import re
import statistics
import sys

import terms

ROOT = pathlib.Path(__file__).resolve().parents[1]
MEDIAN = 17  # words of a sentence
LONGEST = 35
NUMBERS = 3  # of a sentence
ROWS = 12  # of a table; longer ones are files in docs/data
# Pages and folders whose tables are looked up, not read.
REFERENCES = ("benchmarks/README.md", "docs/user_defined_parts.md", "docs/error-budget.md", "docs/reference/")
TERMS = terms.TERMS | {
    r"(?<!reference )\bthe study('s)?": "the reference study or (Author, year)", "main job": "default case", "in the place of": "instead of",
    "(by|until) now|since then": "what holds in this version", "likewise|the former|the latter": "the thing, since nothing may depend on its place"}
# Heads that are sentences or riddles.
NO_NOUN = re.compile(r"[?!.]$|^(how|what|why|when|where|which|who|if|that|nothing|everything|can|do|use|write)\b"
                     r"|\b(is|are|does|has|have|must|should|cannot)\b", re.IGNORECASE)
# A value with its scatter, 3.5 +- 0.1, counts once; digits of names (Tri3, x50, x86-64, .4) do not count.
NUMBER = re.compile(r"(?<![\w.`-])-?\d[\d.,]*(?:e-?\d+)?(?: \+- [\d.]+)?(?![\w.-]*[A-Za-z])")
CITATION = re.compile(r"\([^()]*\b(19|20)\d\d\b[^()]*\)")  # author, year, journal
# One fault of each kind, which the rules must find.
SAMPLE = ("# Can it fail?\n\n" + "word " * 36 + "end.\n\nIt has 1, 2, 3 and 4 parts.\n\nThe law answers.\n\n" + "| a |\n" * 15)
SAMPLE_FAULTS = ["heading", "37 words", "4 numbers", "'answers'", "rows"]


def bare(line):
    """A line without markup: a piece of code or a formula is one word, a link its label, a picture nothing."""
    line = re.sub(r"!\[[^\]]*\]\([^)]*\)", "", re.sub(r"`[^`]+`|\$[^$]+\$", "Code", line))
    return re.sub(r"\[([^\]]*)\]\([^)]*\)", r"\1", line).replace("**", "")


def sentences(paragraph):
    """Sentences of a paragraph or list item, each as text."""
    pieces = re.split(r"(?<!e\.g\.)(?<!i\.e\.)(?<=[.!?])[*_)\"]*\s+", paragraph)
    return [piece for piece in pieces if re.search(r"\w", piece)]


def paragraphs(lines):
    """Number of the first line and text of each paragraph and list item; tables, code, formulas and headings apart."""
    first, text, fenced = 0, [], False
    for number, line in enumerate([*lines, ""], 1):
        fence = line.lstrip().startswith(("```", "$$"))
        fenced ^= fence
        apart = fence or fenced or not line.strip() or line.startswith(("|", "#"))
        if text and (apart or re.match(r"\s*([-*]|\d+\.) ", line)):
            yield first, " ".join(text)
            text = []
        if not apart:
            first = first if text else number
            text.append(re.sub(r"^\s*([-*]|\d+\.) ", "", bare(line)).strip())


def faults_of(page, content):
    """Faults of a page, and the lengths of its sentences [words]."""
    lines = content.splitlines()
    faults, lengths, rows, fenced = [], [], 0, False
    for number, line in enumerate(lines, 1):
        fenced ^= line.lstrip().startswith(("```", "$$"))
        rows = rows + 1 if line.startswith("|") and not fenced else 0
        if rows == ROWS + 3 and not page.startswith(REFERENCES):
            faults.append(f"{page}:{number}: a table of more than {ROWS} rows (move it to docs/data)")
        if not fenced and line.startswith("#") and NO_NOUN.search(bare(line).lstrip("# ")):
            faults.append(f"{page}:{number}: the heading is no noun phrase: {line}")
        for word, term in TERMS.items():
            if not fenced and (match := re.search(rf"\b({word})\b", bare(line), re.IGNORECASE)):
                faults.append(f"{page}:{number}: '{match[0]}': write {term}")
    for number, paragraph in paragraphs(lines):
        for sentence in sentences(paragraph):
            lengths.append(sum(1 for word in sentence.split() if re.search(r"\w", word)))
            where = f"{page}:{number}: '{sentence[:50]}...' has"
            if lengths[-1] > LONGEST:
                faults.append(f"{where} {lengths[-1]} words (at most {LONGEST})")
            if (count := len(NUMBER.findall(CITATION.sub("", sentence)))) > NUMBERS:
                faults.append(f"{where} {count} numbers (at most {NUMBERS})")
    return faults, lengths


found = faults_of("sample", SAMPLE)[0]
faults = [f"the rules do not find '{fault}'" for fault in SAMPLE_FAULTS if sum(fault in one for one in found) != 1]
counted = 0
folders = ["docs", "benchmarks", "tests", "examples"]
pages = sorted({*ROOT.glob("*.md"), *(page for folder in folders for page in (ROOT / folder).rglob("*.md") if "output" not in page.parts)})
for path in pages:
    page = path.relative_to(ROOT).as_posix()
    own, lengths = faults_of(page, path.read_text())
    counted += len(lengths)
    median = statistics.median([length for length in lengths if length > 2] or [0])
    if median > MEDIAN:
        own.append(f"{page}: half of the sentences have {median:.0f} words or more (at most {MEDIAN})")
    faults += own
if len(pages) < 20 or counted < 500:
    faults.append(f"only {len(pages)} pages and {counted} sentences found: this test looks in the wrong place")
print(f"{len(pages)} pages, {counted} sentences, {len(faults)} faults")
sys.exit("\n".join(faults) or None)
