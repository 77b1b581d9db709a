# SPDX-License-Identifier: BSL-1.0
"""[slow] A full disk and a clock that jumps: a run says why it ends, harms nothing that was there, and goes on to the bits of a run that
nobody disturbed. Kills are in checkpoint.test.py, two runs at once in runs.test.py. Environment: SCARP_EXAMPLES, the folder of the
built programs (skipped, exit 77, without); SCARP_SEED, of the sizes at which the disk is full."""
import json
import os
import pathlib
import random
import resource
import shutil
import signal
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish

FAULT = pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / "fault_rupture"
SEED = int(os.environ.get("SCARP_SEED", "1"))
SCENE = [str(FAULT), "--quick", "--size", "12", "--soil", "mohr_coulomb", "--throw-over-depth", "0.01", "--threads", "1",
         "--output", "out"]
SAVING = [*SCENE, "--checkpoint", "states", "--checkpoint-every", "0", "--resume"]
TABLES = ("surface.csv", "probe_A.csv", "probe_B.csv")

# Every look at the wall clock finds it days from where it was: forwards, backwards, forwards.
JUMPING_CLOCK = """
#define _GNU_SOURCE
#include <sys/syscall.h>
#include <time.h>
#include <unistd.h>
static long jump(void) { static long calls; long n = ++calls; return (n % 2 ? 1 : -1) * 86400L * (n % 97); }
int clock_gettime(clockid_t clock, struct timespec* now) {
  int const result = syscall(SYS_clock_gettime, clock, now);
  if (clock == CLOCK_REALTIME) now->tv_sec += jump();
  return result;
}
time_t time(time_t* where) {
  struct timespec now;
  clock_gettime(CLOCK_REALTIME, &now);
  if (where) *where = now.tv_sec;
  return now.tv_sec;
}
"""


def run(words, folder, file_limit=None, preload=None):
    """file_limit: of the size of a file [bytes]; writing beyond it fails as on a full disk"""
    def bound():
        signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
        if file_limit is not None:
            resource.setrlimit(resource.RLIMIT_FSIZE, (file_limit, file_limit))
    environment = {**os.environ, **({"LD_PRELOAD": str(preload)} if preload else {})}
    done = subprocess.run(words, cwd=folder, capture_output=True, text=True, errors="replace", timeout=120, preexec_fn=bound,
                          restore_signals=False, env=environment)
    return done.returncode, done.stdout + done.stderr


def tables(folder):
    return {name: (folder / "out" / name).read_bytes() for name in TABLES if (folder / "out" / name).exists()}


def check_full_disk(folder, expected):
    """From no room at all to less than the largest file needs, whose wall times make it longer or shorter by some letters."""
    chance = random.Random(f"{SEED} full disk")
    most = max(path.stat().st_size for path in (folder / "whole").rglob("*") if path.is_file()) * 9 // 10
    for number in range(6):
        limit = chance.choice((0, 1, chance.randrange(4096), chance.randrange(most), most))
        here = folder / f"full_{number}"
        here.mkdir()
        (here / "notes.txt").write_text("the user's\n")
        code, said = run(SCENE, here, file_limit=limit)
        title = f"a disk with room for {limit} bytes a file"
        expect(code in (1, 2), f"{title}: ended with {code}\n{said[-1000:]}")
        expect("cannot write" in said or "cannot lock" in said, f"{title}: does not say what it cannot write\n{said[-1000:]}")
        for path in here.rglob("*.json"):
            json.loads(path.read_text())
        left = [path.name for path in here.rglob("*.partial-*")]
        expect(not left, f"{title}: {left} are left")
        expect((here / "notes.txt").read_text() == "the user's\n", f"{title}: the user's file is gone")


def check_full_disk_and_resume(folder, expected):
    """The run stops where its tables no longer fit, and goes on when there is room again."""
    here = folder / "resumed"
    here.mkdir()
    code, said = run([*SAVING, "--time-limit", "1e-6"], here)
    expect(code == 130, f"a stopped run: ended with {code}\n{said[-1000:]}")
    states = {path: path.read_bytes() for path in (here / "states").iterdir()}
    code, said = run(SAVING, here, file_limit=max(map(len, states.values())) - 1)
    expect(code in (1, 2) and "cannot write" in said, f"a disk that fills up: ended with {code}\n{said[-1000:]}")
    expect(states == {path: path.read_bytes() for path in states}, "a disk that fills up: the checkpoints are others")
    code, said = run(SAVING, here)
    expect(code == 0, f"with room again: ended with {code}\n{said[-1000:]}")
    expect(tables(here) == expected, "with room again: other tables than those of an undisturbed run")


def check_streams(folder, expected):
    """Nobody reads what the run says: it computes and writes the same."""
    for title, words, ending in (("an error stream on a full disk", "2>/dev/full", 0), ("closed streams", ">&- 2>&-", 0),
                                 ("an error stream that is closed", "2>&-", 0), ("both streams on a full disk", ">/dev/full 2>&1", 1)):
        here = folder / title.replace(" ", "_")
        here.mkdir()
        code, said = run(["sh", "-c", f'exec "$@" {words}', "sh", *SCENE], here)
        expect(code == ending, f"{title}: ended with {code}\n{said[-1000:]}")
        expect(tables(here) == expected, f"{title}: other tables than those of an undisturbed run")
        expect((here / "out/summary.json").exists(), f"{title}: no summary")
    for program in ("fault_rupture", "rve_lab", "rve_biaxial", "biaxial_specimen", "retaining_wall"):
        if not FAULT.with_name(program).is_file():
            continue
        for word, redirection, codes in (("--help", ">/dev/full", (1,)), ("--help", ">&- 2>&-", (0,)),
                                         ("--no-such-option", "2>/dev/full", range(1, 128))):
            title = f"{program} {word} {redirection}"
            code, said = run(["sh", "-c", f'exec "$@" {redirection}', "sh", FAULT.with_name(program), word], folder)
            expect(code in codes, f"{title}: ended with {code}\n{said[-1000:]}")
            expect(redirection != ">/dev/full" or "cannot be written" in said, f"{title}: {said[-1000:]}")


def check_signals(folder, expected):
    """A run whose terminal goes, or whose reader goes, saves itself and ends; it goes on to the same bits."""
    for title, words in (("SIGHUP", 'exec "$@" 2>log'), ("SIGPIPE", 'exec "$@" 2>&1')):
        here = folder / title
        here.mkdir()
        with subprocess.Popen(["sh", "-c", words, "sh", *SAVING], cwd=here, stdout=subprocess.PIPE,
                              stderr=subprocess.DEVNULL, preexec_fn=lambda: signal.signal(signal.SIGPIPE, signal.SIG_DFL)) as process:
            if title == "SIGPIPE":
                while not (here / "out/run.json").exists() and process.stdout.readline():
                    pass
                process.stdout.close()
            else:
                while process.poll() is None and not list((here / "states").glob("checkpoint_*")):
                    time.sleep(0.005)
                process.send_signal(signal.SIGHUP)
            code = process.wait(120)
        expect(code == 130, f"{title}: ended with {code}")
        expect(json.loads((here / "out/run.json").read_text())["state"] == "interrupted", f"{title}: another state")
        code, said = run(SAVING, here)
        expect(code == 0 and tables(here) == expected, f"{title}: gone on, ended with {code}\n{said[-1000:]}")


def check_names(folder, expected):
    """Folders whose names are no UTF-8 get all results, and JSON."""
    here = folder / "names"
    here.mkdir()
    code, said = run([*SCENE[:-1], b"b\xf6den", "--checkpoint", b"st\xe4nde", "--checkpoint-every", "0", "--resume"], here)
    expect(code == 0, f"a folder whose name is no UTF-8: ended with {code}\n{said[-1000:]}")
    for name in ("run.json", "summary.json"):
        json.loads((pathlib.Path(os.fsdecode(os.fsencode(here) + b"/b\xf6den")) / name).read_text(encoding="utf-8"))


def check_small_disk(folder, expected):
    """A file system that fills up: the run ends in words, its record says so, and it goes on when there is room again."""
    (folder / "small").mkdir()
    pages = sum(-(-path.stat().st_size // 4096) for path in (folder / "whole").rglob("*") if path.is_file())
    for share in (0.3, 0.6, 0.9):
        size = int(4 * share * pages)
        title = f"a disk of {size} kB"
        script = (f'mount -t tmpfs -o size={size}k none small || exit 99; cd small; "$@"; echo "first $?"; cp -r . ../full_{size}; '
                  f'mount -o remount,size=20m . ; "$@"; code=$?; cp -r out/. ../whole_{size}; exit $code')
        if shutil.which("unshare") is None:
            return print("no unshare here: no small file systems")
        code, said = run(["unshare", "-rm", "sh", "-c", script, "sh", *SAVING], folder)
        if code == 99 or "unshare" in said:
            return print("no name spaces here: no small file systems")
        expect(("first 1\n" in said or "first 2\n" in said) and "cannot write" in said, f"{title}: {said[-1000:]}")
        record = folder / f"full_{size}/out/run.json"
        if record.exists():
            expect(json.loads(record.read_text())["state"] != "running", f"{title}: the record says that it runs")
        found = {name: (folder / f"whole_{size}" / name).read_bytes() for name in TABLES}
        expect(code == 0 and found == expected, f"{title}, with room again: ended with {code}\n{said[-1000:]}")


def check_jumping_clock(folder, expected):
    compiler = shutil.which("cc") or shutil.which("gcc") or shutil.which("clang")
    if compiler is None:
        print("no compiler of C: the clock does not jump here")
        return
    (folder / "clock.c").write_text(JUMPING_CLOCK)
    library = folder / "clock.so"
    subprocess.run([compiler, "-shared", "-fPIC", "-O1", "-o", library, folder / "clock.c"], check=True)
    here = folder / "clock"
    here.mkdir()
    code, said = run([*SAVING[:-1], "--time-limit", "1e9", "--resume"], here, preload=library)
    expect(code == 0, f"a clock that jumps: ended with {code}\n{said[-1000:]}")
    expect(tables(here) == expected, "a clock that jumps: other tables than those of an undisturbed run")
    record = json.loads((here / "out/run.json").read_text())
    expect(record["started"] != record["changed"], "the clock has not jumped")
    code, said = run([*SCENE, "--overwrite", "--time-limit", "1e-6"], here, preload=library)
    expect(code == 130, f"a time limit with a clock that jumps: ended with {code}\n{said[-1000:]}")


if not FAULT.is_file():
    print(f"skipped: no programs in {FAULT.parent} (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
print(f"SCARP_SEED={SEED}")
with tempfile.TemporaryDirectory() as scratch:
    scratch = pathlib.Path(scratch)
    code, said = run(SCENE, scratch)
    expect(code == 0, f"undisturbed: ended with {code}\n{said[-1000:]}")
    expected = tables(scratch)
    (scratch / "out").rename(scratch / "whole")
    check_full_disk(scratch, expected)
    check_full_disk_and_resume(scratch, expected)
    for check in (check_streams, check_signals, check_names, check_small_disk, check_jumping_clock):
        check(scratch, expected)
finish()
