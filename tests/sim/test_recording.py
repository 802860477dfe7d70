"""A recording that is gathered reading by reading, with a trigger, and laid over as what it is: single
readings."""

from pathlib import Path

import numpy as np
import pytest

from amp_studio.drawing import on_divisions, zoomed
from amp_studio.files import open_file
from amp_studio.sim import (
    LiveRecorder,
    SimulationError,
    laid_over,
    picture_of,
    read_recording,
    recording_picture,
    simulate,
    trigger_of,
    write_recording,
)

MILL = Path(__file__).parents[2] / "examples" / "mill-1394" / "MILL_1394.amp"
MOVE = {"move.distance": 50.0, "move.feedrate": 1000.0}
PERIOD = 0.2


def gathered(recorder: LiveRecorder, positions: list[float]) -> LiveRecorder:
    for n, position in enumerate(positions):
        recorder.add(PERIOD * n, {"position": (position, "mm"), "torque": (None, "%")})
    return recorder


def test_a_record_begins_its_pre_trigger_before_an_edge_and_ends_its_span_after_it() -> None:
    recorder = LiveRecorder(trigger_of("position>1", 0.4), 0.6)
    ramp = [5.0, 5.0, *[0.0] * 10, *np.arange(0.5, 6.0, 0.5).tolist()]  # above it at first: that is no edge
    gathered(recorder, ramp)
    assert (recorder.has_fired, recorder.is_done) == (True, True)
    recording = recorder.recording("live")
    # It fires at 1.5, two readings and the one before are kept, and four come after it.
    assert recording.signals["position"].tolist() == [0.0, 0.5, 1.0, 1.5, 2.0, 2.5, 3.0]
    assert recording.time[0] == 0.0
    assert recording.rate == pytest.approx(1.0 / PERIOD)


def test_a_level_fires_at_once_and_without_a_trigger_every_reading_stays() -> None:
    assert gathered(LiveRecorder(trigger_of("position>=1")), [5.0]).has_fired
    waiting = gathered(LiveRecorder(trigger_of("position<-1", 0.5)), [0.0] * 50)
    assert (waiting.has_fired, waiting.count) == (False, 4)
    free = gathered(LiveRecorder(None, 1.0), [0.0] * 50)
    assert (free.is_done, free.count) == (True, 6)


def test_a_signal_that_the_control_does_not_show_is_no_trigger() -> None:
    with pytest.raises(SimulationError, match="shows no torque for the trigger: it has position"):
        gathered(LiveRecorder(trigger_of("torque>1")), [0.0])
    with pytest.raises(SimulationError, match="0 readings are no recording"):
        LiveRecorder().recording("live")


def test_a_recording_is_read_as_it_was_written(tmp_path: Path) -> None:
    recording = gathered(LiveRecorder(), [0.1 * n for n in range(30)]).recording("live")
    write_recording(recording, tmp_path / "live.csv")
    found = read_recording(tmp_path / "live.csv")
    assert found.time.tolist() == recording.time.tolist()
    assert found.signals["position"].tolist() == recording.signals["position"].tolist()
    assert (found.units, list(found.signals)) == ({"position": "mm"}, ["position"])


def test_readings_five_times_a_second_are_compared_where_they_were_taken() -> None:
    """A line between two of them would be 0.3 mm off in each ramp, and the lag a part of their distance."""
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    recorder, late = LiveRecorder(), 0.6137
    for at in np.arange(0.0, 5.0, PERIOD).tolist():
        place = 7.0 + float(np.interp(at - late, trace.columns["time_s"], trace.columns["position"]))
        recorder.add(at, {"position": (place, "mm")})
    found = laid_over(trace, recorder.recording("live"))
    assert found.result["record_lag"][0] == pytest.approx(late, abs=1e-4)
    assert found.result["difference_rms_position"][0] == pytest.approx(7.0, abs=1e-3)
    assert found.result["difference_peak_position"][0] == pytest.approx(7.0, abs=5e-3)
    known = np.isfinite(found.columns["recorded_position"]).sum()
    assert known == int(trace.columns["time_s"][-1] / PERIOD)
    (recorded,) = [c for c in picture_of(found).panels[0].curves if c.name == "recorded position"]
    assert recorded.dots
    assert all(
        curve.dots for panel in recording_picture(recorder.recording("")).panels for curve in panel.curves
    )


def test_a_channel_on_divisions_keeps_its_scale_where_a_part_is_looked_at() -> None:
    trace = simulate(open_file(MILL).file, "step", "1", MOVE, advise=False)
    panel = on_divisions(picture_of(trace).panels[0], 5.0, 20.0)
    assert (panel.y.low, panel.y.high, panel.y.step) == (0.0, 40.0, 5.0)
    part = zoomed(panel, (0.1, 0.2))
    assert (part.y.low, part.y.high, part.x.low) == (0.0, 40.0, 0.1)


def test_a_record_that_waits_for_an_event_keeps_what_came_ahead_of_it() -> None:
    recorder = LiveRecorder(by_event=True, before=0.4)
    for n in range(10):
        recorder.add(0.2 * n, {"position": (float(n), "mm")})
    assert (recorder.has_fired, recorder.fired_after) == (False, None)
    recorder.fire(1.8)
    recorder.add(2.0, {"position": (10.0, "mm")})
    assert recorder.fired_after == pytest.approx(0.6)
    assert recorder.recording("X").signals["position"].tolist() == [6.0, 7.0, 8.0, 9.0, 10.0]
