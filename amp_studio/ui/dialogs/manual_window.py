"""The manual of the program: its pages as the site has them, read beside the table and without a network."""

from __future__ import annotations

import re
from collections.abc import Iterator
from pathlib import Path
from typing import Any

from PySide6.QtCore import QSize, Qt, QUrl
from PySide6.QtGui import QDesktopServices, QImage, QShortcut
from PySide6.QtWidgets import QLineEdit, QSplitter, QTextBrowser, QTreeWidget, QTreeWidgetItem, QWidget

from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.screen_room import fit_to_screen
from amp_studio.ui.base.theme import GAP2, GAP3, ROW, scheme
from amp_studio.ui.forms.message_bar import MessageBar

TUTORIAL = "tutorial"
_PAGE = Qt.ItemDataRole.UserRole
_CONTENTS = re.compile(r"```\{toctree\}\n(.*?)```", re.DOTALL)
_COMMENT = re.compile(r"<!--.*?-->\s*", re.DOTALL)


def _manual_folder() -> Path:
    """Return where the pages are: inside the installed package, or at the top of the checkout."""
    package = Path(__file__).resolve().parents[2]
    inside = package / "docs"
    return inside if inside.is_dir() else package.parent / "docs"


def pages(folder: Path) -> Iterator[tuple[str, str]]:
    """Yield the head and the name (without ending) of each page that is there, in the order of the site."""
    for block in _CONTENTS.findall((folder / "index.md").read_text("utf-8")):
        options, _, names = block.partition("\n\n")
        head = options.partition(":caption: ")[2].partition("\n")[0]
        for name in names.split():
            yield from ((head, page) for page in _below(folder, name))


def _below(folder: Path, name: str) -> Iterator[str]:
    """Yield a page, or in the place of an ``index`` the pages that it lists."""
    path = folder / f"{name}.md"
    if not path.is_file():
        return
    if path.name != "index.md":
        yield name
        return
    for block in _CONTENTS.findall(path.read_text("utf-8")):
        for each in block.partition("\n\n")[2].split():
            found = (one for one in sorted(path.parent.glob(f"{each}.md")) if one != path)
            yield from (one.relative_to(folder).with_suffix("").as_posix() for one in found)


class ManualWindow(QWidget):
    """A list of the pages, those that have the words searched for, and the page that is read."""

    def __init__(self, parent: QWidget) -> None:
        super().__init__(parent, Qt.WindowType.Window)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self.setWindowTitle(self.tr("Manual"))
        fit_to_screen(self, 1040, 720)
        self.folder = _manual_folder()
        self.search = QLineEdit()
        self.search.setPlaceholderText(self.tr("Search the pages"))
        self.search.setAccessibleName(self.tr("Search the pages of the manual"))
        self.search.setClearButtonEnabled(True)
        self.list = QTreeWidget()
        self.list.setHeaderHidden(True)
        self.list.setAccessibleName(self.tr("Pages of the manual"))
        self.text = _Page()
        self.text.setAccessibleName(self.tr("Page of the manual"))
        self.bar = MessageBar()
        self._texts: dict[str, str] = {}
        self._fill()
        self._arrange()
        self.search.textChanged.connect(self._list_pages)
        self.search.returnPressed.connect(self.list.setFocus)
        self.list.currentItemChanged.connect(self._turn)
        self.text.anchorClicked.connect(self._follow)
        scheme().changed.connect(self.text.reload)
        QShortcut(Qt.Key.Key_Escape, self, self.close)

    def _fill(self) -> None:
        heads: dict[str, QTreeWidgetItem] = {}
        names = {"Learn": self.tr("Learn"), "Use": self.tr("Work With It"), "Look up": self.tr("Look Up")}
        for caption, name in pages(self.folder):
            if (head := names.get(caption)) is None:  # for those who work on the program
                continue
            self._texts[name] = text = (self.folder / f"{name}.md").read_text("utf-8")
            if head not in heads:
                heads[head] = QTreeWidgetItem(self.list, [head])
                heads[head].setFlags(Qt.ItemFlag.ItemIsEnabled)
            title = re.search(r"^# (.+)$", text, re.MULTILINE)
            item = QTreeWidgetItem(heads[head], [title[1].replace("`", "") if title else name])
            item.setData(0, _PAGE, name)
            item.setToolTip(0, item.text(0))
            item.setSizeHint(0, QSize(0, ROW))
        self.list.expandAll()

    def _arrange(self) -> None:
        side, middle = QWidget(), QSplitter()
        in_column(self.search, self.list, on=side, margins=(GAP2, GAP2, 0, GAP2))
        middle.addWidget(side)
        middle.addWidget(self.text)
        middle.setSizes([280, 760])
        middle.setStretchFactor(1, 1)
        in_column(self.bar, (middle, 1), on=self, margins=0, gap=0)

    def items(self) -> Iterator[QTreeWidgetItem]:
        """Yield the row of each page."""
        for n in range(self.list.topLevelItemCount()):
            head = self.list.topLevelItem(n)
            if head is not None:
                found = (head.child(k) for k in range(head.childCount()))
                yield from (item for item in found if item is not None)

    def show_page(self, name: str) -> None:
        """Turn to a page by its name."""
        self.search.clear()
        for item in self.items():
            if item.data(0, _PAGE) == name:
                self.list.setCurrentItem(item)

    def _list_pages(self, text: str) -> None:
        """List the pages that have every word; without one of them the list has its heads alone."""
        words = text.casefold().split()
        for item in self.items():
            content = f"{item.text(0)} {self._texts[item.data(0, _PAGE)]}".casefold()
            item.setHidden(not all(word in content for word in words))
        is_any = any(not item.isHidden() for item in self.items())
        if words and not is_any:
            self.bar.say(self.tr("No page has all of these words: leave one out."), "information")
        else:
            self.bar.hide()

    def _turn(self, item: QTreeWidgetItem | None) -> None:
        if item is not None and (name := item.data(0, _PAGE)):
            self.bar.hide()
            self.text.setSource(QUrl.fromLocalFile(str(self.folder / f"{name}.md")))

    def _follow(self, link: QUrl) -> None:
        """Follow a link to a page here, within the page, or out into the web."""
        if link.scheme() in ("http", "https", "mailto"):
            QDesktopServices.openUrl(link)
            return
        target = self.text.source().resolved(link)
        if not Path(target.toLocalFile()).is_file():
            self.bar.say(
                self.tr("This page is made for the site, and is not part of the program."), "information"
            )
            return
        self.text.setSource(target)
        if target.hasFragment():
            self.text.scrollToAnchor(target.fragment())


class _Page(QTextBrowser):
    """A page of Markdown, with pictures no wider than itself."""

    def __init__(self) -> None:
        super().__init__()
        self.setOpenLinks(False)
        self.setFrameShape(QTextBrowser.Shape.NoFrame)
        self.document().setDocumentMargin(GAP3)

    def loadResource(self, kind: int, name: QUrl | str) -> Any:
        name = QUrl(name)
        path = self.source().resolved(name).toLocalFile() if name.isRelative() else name.toLocalFile()
        if path.endswith(".md"):  # without the lists of contents and remarks of the site's generator
            text = Path(path).read_text("utf-8")
            return _COMMENT.sub("", _CONTENTS.sub("", text))
        if path.endswith(".png"):
            image, room = QImage(path), self.viewport().width() - 3 * GAP3
            if image.width() > room:
                return image.scaledToWidth(room, Qt.TransformationMode.SmoothTransformation)
            return image
        return super().loadResource(kind, name)
