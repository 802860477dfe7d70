"""Figures of motion that manuals print, in the scenarios and formulas that a user calls."""

from __future__ import annotations

import pytest

from amp_studio.schema import Value
from amp_studio.sim import simulate
from amp_studio.validate import calculate
from tests.programs.test_block import example


@pytest.mark.parametrize(("cycle", "scans", "points"), [("1", "1", 800), ("4", "2", 1600), ("5", "3", 1334)])
def test_points_of_a_time_cam(cycle: str, scans: str, points: int) -> None:
    """57C422B, page 5-10: scans of 1.25 ms, at most 1915 words."""
    found = calculate("57c422b", "cam_points", {"cycle_s": cycle, "time_scans": scans})
    assert found == points


def test_both_printed_latencies_of_the_registration_are_shown() -> None:
    """57C422B: 25 µs on page 2-4, 50 µs on page A-2; at 100000 counts/min they are 1/24 and 1/12 of a count."""
    result = simulate(example("57c422b-label-press"), "probe", "X", {"move.speed": 100000.0}).result
    assert result["latency"] == (5e-5, "s")
    errors = [value for name, (value, _) in result.items() if name.startswith("probe_error_")]
    assert errors == pytest.approx([100000 / 60 * 25e-6, 100000 / 60 * 50e-6])


def test_a_homing_counts_its_grid_beyond_a_turn() -> None:
    """Syntec 2.2: with home grid on an index at 35 % is passed, and the next one is at 135 %."""
    assert calculate("syntec", "is_index_ignored", {"grid": "35", "enabled": "yes"}) is True
    assert calculate("syntec", "home_grid", {"turns": "1.35"}) == pytest.approx(135.0)


def test_a_limit_at_zero_has_no_sign() -> None:
    """grblHAL: without a pull-off the soft limit is at the switch, at 0."""
    file = example("grblhal-router")
    file.set(("homing.pull_off", ""), Value(0.0, "mm"))
    assert "soft limit, 0 mm" in simulate(file, "travel", "X", {}).alarms[0].message
