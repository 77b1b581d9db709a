# SPDX-License-Identifier: BSL-1.0
"""Expectations that a script gathers while it goes on."""

import os
import pathlib
import signal
import sys

NIGHTLY = os.environ.get("SCARP_TESTS") == "nightly"  # what takes long then runs too
SLOWER = 10 if "ASAN_OPTIONS" in os.environ else 1  # than without a sanitizer: factor of limits of time
# Programs of a script that a shell runs in the background would ignore Ctrl-C as it does.
signal.signal(signal.SIGINT, signal.default_int_handler)
troubles = []
checks = 0


def expect(truth, message):
    global checks
    checks += 1
    if not truth:
        troubles.append(message)


left_out = []


def leave_out(reason):
    """Part of a script that cannot run here: the script then ends as skipped, where nothing else is wrong."""
    left_out.append(reason)


def rejected(kind, said, call):
    """Expects an exception of this kind whose message has these words."""
    try:
        call()
        expect(False, f"no exception that says '{said}'")
    except kind as trouble:
        expect(said in str(trouble), f"'{trouble}' does not say '{said}'")


def finish():
    """Prints what was not met and ends the script, with exit code 1 if there was any."""
    print("\n".join(troubles))
    print(f"{checks} checks, {len(troubles)} failed")
    if left_out and not troubles:
        print(f"skipped in part: {', '.join(left_out)}")
    sys.exit(1 if troubles else 77 if left_out else 0)


def example(name):
    """The program of an example in the folder SCARP_EXAMPLES; ends the script as skipped (77) where it is not built."""
    program = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / name
    if not program.is_file():
        print(f"skipped: no {name} (set SCARP_EXAMPLES and build the examples)")
        sys.exit(77)
    return program


def python_module():
    """The folder of the Python module, beside that of SCARP_EXAMPLES, for imports too; ends the script as skipped (77) where it is not built."""
    folder = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve().parent / "python"
    if not list(folder.glob("scarp/_points*")):
        print("skipped: no Python module (set SCARP_EXAMPLES, install pybind11-dev and python3-dev and build python_points)")
        sys.exit(77)
    sys.path.insert(0, str(folder))
    return folder
