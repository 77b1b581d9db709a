# SPDX-License-Identifier: BSL-1.0
"""page.py OUTPUT_DIR: puts the tables and figures of error_vs_time that are there into docs/error-against-time.md,
between the lines <!-- SUBJECT --> and <!-- end of SUBJECT -->; a subject for which the page has none gets a section.
The example of a scene of one's own comes from own_scene.cpp."""

import pathlib
import shutil
import sys

sys.dont_write_bytecode = True
sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1]))
from generated_sections import rewrite, with_section

REPOSITORY = pathlib.Path(__file__).resolve().parents[2]
PAGE = REPOSITORY / "docs" / "error-against-time.md"


def section(folder, subject):
    """Tables, how they were made, and the figure, which is copied beside the page."""
    text = (folder / f"{subject}.md").read_text().strip()
    figure = folder / f"{subject}.png"
    if figure.is_file():
        name = f"error_vs_time_{subject}.png"
        shutil.copyfile(figure, PAGE.parent / "figures" / name)
        text += f"\n\n![Error against CPU time: {subject}](figures/{name})"
    return text


def example():
    """The lines of own_scene.cpp between its two marks."""
    text = (REPOSITORY / "benchmarks" / "error_vs_time" / "own_scene.cpp").read_text()
    _, _, rest = text.partition("// [the example of docs/error-against-time.md\n")
    shown, mark, _ = rest.partition("// the example ends]")
    if not mark:
        sys.exit("own_scene.cpp has lost the marks of its example: mend it")
    return f"```cpp\n{shown.strip()}\n```"


def main():
    if len(sys.argv) != 2 or not pathlib.Path(sys.argv[1]).is_dir():
        print(f"usage: {sys.argv[0]} OUTPUT_DIR   (which ./benchmarks/run error_vs_time wrote)", file=sys.stderr)
        return 2
    folder = pathlib.Path(sys.argv[1])
    page = with_section(PAGE.read_text(), "own_scene.cpp", example())
    for path in sorted(folder.glob("*.md")):
        page = with_section(page, path.stem, section(folder, path.stem))
        print(path.stem)
    rewrite(PAGE, page)
    return 0


if __name__ == "__main__":
    sys.exit(main())
