"""AcroMill on an ACR motion controller."""

from __future__ import annotations

from amp_studio.schema import Registration

REGISTRATION = Registration(
    family="acromill",
    formulas="amp_studio.families.acromill.formulas:FORMULAS",
    formats=(
        "amp_studio.families.acromill.formats.acr_script:FORMAT",
        "amp_studio.families.acromill.formats.ballscrew:FORMAT",
    ),
    drivers={
        "terminal": "amp_studio.families.acromill.lines.driver:TerminalDriver.at",
        "terminal-metric": "amp_studio.families.acromill.lines.driver:MetricTerminalDriver.at",
    },
    contents={"ACR script 1": "amp_studio.families.acromill.lines.content:AcrContent"},
    emulators={"terminal": "amp_studio.families.acromill.emulated.card:emulate_terminal"},
    compensation="amp_studio.families.acromill.compensation:COMPENSATION",
    law="amp_studio.families.acromill.law:LAW",
    curve="amp_studio.families.acromill.curve:CURVE",
)
