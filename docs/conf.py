"""How Sphinx makes the site of these pages (``make docs``).

Nothing is loaded from the network, and it is read from file://.
"""

import re
from pathlib import Path

from pygments.lexers.special import TextLexer
from sphinx.application import Sphinx

project = "AMP Studio"
author = "AMP Studio contributors"
project_copyright = f"2026 {author}"
extensions = ["myst_parser"]
myst_heading_anchors = 4
# A block of commands or of a drawing has no language to be coloured in.
highlight_language = "none"

html_theme = "furo"
release = version = re.findall(
    r'__version__ = "(.*)"', (Path(__file__).parents[3] / "amp_studio/version.py").read_text()
)[0]
html_title = f"AMP Studio {release}"
html_static_path = ["_static"]
html_css_files = ["site.css"]
html_js_files = [("search.js", {"defer": "defer"})]
html_logo = html_favicon = "_static/logo.svg"
html_copy_source = False
html_use_index = False  # nothing is in it
html_show_sourcelink = False
# Browsers do not let a page of file:// read the other pages, of which the lines below a hit are made.
html_show_search_summary = False


def setup(app: Sphinx) -> None:
    """Let the blocks of bytes of the protocol pages be shown as they are."""
    app.add_lexer("frame", TextLexer)
    app.connect("build-finished", _search_numbers)


def _search_numbers(app: Sphinx, problem: Exception | None) -> None:
    """Let the search take words that are a number: they are in its index, but its script drops them."""
    if problem is None:
        script = Path(app.outdir) / "_static" / "searchtools.js"
        text = script.read_text(encoding="utf-8")
        condition = r" || queryTerm.match(/^\d+$/)"
        if condition not in text:
            raise ValueError(f"{script} leaves numbers out in another way than it did")
        script.write_text(text.replace(condition, ""), encoding="utf-8")
