# SPDX-License-Identifier: BSL-1.0
"""No range of CLI11 that NaN passes and no seed without a check; no tolerance of doctest's own Approx, which is absolute for numbers below
one; no rejection that is tested by its type alone; no everyday word in a comment of include/scarp where the field has a term; a docstring for every
public class, enumeration and concept there, and no report of a failure that may be dropped; no comment that begins with "Of", and no line beyond
120 columns in C++ and C, which the formatter leaves alone where it is a comment."""
import pathlib
import re
import sys

import terms

ROOT = pathlib.Path(__file__).resolve().parents[1]
WRONG = {r"doctest::Approx\(": "takes tolerances that are absolute for small numbers: use samples::Approx",
         r"CLI::Range\([^()]*[.e][^()]*\)": "lets NaN pass: use examples::number_from",
         r'add_option\(\s*"--seed",(?:(?!seed_number|;\n)[\s\S])*;\n': "takes any text: check it by examples::seed_number",
         r"CHECK_THROWS\(|CHECK_THROWS_AS\([^;]*(?:InputError|FileError|FolderError|CheckpointError)\);":
         "passes with any refusal on the way: name the quantity and its value by CHECK_REFUSED or samples::message_of"}

TERMS = terms.TERMS | {"(?<!reference )study": "the reference study or (Author, year)"}

faults = []
files = 0
for folder in ("tests", "benchmarks", "examples"):
    for path in sorted((ROOT / folder).rglob("*.[ch]pp")):
        files += 1
        text = path.read_text()
        for pattern, why in WRONG.items():
            for match in re.finditer(pattern, text):
                line = text[:match.start()].count("\n") + 1
                if "///" not in text.splitlines()[line - 1]:
                    faults.append(f"{path.relative_to(ROOT)}:{line}: {match[0].splitlines()[0]} {why}")
for folder in ("include", "tests", "benchmarks", "examples"):
    for path in sorted(path for path in (ROOT / folder).rglob("*") if path.suffix in (".hpp", ".cpp", ".h", ".c", ".cu")):
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if len(line) > 120 and not re.search(r'R"\(|\)"', line):
                faults.append(f"{path.relative_to(ROOT)}:{number}: {len(line)} columns: wrap it at 120")
comments = 0
for path in sorted((ROOT / "include" / "scarp").rglob("*.[ch]pp")):
    for number, line in enumerate(path.read_text().splitlines(), 1):
        comment = re.search(r"//.*", line)
        if comment and re.match(r"//[/<]* Of ", comment[0]):
            faults.append(f"{path.relative_to(ROOT)}:{number}: a comment begins with 'Of': say what it is")
        comments += comment is not None
        for word, term in TERMS.items():
            if comment and (match := re.search(rf"\b({word})\b", comment[0], re.IGNORECASE)):
                faults.append(f"{path.relative_to(ROOT)}:{number}: '{match[0]}' in a comment: write {term}")
declared = 0
for path in sorted((ROOT / "include" / "scarp").rglob("*.hpp")):
    private = "detail" in path.parts
    lines = path.read_text().splitlines()
    for number, line in enumerate(lines):
        if namespace := re.match(r"(\}  // )?namespace .*\bdetail\b", line):
            private = namespace[1] is None
        kind = re.match(r"(?:template <.*> )?(?:concept|(?:class|struct|enum class)(?: \[\[nodiscard\]\])?(?!.*;$)) (\w+)\b(?!\s*<)", line)
        if kind and re.fullmatch(r"Verdict|Evaluation|Response|Collapse|SafetyFactor|\w+(?:Report|Result)", kind[1]) and "[[nodiscard]]" not in line:
            faults.append(f"{path.relative_to(ROOT)}:{number + 1}: {kind[1]} reports failures and may be dropped: make it [[nodiscard]]")
        if kind and not private:
            declared += 1
            first = number
            while re.match(r"template|requires|  ", lines[first - 1]):
                first -= 1
            if not lines[first - 1].startswith("///"):
                faults.append(f"{path.relative_to(ROOT)}:{number + 1}: {kind[1]} has no docstring (one sentence is expected): write what it is")
if files < 100 or comments < 1000 or declared < 300:
    faults.append(f"only {files} files, {comments} comments and {declared} declarations found: this test looks in the wrong place")
sys.exit("\n".join(faults) or None)
