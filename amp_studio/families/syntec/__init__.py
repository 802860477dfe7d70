"""The Syntec CNC controls."""

from __future__ import annotations

from amp_studio.schema import Registration

REGISTRATION = Registration(
    family="syntec",
    formulas="amp_studio.families.syntec.formulas:FORMULAS",
    sheet="amp_studio.families.syntec.sheet:KEYING",
    law="amp_studio.families.syntec.law:LAW",
    compensation="amp_studio.families.syntec.compensation:COMPENSATION",
)
