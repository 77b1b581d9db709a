# SPDX-License-Identifier: BSL-1.0
"""[slow] Every option of every example program that takes a value refuses one that it cannot take, by name and before any file is
written. Options are those that --help lists. Environment: SCARP_EXAMPLES, the folder of the built programs (skipped, exit 77, without)."""
import os
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

PROGRAMS = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve()
WRONG = {"FLOAT": ("nan", "inf", "1,5", "many"), "INT": ("1.5", "99999999999", "many"), "UINT": ("-1", "many"),
         "TEXT": ("a file/such thing",), "TEXT:SEED": ("-1", "1.5", "many"), "TEXT:FILE": ("a file/such thing",)}
TEXTS = {"--config"}  # read before anything else, refused in the words of the file
NO_OPTIONS = {"own_ground", "excavation"}  # their words are files


def run(program, words, folder):
    """Exit code 0 where it had to be stopped: it began to compute."""
    words = [PROGRAMS / program[0], *program[1:], *words]
    try:
        done = subprocess.run(words, cwd=folder, capture_output=True, text=True, timeout=20)
    except subprocess.TimeoutExpired:
        return 0, "still running after 20 s"
    return done.returncode, done.stdout + done.stderr


def options_of(said):
    """(name, type, whether it takes several) of the options with a value."""
    for line in said.splitlines():
        found = re.match(r"\s+(?:-\w,)?(--[a-z][a-z0-9-]*)(?:,--[a-z0-9-]+)* (FLOAT|INT|UINT|TEXT(?::SEED|:FILE)?)\b", line)
        if found:
            yield found[1], found[2], "..." in line


built = sorted(path.name for path in PROGRAMS.glob("*") if path.is_file() and os.access(path, os.X_OK) and path.name not in NO_OPTIONS)
if not built:
    print(f"skipped: no programs in {PROGRAMS} (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
tried = set()
with tempfile.TemporaryDirectory() as scratch:
    file = pathlib.Path(scratch) / "a file"
    file.touch()
    for name in built:
        _, said = run([name], ["--help"], scratch)
        commands = re.findall(r"^  ([a-z_]+) {2,}", said.split("Subcommands:")[1], re.M) if "Subcommands:" in said else []
        for program in [[name]] + [[name, command] for command in commands]:
            code, said = run(program, ["--help"], scratch)
            expect(code == 0, f"{program} --help ended with {code}\n{said}")
            for option, kind, is_list in options_of(said):
                tried.add((name, option))
                for value in WRONG[kind]:
                    if is_list and "," in value:
                        continue
                    code, said = run(program, [option, value], scratch)
                    what = f"{' '.join(program)} {option} {value!r}"
                    expect(code > 0, f"{what}: ended with {code}\n{said[-500:]}")
                    # Where others are required, these are named before any file is looked for.
                    asks_first = kind.startswith("TEXT") and "is required" in said
                    is_named = option.lstrip("-") in said or option in TEXTS or value in said or asks_first
                    expect(is_named, f"{what}: the message does not name it\n{said[-500:]}")
    left = [path for path in pathlib.Path(scratch).iterdir() if path != file]
    expect(not left and file.stat().st_size == 0, f"files are left or written: {left}")
expect(len(tried) >= 5 * ("fault_rupture" in built), "the help lists no options in the form that this test looks for")
print(f"{len(tried)} options of {len(built)} programs")
finish()
