#!/usr/bin/python3
# SPDX-License-Identifier: BSL-1.0
"""Public names of include/scarp without a docstring, by header; exit 1 if there are any.

docstrings.py [--count] [ROOM...]    runs Doxygen (without pages) and lists the names of all rooms, or of some
docstrings.py --of WARNINGS          reads the warnings of a run of Doxygen that docs/build has made

Without a docstring may be: what is `= default` or `= delete`, destructors, operators of arithmetic, comparison and logic, deduction guides,
which only repeat a constructor, and specialisations of variables, which have the docstring of their template. What a concept requires has
its docstring from concept_members.txt."""
import argparse
import collections
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
OBVIOUS = re.compile(r"=\s*(default|delete)$|~\w+\(|\boperator ?(==|!=|<=>|[-+*/]=?|[<>]=?|!|&&|\|\|)\("  # of a class
                     r"|^(\w+)\(.*\) -> \3\b|^\w+< .* >$")  # deduction guides, specialisations of variables
WITHOUT_PAGES = "GENERATE_HTML=NO\nGENERATE_TAGFILE=\nLAYOUT_FILE=\n"


def warnings_of_doxygen():
    with tempfile.TemporaryDirectory() as scratch:
        log = pathlib.Path(scratch) / "warnings"
        settings = (ROOT / "docs" / "site" / "Doxyfile").read_text() + WITHOUT_PAGES + f"OUTPUT_DIRECTORY={scratch}\nWARN_LOGFILE={log}\n"
        subprocess.run(["doxygen", "-"], input=settings, text=True, cwd=ROOT, check=True, capture_output=True)
        return log.read_text()


def undocumented(warnings):
    """Names without a docstring, by header, each as line and declaration; and all other warnings."""
    names, others = collections.defaultdict(set), []
    for warning in warnings.splitlines():
        found = re.match(r".*include/scarp/(\S+):(\d+): warning: (?:Member|Compound) (.*) is not documented", warning)
        if not found:
            others.append(warning)
            continue
        header, line, member = found[1], int(found[2]), found[3]
        declaration = re.sub(r" \([\w ]+\) of (namespace|class|struct|union|file|group|concept) .+$", "", member)
        if not OBVIOUS.search(declaration):
            names[header].add((line, declaration))
    return names, others


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("rooms", nargs="*", metavar="ROOM")
    parser.add_argument("--of", type=pathlib.Path, metavar="WARNINGS")
    parser.add_argument("--count", action="store_true", help="only the number of each room")
    options = parser.parse_args()
    for room in options.rooms:
        if not (ROOT / "include/scarp" / room).is_dir():
            parser.error(f"there is no room '{room}': name a folder of include/scarp")
    names, others = undocumented(options.of.read_text() if options.of else warnings_of_doxygen())
    counts = collections.Counter()
    for header in sorted(names):
        room = header.split("/")[0]
        if options.rooms and room not in options.rooms:
            continue
        counts[room] += len(names[header])
        for line, declaration in sorted(names[header]):
            if not options.count:
                print(f"include/scarp/{header}:{line}: {declaration} has no docstring")
    if options.count:
        print("".join(f"{count:5} {room}\n" for room, count in counts.items()), end="")
    if options.rooms:
        others = []
    print("".join(f"{line}\n" for line in others), end="")
    total = sum(counts.values())
    print(f"{total} public names without a docstring, {len(others)} other warnings of Doxygen")
    return 1 if total or others else 0


if __name__ == "__main__":
    sys.exit(main())
