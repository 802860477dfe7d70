"""The right side: help, range, state, rules and history of the selected parameter."""

from __future__ import annotations

import html
from collections.abc import Callable

from PySide6.QtCore import Qt, QUrl, Signal
from PySide6.QtWidgets import QSplitter, QTabWidget, QTextBrowser, QVBoxLayout, QWidget

from amp_studio.files.local_time import local_time
from amp_studio.files.storage_text import storage_text
from amp_studio.report import facts, formula_lines, help_parts, tables_of
from amp_studio.report.wording import severity_name, state_name
from amp_studio.schema import (
    Address,
    Value,
    limits,
    read_address,
    real_value,
    same_value,
    show_value,
    shown,
    written,
)

from .pages import LINK, drawn, link
from .theme import severity_ink
from .word_panel import WordPanel
from .workspace import Workspace


class DetailPanel(QWidget):
    """Shows one address; links lead to other parameters. Only the visible page is filled."""

    linked = Signal(str)
    """A parameter id that was clicked."""

    def __init__(self, workspace: Workspace, commit: Callable[[Address, str], bool]) -> None:
        super().__init__()
        self._workspace = workspace
        self._address: Address | None = None
        self.tabs = QTabWidget()
        self.tabs.setDocumentMode(True)
        self._write = {
            "Help": self._help,
            "Facts": self._facts,
            "Rules": self._rules,
            "History": self._history,
        }
        self.pages = {name: QTextBrowser() for name in self._write}
        for name, page in self.pages.items():
            page.setOpenLinks(False)
            page.anchorClicked.connect(self._follow)
            self.tabs.addTab(page, name)
        self.tabs.currentChanged.connect(self._show)
        self.setFocusProxy(self.tabs)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        self.word = WordPanel(workspace, commit)
        split = QSplitter(Qt.Orientation.Vertical)
        split.setChildrenCollapsible(False)
        split.addWidget(self.word)
        split.addWidget(self.tabs)
        layout.addWidget(split)
        workspace.changed.connect(self._show)
        workspace.changed.connect(lambda _: self.word.refresh())
        workspace.saved.connect(self._show)

    def show_address(self, address: Address | None) -> None:
        """Show an address, or nothing."""
        self._address = address
        self.word.show_address(address)
        self._show()

    def _show(self, *_: object) -> None:
        name = self.tabs.tabText(self.tabs.currentIndex())
        page, address = self.pages[name], self._address
        if address is None:
            page.clear()
            return
        text = self._head(address) + self._write[name](address)
        if page.property("written") != text:  # a page that did not change stays where it was scrolled to
            page.setProperty("written", text)
            page.setHtml(text)

    def _follow(self, url: QUrl) -> None:
        self.linked.emit(url.toString().removeprefix(LINK))

    # -- the head of every page ------------------------------------------------

    def _head(self, address: Address) -> str:
        file = self._workspace.file
        title = html.escape(file.machine_schema.label(address))
        place = html.escape(file.machine_schema.instance_label(address))
        value = self._shown(address, file.get(address))
        default = file.default(address)
        default_text = (
            f"default {self._shown(address, default)}" if default is not None else "no default printed"
        )
        lines = [
            f"<h3>{title}</h3>",
            f"<p><b>{value}</b> &nbsp; <small>{', '.join(t for t in (place, default_text) if t)}</small>",
        ]
        if (used := self._workspace.effective().get(address)) is not None:
            lines.append(
                f"<br><b>{self._shown(address, used)}</b> <small>effective value in the control</small>"
            )
        if stored := storage_text(file, address):
            lines.append(f"<br>{html.escape(stored)} <small>as stored in the control</small>")
        lines += [f"<br>{line}" for line in self._elsewhere(address)]
        lines.append("</p>")
        state = file.evaluation.state(address)
        if not state.is_active:
            page = f" (page {state.page})" if state.page else ""
            lines.append(
                f"<p><i>{state_name(state.state).capitalize()}: {html.escape(state.why)}{page}.</i></p>"
            )
        allowed = self._allowed(address)
        if allowed:
            lines.append(f"<p>Allowed here: <b>{html.escape(allowed)}</b></p>")
        for finding in self._workspace.findings_of(address):
            if finding.rule != "schema.unset":
                colour = severity_ink(finding.severity).name()
                lines.append(f'<p style="color:{colour}">{html.escape(finding.message)}</p>')
        return "".join(lines)

    def _elsewhere(self, address: Address) -> list[str]:
        """Return the values on disk and in the control where they differ from the value shown."""
        workspace, value = self._workspace, self._workspace.file.get(address)
        found: list[tuple[str, Value | None]] = [("on disk", workspace.document.saved.get(address))]
        if workspace.control is not None:
            values, when = workspace.control
            found.append((f"in the control at {when}", values.get(address)))
        return [f"<b>{self._shown(address, v)}</b> <small>{where}</small>" for where, v in found
                if not same_value(v, value)]  # fmt: skip

    def _shown(self, address: Address, value: Value | None) -> str:
        """Return a value; one in units whose size another parameter sets with its length or angle: 1000 BLU = 1 mm."""
        file = self._workspace.file
        parameter = file.schema.parameters[address[0]]
        shown = show_value(parameter, value, secrets=self._workspace.secrets)
        real = None if parameter.secret else real_value(file.evaluation, address, value)
        return html.escape(f"{shown} = {show_value(parameter, real)}" if real else shown)

    def _allowed(self, address: Address) -> str:
        file = self._workspace.file
        if file.schema.parameters[address[0]].choices:
            return ""
        unit = self._workspace.typed_unit(address)
        found = limits(file.evaluation, address, unit)
        if found is None:
            return f"no bounds printed, in {shown(unit)}" if unit else ""
        sources = [s for s in (found.low_from, found.high_from) if s]
        text = found.text() + "".join(f" (set by {file.machine_schema.label(s)})" for s in sources)
        return text + (
            " — no range in degrees is printed; the metric numbers are used" if found.borrowed else ""
        )

    # -- pages -----------------------------------------------------------------

    def _help(self, address: Address) -> str:
        schema = self._workspace.file.schema
        parameter = schema.parameters[address[0]]
        lines = []
        for title, text in help_parts(schema, parameter):
            related = [link(schema, r) for r in parameter.help.related if r in schema.parameters]
            lines.append(
                f"<h4>{title}</h4><p>{', '.join(related) if title == 'Related' else html.escape(text)}</p>"
            )
        formulas = formula_lines(schema, parameter)
        if formulas:
            lines.append("<h4>Formulas</h4>" + "".join(f"<p>{html.escape(line)}</p>" for line in formulas))
        lines += [drawn(table) for table in tables_of(schema, parameter)]
        lines.append(f"<p><small>{html.escape(schema.family.title)}, page {schema.page(address)}</small></p>")
        return "".join(lines)

    def _facts(self, address: Address) -> str:
        schema, machine = self._workspace.file.schema, self._workspace.file.machine
        return "<table cellpadding=2>" + "".join(
            f"<tr><td><b>{html.escape(k)}</b>&nbsp;</td><td>{html.escape(v)}</td></tr>"
            for k, v in facts(schema, schema.parameters[address[0]], machine)
        ) + "</table>"  # fmt: skip

    def _rules(self, address: Address) -> str:
        schema = self._workspace.file.schema
        broken = {f.rule for f in self._workspace.findings_of(address)}
        lines = []
        for rule in self._workspace.validator.rules_of(address):
            names = ", ".join(f"{n} = {link(schema, read_address(t)[0])}" for n, t in rule.reads.items())
            mark = "✗" if rule.id in broken else "✓"
            cited = ", ".join(filter(None, (severity_name(rule.severity), html.escape(rule.cited))))
            when = f" where {html.escape(rule.when)}" if rule.when != "true" else ""
            lines.append(
                f"<p>{mark} <b>{html.escape(rule.title)}</b> <small>({cited})</small><br>"
                f"<code>{html.escape(rule.check)}</code>{when}<br><small>{names}</small></p>"
            )
        return "".join(lines) or "<p>No rule uses this parameter.</p>"

    def _history(self, address: Address) -> str:
        entries = self._workspace.document.history(address)
        lines = [
            f"<p><small>{local_time(entry.when)} {html.escape(entry.who)}, {html.escape(entry.how)}</small>"
            f"<br>{html.escape(entry.old or 'not set')} → {html.escape(entry.new or 'not set')}</p>"
            for entry in entries
        ]
        return "".join(lines) or f"<p>No saved changes of {html.escape(written(address))} yet.</p>"
