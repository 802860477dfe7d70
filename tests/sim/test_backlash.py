"""An axis with backlash alone: its contact is stiff and does not ring,
and what chatters in the gap is the loop.
"""

from pathlib import Path

import numpy as np

from amp_studio.files import ParameterFile, open_file
from amp_studio.sim import Machine, Trace, simulate
from amp_studio.sim.tuning.advice import CHATTER

EXAMPLES = Path(__file__).parents[2] / "examples"


def torque_at_rest(trace: Trace) -> float:
    """Return how far the torque swings in the last tenth of a run."""
    torque = trace.columns["torque"]
    return float(np.ptp(torque[-len(torque) // 10 :]))


def mill() -> ParameterFile:
    """Return the example mill."""
    return open_file(EXAMPLES / "mill-1394" / "MILL_1394.amp").file


def test_backlash_alone_adds_no_oscillation() -> None:
    # A contact of 150 Hz that rings (damping 0.05) made the torque swing through 266 %.
    trace = simulate(mill(), "step", "1", {"model.backlash": 0.02})
    assert torque_at_rest(trace) < 0.1
    assert trace.result["settle_time"][0] is not None
    assert trace.result["peak_torque"][0] < 25.0


def test_what_a_contact_is_taken_as_is_shown_and_can_be_set() -> None:
    short = {"move.duration": 0.05}
    trace = simulate(mill(), "step", "1", {"model.backlash": 0.02, **short}, advise=False)
    message = [
        text for text in trace.assumptions if text.startswith(("ASSUMED: model.res", "ASSUMED: model.damp"))
    ]
    assert [text.partition(". ")[0] for text in message] == [
        "ASSUMED: model.resonance = 150 Hz",
        "ASSUMED: model.damping = 1",
    ]
    given = {"model.backlash": 0.02, "model.resonance": 60, "model.damping": 0.3, **short}
    assert not [
        text
        for text in simulate(mill(), "step", "1", given, advise=False).assumptions
        if "model.damping" in text
    ]
    ringing = simulate(mill(), "step", "1", {"model.resonance": 60, **short}, advise=False)
    assert any(text.startswith("ASSUMED: model.damping = 0.05") for text in ringing.assumptions)


def test_a_damping_that_is_set_to_nothing_stays_nothing() -> None:
    assert Machine(1.0, backlash=0.1, damping=0.0).coupling == (150.0, 0.0, 1.0)
    assert Machine(1.0, backlash=0.1).coupling == (150.0, 1.0, 1.0)
    assert Machine(1.0, resonance=80.0, inertia_ratio=2.0).coupling == (80.0, 0.05, 2.0)


def test_a_loop_that_is_too_fast_for_the_motor_alone_chatters_and_is_named() -> None:
    # The lathe has 1 : 2: in the gap its loop is three times as fast, with 6.4 dB of gain margin.
    lathe = open_file(EXAMPLES / "lathe-ls176" / "LATHE_LS176.amp").file
    trace = simulate(lathe, "step", "1", {"model.backlash": 0.02})
    assert torque_at_rest(trace) > 10.0
    assert CHATTER in trace.assumptions
    short = {"move.duration": 0.05}
    assert CHATTER not in simulate(mill(), "step", "1", {"model.backlash": 0.02, **short}).assumptions
    assert CHATTER not in simulate(lathe, "step", "1", short).assumptions
