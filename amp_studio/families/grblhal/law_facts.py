"""What the law takes from facts: ``parameter_db/grblhal/motion.yaml``."""

from __future__ import annotations

from amp_studio.schema import load_schema
from amp_studio.sim import ParameterRoles

MOTION = load_schema("grblhal").motion
ids = ParameterRoles(MOTION.params)
