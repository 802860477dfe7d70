"""Grbl and grblHAL: controls that a text line sets, a setting at a time,
and of which grblHAL describes itself.
"""

from __future__ import annotations

from amp_studio.schema import Registration

REGISTRATION = Registration(
    family="grblhal",
    formulas="amp_studio.families.grblhal.formulas:FORMULAS",
    formats=("amp_studio.families.grblhal.formats.listing:FORMAT",),
    drivers={"grbl": "amp_studio.families.grblhal.driver:GrblDriver.at"},
    contents={"grblHAL settings 1": "amp_studio.families.grblhal.kind:GrblContentKind"},
    emulators={"grbl": "amp_studio.families.grblhal.emulated.control:emulate_grbl"},
    recognised="amp_studio.families.grblhal.line:RECOGNISED",
    compensation="amp_studio.families.grblhal.compensation:COMPENSATION",
    law="amp_studio.families.grblhal.law:LAW",
    migrate="amp_studio.families.grblhal.migration:migrate",
    describe="amp_studio.families.grblhal.described:schema_of",
)
