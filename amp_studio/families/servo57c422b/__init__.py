"""The Reliance 57C422B 2-axis servo module."""

from __future__ import annotations

from amp_studio.schema.registration import Registration

REGISTRATION = Registration(
    family="57c422b",
    law="amp_studio.families.servo57c422b.law:LAW",
    formulas="amp_studio.families.servo57c422b.formulas:FORMULAS",
    formats=(
        "amp_studio.families.servo57c422b.formats.automax:TASK",
        "amp_studio.families.servo57c422b.formats.automax:TABLE",
    ),
)
