"""The rules that lie beside a parameter file."""

from __future__ import annotations

from pathlib import Path

from amp_studio.files import is_there, real_path
from amp_studio.schema import Schema

from .builder_rules import NO_RULES, RULES_FILE, BuilderRules


def rules_beside(path: Path, schema: Schema) -> BuilderRules:
    """Return the rules that lie beside a parameter file; none where there is no such file."""
    beside = real_path(path).parent / RULES_FILE
    if not is_there(beside):
        return NO_RULES
    from .rule_file import read_builder_rules  # most machines have none

    return read_builder_rules(beside, schema)
