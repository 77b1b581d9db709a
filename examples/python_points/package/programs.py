# SPDX-License-Identifier: BSL-1.0
"""The built programs as child processes: found, followed line by line, stopped so that they save."""
from __future__ import annotations

import importlib
import os
import pathlib
import re
import signal
import subprocess
import sys
import warnings
from typing import Any, Callable, Iterable, List, NoReturn, Union

Progress = Union[bool, None, Callable[[str], object]]
INTERRUPTED = 130  # exit code after a signal or at a time limit
REJECTED = 2  # exit code for options, folders and files that are not accepted
FOLDER = pathlib.Path(__file__).resolve().parent


def find(name: str, build: str = "") -> pathlib.Path:
    """The executable of a program.

    Searched are the folder that the environment variable ``SCARP_PROGRAMS`` names, and nothing else where it is set; ``bin`` beside this
    file, as in a wheel; ``examples`` of the build folder whose ``python`` holds this package.

    Parameters
    ----------
    name : str
        Such as ``fault_rupture``.
    build : str
        The words after ``./examples/run`` that build it; by default the name.

    Raises
    ------
    FileNotFoundError
        The program is in none of these folders.
    """
    chosen = os.environ.get("SCARP_PROGRAMS")
    folders = [pathlib.Path(chosen)] if chosen else [FOLDER / "bin", FOLDER.parents[1] / "examples"]
    for folder in folders:
        if (folder / name).is_file():
            return folder / name
    raise FileNotFoundError(f"there is no program {name} in {' or '.join(map(repr, map(str, folders)))}: build it by './examples/run {build or name} --help' "
                            "in the repository, or set SCARP_PROGRAMS to the folder that has it")


class _Teller:
    """Passes the program's lines on: to a callable, or as a bar of tqdm, or printed where that is not installed."""

    def __init__(self, progress: Progress, title: str) -> None:
        self.tell: Callable[[str], object] = progress if callable(progress) else lambda line: None
        self.bar: Any = None
        if progress is True:
            try:
                auto = importlib.import_module("tqdm.auto")
            except ImportError:
                self.tell = print
            else:
                self.bar = auto.tqdm(total=1.0, desc=title, bar_format="{l_bar}{bar}| {postfix}")
                self.tell = self.draw

    def draw(self, line: str) -> None:
        times = re.search(r"elapsed +([\d.]+) s +remaining +([\d.]+) s", line)
        if times:
            elapsed, remaining = map(float, times.groups())
            self.bar.n = max(self.bar.n, elapsed / max(elapsed + remaining, 1e-9))
        if times or not self.bar.n:  # not the summary
            self.bar.set_postfix_str(re.sub(r" +", " ", line)[:60])

    def close(self) -> None:
        if self.bar is not None:
            self.bar.close()


def _problem(name: str, lines: List[str]) -> str:
    """The program's own message, which ends what it prints, or the verdict of a run that stopped early, which begins its summary."""
    for number in range(len(lines) - 1, -1, -1):
        own, colon, _ = lines[number].partition(": ")
        if colon and own and name.startswith(own):  # fault_rupture_tri6 calls itself fault_rupture
            return "\n".join(lines[number:])[len(own) + 2:]
    verdicts = [line for line in lines if re.match(r"INCOMPLETE|OUTSIDE|.* found no balance", line)]
    plain = [line for line in lines if not re.match(r"(.*: )?step |warning: |Run with --help|$", line)]
    return "\n".join(verdicts or plain[-3:]) or "it printed nothing"


def _fail(name: str, code: int, lines: List[str]) -> NoReturn:
    text = _problem(name, lines)
    if code == REJECTED:
        raise ValueError(f"{name}: {text}")
    if code < 0:
        raise RuntimeError(f"{name} was ended by signal {-code} ({signal.strsignal(-code)}): {text}")
    if code == INTERRUPTED:
        raise RuntimeError(f"{name} was stopped by a signal or its time limit; call it again to resume: {text}")
    raise RuntimeError(f"{name} ended with {code}: {text}")


def _stop(child: subprocess.Popen[str]) -> None:
    """Lets the program save and end. A second Ctrl-C ends it at once."""
    if child.poll() is None:
        child.send_signal(signal.SIGINT)
    try:
        child.communicate()
    except KeyboardInterrupt:
        child.kill()
        child.communicate()


def run(name: str, words: Iterable[str], progress: Progress = None) -> List[str]:
    """Runs a program to its end.

    Parameters
    ----------
    name : str
        Such as ``fault_rupture``.
    words : iterable of str
        Its command line.
    progress : callable, bool, optional
        Called with each line that the program prints; True draws a bar by tqdm, or prints where that is not installed.

    Returns
    -------
    list of str
        All lines that it has printed. Its warnings are also warnings of Python.

    Raises
    ------
    ValueError
        The program rejects an option, a folder or a file (exit code 2).
    RuntimeError
        It stopped early or failed (any other code).
    FileNotFoundError
        It is not built.
    KeyboardInterrupt
        After Ctrl-C, when the program has saved itself.
    """
    if not (progress is None or isinstance(progress, bool) or callable(progress)):
        raise TypeError(f"progress is {progress!r} (expected is a function of a line, True, False or None): correct it")
    program = find(name)
    lines: List[str] = []
    teller = _Teller(progress, name)
    # In a session of its own the program gets Ctrl-C from here alone; a second one would end it before it has saved.
    with subprocess.Popen([str(program), *words], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, stdin=subprocess.DEVNULL, text=True,
                          errors="replace", start_new_session=True) as child:
        try:
            assert child.stdout is not None
            for line in child.stdout:
                lines.append(line.rstrip("\n"))
                teller.tell(lines[-1])
            code = child.wait()
        except BaseException:
            _stop(child)
            raise
        finally:
            teller.close()
    for line in lines:
        if told := re.match(r"(seed \d+: )?warning: (.*)", line):
            warnings.warn((told[1] or "") + told[2], stacklevel=4)
    if code != 0:
        _fail(program.name, code, lines)
    return lines


def script(place: str) -> pathlib.Path:
    """A script or data file of the examples, such as ``fault_rupture/report.py``: beside this file as in a wheel, or in the repository that the build
    folder of this package belongs to.

    Raises
    ------
    FileNotFoundError
        It is in neither.
    """
    repository = FOLDER / "repository.txt"  # written by CMake, not installed
    folders = [FOLDER, pathlib.Path(repository.read_text())] if repository.is_file() else [FOLDER]
    for folder in folders:
        if (folder / "examples" / place).is_file():
            return folder / "examples" / place
    raise FileNotFoundError(f"there is no 'examples/{place}' in {' or '.join(map(repr, map(str, folders)))}: build the module anew, or install the wheel")


def draw(place: str, folder: pathlib.Path) -> List[pathlib.Path]:
    """Runs a script of the examples that draws figures or writes a page in the folder of a run.

    Returns
    -------
    list of pathlib.Path
        The files that it has written.

    Raises
    ------
    RuntimeError
        Something could not be drawn; matplotlib and Pillow are needed.
    """
    done = subprocess.run([sys.executable, str(script(place)), str(folder)], capture_output=True, text=True, env={**os.environ, "MPLBACKEND": "Agg"})
    if done.returncode != 0:
        raise RuntimeError(f"'{place}' ended with {done.returncode}: {done.stderr.strip()}")
    return [pathlib.Path(line) for line in done.stdout.splitlines()]


def sand_file(sand: Any) -> Any:
    """The file of a sand that is named without folder and ending, such as ``fontainebleau``; anything else stays as it is."""
    if isinstance(sand, str) and re.fullmatch(r"\w+", sand) and not os.path.exists(sand):
        try:
            return script(f"sands/{sand}.sand")
        except FileNotFoundError:
            pass
    return sand
