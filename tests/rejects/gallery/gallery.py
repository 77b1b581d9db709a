# SPDX-License-Identifier: BSL-1.0
"""gallery.py COMPILER INCLUDE;INCLUDE...: what a compiler says of the wrong types of gallery.cpp.

Each is refused, and the compiler's first error names in words what is missing. --lines prints that error of each.
"""
import os
import re
import subprocess
import sys

source = os.path.join(os.path.dirname(os.path.abspath(__file__)), "gallery.cpp")
# More lines for a wrong type are a flood: it went on into the library after its fault was named.
max_lines = 40


class Case:
    """A namespace of the gallery: its lines, the words of the first error, words of further ones."""

    def __init__(self, name, first, also, begin, end):
        self.name, self.first, self.also, self.begin, self.end = name, first, also, begin, end


def read_cases():
    cases = []
    first, also = None, []
    with open(source, encoding="utf-8") as file:
        for number, line in enumerate(file, 1):
            if match := re.match(r"// (first|within): (.*)", line):
                first, also = (match[1], match[2].strip()), []
            elif match := re.match(r"// also: (.*)", line):
                also.append(match[1].strip())
            elif match := re.match(r"namespace (\w+) \{", line):
                begin = number
            elif match := re.match(r"\}  // namespace (\w+)", line):
                cases.append(Case(match[1], first, also, begin, number))
    return cases


def places(case, lines):
    """Where the messages point into the case."""
    pattern = re.compile(r"gallery\.cpp:(\d+)")
    return [at for at, line in enumerate(lines)
            if any(case.begin <= int(number) <= case.end for number in pattern.findall(line))]


def fault_of(case, lines, clang, show):
    """What is wrong with the messages about a case, or None; g++ tells where it came from before an error, clang after."""
    errors = [at for at, line in enumerate(lines) if "error:" in line]
    seen = places(case, lines)
    if not seen:
        return "is not refused", []
    around = [at for at in errors if at <= seen[0]][-1:] if clang else [at for at in errors if at >= seen[0]][:1]
    if not around:
        return "has no error of its own", lines[seen[0]:seen[0] + 10]
    begin = min(around[0], seen[0])
    told = lines[around[0]]
    if show:
        print(f"{case.name}: {told.split('error:')[1].strip()}")
    kind, words = case.first
    if kind == "first" and words not in told:
        return f"does not begin with '{words}'", lines[begin:begin + 15]
    if kind == "within" and not any(words in line for line in lines[max(begin - 6, 0):begin + 10]):
        return f"does not say '{words}' at once", lines[begin:begin + 15]
    missing = [] if clang else [words for words in case.also if not any(words in lines[at] for at in errors)]
    return (f"has no error about {missing}", []) if missing else None


def main(compiler, folders, show):
    cases = read_cases()
    assert len(cases) > 15, "the cases of gallery.cpp were not found"
    version = subprocess.run([compiler, "--version"], capture_output=True, text=True, check=True).stdout
    clang = "clang" in version
    command = [compiler, "-std=c++20", "-w", "-fsyntax-only", *[f"-I{folder}" for folder in folders.split(";")], source]
    if clang:
        command.insert(1, "-ferror-limit=0")
    lines = subprocess.run(command, capture_output=True, text=True).stderr.splitlines()
    faults = 0
    for case in cases:
        if fault := fault_of(case, lines, clang, show):
            faults += 1
            print(f"{case.name} {fault[0]}", *fault[1], sep="\n  ")
    print(f"{len(cases)} wrong types, {faults} without the right words, {len(lines)} lines of messages")
    return 1 if faults or len(lines) > max_lines * len(cases) else 0


if __name__ == "__main__":
    shown = "--lines" in sys.argv
    arguments = [argument for argument in sys.argv[1:] if argument != "--lines"]
    sys.exit(main(arguments[0], arguments[1], shown))
