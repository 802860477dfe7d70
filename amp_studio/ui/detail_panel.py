"""The right side: help, range, state, rules and history of the selected parameter."""

from __future__ import annotations

import html

from PySide6.QtCore import QUrl, Signal
from PySide6.QtWidgets import QTabWidget, QTextBrowser, QVBoxLayout, QWidget

from amp_studio.report import facts, help_parts
from amp_studio.schema import Address, Schema, limits, read_address, show_value, written

from .theme import severity_ink
from .workspace import Workspace


class DetailPanel(QWidget):
    """Shows one address; links lead to other parameters."""

    linked = Signal(str)
    """A parameter id that was clicked."""

    def __init__(self, workspace: Workspace) -> None:
        super().__init__()
        self._workspace = workspace
        self._address: Address | None = None
        self.tabs = QTabWidget()
        self.pages = {name: QTextBrowser() for name in ("Help", "Facts", "Rules", "History")}
        for name, page in self.pages.items():
            page.setOpenLinks(False)
            page.anchorClicked.connect(self._follow)
            self.tabs.addTab(page, name)
        layout = QVBoxLayout(self)
        layout.setContentsMargins(0, 0, 0, 0)
        layout.addWidget(self.tabs)
        workspace.changed.connect(lambda _: self.show_address(self._address))
        workspace.saved.connect(lambda: self.show_address(self._address))

    def show_address(self, address: Address | None) -> None:
        """Show an address, or nothing."""
        self._address = address
        if address is None:
            for page in self.pages.values():
                page.clear()
            return
        self.pages["Help"].setHtml(self._help(address))
        self.pages["Facts"].setHtml(self._facts(address))
        self.pages["Rules"].setHtml(self._rules(address))
        self.pages["History"].setHtml(self._history(address))

    def _follow(self, url: QUrl) -> None:
        self.linked.emit(url.toString().removeprefix("param:"))

    # -- pages -----------------------------------------------------------------

    def _head(self, address: Address) -> str:
        file = self._workspace.file
        parameter = file.schema.parameters[address[0]]
        title = html.escape(file.schema.label(address, file.machine))
        place = html.escape(file.schema.instance_label(address, file.machine))
        value = html.escape(show_value(parameter, file.get(address)))
        default = file.default(address)
        told = f"default {html.escape(show_value(parameter, default))}" if default is not None else "no default printed"
        lines = [f"<h3>{title}</h3>", f"<p><b>{value}</b> &nbsp; <small>{place}, {told}</small></p>"]
        state = file.situation.state(address)
        if state.state != "in-force":
            page = f" (page {state.page})" if state.page else ""
            lines.append(f"<p><i>{state.state.capitalize()}: {html.escape(state.why)}{page}.</i></p>")
        allowed = self._allowed(address)
        if allowed:
            lines.append(f"<p>Allowed here: <b>{html.escape(allowed)}</b></p>")
        for finding in self._workspace.findings_of(address):
            if finding.rule != "schema.unset":
                colour = severity_ink(finding.severity).name()
                lines.append(f'<p style="color:{colour}">{html.escape(finding.message)}</p>')
        return "".join(lines)

    def _allowed(self, address: Address) -> str:
        file = self._workspace.file
        if file.schema.parameters[address[0]].choices:
            return ""
        found = limits(file.situation, address, file.situation.unit(address, file.header.units))
        if found is None:
            return ""
        sources = [s for s in (found.low_from, found.high_from) if s]
        text = found.text() + "".join(f" (set by {file.schema.label(s, file.machine)})" for s in sources)
        return text + (" — degrees are not printed; the metric figures are used" if found.borrowed else "")

    def _help(self, address: Address) -> str:
        schema = self._workspace.file.schema
        parameter = schema.parameters[address[0]]
        lines = [self._head(address)]
        for title, text in help_parts(schema, parameter):
            if title == "Related":
                text = ", ".join(_link(schema, r) for r in parameter.help.related if r in schema.parameters)
            else:
                text = html.escape(text)
            lines.append(f"<h4>{title}</h4><p>{text}</p>")
        lines.append(f"<p><small>{html.escape(schema.family.title)}, page {parameter.page}</small></p>")
        return "".join(lines)

    def _facts(self, address: Address) -> str:
        schema, machine = self._workspace.file.schema, self._workspace.file.machine
        rows = "".join(
            f"<tr><td><b>{html.escape(k)}</b>&nbsp;</td><td>{html.escape(v)}</td></tr>"
            for k, v in facts(schema, schema.parameters[address[0]], machine)
        )
        return f"{self._head(address)}<table cellpadding=2>{rows}</table>"

    def _rules(self, address: Address) -> str:
        schema = self._workspace.file.schema
        lines = [self._head(address)]
        broken = {f.rule for f in self._workspace.findings_of(address)}
        for rule in self._workspace.validator.rules_of(address):
            names = ", ".join(f"{n} = {_link(schema, read_address(t)[0])}" for n, t in rule.reads.items())
            mark = "✗" if rule.id in broken else "✓"
            when = f" where {html.escape(rule.when)}" if rule.when != "true" else ""
            lines.append(
                f"<p>{mark} <b>{html.escape(rule.title)}</b> <small>({rule.severity}, page {rule.page})</small><br>"
                f"<code>{html.escape(rule.check)}</code>{when}<br><small>{names}</small></p>"
            )
        if len(lines) == 1:
            lines.append("<p>No rule reads this parameter.</p>")
        return "".join(lines)

    def _history(self, address: Address) -> str:
        document = self._workspace.document
        file = document.file
        parameter = file.schema.parameters[address[0]]
        lines = [self._head(address)]
        on_disk = document.saved.get(address)
        if on_disk != file.get(address):
            lines.append(f"<p>Not saved yet; on disk: {html.escape(show_value(parameter, on_disk))}</p>")
        for entry in document.history(address):
            lines.append(
                f"<p><small>{entry.when[:16].replace('T', ' ')} {html.escape(entry.who)}, {html.escape(entry.how)}</small>"
                f"<br>{html.escape(entry.old or '—')} → {html.escape(entry.new or '—')}</p>"
            )
        if len(lines) == 1:
            lines.append(f"<p>No saved change of {html.escape(written(address))} yet.</p>")
        return "".join(lines)


def _link(schema: Schema, parameter_id: str) -> str:
    name = schema.parameters[parameter_id].name
    return f'<a href="param:{parameter_id}">{html.escape(name)}</a>'
