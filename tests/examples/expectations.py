# SPDX-License-Identifier: BSL-1.0
"""Expectations that a script gathers while it goes on."""

import sys

troubles = []
checks = 0


def expect(truth, message):
    global checks
    checks += 1
    if not truth:
        troubles.append(message)


def finish():
    """Prints what was not met and ends the script, with exit code 1 if there was any."""
    print("\n".join(troubles))
    print(f"{checks} checks, {len(troubles)} failed")
    sys.exit(1 if troubles else 0)
