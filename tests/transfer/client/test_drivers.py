"""Every way of speaking to a control is a driver: the endpoint or the family chooses it, and the client knows no other."""

from __future__ import annotations

import hashlib
from collections.abc import Iterator
from typing import Any

import pytest

from amp_studio.schema.registration import Registration, register, unregister
from amp_studio.transfer.client.drivers import open_driver, protocols_of
from amp_studio.transfer.client.exchange import download
from amp_studio.transfer.driver import Abilities, ControlIdentity, Receipt
from amp_studio.transfer.errors import (
    ImageChangedError,
    NotInEmergencyStopError,
    SignatureMismatchError,
    TransferError,
)
from amp_studio.transfer.house.driver import HouseDriver

OLD, NEW = b"1 old\n", b"1 new\n"


class Sheet:
    """A control as small as a driver can make it: it does not say what it holds before it is read."""

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

    def send(self, image: bytes, **_: Any) -> Receipt:
        self.calls.append("send")
        self.content = image
        return Receipt()

    def wait_restarted(self, *_: Any) -> bool:
        raise AssertionError("this control never restarts")

    def close(self) -> None:
        self.calls.append("close")


@pytest.fixture
def sheet_family() -> Iterator[None]:
    """A family with a protocol of its own."""
    register(Registration("sheet", drivers={"sheet": "tests.not.loaded:FACTORY"}))
    yield
    unregister("sheet")


def test_a_family_without_drivers_is_spoken_to_in_the_house_protocol() -> None:
    assert isinstance(open_driver("tcp://127.0.0.1:7090", "num"), HouseDriver)
    assert isinstance(open_driver("tcp://127.0.0.1:7090?protocol=house"), HouseDriver)


def test_the_first_protocol_of_a_family_is_the_usual_one(sheet_family: None) -> None:
    assert list(protocols_of("sheet")) == ["sheet", "house"]
    assert list(protocols_of("")) == ["house", "sheet"]
    assert isinstance(open_driver("tcp://127.0.0.1:7090?protocol=house", "sheet"), HouseDriver)
    with pytest.raises(ModuleNotFoundError):  # chosen, and loaded only now
        open_driver("tcp://127.0.0.1:7090", "sheet")


def test_an_unknown_protocol_is_refused_with_those_there_are(sheet_family: None) -> None:
    with pytest.raises(ValueError, match=r"^Unknown protocol 'dnc' of num\. Known: house$"):
        open_driver("tcp://127.0.0.1:7090?protocol=dnc", "num")
    with pytest.raises(ValueError, match=r"^Unknown protocol 'sheet' of num"):
        open_driver("tcp://127.0.0.1:7090?protocol=sheet", "num")


def test_a_download_over_any_driver_is_kept_sent_and_read_back() -> None:
    control, kept = Sheet(), []
    outcome = download(control, NEW, lambda old: str(kept.append(old)), signature="s1")
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
        download(control, NEW, lambda _: "kept", signature="s1", expected=seen)
    assert control.content == OLD


def test_a_protocol_without_downloads_is_not_even_connected() -> None:
    control = Sheet(can_send=False)
    with pytest.raises(
        TransferError, match="nothing can be downloaded over this protocol; nothing was replaced"
    ):
        download(control, NEW, lambda _: "kept", signature="s1")
    assert control.calls == []


def test_a_control_that_remembers_nothing_takes_back_only_what_its_schema_made() -> None:
    control = Sheet()
    with pytest.raises(SignatureMismatchError):
        download(control, NEW, lambda _: "kept", signature="", is_return=True)
    remembering = Sheet(remembers=True)
    assert download(remembering, NEW, lambda _: "kept", signature="", is_return=True).verified


def test_a_control_that_does_not_say_its_signature_takes_nothing() -> None:
    with pytest.raises(SignatureMismatchError, match="nothing was replaced"):
        download(Sheet(signature=""), NEW, lambda _: "kept", signature="s1")


def test_only_a_control_that_says_so_is_out_of_estop() -> None:
    with pytest.raises(NotInEmergencyStopError):
        download(Sheet(estop=False), NEW, lambda _: "kept", signature="s1")
    assert download(Sheet(estop=None), NEW, lambda _: "kept", signature="s1").verified
