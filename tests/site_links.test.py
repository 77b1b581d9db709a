# SPDX-License-Identifier: BSL-1.0
"""The check of the site's links (docs/site/check_links.py) finds each kind of fault in a small site, and none in a sound one."""
import pathlib
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[1]
sys.dont_write_bytecode = True
sys.path[:0] = [str(ROOT / "docs" / "site"), str(ROOT / "tests" / "examples")]
from check_links import check
from expectations import expect, finish

SOUND = '''<h1 id="top">scarp</h1><a href="deep/page.html#part">part</a><a href="#top">top</a><a href="deep">folder</a>
<a href="https://doi.org/10.1002/nme.4702">away</a><img src="picture.png"/><script src="code.js?v=1"></script>'''
FAULTS = {'<a href="nowhere.html">': "nowhere.html leads nowhere", '<a href="deep/page.html#other">': "#other has no such anchor",
          '<a href="#bottom">': "#bottom has no such anchor", '<img src="lost.png"/>': "lost.png leads nowhere",
          '<link href="https://fonts.example/sans.css">': "is loaded from the network", '<script src="//cdn.example/x.js">': "is loaded from the network"}


def faults_of(text):
    with tempfile.TemporaryDirectory() as scratch:
        folder = pathlib.Path(scratch)
        (folder / "deep").mkdir()
        (folder / "index.html").write_text(text)
        (folder / "deep" / "index.html").write_text("")
        (folder / "deep" / "page.html").write_text('<a name="part"></a><a href="../index.html#top">')
        for name in ("picture.png", "code.js"):
            (folder / name).write_text("")
        return check(folder)[0]


expect(faults_of(SOUND) == [], f"a sound site has faults: {faults_of(SOUND)}")
for added, message in FAULTS.items():
    found = faults_of(SOUND + added)
    expect(len(found) == 1 and message in found[0], f"{added} gives {found}, not '{message}'")
finish()
