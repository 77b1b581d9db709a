# SPDX-License-Identifier: BSL-1.0
"""Data files of the benchmarks, and runs of the examples that they make."""
import csv
import datetime
import json
import math
import os
import pathlib
import platform
import re
import shutil
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
SHOWN = 12  # rows


def data_folder():
    return pathlib.Path(os.environ.get("SCARP_DATA") or ROOT / "docs" / "data")


def quick():
    """Whether --quick was given; data then go to output/quick."""
    if "--quick" not in sys.argv:
        return False
    os.environ["SCARP_DATA"] = "output/quick"
    return True


def compilers():
    return [name for name in ("g++", "clang++") if shutil.which(name)]


def version_of(compiler):
    return subprocess.run([compiler, "--version"], check=True, capture_output=True, text=True).stdout.split("\n")[0]


def commit():
    said = subprocess.run(["git", "-C", str(ROOT), "describe", "--always", "--dirty"], capture_output=True, text=True)
    return said.stdout.strip() or "unknown"


def processor():
    info = pathlib.Path("/proc/cpuinfo")
    found = re.search(r"model name\s*: (.*)", info.read_text()) if info.exists() else None
    return found.group(1) if found else platform.machine()


def origin(command, names=("g++",), *more):
    """Command, date, commit, machine and compilers of a data file."""
    return "; ".join([command, str(datetime.date.today()), f"commit {commit()}", processor(), *map(version_of, names), *more])


def cell(value):
    if value is None or isinstance(value, float) and math.isnan(value):
        return ""
    return f"{value:.6g}" if isinstance(value, float) else str(value)


def read_table(path):
    """Rows of a data file by column; none where there is no file."""
    if not path.exists():
        return []
    with open(path, newline="") as stream:
        return list(csv.DictReader(line for line in stream if not line.startswith("#")))


def write_table(name, rows, said, key=()):
    """Rows (dictionaries) to the data file `name`, replaced at once, and the first of them to the screen.
    key: columns by which rows of the present file are told apart; those without a new row stay"""
    rows = [{column: cell(value) for column, value in row.items()} for row in rows]
    path = data_folder() / f"{name}.csv"
    if key and not rows and path.exists():
        print(f"{path}: nothing new was run")
        return
    if key:
        new = {tuple(row[column] for column in key) for row in rows}
        rows = [row for row in read_table(path) if tuple(row.get(column, "") for column in key) not in new] + rows
    if not rows:
        sys.exit(f"{path}: there are no rows (nothing was run)")
    columns = [column for column in dict.fromkeys(column for row in rows for column in row) if any(row.get(column) for row in rows)]
    path.parent.mkdir(parents=True, exist_ok=True)
    partial = path.with_suffix(".partial")
    with open(partial, "w", newline="") as stream:
        stream.write(f"# {said}\n")
        writer = csv.DictWriter(stream, columns, extrasaction="ignore", lineterminator="\n")
        writer.writeheader()
        writer.writerows(rows)
    partial.replace(path)
    print(f"{path}: {len(rows)} rows\n" + "\n".join(" | ".join(row.get(column, "") for column in columns) for row in [dict(zip(columns, columns)), *rows[:SHOWN]]))


def example(name, *options, target=None):
    """An example's program: that of SCARP_EXAMPLES, or built.
    options: that examples/run chooses the target by"""
    if "SCARP_EXAMPLES" in os.environ:
        return pathlib.Path(os.environ["SCARP_EXAMPLES"]).resolve() / (target or name)
    done = subprocess.run([ROOT / "examples" / "run", name, *options, "--help"], stdout=subprocess.DEVNULL)
    if done.returncode != 0:
        sys.exit(f"{target or name} does not build")
    return ROOT / "build" / "release" / "examples" / (target or name)


def run_lab(program, *arguments):
    """Runs rve_lab or ends the benchmark. \\return what it printed"""
    command = [str(part) for part in (program, *arguments)]
    done = subprocess.run(command, capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stdout}{done.stderr}")
    return done.stdout


def fault_rupture(element="tri3"):
    return example("fault_rupture", "--element", element, target="fault_rupture" if element == "tri3" else f"fault_rupture_{element}")


def summary_of(folder):
    """None where the run has not ended."""
    file = folder / "summary.json"
    summary = json.loads(file.read_text()) if file.exists() else {"status": "interrupted"}
    return None if summary["status"] == "interrupted" else summary


def summaries(folder):
    return {file.parent.name: json.loads(file.read_text()) for file in sorted(folder.glob("*/summary.json"))}


def run_once(command, folder, *how):
    """Runs an example unless it has been; its result is its summary, also where it stopped early.
    how: options for a folder that is there, --overwrite without any"""
    if summary_of(folder):
        return
    folder.parent.mkdir(parents=True, exist_ok=True)
    command = [*map(str, command), "--output", str(folder), *map(str, how or ["--overwrite"])]
    done = subprocess.run(command, capture_output=True, text=True)
    if not (summary := summary_of(folder)):
        sys.exit(f"{' '.join(command)} ended with {done.returncode}:\n{done.stderr[-2000:]}")
    print(f"{folder}: {summary['status']}", file=sys.stderr, flush=True)


def measures(summary):
    """Columns of a run of fault_rupture. Places are for a run that reached the throw only."""
    def of(name, factor=1.0):
        value = summary.get(name)
        return None if value is None else factor * value

    def place(name, factor=1.0):
        return of(name, factor) if summary["status"] == "ok" else None

    bands = summary.get("bands") or [{}]
    budget = summary.get("error_budget", {}).get("parts", {})
    return {"elements": summary["elements"], "h/H": summary["throw_over_depth"], "x05 [m]": place("surface_x05"), "x50 [m]": place("surface_x50"),
            "x95 [m]": place("surface_x95"), "outcrop width [m]": place("outcrop_width"), "rupture dip [deg]": place("rupture_dip", 180.0 / math.pi),
            "largest slope": place("surface_slope_max"), "x50 at 3/4 of the depth [m]": bands[-1].get("band_x50") if summary["status"] == "ok" else None,
            "tilt [deg]": of("tilt", 180.0 / math.pi), "horizontal displacement [m]": of("horizontal_displacement"), "settlement [m]": of("settlement"),
            "contact share": of("contact_share"), "least base pressure [kPa]": of("contact_pressure_min", 1e-3),
            "largest base pressure [kPa]": of("contact_pressure_max", 1e-3), "imbalance over weight": of("force_imbalance"), "K0": of("k0"),
            "void ratio": of("void_ratio"), "least void ratio": of("void_ratio_min"), "largest void ratio": of("void_ratio_max"),
            "steps": summary["steps"], "refused": summary["rejected_steps"], "iterations": summary["iterations"],
            "DEM steps [million]": of("dem_steps", 1e-6), "largest residual": of("max_accepted_residual"), "CPU time [s]": of("cpu_seconds"),
            "wall time [s]": of("wall_seconds"), "threads": of("threads"), "memory [MB]": of("peak_memory_bytes", 1e-6), "status": summary["status"],
            "error budget": " ".join(name for name, part in budget.items() if not part["within"]) or ("within" if budget else ""),
            "commit": summary.get("run", {}).get("commit", "")[:12]}
