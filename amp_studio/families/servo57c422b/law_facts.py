"""What the law takes from facts: ``parameter_db/57c422b/motion.yaml``."""

from __future__ import annotations

from amp_studio.schema import load_schema
from amp_studio.sim import ParameterRoles

MOTION = load_schema("57c422b").motion
ids = ParameterRoles(MOTION.params)
