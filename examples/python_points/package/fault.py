# SPDX-License-Identifier: BSL-1.0
"""The fault scene: a rupture below level ground or a footing, run by the program fault_rupture."""
from __future__ import annotations

import contextlib
import functools
import itertools
import os
import pathlib
import re
import shutil
from typing import Any, Dict, Iterator, List, Mapping, Union

from . import program_options, programs
from .results import Columns, Record, Run, input_files, is_finished, note_inputs, read_columns, read_record

Folder = Union[str, "os.PathLike[str]"]


class FaultRun(Run):
    """The results of a fault rupture, or of several seeds.

    Parameters
    ----------
    folder : path
        The run's folder; nothing is run.

    Attributes
    ----------
    folder : pathlib.Path

    Raises
    ------
    ValueError
        There is no such folder.
    """

    scripts = "fault_rupture"

    def __repr__(self) -> str:
        state = self.record.get("state", "no run")
        return f"FaultRun({str(self.folder)!r}: {state}{'' if self.within_budget else ', outside its error budget'})"

    @functools.cached_property
    def record(self) -> Record:
        """State, build, and all options as text (``run.json``)."""
        return read_record(self.folder / "run.json")

    @functools.cached_property
    def summary(self) -> Record:
        """Measures in SI units, counts and cost (``summary.json``; of several seeds ``ensemble.json``)."""
        own = self.folder / "summary.json"
        return read_record(own if own.is_file() else self.folder / "ensemble.json")

    @property
    def finished(self) -> bool:
        """Whether the run has come to its end."""
        return bool(self.record.get("state") == "finished")

    @property
    def error_budget(self) -> Record:
        """The parts by name, each a record with ``value``, ``within``, ``meaning`` and mostly ``bound``."""
        parts = self.summary.get("error_budget", Record()).get("parts", Record())
        return parts if isinstance(parts, Record) else Record()

    @property
    def within_budget(self) -> bool:
        """Whether no part of the error budget exceeds its bound, in any member; False where there is none yet."""
        parts, members = self.error_budget.values(), self.members
        return bool(parts or members) and all(part.within for part in parts) and all(one.within_budget for one in members)

    @functools.cached_property
    def surface(self) -> Columns:
        """Settlement profiles [m] with ``throw_over_depth``, ``x_initial`` and ``x`` [m]; of several seeds mean and scatter."""
        own = self.folder / "surface.csv"
        return read_columns(own if own.is_file() else self.folder / "surface_mean.csv")

    @functools.cached_property
    def convergence(self) -> Columns:
        """A row for each iteration of each attempt at a load step."""
        return read_columns(self.folder / "convergence.csv")

    @functools.cached_property
    def footing(self) -> Columns:
        """Motion of the footing, a row for each load step. FileNotFoundError for level ground."""
        return read_columns(self.folder / "footing.csv")

    @functools.cached_property
    def probes(self) -> Dict[str, Columns]:
        """The points nearest to A and B: strains, stresses [Pa, compression positive] and fabric, a row for each load step."""
        return {path.stem[len("probe_"):]: read_columns(path) for path in sorted(self.folder.glob("probe_*.csv"))}

    @property
    def fields(self) -> List[pathlib.Path]:
        """The VTU files in the order of the throw."""
        return sorted((self.folder / "fields").glob("*.vtu"))

    @functools.cached_property
    def grains(self) -> Dict[str, Columns]:
        """Places [m] and half axes [m] of the probes' grains, by names such as ``A_0``, at rest, and later numbers as the throw grows. Empty
        for ground without packings."""
        return {path.stem[:-len("_grains")]: read_columns(path) for path in sorted((self.folder / "packings").glob("*_grains.csv"))}

    @functools.cached_property
    def members(self) -> List[FaultRun]:
        """The runs of several seeds; empty for a single one."""
        members = self.summary.get("members", [])
        return [FaultRun(self.folder / one.folder) for one in members if (self.folder / one.folder).is_dir()]


def _program(keywords: Dict[str, Any]) -> tuple[str, str]:
    """Name, and words that build it: elements, devices and water have programs of their own."""
    if keywords.get("device") == "none":
        keywords.pop("device")
    own = {"water_table": "water", "element": "{}", "device": "device"}
    chosen = [key for key in own if keywords.get(key) is not None and (key, keywords[key]) != ("element", "tri3")]
    if len(chosen) > 1 and "device" in chosen:
        raise ValueError(f"{' and '.join(chosen)} are given (no program has both): leave one out")
    name = "_".join(["fault_rupture", *(own[key].format(keywords[key]) for key in chosen)])
    return name, " ".join(["fault_rupture", *(f"--{key.replace('_', '-')} {keywords[key]}" for key in chosen)])


def _given(options: Mapping[str, Any], **others: str) -> tuple[str, Dict[str, List[str]]]:
    keywords = dict(options)
    name, build = _program(keywords)
    keywords["sand"] = programs.sand_file(keywords.get("sand"))
    if isinstance(keywords.get("layer"), Mapping):
        keywords["layer"] = {depth: programs.sand_file(sand) for depth, sand in keywords["layer"].items()}
    programs.find(name, build)
    return name, program_options.given(name, keywords, **others)


def _checkpoints_of(folder: pathlib.Path) -> pathlib.Path:
    """Where the run of the folder saves itself; the folder may have been moved."""
    known = pathlib.Path(read_record(folder / "run.json").get("checkpoint") or "checkpoints")
    return next((path for path in (known, folder / known.name) if path.is_absolute() and path.is_dir()), folder / "checkpoints")


def _new_checkpoints(folder: pathlib.Path) -> pathlib.Path:
    names = ("checkpoints" if number == 1 else f"checkpoints_{number}" for number in itertools.count(1))
    return next(folder / name for name in names if not (folder / name).exists())


@contextlib.contextmanager
def _replaced(checkpoints: pathlib.Path) -> Iterator[None]:
    """Checkpoints of a run that is replaced stay until the new one is accepted."""
    try:
        yield
    except ValueError:
        raise
    except BaseException:
        shutil.rmtree(checkpoints, ignore_errors=True)
        raise
    shutil.rmtree(checkpoints, ignore_errors=True)


def fault_rupture(folder: Folder = "output/fault_rupture", *, overwrite: bool = False, progress: programs.Progress = None, **options: Any) -> FaultRun:
    """Runs the fault scene, or resumes it where it was stopped; a run that has finished with the same options is read and not run again.

    The program ``fault_rupture`` runs, so that results are those of the command line. Checkpoints go to ``checkpoints`` in the folder.

    Parameters
    ----------
    folder : path
        For all results.
    overwrite : bool
        Whether results of another run in the folder may be replaced.
    progress : callable, bool, optional
        Called with each line of the program; True draws a bar.
    **options
        Those of ``./examples/run fault_rupture --help`` with underscores, such as ``case="heavy"``, ``length=2.0`` [m], ``dip=60.0`` [degrees],
        ``seeds=[1, 2, 3]``, ``quick=True``, ``budget={"residual": 1e-2}``. ``sand`` is a file, or a name such as ``"fontainebleau"``;
        ``layer={8.0: "loose"}`` has another one below a depth [m].
        ``scarp.options("fault_rupture")`` has meanings, units and defaults.

    Returns
    -------
    FaultRun

    Raises
    ------
    ValueError
        An option is unknown or out of its range, or the folder holds another run.
    RuntimeError
        The run stopped early; the folder has what it reached.
    FileNotFoundError
        The program is not built.
    KeyboardInterrupt
        After Ctrl-C, when the run has saved itself.

    Examples
    --------
    >>> run = scarp.fault_rupture("output/first", quick=True, soil="mohr_coulomb")
    >>> run.summary.elements, run.within_budget
    (220, True)
    >>> round(float(run.surface.settlement.max()) / 25.0, 3)  # h/H
    0.085
    """
    target = pathlib.Path(folder)
    before = _checkpoints_of(target.resolve())
    own = options.get("checkpoint") or (_new_checkpoints(target) if overwrite else before)
    name, given = _given({**options, "checkpoint": own})
    if not overwrite and is_finished(target / "run.json", given):
        return FaultRun(target)
    files = input_files(given)
    words = [*program_options.command_line(given), f"--output={os.fspath(target)}", "--overwrite" if overwrite else "--resume"]
    is_stale = overwrite and before.parent == target.resolve() and before != pathlib.Path(own).resolve()
    with _replaced(before) if is_stale else contextlib.nullcontext():
        programs.run(name, words, progress)
    note_inputs(target / "run.json", files)
    return FaultRun(target)


def _number(text: str, pattern: str) -> float:
    found = re.search(pattern, text)
    return float(found[1]) if found else 0.0


def fault_estimate(**options: Any) -> Record:
    """Time and memory that a fault scene would need; nothing is run but a short timing of this machine.

    Parameters
    ----------
    **options
        Those of ``fault_rupture``.

    Returns
    -------
    Record
        ``elements``, ``nodes``, ``points``, ``steps``, ``cpu_seconds`` [s], ``wall_seconds`` [s], ``memory`` [bytes] and the program's ``text``.

    Raises
    ------
    ValueError
        As by ``fault_rupture``.

    Examples
    --------
    >>> scarp.fault_estimate(quick=True).elements
    220.0
    """
    name, given = _given(options, others="")
    lines = programs.run(name, [*program_options.command_line(given), "--estimate"])
    text = "\n".join(lines[next((k for k, line in enumerate(lines) if line.startswith("scene: ")), 0):])
    unit = 1e9 if re.search(r"memory: [\d.]+ GB", text) else 1e6
    return Record(elements=_number(text, r"scene: (\d+) elements"), nodes=_number(text, r"(\d+) nodes"), points=_number(text, r"(\d+) points"),
                  steps=_number(text, r"steps: (\d+)"), cpu_seconds=_number(text, r"CPU time: ([\d.]+) s"),
                  wall_seconds=_number(text, r"wall time: ([\d.]+) s"), memory=unit * _number(text, r"memory: ([\d.]+)"), text=text)
