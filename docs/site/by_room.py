#!/usr/bin/python3 -SE
# SPDX-License-Identifier: BSL-1.0
"""Filter of Doxygen: all that a header declares belongs to the group of its room, and members that a concept requires have the docstring
of concept_members.txt where they have none of their own. Lines keep their numbers."""
import pathlib
import re
import sys

MEMBERS = pathlib.Path(__file__).resolve().parent / "concept_members.txt"
# A line that begins the declaration of a member: a type and then the name, at the depth of a class.
MEMBER = re.compile(r"  (?! )(?!return |throw |delete |else )(?:using (\w+) = |(?:[\w:<>,&* ]+[ &*>])?(\w+)(\(| = |\{|;))")
BEHIND_REQUIRES = re.compile(r"    requires .*? ()(\w+)(\()")
SPACE = r"namespace scarp(::lanes|::geo)?"


def entries():
    """Lines of concept_members.txt: rooms, member, concept, docstring."""
    return [[field.strip() for field in line.split("|")] for line in MEMBERS.read_text().splitlines() if not line.startswith("#")]


def docstrings_of(room):
    """Docstrings by member."""
    found = {}
    for rooms, member, concept, text in entries():
        if rooms == "*" or room in rooms.split():
            end = "." if text.endswith(".") else ""
            found[member] = f"/** {text.removesuffix('.')}{f' ({concept})' if concept else ''}{end} */"
    return found


def with_docstrings(lines, docstrings):
    lines = lines[:]
    in_class, documented, head = False, False, None
    for number, line in enumerate(lines):
        if re.match(r"(template <.*> )?(struct|class) .*\{$", line) or (re.match(r"(struct|class) ", line) and not line.endswith(";")):
            in_class = True
        elif line.startswith("}"):
            in_class = False
        if not in_class:
            continue
        if line.startswith("  //"):
            documented = line.startswith("  ///")
        elif re.match(r"  (template <|requires)", line) and not re.search(r"\) (const )?\{|;$", line):
            head = number if head is None else head
        elif found := MEMBER.match(line) or (head is not None and BEHIND_REQUIRES.match(line)):
            text = docstrings.get(found[1] or found[2] + ("()" if found[3] == "(" else ""))
            if text and not documented and "///<" not in line:
                first = number if head is None else head
                lines[first] = lines[first][:2] + text + " " + lines[first][2:]
            documented, head = False, None
        elif not line.startswith("    "):
            documented, head = False, None
    return lines


def by_room(path):
    """The text of a header as Doxygen reads it."""
    text = path.read_text()
    folder = re.search(r"include/scarp/(.*)/[^/]*$", path.as_posix())
    if not folder:
        return text
    room = folder[1].replace("/", "_")
    lines = with_docstrings(text.split("\n"), docstrings_of(room))
    lines[0] = "/** \\file */ " + lines[0]
    for number, line in enumerate(lines):
        line = re.sub(rf"^{SPACE} \{{", rf"\g<0> /** \\addtogroup {room} */ /** @{{ */", line)
        lines[number] = re.sub(rf"^\}}  // {SPACE}$", r"/** @} */ \g<0>", line)
    return "\n".join(lines)


if __name__ == "__main__":
    sys.stdout.write(by_room(pathlib.Path(sys.argv[1])))
