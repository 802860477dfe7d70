"""The sections of the parameter panel as one page of HTML: Calculated, Rules, Help, Where else, History,
Facts.
"""

from __future__ import annotations

import html
from collections.abc import Callable, Iterable, Iterator

from amp_studio.files import axis_letter, group_note, storage_text, value_note, with_days_and_times
from amp_studio.report import GRADES, facts, help_parts, severity_name, state_name, tables_of
from amp_studio.schema import (
    Address,
    Parameter,
    Value,
    isolated,
    labels_of_word,
    limits,
    real_value,
    same_value,
)
from amp_studio.ui.base.figures import range_in_words, show_value
from amp_studio.ui.base.hazard import hazard_html
from amp_studio.ui.base.places import finding_text
from amp_studio.ui.base.theme import colour, icon_html, severity_html
from amp_studio.ui.base.time_words import stored_in_words
from amp_studio.ui.base.translated import (
    Translated,
    control_message,
    facts_in_words,
    help_language,
    unit_in_words,
    worded,
)
from amp_studio.ui.base.workspace import Workspace
from amp_studio.ui.forms.pages import drawn, link
from amp_studio.validate import NOT_SET, Finding, calculators, family_of_rule, rule_title

USE, FOLD, DOWNLOAD, CALCULATE, MESSAGE = "use:", "fold:", "download:", "calculate:", "message:"
"""What a link begins with that is no parameter: take a calculated value, open a section, read the last
download, calculate, show a message of the control."""


_RULES = 4
"""Rules that are met and shown before the user asks for all."""
_CHANGES = 10
"""Saved changes that are shown before the user asks for all."""


def hex_text(word: int) -> str:
    """Return a word as the table has it beside the names of its bits."""
    return f"0x{word:X}" if word >= 0 else str(word)


class DetailPage(Translated):
    """Writes the page of one address; what it needs besides the file is set by the panel."""

    def __init__(self, workspace: Workspace) -> None:
        self._workspace = workspace
        self.others: Callable[[], Iterable[Workspace]] = tuple
        """The other open files."""
        self.opened: set[str] = set()
        """Sections that are unfolded."""
        self.last_download: tuple[str, Value | None] | None = None
        """When the last download was, and the value it had; None while it was not asked for."""
        self.may_have_download = False

    def write(self, address: Address) -> str:
        """Return the page of an address."""
        dim, line = colour("dim").name(), colour("line").name()
        parts = [self._value(address)]
        for title, text in self._sections(address):
            head = (
                f'<p style="color:{dim}; margin-top:4px; margin-bottom:3px"><b><small>{title}</small></b></p>'
            )
            rule = (
                '<p style="font-size:4px; margin:0">&nbsp;</p><table width="100%" cellspacing="0"'
                f' cellpadding="0"><tr><td style="background-color:{line};'
                ' font-size:1px">&nbsp;</td></tr></table>'
            )
            parts.append(f"{rule}{head}{text}")
        return (
            f"<html><style>a {{ color: {colour('sel').name()}; }} p {{ margin-top:0; margin-bottom:6px;"
            f" }}</style>{''.join(parts)}</html>"
        )

    def _sections(self, address: Address) -> Iterator[tuple[str, str]]:
        if notes := self._notes(address):
            yield self.tr("Notes"), notes
        if calculated := self._calculated(address):
            yield self.tr("Calculated"), calculated
        yield self._rules(address)
        yield " · ".join(filter(None, (self.tr("Help"), help_language()))), self._help(address)
        yield self.tr("Where else"), self._where_else(address)
        yield self.tr("History"), self._history(address)
        yield self._facts(address)

    # -- the value -------------------------------------------------------------

    def value_html(self, address: Address, value: Value | None, workspace: Workspace | None = None) -> str:
        """Return a value; one in units whose size another parameter sets with its length or angle:
        1000 BLU = 1 mm.
        """
        file = (workspace or self._workspace).file
        parameter = file.schema.parameters[address[0]]
        # The labels of the bits, and the number that the control's own screen shows.
        if parameter.bits and value is not None and isinstance(value.value, int) and not parameter.secret:
            return html.escape(f"{labels_of_word(parameter, value.value)} ({hex_text(value.value)})")
        text = (
            self.tr("not set")
            if value is None
            else show_value(parameter, value, secrets=self._workspace.secrets)
        )
        real = None if parameter.secret else real_value(file.evaluation, address, value)
        return html.escape(f"{text} = {show_value(parameter, real)}" if real else text)

    def _value(self, address: Address) -> str:
        file, lines = self._workspace.file, []
        if (used := self._workspace.effective().get(address)) is not None:
            lines.append(
                f"<b>{self.value_html(address, used)}</b>"
                f" <small>{self.tr('effective value in the control')}</small>"
            )
        if stored := storage_text(file, address):
            lines.append(f"{html.escape(stored)} <small>{self.tr('as stored in the control')}</small>")
        state = file.evaluation.state(address)
        if not state.is_active:
            page = self.tr(" (page {page})").format(page=state.page) if state.page else ""
            why = html.escape(worded(state.why, file.schema.family.family))
            lines.append(f"<i>{worded(state_name(state.state)).capitalize()}: {why}{page}.</i>")
        if allowed := self._allowed(address):
            lines.append(f"{self.tr('Allowed here:')} <b>{html.escape(allowed)}</b>")
        return f"<p>{'<br>'.join(lines)}</p>" if lines else ""

    def _allowed(self, address: Address) -> str:
        file = self._workspace.file
        if file.schema.parameters[address[0]].choices:
            return ""
        unit = self._workspace.typed_unit(address)
        found = limits(file.evaluation, address, unit)
        if found is None:
            return self.tr("no bounds printed, in {shown}").format(shown=unit_in_words(unit)) if unit else ""
        sources = [s for s in (found.low_from, found.high_from) if s]
        text = range_in_words(found) + "".join(
            self.tr(" (set by {name})").format(name=file.machine_schema.label(s)) for s in sources
        )
        return text + (
            self.tr(" — no range in degrees is printed; the metric numbers are used")
            if found.borrowed
            else ""
        )

    # -- sections --------------------------------------------------------------

    def findings(self, address: Address) -> list[Finding]:
        """Return what is wrong with an address."""
        # That it is not set is what the value itself shows.
        return [f for f in self._workspace.findings_of(address) if f.rule != NOT_SET]

    def _notes(self, address: Address) -> str:
        """Return what people noted about a value and about its group."""
        file = self._workspace.file
        group = file.schema.group_of[address[0]]
        found = (("", value_note(file, address)), (group.own_name, group_note(file, group.key)))
        return "".join(
            f"<p>{html.escape(isolated(text)).replace(chr(10), '<br>')}"
            f"{f' <small>{html.escape(about)}</small>' if about else ''}</p>"
            for about, text in found
            if text
        )

    def _calculated(self, address: Address) -> str:
        """Return the values that the suggested fixes give this parameter, and the way to its formulas."""
        file, lines = self._workspace.file, []
        for n, finding in enumerate(self.findings(address)):
            for setting in finding.fix:
                # A fix may change several values: here only what it gives this one.
                if setting.address == address:
                    use = f' <a href="{USE}{n}">{self.tr("Use")}</a>' if self._workspace.may_edit else ""
                    title = html.escape(
                        worded(rule_title(self._workspace.validator, finding), family_of_rule(finding.rule))
                    )
                    lines.append(
                        f"<p><b>{self.value_html(address, setting.value)}</b> <small>{title}</small>{use}</p>"
                    )
        if file.schema.parameters[address[0]].formulas:
            lines.append(f'<p><a href="{CALCULATE}">{self.tr("Calculate…")}</a></p>')
        return "".join(lines)

    def _finding_line(self, finding: Finding) -> str:
        source = html.escape(worded(finding.cited, family_of_rule(finding.rule)))
        cited = f' <span style="color:{colour("dim").name()}">{source}</span>' if source else ""
        if self._workspace.is_deferred(finding):
            mark = f"<b>{self.tr('As delivered:')}</b>"
        else:
            name = worded(severity_name(finding.severity)).capitalize()
            mark = f"{severity_html(finding.severity)} <b>{name}:</b>"
        return f"<p>{mark} {html.escape(finding_text(self._workspace.file, finding))}{cited}</p>"

    def _rules(self, address: Address) -> tuple[str, str]:
        """Return the title and the rules: those that are not met with what is wrong, then those that are,
        and those that nothing is known of.
        """
        workspace, lines = self._workspace, list[str]()
        dim = colour("dim").name()
        broken = self.findings(address)
        lines += map(self._finding_line, broken)
        rules = workspace.validator.rules_of(address)
        unmet = {finding.rule for finding in broken}
        is_set = workspace.file.get(address) is not None
        unknown = set() if is_set else workspace.validator.rules_without_values(address) - unmet
        others = sorted((r for r in rules if r.id not in unmet), key=lambda rule: rule.id in unknown)
        shown_rules = others if "rules" in self.opened or len(others) <= _RULES else others[:_RULES]
        for rule in shown_rules:
            page = (
                f'<span style="color:{dim}">{html.escape(worded(rule.cited, family_of_rule(rule.id)))}</span>'
            )
            title = html.escape(worded(rule.title, family_of_rule(rule.id)))
            mark = icon_html("circle-dashed", "dim") if rule.id in unknown else icon_html("check", "text")
            lines.append(f"<p>{mark} {title} {page}</p>")
        if len(shown_rules) < len(others):
            more = self.tr("{number} more").format(number=len(others) - len(shown_rules))
            lines.append(f'<p><a href="{FOLD}rules">{more}</a></p>')
        title = self.tr("Rules")
        if rules or broken:
            # A finding may be of a rule that reads other values: it counts too.
            number = len({r.id for r in rules} | unmet)
            text = self.tr("{unmet} of {number} not met") if unmet else self.tr("all {number} met")
            if unknown:
                text = text if unmet else self.tr("{met} met")
                text += f", {self.tr('{unknown} not checked without a value')}"
            met = number - len(unmet | unknown)
            title += f" &nbsp; {text.format(unmet=len(unmet), number=number, met=met, unknown=len(unknown))}"
        return title, "".join(lines) or f"<p>{self.tr('No rule uses this parameter.')}</p>"

    def _help(self, address: Address) -> str:
        """Return the help of a parameter with its hazards, and the messages about it."""
        schema = self._workspace.file.schema
        parameter = schema.parameters[address[0]]
        lines = []
        for title, text in help_parts(schema, parameter, facts_in_words(schema)):
            if title in GRADES:
                lines.append(hazard_html(GRADES[title], text))
                continue
            body = self._related(parameter) if title == "Related" else html.escape(text)
            lines.append(f"<p><b>{worded(title)}</b><br>{body}</p>")
        if messages := schema.messages_of(parameter.id):
            family = schema.family.family
            names = (
                f'<a href="{MESSAGE}{m.id}">{html.escape(control_message(m, family))}</a>' for m in messages
            )
            lines.append(f"<p><b>{self.tr('Messages of the control')}</b><br>{'<br>'.join(names)}</p>")
        if parameter.formulas:
            known = calculators(schema.family.family)
            words = facts_in_words(schema)
            titles = (
                f"{words.of_formula(known[f])}: {known[f].description.partition(chr(10))[0]}"
                for f in parameter.formulas
            )
            paragraphs = "</p><p>".join(map(html.escape, titles))
            lines.append(f"<p><b>{self.tr('Formulas')}</b></p><p>{paragraphs}</p>")
        lines += [drawn(table, facts_in_words(schema)) for table in tables_of(schema, parameter)]
        lines.append(
            f"<p><small>{html.escape(schema.family.title)},"
            f" {worded(f'page {schema.page(address)}')}</small></p>"
        )
        return "".join(lines)

    def _related(self, parameter: Parameter) -> str:
        schema = self._workspace.file.schema
        return ", ".join(link(schema, r) for r in parameter.help.related if r in schema.parameters)

    def _where_else(self, address: Address) -> str:
        """Return the value on disk, in the control, at the last download and in the other open files."""
        workspace, value = self._workspace, self._workspace.file.get(address)
        rows: list[tuple[str, Value | None]] = [(self.tr("Saved"), workspace.document.saved.get(address))]
        if workspace.control is not None:
            values, when = workspace.control
            rows.append(
                (
                    self.tr("In the control, {time}").format(time=with_days_and_times(when)),
                    values.get(address),
                )
            )
        if self.last_download is not None:
            rows.append(
                (self.tr("Last download, {time}").format(time=self.last_download[0]), self.last_download[1])
            )
        cells = [(name, self._compared(address, each, value)) for name, each in rows]
        # Behind a link: it is read from a file beside, and compared only for who asks.
        if self.may_have_download and self.last_download is None:
            cells.append((self.tr("Last download"), f'<a href="{DOWNLOAD}">{self.tr("Show")}</a>'))
        found = ((html.escape(other.path.stem), self._in_other(other, address)) for other in self.others())
        cells += [(name, text) for name, text in found if text]
        dim = colour("dim").name()
        return (
            "<table cellpadding=2>"
            + "".join(
                f'<tr><td style="color:{dim}">{name}&nbsp;&nbsp;</td><td>{text}</td></tr>'
                for name, text in cells
            )
            + "</table><p></p>"
        )

    def _compared(self, address: Address, found: Value | None, value: Value | None) -> str:
        text = self.value_html(address, found)
        return f"<b>{text}</b>" if not same_value(found, value) else text

    def _in_other(self, other: Workspace, address: Address) -> str:
        """Return the values of this parameter in another open file of the family,
        with the letters of its axes.
        """
        parameter = other.file.schema.parameters.get(address[0])
        if parameter is None or other.file.schema.family.family != self._workspace.file.schema.family.family:
            return ""
        found = [
            (a, v)
            # A few: a table of hundreds of points would fill the page.
            for a in other.file.machine_schema.instances(parameter)[:8]
            if (v := other.file.get((address[0], a)))
        ]
        texts = (
            f"{axis_letter(other.file, a) or a} {self.value_html((address[0], a), v, other)}".strip()
            for a, v in found
        )
        return ", ".join(texts)

    def _history(self, address: Address) -> str:
        entries = self._workspace.document.history(address)
        newest = entries if "history" in self.opened else entries[:_CHANGES]
        lines = [
            f"<p><small>{stored_in_words(entry.when)}, {html.escape(entry.who)},"
            f" {html.escape(entry.how)}</small><br>{html.escape(entry.old or self.tr('not set'))} →"
            f" {html.escape(entry.new or self.tr('not set'))}</p>"
            for entry in newest
        ]
        if len(newest) < len(entries):
            more = self.tr("{number} earlier").format(number=len(entries) - len(newest))
            lines.append(f'<p><a href="{FOLD}history">{more}</a></p>')
        label = html.escape(self._workspace.file.machine_schema.label(address))
        return "".join(lines) or f"<p>{self.tr('No saved changes of {name} yet.').format(name=label)}</p>"

    def _facts(self, address: Address) -> tuple[str, str]:
        schema, machine = self._workspace.file.schema, self._workspace.file.machine
        found = facts(schema, schema.parameters[address[0]], machine)
        is_open = "facts" in self.opened
        shade = colour("dim").name()
        arrow = icon_html("caret-down" if is_open else "caret-right", "dim")
        title = (
            f'<a href="{FOLD}facts" style="color:{shade};'
            f' text-decoration:none">{arrow} {self.tr("Facts")}</a>'
        )
        if not is_open:
            # Folded, with the two facts that decide how a change is made.
            brief = ", ".join(worded(text) for name, text in found if name in ("Takes effect", "Access"))
            return title, f'<p style="color:{shade}">{html.escape(brief)}</p>'
        rows = "".join(
            "<tr><td"
            f' style="color:{shade}">{html.escape(worded(k))}&nbsp;&nbsp;</td><td>{html.escape(v)}</td></tr>'
            for k, v in found
        )
        return title, f"<table cellpadding=2>{rows}</table>"
