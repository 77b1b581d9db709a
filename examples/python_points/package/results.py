# SPDX-License-Identifier: BSL-1.0
"""What the files of a run's folder hold: JSON with attributes, tables as NumPy columns, and whether it is what was requested."""
from __future__ import annotations

import csv
import datetime
import hashlib
import importlib
import json
import os
import pathlib
from typing import Any, Dict, List, Mapping

import numpy as np

from . import programs

# Options that say how a run is made, not what it finds.
NOT_OF_THE_RESULT = {"threads", "time-limit", "checkpoint", "checkpoint-every", "resume", "estimate", "output", "overwrite"}


def _named(names: Mapping[str, Any], name: str) -> Any:
    for one in (name, name.replace("_", "-")):
        if one in names:
            return names[one]
    raise AttributeError(f"there is no {name} (there are {', '.join(map(str, names)) or 'none'})")


class Record(Dict[str, Any]):
    """A dict whose keys are attributes too.

    Examples
    --------
    >>> scarp.results.Record({"surface_x50": -12.2}).surface_x50
    -12.2
    """

    def __getattr__(self, name: str) -> Any:
        return _named(self, name)


class Columns(Dict[str, Any]):
    """The columns of a table, each a numpy.ndarray of shape (rows,): float64, or text where a cell is no number. Columns are attributes too."""

    def __getattr__(self, name: str) -> Any:
        return _named(self, name)

    def table(self) -> Any:
        """The columns as a pandas.DataFrame.

        Raises
        ------
        RuntimeError
            pandas is not installed.
        """
        try:
            pandas = importlib.import_module("pandas")
        except ImportError as missing:
            raise RuntimeError("pandas is not installed (it makes the table): install it, or use the columns, which are arrays of NumPy") from missing
        return pandas.DataFrame(dict(self))


def _column(cells: List[str]) -> Any:
    try:
        return np.array([float(cell) if cell else np.nan for cell in cells])
    except ValueError:
        return np.array(cells)


def read_columns(path: pathlib.Path) -> Columns:
    """A table with a header line; a last row that an interruption cut off is left out.

    Raises
    ------
    FileNotFoundError
        The run has not written it.
    """
    if not path.is_file():
        raise FileNotFoundError(f"there is no '{path}' (the run does not write it, or has not come so far)")
    whole = path.read_text()
    rows = list(csv.reader(whole[: whole.rfind("\n") + 1].splitlines()))
    return Columns({name: _column([row[k] for row in rows[1:]]) for k, name in enumerate(rows[0] if rows else [])})


def read_record(path: pathlib.Path) -> Record:
    """A JSON object; empty where there is none or it is damaged."""
    try:
        value = json.loads(path.read_text(), object_hook=Record)
    except (OSError, ValueError):
        return Record()
    return value if isinstance(value, Record) else Record()


def _equal(one: str, other: str) -> bool:
    try:
        return one == other or float(one) == float(other)
    except ValueError:
        return False


def input_files(given: Mapping[str, List[str]]) -> Dict[str, str]:
    """SHA-256 of each file that the options name, alone or in a list, and of the sand beside a packing."""
    words = [one for words in given.values() for word in words for one in (word, *word.split(","))]
    sands = [os.path.splitext(word)[0] + ".sand" for word in words if word.endswith(".packing")]
    return {file: hashlib.sha256(pathlib.Path(file).read_bytes()).hexdigest() for file in (*words, *sands) if os.path.isfile(file)}


def _inputs_of(record: pathlib.Path) -> pathlib.Path:
    return record.with_name(record.name.replace("run", "inputs", 1))


def note_inputs(record: pathlib.Path, files: Mapping[str, str]) -> None:
    """Keeps beside the record of a run what its input files held."""
    if files:
        partial = record.with_suffix(".partial")
        partial.write_text(json.dumps({"identity": read_record(record).get("identity"), "files": files}, indent=1))
        partial.replace(_inputs_of(record))


def _same_inputs(path: pathlib.Path, record: Record, given: Mapping[str, List[str]]) -> bool:
    """Whether input files are certainly those of the run: by what they held, or without a note because all are older than it."""
    noted, present = read_record(_inputs_of(path)), input_files(given)
    if noted.get("identity") == record.identity:
        return bool(noted.files == present)
    started = datetime.datetime.fromisoformat(record.started.replace("Z", "+00:00")).timestamp()
    return all(pathlib.Path(file).stat().st_mtime < started for file in present)


def is_finished(path: pathlib.Path, given: Mapping[str, List[str]]) -> bool:
    """Whether the run of a record (``run.json``) has finished and certainly had these options and input files. Where this is not certain the program
    decides."""
    record = read_record(path)
    try:
        if record.state != "finished":
            return False
        for name, value in record.options.items():
            words = given.get(name)
            wanted = record.defaults[name] if words is None else ",".join(words) if words else "true"
            if name not in NOT_OF_THE_RESULT and not _equal(value, wanted):
                return False
        return _same_inputs(path, record, given)
    except (AttributeError, KeyError, TypeError, ValueError, OSError):  # the record is damaged
        return False


class Run:
    """The folder of a run."""

    scripts = ""  # folder of the examples with plot.py and report.py

    def __init__(self, folder: Any) -> None:
        self.folder = pathlib.Path(folder)
        if not self.folder.is_dir():
            raise ValueError(f"there is no folder '{self.folder}' (expected is that of a run): give another one")

    def plot(self) -> Dict[str, pathlib.Path]:
        """Draws all figures that the run has data for, in the style of the pages, into ``figures`` of its folder.

        Returns
        -------
        dict of str to pathlib.Path
            The PNG or GIF of each figure; in a notebook ``IPython.display.Image(filename=path)`` shows one.

        Raises
        ------
        RuntimeError
            One could not be drawn; matplotlib is needed.
        """
        return {path.stem: path for path in programs.draw(f"{self.scripts}/plot.py", self.folder)}

    def report(self) -> pathlib.Path:
        """Writes ``report.html`` with numbers, error budget, settings and the figures that ``plot`` has drawn.

        Returns
        -------
        pathlib.Path

        Raises
        ------
        RuntimeError
            The folder holds no run.
        """
        return programs.draw(f"{self.scripts}/report.py", self.folder)[-1]
