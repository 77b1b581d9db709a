# SPDX-License-Identifier: BSL-1.0
"""A program reads only the headers of what it names: linear elasticity no discrete elements, a scene without observer no files (but
the bits of states, which points that hide their types can always tell). What a compiler reads for them is limited too, so that growth is noticed. Environment: see compiler.py."""
import concurrent.futures
import pathlib
import re
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path[:0] = [str(pathlib.Path(__file__).resolve().parent / "examples"), str(pathlib.Path(__file__).resolve().parent)]
from compiler import compiler, include_folders
from expectations import expect, finish

GRAINS = {"scarp/dem/", "scarp/shape/", "scarp/contact/", "scarp/homogenise/", "scarp/rve/", "nanoflann"}
OTHER_GRAINS = {"scarp/dem/fire", "scarp/dem/uniform_strain_rim", "scarp/contact/law_per_species", "scarp/shape/with_species"}
COMPOSED = {"boost/hana"}
FILES = {"scarp/io/"}
FILES_OF_A_RUN = {"scarp/io/(?!state_bits)"}
OBSERVED = {"scarp/observe/field_series", "scarp/io/vtu"}
ELASTIC = '#include "scarp/constitutive/linear_elastic.hpp"\n'
SCENE = '#include "scarp/fault/free_field_fault.hpp"\n'
SAND = """#include "scarp/rve/dem_rve.hpp"
#include "scarp/rve/packings_by_depth.hpp"
#include "scarp/contact/linear_frictional.hpp"
#include "scarp/shape/ellipse.hpp"
"""
SERIES = '#include "scarp/observe/field_series.hpp"\n'
# What a program names; what it must not read; what it must read, or the names above are out of date; lines at most, a quarter
# more than were counted with g++ 12 when this was written.
PROGRAMS = {
    "an elastic point": (ELASTIC, GRAINS | COMPOSED | FILES | OBSERVED, set(), 130000),
    "a packing": (SAND, OTHER_GRAINS | COMPOSED | OBSERVED, GRAINS, 153000),
    "an elastic scene": (ELASTIC + SCENE, GRAINS | FILES_OF_A_RUN | OBSERVED, COMPOSED, 178000),
    "a scene of packings": (SAND + SCENE, OTHER_GRAINS | FILES_OF_A_RUN | OBSERVED, GRAINS | COMPOSED, 186000),
    "an observed scene": (SAND + SCENE + SERIES, set(), GRAINS | COMPOSED | FILES | OBSERVED, 195000),
}


def read(source):
    """Names of all headers that a compiler reads, and the number of lines that are left of them."""
    command = [compiler, "-std=c++20", *include_folders(), "-E", str(source)]
    text = subprocess.run(command, check=True, capture_output=True, text=True).stdout
    lines = sum(1 for line in text.splitlines() if line.strip() and not line.startswith("#"))
    return set(re.findall(r'^# \d+ "([^"]+)"', text, re.M)), lines


with tempfile.TemporaryDirectory() as scratch:
    sources = []
    for number, (text, _, _, _) in enumerate(PROGRAMS.values()):
        sources.append(pathlib.Path(scratch) / f"program{number}.cpp")
        sources[-1].write_text(text)
    with concurrent.futures.ThreadPoolExecutor(max_workers=2) as pool:
        for (name, (_, without, wanted, most)), (headers, lines) in zip(PROGRAMS.items(), pool.map(read, sources)):
            print(f"{name}: {lines} lines")
            for part in sorted(without):
                found = sorted(header for header in headers if re.search(part, header))
                expect(not found, f"{name} reads {', '.join(found[:3])}, which it does not name")
            for part in sorted(wanted):
                expect(any(part in header for header in headers), f"{name} reads no {part}: a name in this script is out of date")
            expect(lines <= most, f"{name} has {lines} lines, at most {most} are expected: look for a new include, or raise the limit")
finish()
