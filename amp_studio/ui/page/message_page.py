"""A message of the control beside the window: what it means, where to look, what helps,
and what this machine has there.
"""

from __future__ import annotations

from html import escape
from urllib.parse import quote, unquote

from PySide6.QtCore import Qt, QUrl
from PySide6.QtWidgets import QDialog, QTextBrowser, QWidget

from amp_studio.find import LinkedParameter, LinkedRule, MessagePage, message_page
from amp_studio.schema import Address, Schema
from amp_studio.ui.base.figures import unbroken
from amp_studio.ui.base.layout import in_column
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.theme import GAP3, colour, scheme
from amp_studio.ui.base.translated import control_message, scenario_in_words, worded

from .file_page import FilePage


class MessageWindow(QDialog):
    """Stays beside the table while one goes through its parameters; follows every edit."""

    def __init__(self, parent: QWidget, schema: Schema, message: str, page: FilePage | None = None) -> None:
        """Show a message of a family by its id; with a page its links lead into that file,
        and its values are shown.
        """
        super().__init__(parent)
        self.setAttribute(Qt.WidgetAttribute.WA_DeleteOnClose)
        self._page, self._schema, self._message = page, schema, schema.messages[message]
        self._name = control_message(self._message, schema.family.family)
        self.setWindowTitle(self._name)
        self.resize(420, 520)
        self.text = QTextBrowser()
        self.text.setAccessibleName(self.tr("Message of the control"))
        self.text.setOpenLinks(False)
        self.text.anchorClicked.connect(self._follow)
        self.text.document().setDocumentMargin(GAP3)
        in_column(self.text, on=self, margins=0)
        if page is not None:
            page.workspace.changed.connect(self._show)
            page.workspace.closed.connect(self.close)
        scheme().changed.connect(self._show)
        self._show()

    def _show(self, *_: object) -> None:
        if self._page is None:
            found = message_page(self._schema, self._schema.family.default_machine, self._message)
        else:
            workspace = self._page.workspace
            file = workspace.file
            found = message_page(file.schema, file.machine, self._message, file, workspace.findings)
        at = self.text.verticalScrollBar().value()
        self.text.setHtml(unbroken(self._html(found)))
        self.text.verticalScrollBar().setValue(at)

    def _html(self, page: MessagePage) -> str:
        """Return a message with its meaning, causes and cures, as the page shows it."""
        message, family = page.message, self._schema.family.family

        def own(text: str) -> str:
            return escape(worded(text, family))

        parts = [f"<p style='font-size:large; font-weight:600'>{escape(self._name)}</p>"]
        if self._page is None:
            parts.append(f"<p>{escape(self._schema.family.name)}</p>")
        if message.title and message.reaction != "symptom":
            parts.append(f"<p>{escape(self.tr('The manual does not print the text of this message.'))}</p>")
        parts.append(f"<p>{own(message.means)}</p>")
        parts += self._broken(page.broken)
        parts += self._listed(self.tr("How to find the cause"), [*map(own, message.causes)])
        parts += self._listed(self.tr("What helps"), [*map(own, message.cures)])
        parts += self._listed(self.tr("Scenarios that show it"), [*map(scenario_in_words, message.scenarios)])
        parts += self._listed(self.tr("Parameters to look at"), [*map(self._parameter, page.parameters)])
        rest = [own(linked.rule.title) for linked in page.rules if not linked.findings]
        title = self.tr("Rules that find it") if self._page is None else self.tr("Rules that are met here")
        parts += self._listed(title, rest)
        if message.note:
            parts.append(f"<p>{own(message.note)}</p>")
        pages = ", ".join(message.every_page)
        parts.append(f"<p>{escape(self.tr('Page {pages}').format(pages=pages))}</p>")
        return "".join(parts)

    def _broken(self, rules: tuple[LinkedRule, ...]) -> list[str]:
        if self._page is None:
            return []
        shade, file = colour("error").name(), self._page.workspace.file
        lines = [
            f"<span style='color:{shade}'>✕</span>"
            f" {self._link(finding.addresses[0], finding_text(file, finding))}"
            for linked in rules
            for finding in linked.findings
        ]
        return self._listed(self.tr("In this file"), lines)

    def _parameter(self, linked: LinkedParameter) -> str:
        name = f"{linked.number} {linked.name}".strip()
        if self._page is None:
            return escape(name)
        if not linked.values:
            return f"<a href='id:{quote(linked.id)}'>{escape(name)}</a>"
        file, cells = self._page.workspace.file, self._page.table.values
        values = ", ".join(
            f"{escape(v.place)} {self._link(v.address, cells.text(v.address, file.get(v.address)))}".lstrip()
            for v in linked.values
        )
        return f"{escape(name)}: {values}"

    @staticmethod
    def _link(address: Address, text: str) -> str:
        return f"<a href='at:{quote('@'.join(address))}'>{escape(text)}</a>"

    @staticmethod
    def _listed(title: str, lines: list[str]) -> list[str]:
        if not lines:
            return []
        items = "".join(f"<li>{line}</li>" for line in lines)
        return [
            (
                f"<p style='font-weight:600; margin-bottom:2px'>{escape(title)}</p><ul"
                f" style='margin-top:0'>{items}</ul>"
            )
        ]

    def _follow(self, link: QUrl) -> None:
        if self._page is None:
            return
        kind, _, target = unquote(link.toString()).partition(":")
        if kind == "id":
            self._page.follow(target)
        else:
            name, _, instance = target.partition("@")
            self._page.go_to((name, instance))
