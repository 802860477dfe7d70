"""Times are stored in UTC and shown as local time, to the minute."""

import time
from collections.abc import Iterator
from datetime import datetime, timedelta

import pytest

from amp_studio.files import ParameterFile
from amp_studio.files.times import day_and_time, local_time, with_local_times
from amp_studio.schema import Value, load_schema
from amp_studio.validate import Validator

pytestmark = pytest.mark.skipif(not hasattr(time, "tzset"), reason="this system cannot change its time zone")


@pytest.fixture(autouse=True)
def in_helsinki(monkeypatch: pytest.MonkeyPatch) -> Iterator[None]:
    """Be in a place two hours before UTC."""
    monkeypatch.setenv("TZ", "EET-2")
    time.tzset()
    yield
    monkeypatch.undo()
    time.tzset()


@pytest.mark.parametrize(
    ("stored", "displayed"),
    [
        ("2026-11-22T18:21:04+00:00", "2026-11-22 20:21"),
        ("2026-12-31T23:30:00+00:00", "2027-01-01 01:30"),
        ("", ""),
        ("some day", "some day"),
        ("9999-12-31T23:59:59+00:00", "9999-12-31T23:59:59+00:00"),
    ],
)
def test_a_stored_time_is_local_to_the_minute(stored: str, displayed: str) -> None:
    assert local_time(stored) == displayed


def test_only_times_of_a_text_are_changed() -> None:
    text = "by J. Fitter on 2026-07-01, again 2026-11-22T18:21:04+00:00 by 'set --force', 12:30"
    assert (
        with_local_times(text) == "by J. Fitter on 2026-07-01, again 2026-11-22 20:21 by 'set --force', 12:30"
    )


def test_the_finding_of_a_forced_value_shows_when_in_local_time() -> None:
    file = ParameterFile(load_schema("9pc"))
    file.set_checked(
        {("zone.group_count", ""): Value(9)}, force="on 2026-11-22T18:21:04+00:00 by 'set --force'"
    )
    (finding,) = [f for f in Validator(file).run() if f.rule == "schema.range"]
    assert finding.message.endswith("It was forced on 2026-11-22 20:21 by 'set --force'.")
    assert file.forced == {("zone.group_count", ""): "on 2026-11-22T18:21:04+00:00 by 'set --force'"}


def test_a_time_is_shown_as_a_user_shows_it() -> None:
    zone = datetime(2026, 11, 22, 15, 0).astimezone()
    message = [
        day_and_time(f"{stamp}", zone)
        for stamp in (
            zone.replace(hour=14, minute=35).isoformat(),
            (zone - timedelta(days=1)).isoformat(),
            (zone - timedelta(days=4)).isoformat(),
            (zone - timedelta(days=400)).isoformat(),
            "no time",
            "0001-01-01T00:00:00+00:00",
        )
    ]
    assert message[:5] == ["today 14:35", "yesterday 15:00", "18 Nov 15:00", "18 Oct 2025", "no time"]
    assert message[5]
