"""The findings of a file, for tests that ask for those of one rule."""

from amp_studio.files import ParameterFile
from amp_studio.validate import Finding, Validator


def found(file: ParameterFile, rule: str) -> list[Finding]:
    """Return the findings of one rule in a file."""
    return [finding for finding in Validator(file).run() if finding.rule == rule]


def the(file: ParameterFile, rule: str) -> Finding:
    """Return the only finding of a rule."""
    (finding,) = found(file, rule)
    return finding
