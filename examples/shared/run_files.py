# SPDX-License-Identifier: BSL-1.0
"""What the files of an output folder say of a run: its record, summary and tables. Whatever is missing or damaged is empty."""

import csv
import datetime
import json
import math


class Run:
    """Of one output folder."""

    def __init__(self, folder):
        self.folder = folder
        self.record = newest_record(folder)
        self.summary = read_json(folder / "summary.json")
        self.ensemble = read_json(folder / "ensemble.json")
        own = self.summary.get("run") if isinstance(self.summary.get("run"), dict) else {}
        self.program = str(self.record.get("program") or own.get("program") or folder.resolve().name)
        self.options = words_of(self.record.get("options") or own.get("options"))
        self.defaults = words_of(self.record.get("defaults"))
        told = {name: value for name, value in own.items() if isinstance(value, str)}
        self.build = words_of(self.record.get("build")) or {name: value for name, value in told.items()
                                                           if name not in ("program", "identity", "started")}

    def number(self, key):
        value = self.summary.get(key)
        is_number = isinstance(value, (int, float)) and not isinstance(value, bool)
        return float(value) if is_number and math.isfinite(value) else None

    def option(self, name, otherwise=""):
        return self.options.get(name, otherwise)


def read_json(path):
    try:
        value = json.loads(path.read_text())
    except (OSError, ValueError):
        return {}
    return value if isinstance(value, dict) else {}


def newest_record(folder):
    records = sorted(folder.glob("run*.json"), key=lambda path: path.stat().st_mtime)
    return read_json(records[-1]) if records else {}


def words_of(lines):
    return {str(name): str(value) for name, value in lines.items()} if isinstance(lines, dict) else {}


def is_finished(run):
    return run.record.get("state", "finished") == "finished" and run.summary.get("status", "ok") == "ok"


def budget_of(run):
    budget = run.summary.get("error_budget")
    parts = budget.get("parts") if isinstance(budget, dict) else None
    return {name: part for name, part in parts.items() if isinstance(part, dict)} if isinstance(parts, dict) else {}


def started_at(run):
    try:
        return datetime.datetime.fromisoformat(str(run.record.get("started")).replace("Z", "+00:00")).timestamp()
    except ValueError:
        return 0.0


def read_rows(path):
    """Rows of a table, without a last one that is cut off."""
    try:
        whole = path.read_text()
    except OSError:
        return []
    return list(csv.DictReader(whole[: whole.rfind("\n") + 1].splitlines()))
