"""AcroMill on an ACR motion controller."""

from __future__ import annotations

from amp_studio.schema.registration import Registration

REGISTRATION = Registration(
    family="acromill",
    formulas="amp_studio.families.acromill.formulas:FORMULAS",
    formats=(
        "amp_studio.families.acromill.formats.acr_script:FORMAT",
        "amp_studio.families.acromill.formats.ballscrew:FORMAT",
    ),
    law="amp_studio.families.acromill.law:LAW",
)
