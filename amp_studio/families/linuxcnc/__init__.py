"""LinuxCNC: a configuration file of sections and keys, which several programs read when the control
starts.
"""

from __future__ import annotations

from amp_studio.schema import Registration

REGISTRATION = Registration(
    family="linuxcnc",
    formulas="amp_studio.families.linuxcnc.formulas:FORMULAS",
    formats=("amp_studio.families.linuxcnc.formats.ini:FORMAT",),
    drivers={"configuration": "amp_studio.families.linuxcnc.control.driver:ConfigurationDriver.at"},
    contents={
        "LinuxCNC configuration 1": "amp_studio.families.linuxcnc.control.content:ConfigurationContent"
    },
    law="amp_studio.families.linuxcnc.law:LAW",
    compensation="amp_studio.families.linuxcnc.compensation:COMPENSATION",
    migrate="amp_studio.families.linuxcnc.migration:migrate",
)
