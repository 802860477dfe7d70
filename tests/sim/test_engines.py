"""The laws of all families give the same numbers as plain Python and as machine code."""

from __future__ import annotations

from pathlib import Path

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.sim import law_of
from amp_studio.sim.axis.motion import Until, run_axis
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine.signals import POSITION_LOOP, VELOCITY_LOOP
from amp_studio.sim.law import simulated_families

EXAMPLES = [
    path
    for path in sorted((Path(__file__).parents[2] / "examples").glob("*/*.amp"))
    if any(f"family: {family}\n" in path.read_text() for family in simulated_families())
]
ROUGH = {
    "model.coulomb_friction": 0.5,
    "model.static_friction": 0.8,
    "model.backlash": 0.01,
    "model.gravity": 0.2,
    "model.delay": 0.3,
}


@pytest.mark.parametrize("path", EXAMPLES, ids=lambda path: path.stem)
def test_plain_python_and_machine_code_agree_for_the_law_of_every_family(path: Path) -> None:
    file = open_file(path).file
    axis = bind_axis(file, law_of(file.schema.family.family), None, ROUGH)
    assert axis.feedrate is not None
    profile = move(0.05 * axis.feedrate, 0.5 * axis.feedrate, next(iter(axis.ramps.values())), 1e-3)
    for mode in (POSITION_LOOP, VELOCITY_LOOP):
        runs = [
            run_axis(axis, profile, Until(0.15), mode=mode, engine=engine) for engine in ("plain", "compiled")
        ]
        assert runs[0].stop == runs[1].stop
        for name, column in runs[0].columns.items():
            scale = 1e-9 * (1.0 + float(np.max(np.abs(column))))
            np.testing.assert_allclose(runs[1].columns[name], column, rtol=1e-9, atol=scale, err_msg=name)
