# SPDX-License-Identifier: BSL-1.0
"""check_links.py FOLDER: every link, anchor, picture, script and style of the HTML files in a folder leads to a file in it, and none of the
latter three comes from the network."""
import html.parser
import pathlib
import sys
import urllib.parse

BYTES = 15_500_000  # of a site
LISTED = 40  # faults of one kind are often in every page
LOADED = {("script", "src"), ("img", "src"), ("link", "href"), ("iframe", "src"), ("source", "src")}


class Page(html.parser.HTMLParser):
    """Anchors of a page and what it links, with whether a browser loads it by itself."""

    def __init__(self, text):
        super().__init__()
        self.anchors = set()
        self.links = set()
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        for name, value in attributes:
            if name == "id" or (tag, name) == ("a", "name"):
                self.anchors.add(value)
            elif value and ((tag, name) == ("a", "href") or (tag, name) in LOADED):
                self.links.add((value, tag != "a"))


def check(folder):
    """Faults of all pages as messages, the number of pages and of links."""
    pages = {path: Page(path.read_text(errors="replace")) for path in sorted(folder.rglob("*.html"))}
    faults = []
    links = 0
    for path, page in pages.items():
        for link, loaded in sorted(page.links):
            links += 1
            address = urllib.parse.urlsplit(link)
            where = path.relative_to(folder).as_posix()
            if address.scheme or address.netloc:  # javascript: and the like have no place
                if loaded and address.netloc:
                    faults.append(f"{where}: {link} is loaded from the network (the site must work without): keep a copy in the site")
                continue
            place = urllib.parse.unquote(address.path)
            file = (folder / place.lstrip("/") if place.startswith("/") else path.parent / place).resolve() if place else path
            if file.is_dir():
                file /= "index.html"
            if not file.exists():
                faults.append(f"{where}: {link} leads nowhere (no such file): correct the link")
            elif address.fragment and file in pages and urllib.parse.unquote(address.fragment) not in pages[file].anchors:
                faults.append(f"{where}: {link} has no such anchor in its page: correct the link")
    return faults, len(pages), links


if __name__ == "__main__":
    site = pathlib.Path(sys.argv[1]).resolve()
    problems, pages, links = check(site)
    size = sum(path.stat().st_size for path in site.rglob("*") if path.is_file())
    if pages == 0:
        problems.append(f"{site} has no page: build the site first")
    if size > BYTES:
        problems.append(f"the site has {size} bytes, more than {BYTES}: leave something out")
    print(f"{pages} pages, {links} links, {size / 1e6:.1f} MB, {len(problems)} faults")
    more = [f"and {len(problems) - LISTED} more"] if len(problems) > LISTED else []
    sys.exit("\n".join(problems[:LISTED] + more) or None)
