# SPDX-License-Identifier: BSL-1.0
"""What a table of measurements names: command, day, commit, processor, compilers."""
import datetime
import pathlib
import platform
import re
import shutil
import subprocess

root = pathlib.Path(__file__).resolve().parent.parent.parent


def compilers():
    return [name for name in ("g++", "clang++") if shutil.which(name)]


def version_of(compiler):
    return subprocess.run([compiler, "--version"], check=True, capture_output=True, text=True).stdout.split("\n")[0]


def processor():
    found = re.search(r"model name\s*: (.*)", pathlib.Path("/proc/cpuinfo").read_text())
    return found.group(1) if found else platform.machine()


def head_of(command, names, flags=()):
    """Command, day, commit, processor, these compilers and their flags."""
    commit = subprocess.run(["git", "-C", str(root), "describe", "--always", "--dirty"], capture_output=True, text=True)
    with_flags = f" `{' '.join(flags)}`" if flags else ""
    return (f"`{command}`, {datetime.date.today()}, commit {commit.stdout.strip() or 'unknown'}, {processor()}; "
            f"{'; '.join(map(version_of, names))}{with_flags}.")


def provenance(command):
    return head_of(command, compilers())
