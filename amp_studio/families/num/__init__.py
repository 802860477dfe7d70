"""The NUM 1020, 1040 and 1060 CNC controls."""

from __future__ import annotations

from amp_studio.schema import Registration

REGISTRATION = Registration(
    family="num",
    formulas="amp_studio.families.num.formulas:FORMULAS",
    formats=("amp_studio.families.num.formats.table:FORMAT",),
    drivers={
        "peripheral": "amp_studio.families.num.lines.driver:PeripheralDriver.at",
        "peripheral-check": "amp_studio.families.num.lines.driver:CheckingPeripheralDriver.at",
    },
    contents={"NUM table 1": "amp_studio.families.num.lines.content:NumTableContent"},
    emulators={
        "house": "amp_studio.families.num.emulated.gateway:emulate",
        "peripheral": "amp_studio.families.num.emulated.control:emulate_peripheral",
    },
    sheet="amp_studio.families.num.sheet:KEYING",
    compensation="amp_studio.families.num.compensation:COMPENSATION",
    law="amp_studio.families.num.law:LAW",
)
