"""The formats in which ``validate`` prints what it found: for a person, for programs,
and for the services that check a repository.

Each gives what is printed of one file, and one document of all files. What a single file needs is loaded
with the first one: a run that finds all its results kept needs none of it.
"""

from __future__ import annotations

import hashlib
import json
import os
import re
import textwrap
from collections.abc import Iterable, Iterator, Mapping, Sequence
from dataclasses import dataclass
from pathlib import Path
from textwrap import indent
from typing import TYPE_CHECKING, Any, NamedTuple
from urllib.parse import quote_from_bytes

from amp_studio.version import __version__

if TYPE_CHECKING:
    from amp_studio.guide import Present
    from amp_studio.schema import Address
    from amp_studio.validate import Finding, Suppressed, Validator

_SARIF_SCHEMA = "https://docs.oasis-open.org/sarif/sarif/v2.1.0/errata01/os/schemas/sarif-schema-2.1.0.json"
_SARIF_LEVELS = {"error": "error", "warning": "warning", "advice": "note"}
_GITHUB_COMMANDS = {"error": "error", "warning": "warning", "advice": "notice"}
_NOT_IN_XML = re.compile("[\x00-\x08\x0b\x0c\x0e-\x1f\ud800-\udfff\ufffe\uffff]")
"""Characters that XML 1.0 has no way to write."""


class CheckResult(NamedTuple):
    """The result of one file; passes from one process to another."""

    path: Path
    errors: int = 0
    printed: str = ""
    """What its format prints of it."""
    notes: tuple[str, ...] = ()
    """What a person should know of a control's own text."""
    fault: str = ""
    """Why the file cannot be checked."""
    line: int | None = None
    """Where it cannot be read."""


@dataclass(frozen=True)
class FileFindings:
    """A file with what was found in it."""

    path: Path
    validator: Validator
    present: Present
    """Its findings, and apart from them what is as delivered."""
    why: bool
    """Whether each finding is explained."""
    is_listed: bool = False
    """Whether other files are printed beside it, so that its name comes first."""
    motion: object = None
    """What the check of the motion found, where it was asked for: text, or a part of the JSON document."""

    @property
    def findings(self) -> tuple[Finding, ...]:
        """What was found in the file."""
        return self.present.findings

    @property
    def counts(self) -> dict[str, int]:
        """Severity -> number of findings."""
        from amp_studio.validate import SEVERITIES

        return {s: sum(f.severity == s for f in self.findings) for s in SEVERITIES}

    @property
    def summary(self) -> str:
        """The numbers of findings in words."""
        from amp_studio.report import counted

        text = ", ".join(counted(count, severity) for severity, count in self.counts.items())
        suppressed = len(self.validator.suppressed)
        return f"{self.path}: {text}" + (f", {suppressed} suppressed" if suppressed else "")

    def message(self, finding: Finding) -> str:
        """Return a finding in one line: what it is about, its page and its fix."""
        from amp_studio.report import finding_parts

        return ". ".join(part[:1].upper() + part[1:] for part in finding_parts(self.validator.file, finding))


class CheckFormat:
    """Lines for a person; nothing around them."""

    needs_all = False
    """Whether it prints once all files are checked."""
    alone = False
    """Whether a file that is no part of a list is printed as it is."""
    from_here = False
    """Whether paths are shortened to those from the present folder."""

    def one(self, checked: FileFindings) -> str:
        """Return what is printed of a file."""
        return "\n".join(self._lines(checked))

    def line_of(self, one: CheckResult) -> str:
        """Return what is printed as soon as a file is checked; that one cannot be is reported in any case."""
        return one.printed

    def all(self, results: Sequence[CheckResult]) -> str:
        """Return one document of all files; only a format that needs all has it."""
        raise NotImplementedError

    def in_ascii(self, document: str) -> str:
        """Return the same document without other letters, for a terminal without UTF-8."""
        return re.sub("[^\0-\x7f]", lambda found: json.dumps(found[0])[1:-1], document)

    def _lines(self, checked: FileFindings) -> Iterator[str]:
        """Yield what was found and the summary; of one file of several the summary, with its name, and what
        was found below it.
        """
        if not checked.is_listed:
            yield from self._finding_lines(checked)
            yield checked.summary
        else:
            yield checked.summary
            for text in self._finding_lines(checked):
                yield indent(text, "  ")
        if checked.motion:
            yield str(checked.motion)

    def _finding_lines(self, checked: FileFindings) -> Iterator[str]:
        """Yield the findings with their reasons where they are asked for, what is suppressed, what is as
        delivered.
        """
        from amp_studio.report import alike, delivered_text, same_finding_text, suppressed_text

        validator = checked.validator
        for same in alike(checked.findings):
            yield same_finding_text(validator.file, same)
            if checked.why:
                yield from _reasons(validator, same)
        for left in validator.suppressed:
            yield suppressed_text(validator.file, left)
        if state := delivered_text(checked.present.delivered, checked.present.steps):
            yield state


def _reasons(validator: Validator, same: Iterable[Finding]) -> Iterator[str]:
    from amp_studio.report import why_text
    from amp_studio.validate import explain

    return (why_text(validator.file, finding, explain(validator, finding)) for finding in same)


class _JsonFormat(CheckFormat):
    """One document: that of a file, or ``files``."""

    needs_all = True
    alone = True

    def one(self, checked: FileFindings) -> str:
        from amp_studio.report import finding_json

        file, counts = checked.validator.file, checked.counts
        return _dumped(
            {
                "file": str(checked.path),
                "errors": counts["error"],
                "warnings": counts["warning"],
                "advice": counts["advice"],
                "findings": [self._finding(checked, f) for f in checked.findings],
                "suppressed": [
                    finding_json(file, s.finding) | {"by": s.suppression.by, "reason": s.suppression.reason}
                    for s in checked.validator.suppressed
                ],
                "delivered": [self._finding(checked, f) for f in checked.present.delivered],
                **({} if checked.motion is None else {"motion": checked.motion}),
            }
        )

    def all(self, results: Sequence[CheckResult]) -> str:
        # As text: each file was written as JSON by the process that checked it.
        entries = [one.printed or _dumped({"file": str(one.path), "error": one.fault}) for one in results]
        return '{\n  "files": [\n' + ",\n".join(_indented(entry) for entry in entries) + "\n  ]\n}"

    def _finding(self, checked: FileFindings, finding: Finding) -> dict[str, Any]:
        """Return a finding of the JSON document, with its reasons where they are asked for."""
        from amp_studio.report import finding_json

        validator = checked.validator
        found = finding_json(validator.file, finding)
        if checked.why:
            from amp_studio.report import why_parts
            from amp_studio.validate import explain

            parts = why_parts(validator.file, finding, explain(validator, finding))
            found["why"] = [{"title": title, "text": text} for title, text, _ in parts]
        return found


class _SarifFormat(CheckFormat):
    """SARIF 2.1.0 (OASIS), which services for code scanning and editors read."""

    needs_all = True
    from_here = True

    def one(self, checked: FileFindings) -> str:
        validator = checked.validator
        lines = _Lines(checked)
        suppressed = [left.finding for left in validator.suppressed]
        rules: dict[str, Any] = {}
        for finding in (*checked.findings, *suppressed):
            rules.setdefault(finding.rule, _sarif_rule(validator, finding))
        results = [self._result(checked, lines, finding) for finding in checked.findings]
        results += [
            self._result(checked, lines, left.finding) | _sarif_suppression(left)
            for left in validator.suppressed
        ]
        return json.dumps({"rules": rules, "results": results}, ensure_ascii=False)

    def all(self, results: Sequence[CheckResult]) -> str:
        rules: dict[str, Any] = {}
        found: list[Any] = []
        for one in results:
            if not one.fault:
                part = json.loads(one.printed)
                # The first file that has a rule describes it: the order of the files decides, not which
                # process was ready.
                rules = part["rules"] | rules
                found += part["results"]
        unread = [one for one in results if one.fault]
        notices = [
            {
                "level": "error",
                "message": {"text": one.fault},
                "locations": [_sarif_place(one.path, one.line or 1)],
            }
            for one in unread
        ]
        driver = {
            "name": "AMP Studio",
            "version": __version__,
            "rules": [rules[key] for key in sorted(rules)],
        }
        run = {
            "tool": {"driver": driver},
            "invocations": [{"executionSuccessful": not unread, "toolExecutionNotifications": notices}],
            "results": found,
        }
        return _dumped({"$schema": _SARIF_SCHEMA, "version": "2.1.0", "runs": [run]})

    def _result(self, checked: FileFindings, lines: _Lines, finding: Finding) -> dict[str, Any]:
        """Return a finding as a result of SARIF, with the place of its first value."""
        from amp_studio.report import finding_json
        from amp_studio.schema import written

        file = checked.validator.file
        found = finding_json(file, finding)
        names = [
            {"name": name, "fullyQualifiedName": written(address)}
            for name, address in zip(found["params"], finding.addresses, strict=True)
        ]
        # Without the message: a service knows a finding again while the figures in it change.
        same = json.dumps([finding.rule, finding.instance, *map(written, finding.causes)])
        return {
            "ruleId": finding.rule,
            "level": _SARIF_LEVELS[finding.severity],
            "message": {"text": checked.message(finding)},
            "locations": [_sarif_place(checked.path, lines.of(finding)) | {"logicalLocations": names}],
            "partialFingerprints": {"finding/v1": hashlib.sha256(same.encode()).hexdigest()[:32]},
            "properties": {key: found[key] for key in ("params", "compared", "fix", "effective", "source")},
        }


def _sarif_rule(validator: Validator, finding: Finding) -> dict[str, Any]:
    """Return a rule as SARIF lists it once for all of its findings."""
    from amp_studio.validate import rule_title

    title = rule_title(validator, finding)
    is_cited = finding.cited and validator.check_of(finding)  # a range is on another page for each parameter
    source = f"{title} ({finding.cited})" if is_cited else title
    return {
        "id": finding.rule,
        "shortDescription": {"text": title},
        "fullDescription": {"text": source},
        "help": {"text": f"{source}. 'amp-studio validate --why' explains it."},
        "defaultConfiguration": {"level": _SARIF_LEVELS[finding.severity]},
    }


def _sarif_suppression(left: Suppressed) -> dict[str, Any]:
    why = f"{left.suppression.by}: {left.suppression.reason}"
    return {"suppressions": [{"kind": "external", "justification": why}]}


def _sarif_place(path: Path, line: int) -> dict[str, Any]:
    place = {"artifactLocation": {"uri": uri_of(path)}, "region": {"startLine": line}}
    return {"physicalLocation": place}


class _GithubFormat(CheckFormat):
    """Workflow commands of GitHub Actions, which shows them beside the changed lines."""

    from_here = True

    def line_of(self, one: CheckResult) -> str:
        if not one.fault:
            return one.printed
        return _github_command("error", one.path, one.line or 1, "not readable", one.fault)

    def _lines(self, checked: FileFindings) -> Iterator[str]:
        lines = _Lines(checked)
        for finding in checked.findings:
            command, message = _GITHUB_COMMANDS[finding.severity], checked.message(finding)
            yield _github_command(command, checked.path, lines.of(finding), finding.rule, message)
        yield _github_message(checked.summary)


def _github_command(command: str, path: Path, line: int, title: str, message: str) -> str:
    file = _github_value(_from_here(path).as_posix())
    return f"::{command} file={file},line={line},title={_github_value(title)}::{_github_message(message)}"


def _github_message(text: str) -> str:
    """Return the message of a workflow command."""
    # The per cent sign first: the other two are written with it.
    return text.replace("%", "%25").replace("\r", "%0D").replace("\n", "%0A")


def _github_value(text: str) -> str:
    """Return the value of a property of a workflow command."""
    return _github_message(text).replace(":", "%3A").replace(",", "%2C")


class _JunitFormat(CheckFormat):
    """JUnit's XML: a suite a file, a failed case an error;
    warnings and recommendations fail nothing and are its output.
    """

    needs_all = True

    def one(self, checked: FileFindings) -> str:
        return self._suite(checked.path, list(self._cases(checked)), super().one(checked))

    def _cases(self, checked: FileFindings) -> Iterator[tuple[str, str, str]]:
        """Yield name, kind and message of each case."""
        from amp_studio.report import suppressed_text

        file = checked.validator.file
        errors = [finding for finding in checked.findings if finding.severity == "error"]
        for finding in errors:
            yield _case_name(checked, finding), "failure", checked.message(finding)
        for left in checked.validator.suppressed:
            yield _case_name(checked, left.finding), "skipped", suppressed_text(file, left)
        if not errors:
            yield "no errors", "", ""

    def all(self, results: Sequence[CheckResult]) -> str:
        suites = [
            one.printed or self._suite(one.path, [("can be read", "error", one.fault)], "") for one in results
        ]
        return (
            '<?xml version="1.0" encoding="UTF-8"?>\n<testsuites>\n' + "\n".join(suites) + "\n</testsuites>"
        )

    def in_ascii(self, document: str) -> str:
        return document.encode("ascii", "xmlcharrefreplace").decode()

    def _suite(self, path: Path, cases: Sequence[tuple[str, str, str]], output: str) -> str:
        """Return the XML of one file: its cases (name, kind, message), and what else was printed."""
        from xml.etree import ElementTree as ET

        kinds = {kind: sum(case[1] == kind for case in cases) for kind in ("failure", "error", "skipped")}
        numbers = {"failures": kinds["failure"], "errors": kinds["error"], "skipped": kinds["skipped"]}
        counts = {name: str(number) for name, number in {"tests": len(cases), **numbers}.items()}
        suite = ET.Element("testsuite", {"name": _xml_text(str(path)), **counts})
        for name, kind, message in cases:
            case = ET.SubElement(
                suite, "testcase", {"classname": _xml_text(str(path)), "name": _xml_text(name)}
            )
            if kind:
                ET.SubElement(case, kind, {"message": _xml_text(message)})
        if output:
            ET.SubElement(suite, "system-out").text = _xml_text(output)
        return ET.tostring(suite, encoding="unicode")


def _case_name(checked: FileFindings, finding: Finding) -> str:
    from amp_studio.report import finding_json

    names = finding_json(checked.validator.file, finding)["params"]
    return f"{finding.rule} {', '.join(names)}".rstrip()


def _xml_text(text: str) -> str:
    """Return a text that XML can contain; other characters are written as JSON writes them."""
    return _NOT_IN_XML.sub(lambda found: json.dumps(found[0])[1:-1], text)


CHECK_FORMATS: Mapping[str, CheckFormat] = {
    "text": CheckFormat(),
    "json": _JsonFormat(),
    "sarif": _SarifFormat(),
    "github": _GithubFormat(),
    "junit": _JunitFormat(),
}


class _Lines:
    """The lines of a file in which its values are."""

    def __init__(self, checked: FileFindings) -> None:
        self._known: dict[Address, int] = {}
        if checked.findings or checked.validator.suppressed:
            from amp_studio.files import value_lines
            from amp_studio.formats import text_lines

            self._known = value_lines(checked.path) or text_lines(checked.path, checked.validator.file)

    def of(self, finding: Finding) -> int:
        """Return the line of the first value that a finding is about; 1 where none of them is in the file."""
        return next((self._known[a] for a in finding.addresses if a in self._known), 1)


def uri_of(path: Path) -> str:
    """Return the address of a file as SARIF names it:
    relative to the folder of the run where the file is below it.
    """
    inside = _from_here(path)
    if inside.is_absolute():
        return inside.as_uri()
    return quote_from_bytes(os.fsencode(inside.as_posix()), safe="/")


def _from_here(path: Path) -> Path:
    here = Path.cwd()
    return path.relative_to(here) if path.is_absolute() and path.is_relative_to(here) else path


def _dumped(data: Any) -> str:
    return json.dumps(data, ensure_ascii=False, indent=2)


def _indented(document: str) -> str:
    """Return a JSON document four columns to the right; its strings contain no line end."""
    return textwrap.indent(document, "    ")
