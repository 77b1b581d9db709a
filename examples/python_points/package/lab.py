# SPDX-License-Identifier: BSL-1.0
"""The laboratory: packings are prepared, sheared, tested and calibrated by the program rve_lab."""
from __future__ import annotations

import functools
import os
import pathlib
from typing import Any, Dict, Sequence, Union

from . import program_options, programs
from .results import Columns, Record, Run, input_files, is_finished, note_inputs, read_columns, read_record

Folder = Union[str, "os.PathLike[str]"]
CURVES = {"shear": "path", "test": "test", "calibrate": "curve", "replay": "replay"}  # the main table of each command
COMMANDS = ("prepare", *CURVES)


class LabRun(Run):
    """The results of a command of the laboratory.

    Parameters
    ----------
    folder : path
        Its folder; nothing is run.
    command : str
        ``prepare``, ``shear``, ``test``, ``calibrate`` or ``replay``.

    Attributes
    ----------
    folder : pathlib.Path
    command : str

    Raises
    ------
    ValueError
        There is no such folder or command.
    """

    scripts = "rve_lab"

    def __init__(self, folder: Folder, command: str) -> None:
        super().__init__(folder)
        self.command = _checked(command)

    def __repr__(self) -> str:
        return f"LabRun({str(self.folder)!r}, {self.command!r}: {self.record.get('state', 'no run')})"

    @functools.cached_property
    def record(self) -> Record:
        """State, build, and all options as text (``run_COMMAND.json``); ``replay`` has none."""
        return read_record(self.folder / f"run_{self.command}.json")

    @functools.cached_property
    def summary(self) -> Record:
        """Strengths [degrees], moduli [Pa] and what the tests had in common (``summary.json``)."""
        return Record() if self.command == "prepare" else read_record(self.folder / "summary.json")

    @functools.cached_property
    def curve(self) -> Columns:
        """The path of ``shear`` or ``replay``, the test of ``test``, or the calibrated one: strains, stresses [Pa], void ratio and more.
        FileNotFoundError for ``prepare``."""
        if self.command == "prepare":
            raise FileNotFoundError(f"'{self.folder}' is of prepare, which writes no curve: take that of shear or test")
        return read_columns(self.folder / f"{CURVES.get(self.command, 'path')}.csv")

    @functools.cached_property
    def tables(self) -> Dict[str, Columns]:
        """All tables of the folder by name, among them grains, contacts and cell of each packing."""
        return {path.stem: read_columns(path) for path in sorted(self.folder.glob("*.csv"))}

    @property
    def packing(self) -> pathlib.Path:
        """The file of the packing that was prepared, or of the end of the path."""
        return self.folder / ("packing.packing" if self.command == "prepare" else "end.packing")

    @property
    def sand(self) -> pathlib.Path:
        """The file of the sand: that of the packing, or the calibrated one."""
        return self.folder / "calibrated.sand" if self.command == "calibrate" else self.packing.with_suffix(".sand")

    @property
    def parameters(self) -> Record:
        """The calibrated parameters by name, each a record with ``value``, ``standard_error``, ``range`` and ``at_bound``."""
        found = self.summary.get("parameters", Record())
        return found if isinstance(found, Record) else Record()


def _checked(command: str) -> str:
    if command not in COMMANDS:
        raise ValueError(f"the command is {command!r} (expected is one of {', '.join(COMMANDS)}): choose one; 'biaxial' and the like are its path")
    return command


def rve_lab(command: str, folder: Folder = "output/rve_lab", *, overwrite: bool = False, progress: programs.Progress = None, **options: Any) -> LabRun:
    """Prepares a packing or sends one along a path; what has finished in the folder with the same options is read and not run again.

    The program ``rve_lab`` runs, so that results are those of the command line.

    Parameters
    ----------
    command : str
        ``prepare``, ``shear``, ``test``, ``calibrate`` or ``replay``.
    folder : path
        For all results; a packing may be sheared in the folder where it was prepared.
    overwrite : bool
        Whether results that are there may be replaced.
    progress : callable, bool, optional
        Called with each line of the program; True draws a bar.
    **options
        Those of ``./examples/run rve_lab COMMAND --help`` with underscores, such as ``path="biaxial"``, ``strain=0.05``, ``packing=FILE``,
        ``pressure=2e5`` [Pa]. ``sand`` is a file, or a name such as ``"fontainebleau"``. ``scarp.options("rve_lab", "shear")`` has meanings,
        units and defaults.

    Returns
    -------
    LabRun

    Raises
    ------
    ValueError
        A command or option is unknown or out of its range, or the folder holds another run.
    RuntimeError
        The packing could not be prepared or cannot continue.
    FileNotFoundError
        The program is not built.
    KeyboardInterrupt
        After Ctrl-C.

    Examples
    --------
    >>> sand = scarp.rve_lab("prepare", "output/packing", grains=100)
    >>> test = scarp.rve_lab("shear", "output/packing", packing=sand.packing, path="biaxial", strain=0.01)
    >>> round(float(test.curve.axial_strain[-1]), 4)
    0.01
    """
    target = pathlib.Path(folder)
    keywords = dict(options)
    if "sand" in keywords:
        keywords["sand"] = programs.sand_file(keywords["sand"])
    replayed = target / "replay.csv"
    if _checked(command) == "replay" and replayed.is_file() and not overwrite:
        raise ValueError(f"'{replayed}' is there (it would be lost): choose another folder, or give overwrite=True")
    given = program_options.given("rve_lab", keywords, command)
    record = target / f"run_{command}.json"
    if not overwrite and is_finished(record, given):
        return LabRun(target, command)
    files = input_files(given)
    words = [command, *program_options.command_line(given)]
    if command == "replay":
        target.mkdir(parents=True, exist_ok=True)
        words.append(f"--out={replayed}")
    else:
        words += [f"--output={os.fspath(target)}", *(["--overwrite"] if overwrite else ["--resume"] if command == "calibrate" else [])]
    programs.run("rve_lab", words, progress)
    if command != "replay":
        note_inputs(record, files)
    return LabRun(target, command)


def calibrate(tables: Union[Folder, Sequence[Folder], None] = None, folder: Folder = "output/sand", *, overwrite: bool = False,
              progress: programs.Progress = None, **options: Any) -> LabRun:
    """Finds parameters of a sand by laboratory tests, or resumes the search of the folder.

    Parameters
    ----------
    tables : path or several, optional
        CSV of tests with ``axial_strain``, ``volumetric_strain`` and ``stress_ratio``, or ``q`` and ``p`` [Pa]; without, ``target`` has values.
    folder : path
        For all results.
    overwrite : bool
        Whether another calibration in the folder may be replaced.
    progress : callable, bool, optional
        Called with each line of the program; True draws a bar.
    **options
        Those of ``./examples/run rve_lab calibrate --help`` with underscores, such as ``sand="fontainebleau"``, ``triaxial=True``,
        ``free={"friction": (0.3, 0.9), "relative-density": None}`` (None: usual bounds), ``target={"peak-friction": 36.0}`` [degrees].

    Returns
    -------
    LabRun
        With ``parameters``, ``curve`` and the file ``sand``, which ``fault_rupture(sand=...)`` takes.

    Raises
    ------
    ValueError, RuntimeError, FileNotFoundError, KeyboardInterrupt
        As by ``rve_lab``.

    Examples
    --------
    >>> found = scarp.calibrate(folder="output/sand", target={"peak-friction": 25.0}, free={"friction": (0.2, 0.9)}, grains=60, seeds=2,
    ...                         evaluations=3, strain_step=1e-4)
    >>> 0.2 <= found.parameters.friction.value <= 0.9
    True
    """
    return rve_lab("calibrate", folder, overwrite=overwrite, progress=progress, table=tables, **options)
