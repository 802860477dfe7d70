"""Every way of speaking to a control is a driver: the endpoint or the family chooses it,
and the client knows no other.
"""

import hashlib
from collections.abc import Iterator
from functools import partial
from pathlib import Path
from typing import Any

import pytest

from amp_studio.cli.exit_codes import AT_CONTROL
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import family_ids, load_schema
from amp_studio.schema.registration import Registration, register, registration_of, unregister
from amp_studio.transfer.client.drivers import open_driver, protocols_of
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.client.kept import keep_image, open_copy
from amp_studio.transfer.content import HouseContent
from amp_studio.transfer.driver import Abilities, ControlIdentity, Receipt
from amp_studio.transfer.emulated.family_control import EmulatedOptions, emulate, emulators_of
from amp_studio.transfer.errors import (
    AtControl,
    CancelledError,
    ConnectionCutError,
    ImageChangedError,
    NotInEmergencyStopError,
    SignatureMismatchError,
    TransferError,
)
from amp_studio.transfer.exchange import Replacement
from amp_studio.transfer.house.driver import HouseDriver
from amp_studio.transfer.image import ImageError, decode_image, encode_image
from amp_studio.transfer.links.endpoint import Endpoint

OLD, NEW = b"1 old\n", b"1 new\n"


class Sheet(HouseContent):
    """A control as small as a driver can make it: it does not say what it contains before it is read."""

    def __init__(self, *, estop: bool | None = None, signature: str = "s1", **abilities: bool) -> None:
        self.abilities = Abilities(**abilities)
        self.content = OLD
        self.calls: list[str] = []
        self._who = ControlIdentity("sheet", "sheet", signature=signature, in_estop=estop)

    def identify(self, *_: Any) -> ControlIdentity:
        self.calls.append("identify")
        return self._who

    def fetch(self, *_: Any) -> bytes:
        self.calls.append("fetch")
        return self.content

    def send(self, replacement: Replacement, *_: Any) -> Receipt:
        self.calls.append("send")
        self.content = replacement.content
        return Receipt()

    def wait_restarted(self, *_: Any) -> bool:
        raise AssertionError("this control never restarts")

    def close(self) -> None:
        self.calls.append("close")


@pytest.fixture
def sheet_family() -> Iterator[None]:
    """A family with a separate protocol."""
    register(Registration("sheet", drivers={"sheet": "tests.not.loaded:FACTORY"}))
    yield
    unregister("sheet")


@pytest.mark.parametrize("family", family_ids())
def test_the_ways_that_the_facts_of_a_family_list_are_those_that_it_registers(family: str) -> None:
    ways = load_schema(family).family.ways
    own = registration_of(family)
    assert [each.protocol for each in ways if each.protocol] == list(own.drivers)
    assert [each.protocol or "house" for each in ways if each.way != "sheet"] == list(protocols_of(family))
    assert set(emulators_of(family)) <= set(protocols_of(family))
    assert sum(each.way == "sheet" for each in ways) == 1, "any control can be keyed in"


def test_a_gateway_is_spoken_to_in_the_house_protocol() -> None:
    assert isinstance(open_driver("tcp://127.0.0.1:7090", "num"), HouseDriver)
    assert isinstance(open_driver("tcp://127.0.0.1:7090?protocol=house"), HouseDriver)


def test_the_first_protocol_of_a_family_is_the_usual_one(sheet_family: None) -> None:
    assert list(protocols_of("sheet")) == ["sheet"], "no facts list a gateway"
    assert next(iter(protocols_of(""))) == "house"
    assert "sheet" in protocols_of("")
    with pytest.raises(ModuleNotFoundError):  # chosen, and loaded only now
        open_driver("tcp://127.0.0.1:7090", "sheet")


def test_an_unknown_protocol_is_refused_with_those_there_are(sheet_family: None) -> None:
    with pytest.raises(ValueError, match=r"^Unknown protocol 'dnc' of syntec\. Known: house$"):
        open_driver("tcp://127.0.0.1:7090?protocol=dnc", "syntec")
    with pytest.raises(ValueError, match=r"^Unknown protocol 'sheet' of num"):
        open_driver("tcp://127.0.0.1:7090?protocol=sheet", "num")


def test_a_download_over_any_driver_is_kept_sent_and_read_back() -> None:
    control, kept = Sheet(), []
    outcome = download(control, WantedContent(NEW, "s1"), lambda old: str(kept.append(old)))
    assert (outcome.at_control, outcome.verified, outcome.written, outcome.restart) == (
        "new",
        True,
        True,
        "needed",
    )
    assert (control.content, kept) == (NEW, [OLD])
    assert control.calls == ["identify", "fetch", "send", "fetch"]


def test_what_may_be_replaced_is_compared_with_what_was_read_where_the_control_states_no_digest() -> None:
    control = Sheet()
    seen = hashlib.sha256(b"seen").digest()
    with pytest.raises(ImageChangedError, match="than what was approved"):
        download(control, WantedContent(NEW, "s1", expected=seen), lambda _: "kept")
    assert control.content == OLD


def test_a_protocol_without_downloads_is_not_even_connected() -> None:
    control = Sheet(can_send=False)
    with pytest.raises(
        TransferError, match="nothing can be downloaded over this protocol; nothing was replaced"
    ):
        download(control, WantedContent(NEW, "s1"), lambda _: "kept")
    assert control.calls == []


def test_a_control_that_remembers_nothing_takes_back_only_what_its_schema_made() -> None:
    control = Sheet()
    with pytest.raises(SignatureMismatchError):
        download(control, WantedContent(NEW, "", is_return=True), lambda _: "kept")
    remembering = Sheet(remembers=True)
    assert download(remembering, WantedContent(NEW, "", is_return=True), lambda _: "kept").verified


def test_a_control_that_does_not_say_its_signature_takes_nothing() -> None:
    with pytest.raises(SignatureMismatchError, match="nothing was replaced"):
        download(Sheet(signature=""), WantedContent(NEW, "s1"), lambda _: "kept")


def test_only_a_control_that_shows_it_is_out_of_estop() -> None:
    with pytest.raises(NotInEmergencyStopError):
        download(Sheet(estop=False), WantedContent(NEW, "s1"), lambda _: "kept")
    assert download(Sheet(estop=None), WantedContent(NEW, "s1"), lambda _: "kept").verified


class Settings(Sheet):
    """A control that takes one setting a line, ``1=5``, by its number, and shows it with one decimal."""

    def __init__(
        self, current: bytes, *, breaks_after: int = 99, cut: type[TransferError] | None = None
    ) -> None:
        super().__init__(signature="another build", all_or_nothing=False, maps_numbers=True)
        self.content, self._left, self._cut = current, breaks_after, cut

    def encode(self, file: Any, current: bytes) -> bytes:
        """Put the lines of ``file``, bytes too here, over those that are there;
        a number that is not there is an error.
        """
        lines = dict(line.split(b"=") for line in current.splitlines())
        for number, value in (line.split(b"=") for line in file.splitlines()):
            if number not in lines:
                raise ImageError(f"the control does not have the setting {number.decode()}")
            lines[number] = value
        return b"".join(b"%s=%s\n" % line for line in lines.items())

    def difference(self, content: bytes, found: bytes) -> str:
        return "" if content == found else "in setting 1"

    def fetch(self, *_: Any) -> bytes:
        if self._cut is not None and "send" in self.calls:
            raise self._cut("gone")
        return super().fetch()

    def send(self, replacement: Replacement, *_: Any) -> Receipt:
        self.calls.append("send")
        self.content = replacement.current
        for line in replacement.content.splitlines():
            if line not in replacement.current.splitlines():
                if not self._left:
                    raise ConnectionCutError("the line broke", "mixed", new=("1",))
                self._left -= 1
                self.content = self.encode(line, self.content)
        return Receipt(restart_needed=False, notes=("Setting 1 is shown with one decimal.",))


def test_what_a_file_does_not_set_stays_as_the_control_has_it() -> None:
    control = Settings(b"1=5\n2=6\n")
    outcome = download(control, WantedContent(partial(control.encode, b"2=7\n"), "s1"), lambda _: "kept")
    assert control.content == b"1=5\n2=7\n"
    assert (
        outcome.text == "Download complete and read back equal. Setting 1 is shown with one decimal. "
        "What it contained before is kept in kept."
    )
    assert (outcome.verified, outcome.restart) == (True, "not needed")


def test_what_a_control_does_not_have_is_named_before_anything_is_kept_or_sent() -> None:
    control, kept = Settings(b"1=5\n2=6\n"), []
    with pytest.raises(ImageError, match="the control does not have the setting 9"):
        download(
            control,
            WantedContent(partial(control.encode, b"2=7\n9=1\n"), "s1"),
            lambda old: str(kept.append(old)),
        )
    assert (control.calls, kept) == (["identify", "fetch"], [])


def test_a_break_between_two_settings_shows_which_are_new() -> None:
    control = Settings(b"1=5\n2=6\n3=7\n", breaks_after=1)
    with pytest.raises(ConnectionCutError) as caught:
        download(control, WantedContent(partial(control.encode, b"1=8\n2=9\n"), "s1"), lambda _: "kept")
    assert (
        str(caught.value) == "the line broke; the control contains the new 1 and the old values of the rest "
        "(what it contained before is kept in kept)"
    )
    assert (caught.value.at_control, AT_CONTROL[caught.value.at_control]) == ("mixed", 3)


@pytest.mark.parametrize(("cut", "state"), [(ConnectionCutError, "unknown"), (CancelledError, "new")])
def test_without_a_commit_only_what_is_read_back_is_certain(
    cut: type[TransferError], state: AtControl
) -> None:
    control = Settings(b"1=5\n", cut=cut)
    with pytest.raises(cut) as caught:
        download(control, WantedContent(partial(control.encode, b"1=8\n"), "s1"), lambda _: "kept")
    assert (caught.value.at_control, caught.value.kept) == (state, "kept")


def test_settings_that_read_back_otherwise_are_some_new_and_some_not() -> None:
    control = Settings(b"1=5\n2=6\n")
    control.difference = lambda content, found: "in setting 2"
    outcome = download(control, WantedContent(partial(control.encode, b"1=8\n2=9\n"), "s1"), lambda _: "kept")
    assert (outcome.at_control, outcome.verified) == ("mixed", False)
    assert "what it contains differs in setting 2; the rest is as it was sent." in outcome.text


class Reversed(HouseContent):
    """A kind of content that is an image written backwards under a separate first line."""

    def decode(self, content: bytes) -> ParameterFile:
        return decode_image(content.removeprefix(b"REVERSED 1\n")[::-1])

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        return b"REVERSED 1\n" + encode_image(file)[::-1]


def test_a_kept_copy_is_read_by_its_first_line_whatever_protocol_it_came_over(tmp_path: Path) -> None:
    register(Registration("sheet", contents={"REVERSED 1": f"{__name__}:Reversed"}))
    try:
        file = new_file("57c422b")
        kept = keep_image(Reversed().encode(file, b""), tmp_path, "rack")
        copy = open_copy(kept)
        assert copy.file is not None
        assert (copy.file.values, copy.signature) == (file.values, file.schema.signature)
        beside = open_copy(kept.with_suffix(".amp"))
        assert (beside.image, beside.is_kept) == (kept.read_bytes(), True)
    finally:
        unregister("sheet")
    assert open_copy(kept).fault == "this is not a control image"


def test_an_emulated_control_is_chosen_by_the_protocol_of_the_address() -> None:
    register(Registration("sheet", emulators={"sheet": f"{__name__}:be_a_sheet"}))
    try:
        assert emulate("tcp://127.0.0.1:0?protocol=sheet", EmulatedOptions("sheet")) == 7
        assert emulate("pty:", EmulatedOptions("sheet")) == 7
        with pytest.raises(
            ValueError, match=r"no emulated control of sheet with the protocol 'dnc'\. Known: sheet"
        ):
            emulate("pty:?protocol=dnc", EmulatedOptions("sheet"))
    finally:
        unregister("sheet")


def be_a_sheet(listen: Endpoint, options: EmulatedOptions) -> int:
    return 7 if options.family == "sheet" and listen.kind in {"tcp", "pty"} else 0
