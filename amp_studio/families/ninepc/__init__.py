"""The Allen-Bradley 9/PC CNC control."""

from __future__ import annotations

from amp_studio.schema import Registration

REGISTRATION = Registration(
    family="9pc",
    formulas="amp_studio.families.ninepc.formulas:FORMULAS",
    formats=("amp_studio.families.ninepc.formats.patch_sheet:FORMAT",),
    emulators={"house": "amp_studio.families.ninepc.emulated:emulate"},
    sheet="amp_studio.families.ninepc.sheet:KEYING",
    compensation="amp_studio.families.ninepc.compensation:COMPENSATION",
    curve="amp_studio.families.ninepc.curve:CURVE",
    law="amp_studio.families.ninepc.law:LAW",
)
