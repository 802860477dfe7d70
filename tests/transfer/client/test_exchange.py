"""Download, upload: what a person reads, and that nothing is replaced before it is kept."""

import hashlib
import threading
from collections.abc import Callable
from typing import Any

import pytest

from amp_studio.transfer.client.exchange import WantedContent, download, upload
from amp_studio.transfer.content import first_difference
from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.errors import (
    CancelledError,
    ConnectionCutError,
    ControlSilentError,
    ImageChangedError,
    KeepFailedError,
    NoConnectionError,
    NotInEmergencyStopError,
    SignatureMismatchError,
    TransferError,
)
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.house import download_transfer
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.house.message import Flags

OLD = b"1 old\n" * 20
NEW = b"2 new!\n" * 25


class Shelf:
    """Where old images are kept; remembers what the control contained at that moment."""

    def __init__(self, control: Any) -> None:
        self.control = control
        self.kept: list[bytes] = []

    def __call__(self, image: bytes) -> str:
        assert self.control.image == image, "nothing has been replaced yet"
        self.kept.append(image)
        return "machine.before.amp"


@pytest.fixture
def bench(rig: Callable[..., Any], new_control: Callable[..., Any]) -> Callable[..., Any]:
    """Give a function that sets up a session, its control and a shelf."""

    def make(
        faults: Faults | None = None, *, lines: int = 1_000_000, initial: bytes = OLD, **options: Any
    ) -> Any:
        made = rig(faults, control=new_control(initial=initial, **options), lines=lines)
        return made, made.session(), Shelf(made.control)

    return make


def test_a_download_is_kept_sent_restarted_and_read_back(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench()
    reported: list[str] = []
    outcome = download(
        HouseDriver(session),
        WantedContent(NEW, "s1"),
        shelf,
        Exchange(lambda stage, done, total: reported.append(stage)),
    )
    assert (outcome.at_control, outcome.verified, outcome.written, outcome.restart) == (
        "new",
        True,
        True,
        "done",
    )
    assert outcome.sha256 == hashlib.sha256(NEW).hexdigest()
    assert outcome.kept == "machine.before.amp"
    assert (
        outcome.text == "Download complete and read back equal; the control has restarted with it. "
        "What it contained before is kept in machine.before.amp."
    )
    assert shelf.kept == [OLD]
    assert made.control.image == NEW
    assert list(dict.fromkeys(reported)) == ["keep", "download", "commit", "restart", "verify"]


def test_without_autostart_a_user_must_restart_the_control(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench(autostart=False)
    outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
    assert (outcome.at_control, outcome.verified, outcome.restart) == ("new", True, "needed")
    assert "Restart the control to make it current" in outcome.text
    assert made.control.flags & Flags.RESTART_NEEDED
    again = download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
    assert (again.written, again.restart) == (False, "needed")
    assert "Restart the control" in again.text


def test_an_image_that_is_there_already_is_not_written(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench(estop=False)
    outcome = download(HouseDriver(session), WantedContent(OLD, "s1"), shelf)
    assert (outcome.at_control, outcome.verified, outcome.written, outcome.kept) == ("new", True, False, None)
    assert outcome.text == "The control contains exactly this image already; nothing was written."
    assert shelf.kept == []
    assert made.control.boot_count == 1


def test_a_control_without_an_image_has_nothing_to_keep(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench(initial=b"")
    outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
    assert (outcome.at_control, outcome.kept, shelf.kept) == ("new", None, [])
    assert outcome.text.endswith("It was empty before.")
    assert made.control.image == NEW


def test_out_of_estop_nothing_is_even_fetched(bench: Callable[..., Any]) -> None:
    _, session, shelf = bench(estop=False)
    with pytest.raises(
        NotInEmergencyStopError, match="place the control in E-stop to download; nothing was replaced"
    ):
        download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
    assert shelf.kept == []


def test_another_schema_is_refused_before_anything_moves(bench: Callable[..., Any]) -> None:
    _, session, shelf = bench()
    with pytest.raises(SignatureMismatchError, match=r"CNC_1.*another schema"):
        download(HouseDriver(session), WantedContent(NEW, "s2"), shelf)
    assert shelf.kept == []


def test_what_cannot_be_kept_is_not_replaced(bench: Callable[..., Any]) -> None:
    made, session, _ = bench()

    def full(image: bytes) -> str:
        raise OSError(28, "No space left on device")

    with pytest.raises(KeepFailedError, match=r"could not be kept.*No space left.*nothing was replaced"):
        download(HouseDriver(session), WantedContent(NEW, "s1"), full)
    assert made.control.image == OLD


def test_a_change_at_the_control_after_it_was_kept_is_not_overwritten(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench()

    def keep_and_patch(image: bytes) -> str:
        made.control.patch(lambda at_control: at_control + b"11 = 5\n")
        return shelf.kept.append(image) or "kept.amp"

    with pytest.raises(ImageChangedError) as caught:
        download(HouseDriver(session), WantedContent(NEW, "s1"), keep_and_patch)
    assert (caught.value.at_control, caught.value.kept) == ("old", "kept.amp")
    assert made.control.image == OLD + b"11 = 5\n"


def sha(image: bytes) -> bytes:
    return hashlib.sha256(image).digest()


def test_only_the_image_that_was_approved_is_replaced(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench()
    with pytest.raises(ImageChangedError, match="approved to be replaced") as caught:
        download(HouseDriver(session), WantedContent(NEW, "s1", expected=sha(b"seen")), shelf)
    assert f"(sha256 {sha(OLD).hex()[:12]}…, approved {sha(b'seen').hex()[:12]}…)" in str(caught.value)
    assert str(caught.value).endswith("nothing was replaced in the control")
    assert (made.control.image, shelf.kept) == (OLD, [])
    assert download(HouseDriver(session), WantedContent(NEW, "s1", expected=sha(OLD)), shelf).verified


def test_a_change_between_the_greeting_and_the_reading_is_noticed(bench: Callable[..., Any]) -> None:
    """What is kept is what was approved, or nothing is kept."""
    made, session, shelf = bench()
    greet = session.hello

    def greet_and_patch(*arguments: Any) -> Any:
        welcome = greet(*arguments)
        made.control.patch(lambda at_control: at_control + b"11 = 5\n")
        return welcome

    session.hello = greet_and_patch
    with pytest.raises(ImageChangedError, match="approved to be replaced"):
        download(HouseDriver(session), WantedContent(NEW, "s1", expected=sha(OLD)), shelf)
    assert (made.control.image, shelf.kept) == (OLD + b"11 = 5\n", [])


def test_what_is_there_already_must_still_be_what_was_approved(bench: Callable[..., Any]) -> None:
    _, session, shelf = bench(initial=NEW)
    with pytest.raises(ImageChangedError):
        download(HouseDriver(session), WantedContent(NEW, "s1", expected=sha(OLD)), shelf)
    assert not download(HouseDriver(session), WantedContent(NEW, "s1", expected=sha(NEW)), shelf).written


def test_what_a_control_has_kept_goes_back_under_no_signature(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench()
    download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
    outcome = download(HouseDriver(session), WantedContent(OLD, "", is_return=True), shelf)
    assert (outcome.at_control, outcome.verified, made.control.image) == ("new", True, OLD)
    with pytest.raises(SignatureMismatchError, match="has not contained this image; nothing was replaced"):
        download(HouseDriver(session), WantedContent(b"other", "", is_return=True), shelf)


def test_an_error_while_only_looking_does_not_say_what_was_replaced(bench: Callable[..., Any]) -> None:
    """A download before may have replaced something."""
    _, session, _ = bench(lines=0)
    with pytest.raises(NoConnectionError) as caught:
        upload(HouseDriver(session))
    assert caught.value.at_control == ""
    assert "replaced" not in str(caught.value)


def test_a_cut_that_leaves_the_end_unknown_names_the_kept_image(bench: Callable[..., Any]) -> None:
    made, session, shelf = bench()

    def pull_the_cable(stage: str, done: int, total: int) -> None:
        if stage == "commit" and done == 0:
            made.lines_left = 0
            session._line._transaction.link.close()

    with pytest.raises(ConnectionCutError) as caught:
        download(HouseDriver(session), WantedContent(NEW, "s1"), shelf, Exchange(pull_the_cable))
    assert caught.value.at_control == "unknown"
    assert "not known: verify before you go on" in str(caught.value)
    assert "kept in machine.before.amp" in str(caught.value)


def test_a_control_that_does_not_come_back_is_reported(bench: Callable[..., Any]) -> None:
    _, session, shelf = bench(lines=1)
    outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), shelf, restart_wait=5)
    assert (outcome.at_control, outcome.verified, outcome.restart) == ("new", False, "missed")
    assert "has not come back from its restart within 5 s" in outcome.text
    assert "kept in machine.before.amp" in outcome.text


def test_a_cancel_while_the_control_restarts_shows_that_the_new_image_is_there(
    bench: Callable[..., Any],
) -> None:
    made, session, shelf = bench()
    cancel = threading.Event()

    def while_restarting(stage: str, done: int, total: int) -> None:
        if stage == "restart":
            cancel.set()

    with pytest.raises(
        CancelledError, match=r"the control contains the new image.*kept in machine\.before\.amp"
    ) as caught:
        download(HouseDriver(session), WantedContent(NEW, "s1"), shelf, Exchange(while_restarting, cancel))
    assert caught.value.at_control == "new"
    assert made.control.image == NEW


def test_a_control_that_contains_something_else_after_the_commit_is_found_out(
    bench: Callable[..., Any],
) -> None:
    made, session, shelf = bench()

    def rot(stage: str, done: int, total: int) -> None:
        if stage == "restart" and (done, total) == (1, 1):
            made.control._activate(NEW[:50] + b"?" + NEW[51:])

    outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), shelf, Exchange(rot))
    assert (outcome.at_control, outcome.verified) == ("unknown", False)
    assert "differs from byte 50 on" in outcome.text
    assert "kept in machine.before.amp" in outcome.text


def test_a_download_is_all_or_nothing_wherever_the_line_is_cut(bench: Callable[..., Any]) -> None:
    """Cut at every seventh byte of the whole exchange, from the first Hello to the last byte read back."""
    cut_at, was_cut, first_hello_failed = 0, True, []
    while was_cut:
        made, session, shelf = bench(Faults(drop_after_bytes=cut_at))
        try:
            outcome = download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
        except (NoConnectionError, ControlSilentError):
            first_hello_failed.append(cut_at)
            assert made.control.image == OLD
        else:
            assert (outcome.at_control, outcome.verified, outcome.kept) == ("new", True, "machine.before.amp")
            assert made.control.image == NEW
            was_cut = made.modem.lines > 2
        made.control.close()
        cut_at += 7
    assert cut_at > 900
    assert first_hello_failed == list(range(0, first_hello_failed[-1] + 1, 7))
    assert first_hello_failed[-1] < 200, "once it has answered, no single cut ends the exchange"


def test_an_upload_is_the_exact_image(bench: Callable[..., Any]) -> None:
    _, session, _ = bench(estop=False)
    assert upload(HouseDriver(session)) == OLD


@pytest.mark.parametrize(
    ("a", "b", "at"),
    [(b"", b"", None), (b"a", b"", 0), (b"abc", b"abd", 2), (b"ab", b"abc", 2), (b"ab", b"ab", None)],
)
def test_where_two_images_first_differ(a: bytes, b: bytes, at: int | None) -> None:
    assert first_difference(a, b) == at


@pytest.mark.parametrize(
    "error", [MemoryError(), OSError(28, "No space left on device"), RuntimeError("odd")]
)
@pytest.mark.parametrize(("part", "at_control"), [("OpenDownload", "old"), ("Commit", "unknown")])
def test_whatever_breaks_a_download_off_is_reported_with_what_the_control_contains(
    bench: Callable[..., Any], monkeypatch: pytest.MonkeyPatch, error: Exception, part: str, at_control: str
) -> None:
    def breaks(*_: object) -> None:
        raise error

    monkeypatch.setattr(download_transfer, part, breaks)
    _, session, shelf = bench()
    with pytest.raises(TransferError) as caught:
        download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
    assert caught.value.at_control == at_control
    assert (str(error) or "MemoryError") in str(caught.value)


@pytest.mark.parametrize("error", [MemoryError(), OSError(24, "Too many open files")])
def test_whatever_ends_the_reading_back_is_reported_with_what_the_control_contains(
    bench: Callable[..., Any], monkeypatch: pytest.MonkeyPatch, error: Exception
) -> None:
    def breaks(*_: object) -> None:
        raise error

    _, session, shelf = bench()
    monkeypatch.setattr(session, "wait_restarted", breaks)
    with pytest.raises(TransferError, match=r"kept in machine\.before\.amp") as caught:
        download(HouseDriver(session), WantedContent(NEW, "s1"), shelf)
    assert caught.value.at_control == "new"
