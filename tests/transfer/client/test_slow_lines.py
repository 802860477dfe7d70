"""A download over a slow line makes two passes: what the control contained, what it is to contain,
and a sample of the proof.
"""

from collections.abc import Callable
from typing import Any

import pytest

from amp_studio.transfer.client.exchange import Outcome, WantedContent, download
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.upload_transfer import SLOW

OLD = b"".join(b"%06d old\n" % n for n in range(2_400))
NEW = OLD.replace(b"000700 old", b"000700 new")
BAUD_9600 = 960.0
PASS = len(OLD) / BAUD_9600
"""Seconds that one image takes on the wire, without frames."""


def exchanged(made: Any, image: bytes = NEW) -> tuple[Outcome, float]:
    """Download an image and return what came of it, and the seconds on the clock of the line."""
    begun = made.clock.now
    outcome = download(HouseDriver(made.session()), WantedContent(image, "s1"), lambda _: "kept")
    return outcome, made.clock.now - begun


@pytest.fixture
def slow(rig: Callable[..., Any], new_control: Callable[..., Any]) -> Any:
    """Return a control with a large image behind a line of 9,600 baud."""
    return rig(control=new_control(initial=OLD), bytes_per_second=BAUD_9600, chunk=512, window=16)


def test_over_9600_baud_a_whole_download_makes_two_passes_and_not_three(slow) -> None:
    outcome, seconds = exchanged(slow)
    assert (outcome.at_control, outcome.verified, slow.control.image) == ("new", True, NEW)
    assert 2.0 * PASS < seconds < 2.35 * PASS


def test_what_was_not_read_is_shown(slow) -> None:
    outcome, _ = exchanged(slow)
    assert outcome.text.startswith(
        "Download complete: the control states the digest of the new image for what it contains, and 6 of 52"
        " pieces, chosen at random, were read back equal (a verification reads everything); the control"
        " has restarted with it."
    )


def test_a_line_on_which_everything_is_read_in_time_is_read_whole(rig, new_control) -> None:
    quick = rig(control=new_control(initial=OLD), bytes_per_second=len(OLD) / SLOW + 1, chunk=512, window=16)
    unknown = rig(control=new_control(initial=OLD), chunk=512, window=16)
    for made in (quick, unknown):
        assert exchanged(made)[0].text.startswith("Download complete and read back equal")


def test_a_control_that_contains_something_else_after_its_restart_is_read_whole_and_found_out(
    slow, monkeypatch
) -> None:
    restart = slow.control.restart

    def corrupted() -> None:
        slow.control._activate(NEW.replace(b"001500 old", b"001500 odd"))
        restart()

    monkeypatch.setattr(slow.control, "restart", corrupted)
    outcome, seconds = exchanged(slow)
    assert (outcome.at_control, outcome.verified) == ("unknown", False)
    assert "differs from byte" in outcome.text
    assert seconds > 2.9 * PASS


def test_pieces_that_are_not_what_the_stated_digest_promises_are_read_again_and_refused(
    slow, monkeypatch
) -> None:
    """The control repeats the digest it was sent, and contains something else everywhere."""
    restart = slow.control.restart

    def lies() -> None:
        digest = slow.control._digest
        slow.control._activate(b"x" * len(NEW))
        slow.control._digest = digest
        restart()

    monkeypatch.setattr(slow.control, "restart", lies)
    with pytest.raises(OSError, match="does not have the digest it states"):
        exchanged(slow)


def test_an_upload_and_a_verify_read_every_byte_of_a_slow_line(slow) -> None:
    driver = HouseDriver(slow.session())
    driver.identify()
    begun = slow.clock.now
    assert driver.fetch() == OLD
    assert slow.clock.now - begun > PASS
    assert driver.read_back == ""


def test_what_was_just_fetched_to_be_shown_is_not_fetched_again(slow) -> None:
    begun, kept = slow.clock.now, []
    outcome = download(
        HouseDriver(slow.session()),
        WantedContent(NEW, "s1", known=OLD),
        lambda old: kept.append(old) or "kept",
    )
    assert (outcome.verified, kept) == (True, [OLD])
    assert slow.clock.now - begun < 1.35 * PASS


def test_what_was_fetched_before_a_user_changed_the_control_is_fetched_again(slow) -> None:
    kept: list[bytes] = []
    download(
        HouseDriver(slow.session()),
        WantedContent(NEW, "s1", known=OLD[:-1]),
        lambda old: kept.append(old) or "kept",
    )
    assert kept == [OLD]
