# SPDX-License-Identifier: BSL-1.0
"""A run for each combination of values, which resumes where it was stopped."""
from __future__ import annotations

import itertools
import os
import pathlib
import warnings
from typing import Any, Callable, Dict, Iterable, List, Mapping, NamedTuple, Optional, Union

import numpy as np

from .programs import Progress
from .results import Columns, Run


class Member(NamedTuple):
    """A run of a study.

    Attributes
    ----------
    values : dict
        The options that differ among the members.
    folder : pathlib.Path
    run : FaultRun or LabRun or None
        None where it stopped early.
    problem : str
        Why, or empty.
    """

    values: Dict[str, Any]
    folder: pathlib.Path
    run: Optional[Run]
    problem: str


class Study(List[Member]):
    """The members of a study, in the order of their values."""

    def measures(self, *names: str) -> Columns:
        """A table with a row for each member: the values that differ, then measures of the summaries.

        Parameters
        ----------
        *names : str
            Keys of the summaries; by default all that are numbers. NaN where a run stopped early or has no such number.

        Returns
        -------
        Columns
        """
        summaries = [getattr(one.run, "summary", {}) for one in self]
        known = {key: None for one in summaries for key, value in one.items() if _is_number(value)}
        missing = [name for name in names if name not in known]
        if missing:
            raise ValueError(f"no summary has the number {missing[0]} (there are {', '.join(known) or 'none'}): choose one of these")
        options: Dict[str, Any] = {key: np.array([_plain(one.values[key]) for one in self]) for key in (self[0].values if self else {})}
        return Columns({**options, **{key: np.array([one[key] if _is_number(one.get(key)) else np.nan for one in summaries], dtype=float)
                                      for key in names or known}})


def _is_number(value: Any) -> bool:
    return isinstance(value, (int, float)) and not isinstance(value, bool)


def _plain(value: Any) -> Any:
    return value if isinstance(value, (bool, int, float, str, np.generic)) else str(value)


def _name(values: Mapping[str, Any]) -> str:
    def word(value: Any) -> str:
        return pathlib.Path(value).stem if isinstance(value, os.PathLike) or "/" in str(value) else str(value).replace(" ", "")
    return ",".join(f"{key}={word(value)}" for key, value in values.items())


def _listed(key: str, values: Iterable[Any]) -> List[Any]:
    found = list(values) if isinstance(values, Iterable) and not isinstance(values, (str, os.PathLike)) else []
    if not found:
        raise TypeError(f"over has {key}={values!r} (expected is a sequence of values): write [...]")
    return found


def _named(progress: Progress, name: str) -> Progress:
    if not callable(progress):
        return progress
    told = progress
    return lambda line: told(f"{name}: {line}")


def study(run: Callable[..., Run], over: Mapping[str, Iterable[Any]], folder: Union[str, "os.PathLike[str]"], *, progress: Progress = None,
          **common: Any) -> Study:
    """Runs every combination of values, each in a folder of its own. A second call skips what has finished and resumes the rest.

    Parameters
    ----------
    run : callable
        ``scarp.fault_rupture``, or one with its command, ``functools.partial(scarp.rve_lab, "test")``.
    over : mapping of str to iterable
        Options and their values; the last one varies fastest.
    folder : path
        Has a folder for each member, such as ``seed=1,length=2.0``.
    progress : callable, bool, optional
        Called with each line of the program after the member's name; True draws a bar for each member.
    **common
        Options of all members.

    Returns
    -------
    Study
        A list of members. One that stopped early has a ``problem``, and a warning tells; the others run.

    Raises
    ------
    ValueError
        An option is rejected, or two members would share a folder.
    TypeError
        An option of ``over`` has no sequence of values.
    KeyboardInterrupt
        After Ctrl-C, when the present member has saved itself.

    Examples
    --------
    >>> runs = scarp.study(scarp.fault_rupture, over={"dip": [60, 75]}, folder="output/dips", quick=True, soil="mohr_coulomb")
    >>> runs.measures("surface_x50").dip
    array([60, 75])
    """
    listed = [_listed(key, values) for key, values in over.items()]
    combinations = [dict(zip(over, values)) for values in itertools.product(*listed)]
    names = [_name(values) for values in combinations]
    twice = [name for name in names if names.count(name) > 1]
    if twice:
        raise ValueError(f"two members have the folder '{twice[0]}' (each needs one of its own): give values that differ, files by other names")
    found = Study()
    for name, values in zip(names, combinations):
        own = pathlib.Path(folder) / name
        try:
            found.append(Member(values, own, run(folder=own, progress=_named(progress, name), **{**common, **values}), ""))
        except RuntimeError as trouble:
            found.append(Member(values, own, None, str(trouble)))
            warnings.warn(f"{name} stopped early: {trouble}", stacklevel=2)
    return found
