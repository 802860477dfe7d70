"""The Reliance 57C422B 2-axis servo module."""

from __future__ import annotations

from amp_studio.schema import Registration

REGISTRATION = Registration(
    family="57c422b",
    drivers={"registers": "amp_studio.families.servo57c422b.lines.driver:RegisterDriver.at"},
    contents={"57C422B registers 1": "amp_studio.families.servo57c422b.lines.content:RegisterContent"},
    emulators={"registers": "amp_studio.families.servo57c422b.emulated.rack:emulate_registers"},
    compensation="amp_studio.families.servo57c422b.compensation:COMPENSATION",
    law="amp_studio.families.servo57c422b.law:LAW",
    formulas="amp_studio.families.servo57c422b.formulas:FORMULAS",
    formats=(
        "amp_studio.families.servo57c422b.formats.automax:TASK",
        "amp_studio.families.servo57c422b.formats.automax:TABLE",
    ),
)
