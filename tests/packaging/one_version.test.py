# SPDX-License-Identifier: BSL-1.0
"""Sources compiled with two versions of scarp, for registers of different width or with another alignment of Eigen's objects
stop a program at its start where their functions have been merged, by the linker or by the loader, and nowhere else.
Whoever includes a room takes part. Environment: see compiler.py."""
import pathlib
import platform
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from compiler import compiler, include_folders, root

include = root / "include"
PART = """
#include "scarp/core/one_version.hpp"
[[gnu::visibility("default")]] int NAME() { return 0; }
"""
SOURCES = {
    "program.cpp": '#include "scarp/core/one_version.hpp"\nint part();\nint main() { return part(); }\n',
    "plain.cpp": "int part();\nint other_part();\nint main() { return part() + other_part(); }\n",
    "part.cpp": PART.replace("NAME", "part"),
    "other_part.cpp": PART.replace("NAME", "other_part"),
    "library.cpp": '#include "scarp/core/one_version.hpp"\n'
                   "int scarp::detail::version_of_library() { return version_number(); }\n"
                   "int scarp::detail::container_of_library() { return bytes_of_container(); }\n",
}
HIDDEN = ["-fvisibility=hidden", "-fvisibility-inlines-hidden"]
PRECOMPILED = ["-DSCARP_PRECOMPILED"]


class Scratch:
    def __init__(self, folder):
        self.folder = pathlib.Path(folder)
        for name, text in SOURCES.items():
            (self.folder / name).write_text(text)
        own = re.search(r'SCARP_VERSION "(\d+)[.](\d+)[.](\d+)"', (include / "scarp/core/version.hpp").read_text())
        major, minor, last = map(int, own.groups())
        self.own, self.patch, self.next = f"{major}.{minor}.{last}", f"{major}.{minor}.{last + 1}", f"{major}.{minor + 1}.0"
        self.made = 0
        self.objects = {}

    def headers(self, version):
        """As they would be in that version: only its number differs."""
        folder = self.folder / version
        if not folder.exists():
            (folder / "scarp/core").mkdir(parents=True)
            for name in ("version.hpp", "one_version.hpp"):
                text = (include / "scarp/core" / name).read_text()
                (folder / "scarp/core" / name).write_text(text.replace(f'"{self.own}"', f'"{version}"'))
        return folder

    def compile(self, what, *flags):
        self.made += 1
        made = self.folder / f"made{self.made}"
        subprocess.run([compiler, "-std=c++20", *flags, *map(str, what), "-o", str(made)], check=True)
        return made

    def object(self, *words):
        """Of a source, with the headers of a version and flags."""
        if words not in self.objects:
            source, version, *flags = words
            made = self.compile([self.folder / source], "-c", f"-I{self.headers(version)}", "-O1", *flags)
            self.objects[words] = made.rename(self.folder / f"object{self.made}.o")
        return self.objects[words]

    def library(self, source, version, *flags):
        return self.compile([self.folder / source], "-shared", "-fPIC", f"-I{self.headers(version)}", "-O1", *flags)


def run(program):
    done = subprocess.run([str(program)], capture_output=True, text=True)
    return done.returncode, done.stderr


def faults(scratch):
    def in_one_link(version):
        return [scratch.object("program.cpp", scratch.own), scratch.object("part.cpp", version)]

    def of_two_libraries(*flags):
        return [scratch.object("plain.cpp", scratch.own), scratch.library("part.cpp", scratch.own, *flags),
                scratch.library("other_part.cpp", scratch.next, *flags)]

    def with_library(version):
        return [scratch.object("program.cpp", scratch.own, *PRECOMPILED),
                scratch.object("part.cpp", scratch.own, *PRECOMPILED),
                scratch.object("library.cpp", version, *PRECOMPILED, *HIDDEN)]

    def two_minors(said):
        return all(re.search(rf"version {re.escape(number.rpartition('.')[0])}\b", said)
                   for number in (scratch.own, scratch.next))

    for title, parts, may_run in (("one version", in_one_link(scratch.own), True),
                                  ("last number differs", in_one_link(scratch.patch), True),
                                  ("two versions in one link", in_one_link(scratch.next), False),
                                  ("two shared libraries", of_two_libraries(), False),
                                  ("two shared libraries, hidden symbols", of_two_libraries(*HIDDEN), True),
                                  ("a fitting scarp::precompiled", with_library(scratch.own), True),
                                  ("scarp::precompiled of another version", with_library(scratch.next), False)):
        code, said = run(scratch.compile(parts, f"-Wl,-rpath,{scratch.folder}"))
        if may_run and (code, said) != (0, ""):
            yield f"{title}: ended with {code}: {said}"
        if not may_run and (code == 0 or not two_minors(said)):
            yield f"{title}: was not refused: {code}, {said}"


def mixed(scratch):
    """Sources of one program that were not compiled alike."""
    aligned = '#include "scarp/tensor/tensor.hpp"\n'
    (scratch.folder / "aligned_program.cpp").write_text(aligned + "int main() { return 0; }\n")
    (scratch.folder / "aligned_part.cpp").write_text(aligned)
    (scratch.folder / "aligned_library.cpp").write_text(
        aligned + "int scarp::detail::version_of_library() { return version_number(); }\n"
        "int scarp::detail::container_of_library() { return bytes_of_container(); }\n"
        "int scarp::detail::alignment_of_library() { return own_alignment(); }\n")

    def part(source, alignment, *flags):
        made = scratch.compile([scratch.folder / source], "-c", *include_folders(), f"-DEIGEN_MAX_ALIGN_BYTES={alignment}",
                               *flags)
        return made.rename(scratch.folder / f"object{scratch.made}.o")

    cases = [("two alignments", [part("aligned_program.cpp", 16), part("aligned_part.cpp", 64)],
              r"Eigen aligns by (16|64) bytes .* meets (16|64) "),
             ("scarp::precompiled with another alignment",
              [part("aligned_program.cpp", 16, *PRECOMPILED), part("aligned_library.cpp", 64, *PRECOMPILED, *HIDDEN)],
              r"Eigen aligns by (16|64) bytes .* meets (16|64) ")]
    checks = "-D_GLIBCXX_DEBUG"
    plain, checked = (scratch.object(source, scratch.own, *flags) for source, flags in (("program.cpp", ()), ("part.cpp", (checks,))))
    linked = [scratch.object("program.cpp", scratch.own, *PRECOMPILED, checks), scratch.object("part.cpp", scratch.own, *PRECOMPILED, checks),
              scratch.object("library.cpp", scratch.own, *PRECOMPILED, *HIDDEN)]
    said = r"std::vector has \d+ bytes meets one where it has \d+"
    cases += [("checked containers and others", [plain, checked], said), ("scarp::precompiled without checked containers", linked, said),
              ("checked containers everywhere", [scratch.object(source, scratch.own, checks) for source in ("program.cpp", "part.cpp")], None)]
    if platform.machine() == "x86_64":
        plain = scratch.object("program.cpp", scratch.own)
        avx = scratch.object("part.cpp", scratch.own, "-march=x86-64-v3")
        said = r"vector registers of (16|32) bytes meets one for (16|32) bytes"
        library = scratch.library("part.cpp", scratch.own, "-march=x86-64-v3", *HIDDEN)
        cases += [("two instruction sets", [plain, avx], said),
                  ("two instruction sets, hidden symbols", [plain, library], None)]
    for title, parts, refusal in cases:
        code, said = run(scratch.compile(parts, f"-Wl,-rpath,{scratch.folder}"))
        if refusal is None and (code, said) != (0, ""):
            yield f"{title}: ended with {code}: {said}"
        if refusal and (code == 0 or not re.search(refusal, said)):
            yield f"{title}: was not refused: {code}, {said}"


def plugins(scratch):
    """Two libraries with hidden symbols whose functions are visible to all once they are loaded keep their own, for two instruction sets."""
    (scratch.folder / "plugin.cpp").write_text("""
#include "scarp/constitutive/mohr_coulomb.hpp"
extern "C" [[gnu::visibility("default")]] int lanes() {
  scarp::MohrCoulomb<3> const soil{scarp::IsotropicElasticity::from_young_poisson(9e6, 0.2), {{.cohesion = 400.0, .friction = 0.6}}};
  auto const start = soil.initial_state({});
  auto end = start;
  auto const response = soil.respond(start, scarp::Gradient<3>{{0.0, 1e-2, 0.0}, {0.0, 0.0, 0.0}, {0.0, 0.0, -2e-2}}, end);
  return response.verdict.acceptable() ? scarp::detail::bytes_of_register() : 0;
}
""")
    names, libraries = [], []
    for level in ("x86-64", "x86-64-v3"):
        made = scratch.compile([scratch.folder / "plugin.cpp", "-lfmt"], "-shared", "-fPIC", f"-march={level}", *include_folders(), *HIDDEN)
        symbols = subprocess.run(["nm", "-DC", "--defined-only", made], capture_output=True, text=True, check=True).stdout
        libraries.append(str(made))
        names.append({line.split(maxsplit=2)[2] for line in symbols.splitlines() if "scarp::" in line})
    if common := names[0] & names[1]:
        yield f"two plugins share {len(common)} functions of scarp, such as {sorted(common)[0]}"
    if "avx2" not in pathlib.Path("/proc/cpuinfo").read_text():
        return  # the second one cannot be called
    calls = "import ctypes, sys; loaded = [ctypes.CDLL(name, ctypes.RTLD_GLOBAL) for name in sys.argv[1:]]; print(*(one.lanes() for one in loaded))"
    for order, registers in ((libraries, "16 32"), (libraries[::-1], "32 16")):
        said = subprocess.run([sys.executable, "-c", calls, *order], capture_output=True, text=True)
        if said.stdout.strip() != registers:
            yield f"two plugins in one process answer '{said.stdout.strip()}' for {registers} bytes of a register: {said.stderr}"


def reached(header, seen):
    if header not in seen:
        seen.add(header)
        for other in re.findall(r'#include "(scarp/[^"]+)"', (include / header).read_text()):
            reached(other, seen)
    return seen


with tempfile.TemporaryDirectory() as folder:
    scratch = Scratch(folder)
    found = [*faults(scratch), *mixed(scratch), *(plugins(scratch) if platform.machine() == "x86_64" else [])]
for room in sorted(folder for folder in (include / "scarp").iterdir() if any(folder.glob("*.hpp"))):
    if not any("scarp/core/one_version.hpp" in reached(f"scarp/{room.name}/{header.name}", set())
               for header in room.glob("*.hpp")):
        found.append(f"no header of scarp/{room.name} includes core/one_version.hpp, not even by way of others")
sys.exit("\n".join(found) or None)
