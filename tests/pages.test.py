# SPDX-License-Identifier: BSL-1.0
"""The pages point to what exists: links, pictures, paths, commands, options and names of the code in README.md and docs stand; every figure and
table of docs is named by a page; every page is in a menu of the site; no page holds generated sections; all pages together are short enough to be read."""
import pathlib
import re
import sys

ROOT = pathlib.Path(__file__).resolve().parents[1]
WORDS = 47_400  # of all pages: a person reads them in three and a half hours
BYTES = 5_000_000  # of docs
LARGEST_TABLE = 20  # rows; larger ones are files in docs/data
SOURCES = ["include", "examples", "tests", "benchmarks", "docs/packaging", ".ci"]
# Written by a run or by other programs, or placeholders.
NOT_OURS = re.compile(r"^(output|build|sensitivity_|figures/ensemble|packings/|DIR/|PREFIX|PATH|\./packages/)|[*<]|^/|\$")
# Names that programs put together.
MADE = {"seed_1", "heavy_frictional", "light_frictional"}
ENDS = (".hpp", ".cpp", ".py", ".md", ".csv", ".png", ".geo", ".msh", ".cmake", ".in", ".txt")

folders = ["docs", "benchmarks", "tests", "examples", ".github"]
pages = sorted({path for path in [*ROOT.glob("*.md"), *(p for f in folders for p in (ROOT / f).rglob("*.md"))]
                if "output" not in path.relative_to(ROOT).parts})
sources = [path for folder in SOURCES for path in (ROOT / folder).rglob("*") if path.is_file() and "output" not in path.parts]
code = "\n".join(path.read_text(errors="ignore") for path in [*sources, ROOT / "CMakeLists.txt", ROOT / "setup.py"] if path.suffix != ".md")
names = set(re.findall(r"\w+", code)) | {path.stem for path in sources} | MADE
faults = []
named = set()  # files that some page links


def exists(text, page):
    """Whether a path of a page is there: from the repository, the page, the headers or the tables."""
    places = [ROOT, page.parent, ROOT / "include", ROOT / "include" / "scarp", ROOT / "docs" / "data"]
    return any((place / text).exists() for place in places)


def program_folder(kind, name):
    """Where the sources of `./examples/run NAME` or `./benchmarks/run NAME` are."""
    here = ROOT / kind
    candidates = [*here.glob(f"[0-9]*_{name}"), here / name, here / "tutorials" / f"{name}.cpp", here / f"{name}.cpp"]
    return next((path for path in candidates if path.exists()), None)


def check_command(line, where):
    for kind, rest in re.findall(r"\./(examples|benchmarks)/run((?: [^\s#;|`]+)*)", line):
        words = [word for word in rest.split() if not re.fullmatch(r"\d+", word)]
        while words and words[0] in ("--ranks",):
            words.pop(0)
        if not words or words[0] in ("NAME", "X", "..."):
            continue
        folder = program_folder(kind, words[0])
        if folder is None:
            faults.append(f"{where}: ./{kind}/run {words[0]} is not there")
    for script in re.findall(r"(?<![.\w])\./((?:tests|benchmarks)(?:/\w+)+(?:\.\w+)?)", line):
        if not (ROOT / script).exists():
            faults.append(f"{where}: ./{script} is not there")
    if "./examples/run" in line or "./benchmarks/" in line or "./tests/" in line:
        for option in re.findall(r"(?<![\w-])--([a-z][a-z0-9-]+)", line):
            if f"--{option}" not in code and f'"{option}"' not in code and option != "help" and not option.startswith("benchmark"):
                faults.append(f"{where}: the option --{option} is declared nowhere")


def check_span(span, page, where):
    path = span.split(" ")[0].rstrip("/")
    if path.endswith(ENDS) and "/" in path and not NOT_OURS.search(path) and not exists(path.removeprefix("./"), page):
        faults.append(f"{where}: there is no {path}")
    elif re.fullmatch(r"(docs|tests|examples|benchmarks|include)(/[\w.-]+)+", path) and not exists(path, page):
        faults.append(f"{where}: there is no {path}")
    name = re.match(r"((?:\w+::)*\w+)(?:[<(].*)?$", span)
    if name and page.name != "CHANGELOG.md":  # which names what is gone
        for word in name[1].split("::"):
            identifier = "_" in word or re.match(r"[A-Z][a-z]", word)
            if identifier and word not in names and not word.startswith(("My", "Wrong")):
                faults.append(f"{where}: the code knows no {word}")


words = 0
for page in pages:
    text = page.read_text()
    short = page.relative_to(ROOT).as_posix()
    words += len(text.split())
    fenced = False
    rows = 0
    for number, line in enumerate(text.splitlines(), 1):
        where = f"{short}:{number}"
        if line.startswith("```"):
            fenced = not fenced
            continue
        check_command(line, where)
        rows = rows + 1 if line.startswith("|") else 0
        if rows == LARGEST_TABLE + 3:
            faults.append(f"{where}: a table of more than {LARGEST_TABLE} rows (move it to docs/data)")
        if fenced:
            continue
        if re.match(r"<!-- .* -->$", line):
            faults.append(f"{where}: a mark of a generated section (write docs/data instead)")
        if "-dirty" in line:
            faults.append(f"{where}: names a commit that nobody can check out")
        for span in re.findall(r"`([^`]+)`", line):
            check_span(span, page, where)
            for pattern in re.findall(r"[\w*]+\.csv", span):
                named.update((ROOT / "docs" / "data").glob(pattern))
        for target in re.findall(r"\]\(([^)\s]+)\)", re.sub(r"`[^`]*`", "", line)):
            if target.startswith(("http://", "https://", "#", "mailto:")):
                continue
            file = (page.parent / target.split("#")[0]).resolve()
            if not file.exists():
                faults.append(f"{where}: the link to {target} leads nowhere")
            named.add(file)

for page in sorted(set(re.findall(r"docs/[\w/-]+\.md", code))):
    if not (ROOT / page).exists():
        faults.append(f"a source names {page}, which is not there")
menu = set(re.findall(r"- (\S+\.md)$", (ROOT / "docs" / "site" / "mkdocs.yml").read_text(), re.MULTILINE))
for page in sorted((ROOT / "docs").rglob("*.md")):
    path = page.relative_to(ROOT / "docs").as_posix()
    if path not in menu and path != "README.md":
        faults.append(f"docs/{path} is in no menu of the site: add it to docs/site/mkdocs.yml")
if words > WORDS:
    faults.append(f"the pages have {words} words, more than {WORDS}")
size = sum(path.stat().st_size for path in (ROOT / "docs").rglob("*") if path.is_file())
if size > BYTES:
    faults.append(f"docs takes {size} bytes, more than {BYTES}")
for file in sorted([*(ROOT / "docs" / "figures").iterdir(), *(ROOT / "docs" / "data").iterdir()]):
    if file not in named:
        faults.append(f"no page names {file.relative_to(ROOT)}")
for file in sorted((ROOT / "docs" / "data").glob("*.csv")):
    first = file.read_text().splitlines()[0]
    if not re.match(r"# \S", first) or "-dirty" in first:
        faults.append(f"{file.relative_to(ROOT)}: the first line must be '# command, commit, machine'")
if len(pages) < 20 or len(names) < 1000:
    faults.append(f"only {len(pages)} pages and {len(names)} names found: this test looks in the wrong place")
print(f"{len(pages)} pages, {words} words, docs {size / 1e6:.1f} MB, {len(faults)} faults")
sys.exit("\n".join(faults) or None)
