# SPDX-License-Identifier: BSL-1.0
"""[slow] The page of a run is whole: it holds the numbers, the budget, the settings and all figures, names nothing outside of itself, shows
nothing that a file could smuggle in, says when a run has stopped, and a browser opens it from disk. Environment: SCARP_EXAMPLES, the
folder of the built programs (skipped, exit 77, without, and without matplotlib or a browser)."""
import html.parser
import importlib.util
import json
import os
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile
import time

sys.dont_write_bytecode = True  # the import below leaves no folder in the sources
from expectations import expect, finish, troubles

program = (pathlib.Path(os.environ.get("SCARP_EXAMPLES", "nowhere")).resolve() / "fault_rupture").resolve()
scripts = pathlib.Path(__file__).resolve().parents[2] / "examples" / "fault_rupture"
TINY = ["--quick", "--size", "12", "--grains", "49", "--throw-over-depth", "0.01", "--frames", "4", "--threads", "1"]
BROWSERS = ("chromium", "chromium-headless-shell", "chromium-browser", "google-chrome")
# Answers into the document what a browser made of the images, and how wide the page gets on a telephone.
QUESTION = """<script>addEventListener("load", () => {
  const told = {
    images: Array.from(document.images, image => [image.naturalWidth, image.naturalHeight]),
    refused: performance.getEntriesByType("resource").map(entry => entry.name).filter(name => !name.startsWith("data:"))};
  document.body.style.width = "400px";
  told.width = document.querySelector("main").scrollWidth;
  document.documentElement.dataset.told = JSON.stringify(told);
});</script>"""


class Page(html.parser.HTMLParser):
    """Tags with their attributes, and the text outside of them."""

    def __init__(self, path):
        super().__init__()
        self.tags, self.words = [], ""
        self.feed(path.read_text())

    def handle_starttag(self, tag, attributes):
        self.tags.append((tag, dict(attributes)))

    def handle_data(self, data):
        self.words += data + " "

    def all(self, tag):
        return [attributes for name, attributes in self.tags if name == tag]


def run(folder, *options):
    words = [program, *TINY, "--output", folder.name, *options]
    done = subprocess.run(words, cwd=folder.parent, capture_output=True, text=True, timeout=900)
    return done.returncode, done.stderr


def write_page(folder, figures=True):
    """\\return what the two scripts ended with"""
    codes = []
    for script in ["plot.py"] * figures + ["report.py"]:
        done = subprocess.run([sys.executable, scripts / script, folder], capture_output=True, text=True, timeout=900)
        codes.append((done.returncode, done.stdout + done.stderr))
    return codes


def check_stands_alone(title, path):
    page = Page(path)
    names = [value for _, attributes in page.tags for name, value in attributes.items() if name in ("src", "href", "srcset", "action")]
    outside = [value[:80] for value in names if not value.startswith(("data:", "#"))]
    expect(not outside, f"{title}: names {outside}")
    expect(not re.search(r"https?://|url\(|@import", path.read_text()), f"{title}: names an address")
    expect(not page.all("script") and all(not name.startswith("on") for _, attributes in page.tags for name in attributes),
           f"{title}: holds a script")
    expect(all(image.get("alt") for image in page.all("img")), f"{title}: an image without words")
    return page


def check_whole(folder):
    code, said = run(folder)
    expect(code == 0, f"the run ended with {code}\n{said[-2000:]}")
    started = time.monotonic()
    for code, said in write_page(folder):
        expect(code == 0, f"a script ended with {code}\n{said}")
    print(f"figures and page: {time.monotonic() - started:.1f} s")
    page = check_stands_alone("a page", folder / "report.html")
    drawn = sorted(path.stem for path in (folder / "figures").iterdir())
    expect({"rupture", "stress_crosses", "probe_packings", "probe_roses"} <= set(drawn), f"figures {drawn}")
    shown = sorted(attributes["id"].removeprefix("figure-") for attributes in page.all("figure"))
    expect(shown == drawn and len(page.all("img")) == len(drawn), f"shown are {shown}, drawn {drawn}")
    expect((folder / "figures/rupture.gif").stat().st_size < 3e6, "the animation is large")
    fields = shutil.copytree(folder, folder.with_name("fields"), ignore=shutil.ignore_patterns("*.csv", "*.json", "figures"))
    done = subprocess.run([sys.executable, scripts.parent / "shared/field_figures.py", fields], capture_output=True, text=True, timeout=900)
    expect(done.returncode == 0 and {path.name for path in (fields / "figures").iterdir()} ==
           {"deformation.png", "strain.gif", "stress_crosses.png"}, f"figures of fields alone: {done.stdout}{done.stderr}")

    summary = json.loads((folder / "summary.json").read_text())
    for key in ("surface_x50", "k0", "max_accepted_residual", "dem_steps"):
        expect(f"{summary[key]}" in page.words, f"{key} = {summary[key]} does not stand in the page")
    expect(f"{summary['surface_x50']:.2f} m" in page.words, "the middle of the rupture stands in no tile")
    for name, part in summary["error_budget"]["parts"].items():
        expect(name in page.words and part["meaning"] in page.words, f"the budget's {name} is missing")
    expect(("OUTSIDE" in page.words) != summary["error_budget"]["within"], "the budget's verdict is not that of the run")
    options = json.loads((folder / "run.json").read_text())["options"]
    expect(all(f"--{name}" in page.words for name in options), "an option is missing")
    marked = sum(attributes.get("class") == "marked" for attributes in page.all("tr"))
    expect(6 <= marked <= 2 * (len(TINY) - 1), f"{marked} settings are marked")
    steps = len(re.findall(r"\baccepted\b", page.words))
    expect(steps >= summary["steps"], f"{steps} lines of load steps, {summary['steps']} steps")
    expect("INCOMPLETE" not in page.words and "Finished" in page.words, "a finished run is not told so")


def drawn_marks(folder):
    """Labels of the marks of surface.png, and the number of footings in deformation.png."""
    words = ("import json, pathlib, sys, plot; from matplotlib.patches import Polygon; folder = pathlib.Path(sys.argv[1]); "
             "labels = [line.get_label() for axes in plot.surface(folder).axes for line in axes.lines]; "
             "boxes = sum(type(patch) is Polygon for axes in plot.deformation(folder).axes[:2] for patch in axes.patches); "
             "print(json.dumps([labels, boxes]))")
    done = subprocess.run([sys.executable, "-B", "-c", words, folder], cwd=scripts, capture_output=True, text=True, timeout=900)
    expect(done.returncode == 0, f"marks: {done.stderr[-1000:]}")
    labels, boxes = json.loads(done.stdout)
    return " ".join(labels), boxes


def check_site(folder):
    """The reference study's numbers stand beside its own site only, and a rigid footing is drawn."""
    def site(*options):
        done = subprocess.run([program, "--quick", "--soil", "mohr_coulomb", "--frames", "2", "--output", folder.name, "--overwrite", *options],
                              cwd=folder.parent, capture_output=True, text=True, timeout=900)
        expect(done.returncode == 0, f"{options}: ended with {done.returncode}: {done.stderr[-1000:]}")
        told = json.loads((folder / "summary.json").read_text())
        return told["repeats_study"], (folder / "summary.txt").read_text(), *drawn_marks(folder)

    repeats, table, marks, boxes = site("--throw-over-depth", "0.01")
    expect(repeats and "-12.5" in table and "centrifuge" in marks and boxes == 0, f"the reference study's site: {repeats}, {boxes}\n{table}\n{marks}")
    for options in (["--depth", "11"], ["--reverse"], ["--peak-friction-angle", "38"], ["--dip", "50"], ["--surcharge", "2e4"]):
        repeats, table, marks, _ = site("--throw-over-depth", "0.01", *options)
        strange = [word for word in ("study", "-12.5 (", "-14.5", "0.085\n", "about 0.4", "centrifuge") if word in table + marks]
        expect(not repeats and not strange, f"{options}: {strange}\n{table}\n{marks}")
    _, _, marks, boxes = site("--throw-over-depth", "0.02", "--case", "heavy", "--footing", "frictional", "--footing-centre", "-14")
    expect(boxes == 2 and "footing" in (folder / "run.json").read_text(), f"a rigid footing is drawn {boxes} times")
    for code, said in write_page(folder):
        expect(code == 0, f"figures of a footing: {said}")


def check_packings(folder):
    """The observer's files, as the figures read them."""
    throws = [line.split(",")[0] for line in (folder / "packings/A.csv").read_text().splitlines()[1:]]
    last = json.loads((folder / "summary.json").read_text())["throw_over_depth"]
    expect(len(throws) == 4 and float(throws[0]) == 0.0 and abs(float(throws[-1]) - last) < 1e-12, f"packings at {throws}")
    code, said = run(folder, "--overwrite", "--soil", "mohr_coulomb")
    expect(code == 0, f"over it another soil: ended with {code}\n{said[-2000:]}")
    expect(not list((folder / "packings").iterdir()), "packings of an older run are left")
    names = "import plot, sys, pathlib; print(*plot.figures_of(pathlib.Path(sys.argv[1])))"
    done = subprocess.run([sys.executable, "-B", "-c", names, folder], cwd=scripts, capture_output=True, text=True, timeout=900)
    shown = set(done.stdout.split())
    expect("rupture" in shown and not shown & {"packing", "fabric", "probe_packings", "probe_roses"}, f"another soil shows {shown}")
    expect(write_page(folder, figures=False)[0][0] == 0, "a page of another soil")
    page = check_stands_alone("another soil", folder / "report.html")
    expect("Mohr-Coulomb soil" in page.words, "another soil is not told so")


def check_stopped(folder):
    code, said = run(folder, "--checkpoint", "states", "--time-limit", "1e-6")
    expect(code == 130, f"a time limit: ended with {code}\n{said[-2000:]}")
    expect(write_page(folder, figures=False)[0][0] == 0, "a page of a stopped run")
    page = check_stands_alone("a stopped run", folder / "report.html")
    expect("INCOMPLETE: stopped (interrupted" in page.words, "a stopped run is not told so")
    (folder / "summary.json").unlink()
    for harmed in ('{"state": "running", "options": {"size": "1"}}', '{"state": 1, "options": [], "build": "x"}'):
        (folder / "run.json").write_text(harmed)
        codes = write_page(folder, figures=False)
        expect(codes[0][0] == 0, f"a run without summary: {codes}")
        expect("INCOMPLETE" in Page(folder / "report.html").words, "a run that has not ended is not told so")


def check_sunk(folder):
    """A footing that sinks before the fault moves has no figure over the throw, but a page."""
    done = subprocess.run([program, "--quick", "--soil", "mohr_coulomb", "--case", "heavy", "--bearing-pressure", "1e7", "--frames", "1",
                           "--output", folder.name], cwd=folder.parent, capture_output=True, text=True, timeout=900)
    expect(done.returncode == 3, f"a footing that sinks: ended with {done.returncode}: {done.stderr[-1000:]}")
    (code, said), (page, trouble) = write_page(folder)
    expect(code == 1 and "figure 'footing' is not drawn: 'footing.csv' holds no load from zero on" in said, f"figures: {code}\n{said}")
    expect(page == 0 and not (folder / "figures/footing.png").exists(), f"an empty figure of a footing: {trouble}")


def check_ensembles(folder):
    """Of members that have ended alone it is told that they are inside their error budgets."""
    folder.mkdir()
    inside = "all members that ended inside their error budgets"
    for states, told in ((("interrupted", "interrupted"), False), (("ok", "interrupted"), True), (("ok", "ok"), True)):
        members = [{"seed": seed, "folder": f"seed_{seed}", "status": state} for seed, state in enumerate(states)]
        (folder / "ensemble.json").write_text(json.dumps({"members": members}))
        state = "finished" if set(states) == {"ok"} else "stopped early"
        (folder / "run.json").write_text(json.dumps({"program": "fault_rupture, ensemble", "state": state}))
        expect(write_page(folder, figures=False)[0][0] == 0, "a page of an ensemble")
        expect((inside in Page(folder / "report.html").words) == told, f"an ensemble of {states} does not tell of its budgets what is so")


def check_escapes(folder):
    """Whatever stands in the files is text."""
    evil = '"><script src="http://x/">&<img src=x onerror=alert(1)>'
    (folder / "figures").mkdir(parents=True)
    (folder / "figures" / 'a" onload="x.png').write_bytes(b"no picture")
    (folder / "run.json").write_text(json.dumps({
        "program": evil, "state": evil, "started": evil, "build": {evil: evil},
        "options": {evil: evil, "case": evil, "soil": evil, "dip": evil}, "defaults": {evil: "1"}}))
    part = {"value": evil, "bound": None, "within": False, "meaning": evil}
    (folder / "summary.json").write_text(json.dumps({
        "status": evil, evil: evil, "elements": 3.0, "element": evil, "error_budget": {"parts": {evil: part}}}))
    (folder / "summary.txt").write_text(evil)
    (folder / "convergence.csv").write_text(f"step,throw_over_depth,iteration,residual,accepted,reason\n{evil},1,1,1,0,{evil}\n")
    expect(write_page(folder, figures=False)[0][0] == 0, "a page of evil words cannot be written")
    page = Page(folder / "report.html")
    expect(not page.all("script") and len(page.all("img")) == 1, "words of a file became tags")
    expect(not any(name.startswith("on") for _, attributes in page.tags for name in attributes), "words of a file became attributes")
    expect(page.words.count(evil) > 10, "words of a file are lost")


def check_browser(browser, path, scratch):
    asked = scratch / "asked.html"
    text = path.read_text()
    policy = re.search(r'<meta http-equiv="Content-Security-Policy" content="([^"]*)">', text)
    expect(policy is not None and "default-src" in policy[1], "a page without a policy")
    allowed = text.replace(policy[0], policy[0].replace(policy[1], policy[1] + "; script-src &#x27;unsafe-inline&#x27;"))
    asked.write_text(allowed.replace("</body>", QUESTION + "</body>"))
    started = time.monotonic()
    done = subprocess.run([browser, "--headless", "--no-sandbox", "--disable-gpu", "--disable-quic", "--no-first-run",
                           "--disable-background-networking", "--disable-component-update", "--disable-sync", "--disable-dev-shm-usage",
                           f"--user-data-dir={scratch / 'profile'}", "--virtual-time-budget=10000", "--dump-dom", asked.as_uri()],
                          capture_output=True, text=True, timeout=240)
    print(f"{pathlib.Path(browser).name}: {time.monotonic() - started:.1f} s")
    found = re.search(r'data-told="([^"]*)"', done.stdout)
    expect(found is not None, f"the browser says nothing (ended with {done.returncode})\n{done.stderr[-1500:]}")
    if found is None:
        return
    told = json.loads(html.unescape(found[1]))
    expect(len(told["images"]) == len(Page(path).all("img")) > 8, f"{len(told['images'])} images")
    expect(all(min(size) > 99 for size in told["images"]), f"an image is not decoded: {told['images']}")
    expect(not told["refused"], f"the browser asked for {told['refused']}")
    expect(told["width"] <= 400, f"on a telephone the page is {told['width']} pixels wide")


if not program.is_file():
    print("skipped: no fault_rupture (set SCARP_EXAMPLES and build the examples)")
    sys.exit(77)
if importlib.util.find_spec("matplotlib") is None:
    print("skipped: no matplotlib")
    sys.exit(77)
browser = next(filter(None, map(shutil.which, BROWSERS)), None)
with tempfile.TemporaryDirectory(ignore_cleanup_errors=True) as scratch:
    scratch = pathlib.Path(scratch)
    check_whole(scratch / "out")
    if browser:
        check_browser(browser, scratch / "out/report.html", scratch)
    check_packings(scratch / "out")
    check_site(scratch / "site")
    check_stopped(scratch / "stopped")
    check_sunk(scratch / "sunk")
    check_ensembles(scratch / "ensemble")
    check_escapes(scratch / "evil")
if browser is None and not troubles:
    print("skipped: no browser opened the page (install chromium)")
    sys.exit(77)
finish()
