# SPDX-License-Identifier: BSL-1.0
"""examples/run builds the program for the water, element and device that the command line or the file of --config names. A cmake that
builds nothing says which."""
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from compiler import root
from expectations import expect, finish

CMAKE = '#!/bin/sh\n[ "$1" != --build ] || { echo "$4" > "$SAID"; exit 9; }\n'
DPKG = "#!/bin/sh\necho 'Status: install ok installed'\n"
# Arguments, lines of the file, program
CASES = [
    ([], "", "fault_rupture"),
    (["--quick", "--element", "quad8"], "", "fault_rupture_quad8"),
    (["--element=Tri6", "--water-table", "0"], "", "fault_rupture_water_tri6"),
    (["--device", "threads"], "", "fault_rupture_device"),
    ([], "water-table=0\n", "fault_rupture_water"),
    ([], "element = 'Quad4'  # of the pilot\r\n", "fault_rupture_quad4"),
    ([], 'device="cuda"\n', "fault_rupture_device"),
    ([], "device=none\nelement=tri3\n", "fault_rupture"),
    ([], "# element=quad8\nno-element=quad8\nelement-size=2\n", "fault_rupture"),
    (["--element", "quad4"], "element=quad8\n", "fault_rupture_quad4"),
]

with tempfile.TemporaryDirectory() as folder:
    scratch = pathlib.Path(folder)
    for name, text in (("cmake", CMAKE), ("dpkg", DPKG)):
        (scratch / name).write_text(text)
        (scratch / name).chmod(0o755)
    said = scratch / "said"
    environment = {**os.environ, "PATH": f"{scratch}:{os.environ['PATH']}", "SAID": str(said)}

    def run(*arguments, example="fault_rupture"):
        said.write_text("")
        done = subprocess.run([root / "examples/run", example, *arguments], cwd=scratch, env=environment, capture_output=True, text=True)
        return done, said.read_text().strip()

    for arguments, lines, program in CASES:
        (scratch / "site.ini").write_bytes(lines.encode())
        done, built = run(*arguments, *(["--config", "site.ini"] if lines else []))
        expect(done.returncode == 9 and built == program, f"{arguments} and a file with {lines!r} build '{built}', not {program}: {done.stderr}")
    (scratch / "tests.ini").write_text("[shear]\noutput=test\n[test]\ndevice=cuda\n")
    for arguments, program in ((["shear"], "rve_lab"), (["--config", "tests.ini", "shear", "--output", "test"], "rve_lab"), (["test"], "rve_lab_device")):
        done, built = run(*arguments, *([] if "--config" in arguments else ["--config=tests.ini"]), example="rve_lab")
        expect(done.returncode == 9 and built == program, f"rve_lab {arguments} builds '{built}', not {program}: {done.stderr}")
    (scratch / "site.ini").write_text("water-table=0\ndevice=threads\n")
    done, built = run("--config=site.ini")
    expect(done.returncode == 2 and not built and "no program has both" in done.stderr, f"water on a device is no error: {done.stderr}")
    done, built = run("--config", "nowhere.ini")
    expect(built == "fault_rupture", f"without the file, of which the program says more, it builds '{built}'")

    # An ensemble with a member that stopped early has figures and a page: a repository with a program that writes nothing else.
    tree = scratch / "repository"
    (tree / "build/release/examples").mkdir(parents=True)
    (tree / "examples/fault_rupture").mkdir(parents=True)
    shutil.copytree(root / ".ci", tree / ".ci")
    shutil.copy(root / "examples/run", tree / "examples/run")
    (scratch / "cmake").write_text("#!/bin/sh\n")
    program = tree / "build/release/examples/fault_rupture"
    program.write_text('#!/bin/sh\nmkdir -p out && touch "out/$WRITES"; exit 3\n')
    program.chmod(0o755)
    (tree / "examples/fault_rupture/plot.py").write_text("import pathlib, sys\npathlib.Path(sys.argv[1], 'drawn').touch()\n")
    for name, is_drawn in (("ensemble.json", True), ("summary.json", True), ("table.csv", False)):
        shutil.rmtree(scratch / "out", ignore_errors=True)
        done = subprocess.run([tree / "examples/run", "fault_rupture", "--output", "out"], cwd=scratch, env={**environment, "WRITES": name},
                              capture_output=True, text=True)
        expect(done.returncode == 3 and (scratch / "out/drawn").exists() == is_drawn, f"{name} of a run that stopped early: {done.stderr}")
finish()
