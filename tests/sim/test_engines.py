"""The laws of all families give the same numbers as plain Python and as machine code.

``make test`` compiles the samples of every law, and the kernel around those of one; ``make campaign`` the
kernel of each, five seconds apiece.
"""

from pathlib import Path
from random import Random
from typing import Any, cast

import numpy as np
import pytest

from amp_studio.files import open_file
from amp_studio.sim import law_of
from amp_studio.sim.axis.motion import RunEnd, run_axis
from amp_studio.sim.binding import bind_axis
from amp_studio.sim.command.ramps import move
from amp_studio.sim.engine.compiled import _machine_code
from amp_studio.sim.engine.signals import FEED_SHARE, MODE, MONITOR, POSITION_LOOP, STOP, VELOCITY_LOOP
from amp_studio.sim.law import AxisLaw, simulated_families
from tests.campaigns import CAMPAIGN

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


WHOLE = [path for path in EXAMPLES if CAMPAIGN or path.stem == "MILL_1394"]
"""One with a velocity loop of the law."""
ALONE = [path for path in EXAMPLES if CAMPAIGN or path.stem in ("MILL_1060", "ROUTER", "SYNTEC_MILL")]
"""The samples of the 9/PC are compiled within its whole move; those of three other laws have all that a law
does."""


def axis_of(path: Path) -> AxisLaw:
    file = open_file(path).file
    return bind_axis(file, law_of(file.schema.family.family), None, ROUGH)


@pytest.mark.parametrize("path", ALONE, ids=lambda path: path.stem)
def test_the_samples_of_a_law_agree_whatever_the_signals(path: Path) -> None:
    numba = pytest.importorskip("numba")
    axis, chance = axis_of(path), Random(path.stem)
    signature = numba.void(*[numba.float64[::1]] * 3)
    for sample in filter(None, (axis.position_sample, axis.velocity_sample)):
        fast = _machine_code(cast(Any, sample), {}, signature)
        plain = [[float(each) for each in axis.parameters], [0.0] * axis.state_size]
        arrays = [np.array(each) for each in plain]
        for n in range(200):
            signals = [chance.uniform(-2.0, 2.0) for _ in range(MONITOR + len(axis.monitors))]
            signals[FEED_SHARE], signals[STOP] = 1.0, 0.0
            signals[MODE] = VELOCITY_LOOP if n % 5 == 4 else POSITION_LOOP
            machine_signals = np.array(signals)
            sample(*plain, signals)
            fast(*arrays, machine_signals)
            np.testing.assert_allclose(machine_signals, signals, rtol=1e-9, atol=1e-12)
            np.testing.assert_allclose(arrays[1], plain[1], rtol=1e-9, atol=1e-12)


@pytest.mark.parametrize("path", WHOLE, ids=lambda path: path.stem)
def test_plain_python_and_machine_code_agree_for_a_whole_move(path: Path) -> None:
    axis = axis_of(path)
    assert axis.feedrate is not None
    profile = move(0.05 * axis.feedrate, 0.5 * axis.feedrate, next(iter(axis.ramps.values())), 1e-3)
    for mode in (POSITION_LOOP, VELOCITY_LOOP):
        runs = [
            run_axis(axis, profile, RunEnd(0.15), mode=mode, engine=engine)
            for engine in ("plain", "compiled")
        ]
        assert runs[0].stop == runs[1].stop
        for name, column in runs[0].columns.items():
            scale = 1e-9 * (1.0 + float(np.max(np.abs(column))))
            np.testing.assert_allclose(runs[1].columns[name], column, rtol=1e-9, atol=scale, err_msg=name)
