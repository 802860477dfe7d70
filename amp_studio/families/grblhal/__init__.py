"""Grbl and grblHAL: controls that a text line sets, a setting at a time, and of which grblHAL describes itself."""

from __future__ import annotations

from amp_studio.schema.registration import Registration

REGISTRATION = Registration(
    family="grblhal",
    describe="amp_studio.families.grblhal.described:schema_of",
)
