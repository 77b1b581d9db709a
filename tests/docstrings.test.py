# SPDX-License-Identifier: BSL-1.0
"""The list of public names without a docstring (docs/site/docstrings.py, which docs/build runs) has every kind that needs one and no
other; docstrings from concepts (docs/site/concept_members.txt) stand where a member has none of its own, and each is of use."""
import collections
import pathlib
import re
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "docs" / "site"), str(ROOT / "tests" / "examples")]
from by_room import by_room, entries
from docstrings import undocumented
from expectations import expect, finish

MISSING = ["stiffness (variable) of struct scarp::Law", "respond(double overlap) const (function) of struct scarp::Law",
           "make(Law const &law) -> Other (function) of namespace scarp", "operator()(double x) const (function) of class scarp::F",
           "Law(double stiffness) (function) of struct scarp::Law", "operator long() const (function) of struct scarp::Law"]
OBVIOUS = ["Law()=default (function) of struct scarp::Law", "operator==(Law const &, Law const &)=default (friend) of struct scarp::Law",
           "operator+(Pack const &a, Pack const &b) (friend) of class scarp::lanes::Pack", "~Lock() (function) of class scarp::Lock",
           "Law(double) -> Law< double > (function) of namespace scarp", "is_precompiled< Disc > (variable) of namespace scarp"]
HEADER = """// SPDX
namespace scarp {
struct Line9 {
  static constexpr int nodes = 9;
  static constexpr int facet_nodes = 9;  ///< of its own
  /// Of its own.
  static int shape(double x) {
    return nodes;
  }
  template <class T>
  static int shape_gradients(T x);
};
void nodes();
}  // namespace scarp
"""

names, others = undocumented("".join(f"/x/include/scarp/room/law.hpp:7: warning: Member {one} is not documented.\n"
                                     for one in MISSING + OBVIOUS) + "law.hpp:1: warning: unknown command \\x\n")
found = {declaration for _, declaration in names["room/law.hpp"]}
expect(found == {re.sub(r" \(\w+\) of .*", "", one) for one in MISSING}, f"listed are {found}")
expect(others == ["law.hpp:1: warning: unknown command \\x"], f"other warnings are {others}")

with tempfile.TemporaryDirectory() as scratch:
    path = pathlib.Path(scratch) / "include" / "scarp" / "element" / "line9.hpp"
    path.parent.mkdir(parents=True)
    path.write_text(HEADER)
    lines = by_room(path).splitlines()
with_docstring = [number for number, line in enumerate(lines, 1) if "/** " in line and "addtogroup" not in line and "@}" not in line]
expect(with_docstring == [1, 4, 10], f"by_room puts docstrings into lines {with_docstring}:\n" + "\n".join(lines))
expect(len(lines) == len(HEADER.splitlines()), "by_room changes the numbers of lines")

headers = sorted((ROOT / "include" / "scarp").rglob("*.hpp"))
concepts = set(re.findall(r"\nconcept (\w+)", "".join(path.read_text() for path in headers)))
uses = collections.Counter(re.findall(r"/\*\* (.*?) \*/ ", "".join(map(by_room, headers))))
for rooms, member, concept, text in entries():
    expect(not concept or concept in concepts, f"concept_members.txt: {concept} is no concept")
    used = sum(count for docstring, count in uses.items() if docstring.startswith(text.removesuffix(".")))
    expect(used >= 2, f"concept_members.txt: {member} of {rooms} serves {used} members (at least two are expected): write it there")
expect(len(entries()) > 30, f"concept_members.txt has only {len(entries())} entries")
finish()
