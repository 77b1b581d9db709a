# SPDX-License-Identifier: BSL-1.0
"""Options of the built programs, as their --help has them, and keywords of Python as words of the command line."""
from __future__ import annotations

import difflib
import functools
import numbers
import os
import pathlib
import re
import subprocess
from typing import Any, Dict, Iterable, List, Mapping, NamedTuple

from . import programs


class Option(NamedTuple):
    """An option of a program, as its ``--help`` has it.

    Attributes
    ----------
    name : str
        Without the two hyphens; the first one where there are several.
    takes_value : bool
        Otherwise it is a flag.
    repeated : bool
        Whether it may be given several times.
    default : str
        Empty where there is none.
    text : str
        Meaning and unit.
    """

    name: str
    takes_value: bool
    repeated: bool
    default: str
    text: str


# What the functions of this package give themselves.
NO_KEYWORDS = ("output", "out", "overwrite", "resume", "estimate")


def parsed(text: str) -> Dict[str, Option]:
    """Options by name, from what ``--help`` prints; other names of one option have entries too."""
    found: Dict[str, Option] = {}
    lines = text.splitlines()
    for number, line in enumerate(lines):
        if not re.match(r"  (-\w,)?--", line):
            continue
        after = lines[number + 1] if number + 1 < len(lines) else ""
        head, meaning = (line, after.strip()) if after.startswith(" " * 30) else (line[:30], line[30:].strip())
        names, rest = head.split()[0], head.strip().partition(" ")[2]
        if names in ("-h,--help", "--version"):
            continue
        takes_value = bool(re.match(r"[A-Z]+\b", rest)) and not rest.startswith("REQUIRED")
        default = re.search(r"=(\S*)", re.sub(r"\{.*?\}", "", rest))
        words = [one[2:] for one in names.split(",") if one.startswith("--")]
        option = Option(words[0], takes_value or words[0] == "config", "..." in rest, default[1] if default else "", meaning)
        found.update({word: option for word in words})
    return found


@functools.lru_cache(maxsize=None)
def _help_of(program: pathlib.Path, command: str) -> Dict[str, Option]:
    words = [str(program), *([command] if command else []), "--help"]
    done = subprocess.run(words, capture_output=True, text=True)
    if done.returncode != 0:
        raise RuntimeError(f"'{' '.join(words)}' ended with {done.returncode} ({done.stderr.strip() or 'it printed nothing'}): build the program for this machine")
    return parsed(done.stdout)


def options(name: str, command: str = "") -> Dict[str, Option]:
    """All options of a program or of one of its commands, which are the keywords of its function with hyphens for underscores.

    Parameters
    ----------
    name : str
        Such as ``fault_rupture`` or ``rve_lab``.
    command : str
        Such as ``shear`` of ``rve_lab``.

    Returns
    -------
    dict of str to Option

    Raises
    ------
    FileNotFoundError
        The program is not built.
    RuntimeError
        It does not run, such as one of another machine.

    Examples
    --------
    >>> scarp.options("fault_rupture")["dip"].text
    'of the fault [degrees]'
    """
    return dict(_help_of(programs.find(name), command))


def _word(value: Any, between: str = ",") -> str:
    """A value as the command line has it: inner sequences have blanks between their items, those of a mapping colons."""
    if isinstance(value, (str, os.PathLike)):
        return os.fspath(value)
    if isinstance(value, numbers.Integral):
        return str(int(value))
    if isinstance(value, numbers.Real):
        return repr(float(value))
    if isinstance(value, Mapping):
        return between.join(_pair(*item) for item in value.items())
    if isinstance(value, Iterable):
        return between.join(_word(one, " ") for one in value)
    raise TypeError(f"an option is {value!r} (expected is a number, text, a path or several of these): correct it")


def _pair(key: str, value: Any) -> str:
    return key if value is None else f"{key}={_word(value, ':')}"


def _is_truth(value: Any) -> bool:
    return type(value).__name__ in ("bool", "bool_")  # also NumPy's


def _words_of(option: Option, value: Any) -> List[str]:
    """What stands after the option, for each time that it is given."""
    if option.takes_value and _is_truth(value):
        if option.default not in ("yes", "no"):
            raise TypeError(f"{option.name.replace('-', '_')} is {value} (expected is a value{f' like {option.default}' if option.default else ''}): give one")
        return ["yes" if value else "no"]
    if not option.repeated:
        return [_word(value)]
    if isinstance(value, Mapping):
        return [_pair(*item) for item in value.items()]
    several = isinstance(value, Iterable) and not isinstance(value, (str, os.PathLike))
    return [_word(one) for one in value] if several else [_word(value)]


def given(name: str, keywords: Mapping[str, Any], command: str = "", others: str = "folder, overwrite, progress, and of the program ") -> Dict[str, List[str]]:
    """Options and their values as words; nothing is left of keywords that are None, nor of flags that are False. others: keywords that the caller has.

    Raises
    ------
    ValueError
        The program has no such option; the message names those that exist.
    TypeError
        A flag has a value, or an option has none.
    """
    known = {key: option for key, option in options(name, command).items() if key not in NO_KEYWORDS}
    found: Dict[str, List[str]] = {}
    for keyword, value in keywords.items():
        option = known.get(keyword.replace("_", "-"))
        if option is None:
            there = sorted(one.replace("-", "_") for one in known)
            near = ", ".join(difflib.get_close_matches(keyword, there, 3))
            raise ValueError(f"{f'{name} {command}'.strip()} has no option {keyword} ({f'near are {near}; ' if near else ''}there are "
                             f"{others}{', '.join(there)}): correct it")
        if value is None or (not option.takes_value and _is_truth(value) and not value):
            continue
        if not option.takes_value and not _is_truth(value):
            raise TypeError(f"{keyword} is {value!r} (expected is True or False): correct it")
        if option.name in found:
            raise ValueError(f"{keyword} is another name of {option.name.replace('-', '_')}, which is given too: leave one of the two out")
        found[option.name] = _words_of(option, value) if option.takes_value else []
        if option.takes_value and (not found[option.name] or "" in found[option.name]):
            raise ValueError(f"{keyword} is {value!r} (a value is expected): give one, or leave it out")
    return found


def command_line(words: Mapping[str, List[str]]) -> List[str]:
    """Options as the program reads them."""
    return [one for name, values in words.items() for one in ([f"--{name}={value}" for value in values] or [f"--{name}"])]
