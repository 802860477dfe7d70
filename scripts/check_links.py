"""Checks every link of the pages in a folder: its page or file must be there, and its anchor on that page.

What the search leads to is checked too. Only the folder is read: a link out of it by a path is broken, and
one into the network is not followed. A picture, script or style that a page would load from the network is an
error, because the site is read without one.
"""

import re
import sys
from html.parser import HTMLParser
from pathlib import Path
from urllib.parse import unquote, urlsplit

from reference_search import addresses

LOADED = {"img": "src", "script": "src", "link": "href", "iframe": "src"}
"""Tag -> its attribute that names what a browser loads by itself."""
_LOADED_BY_CSS = re.compile(r"""(?:url\(|@import)\s*["']?((?:https?:)?//[^"')\s;]+)""")
NAMING = {"canonical", "search", "next", "prev", "index"}
"""``link`` tags that only name a page."""


class Page(HTMLParser):
    """The anchors of a page, where its links lead, and what it loads."""

    def __init__(self, text: str) -> None:
        super().__init__()
        self.anchors: set[str] = set()
        self.twice: set[str] = set()
        """Anchors that are on the page more than once."""
        self.links: list[str] = []
        self.loaded: list[str] = []
        self.feed(text)

    def handle_starttag(self, tag: str, attrs: list[tuple[str, str | None]]) -> None:
        """Note what a tag is, leads to, or loads."""
        given = {name: value for name, value in attrs if value is not None}
        self.twice |= {given["id"]} & self.anchors if "id" in given else set()
        self.anchors |= {given[name] for name in ("id", "name") if name in given}
        if tag == "a" and "href" in given:
            self.links.append(given["href"])
        elif LOADED.get(tag, "") in given:
            self.links.append(given[LOADED[tag]])
            if tag != "link" or given.get("rel") not in NAMING:
                self.loaded.append(given[LOADED[tag]])


def faults(folder: Path) -> tuple[list[str], int, int]:
    """Return what is wrong with the links of a site, how many pages it has, and how many links were
    followed.
    """
    pages = {
        path.resolve(): Page(path.read_text(encoding="utf-8")) for path in sorted(folder.rglob("*.html"))
    }
    found, followed = [], 0
    for path, page in pages.items():
        here = path.relative_to(folder.resolve())
        found += [f"{here}: loads {address}" for address in page.loaded if _is_remote(address)]
        found += [f"{here}: the anchor {anchor} is there twice" for anchor in sorted(page.twice)]
        for address in page.links:
            if urlsplit(address).scheme or address.startswith("//"):
                continue
            followed += 1
            fault = _fault(address, path, pages, folder.resolve())
            found += [f"{here}: {fault}"] if fault else []
    for path in sorted(folder.rglob("*.css")):
        text = path.read_text(encoding="utf-8")
        found += [f"{path.relative_to(folder)}: loads {address}" for address in _LOADED_BY_CSS.findall(text)]
    entries = folder.resolve() / "_static/search-entries.js"
    if entries.is_file():
        for address in addresses(entries.read_text(encoding="utf-8")):
            followed += 1
            fault = _fault(address, folder.resolve() / "index.html", pages, folder.resolve())
            found += [f"search: {fault}"] if fault else []
    return list(dict.fromkeys(found)), len(pages), followed


def _is_remote(address: str) -> bool:
    return address.startswith("//") or urlsplit(address).scheme in ("http", "https")


def _fault(address: str, path: Path, pages: dict[Path, Page], folder: Path) -> str:
    """Return what is wrong with a link of a page; empty if it leads somewhere."""
    parts = urlsplit(address)
    target = (path.parent / unquote(parts.path)).resolve() if parts.path else path
    if not target.is_relative_to(folder):
        return f"{address} leads out of the site"
    if not target.is_file():
        return f"{address} is not there"
    anchor = unquote(parts.fragment)
    # An empty anchor is the top of the page.
    if anchor and target in pages and anchor not in pages[target].anchors:
        return f"{address} has no such anchor"
    return ""


def main() -> int:
    """Check the folder that is named, and print the faults."""
    found, pages, links = faults(Path(sys.argv[1]))
    print(*found, f"{pages} pages, {links} links, {len(found)} broken", sep="\n")
    return 1 if found or not pages else 0


if __name__ == "__main__":
    sys.exit(main())
