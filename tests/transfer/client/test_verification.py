"""A result names no more than what is known of a control."""

from __future__ import annotations

import pytest

from amp_studio.files import ParameterFile
from amp_studio.schema import load_schema
from amp_studio.schema.values import read_value
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.client.verification import verify_content
from amp_studio.transfer.content import HouseContent
from amp_studio.transfer.driver import Abilities, ControlDriver, ControlIdentity, Receipt
from amp_studio.transfer.errors import AtControl, CancelledError, TransferError

CARD = b"ACR script 1\nREM units inch\nPPU X4096\nend 1\n"


def test_a_control_that_cannot_contain_a_file_is_not_the_same() -> None:
    file = ParameterFile(load_schema("acromill"))
    gain = file.schema.parameters["servo.p_gain"]
    file.take({("servo.p_gain", "X"): read_value(gain, "0.08", next(iter(file.schema.units_of(gain))))})
    found = verify_content(file, CARD)
    assert not found.is_same
    assert found.missing == "the card does not have PGAIN X, which the file sets"
    assert found.summary().startswith("The control cannot contain this file")


class Stopped(HouseContent):
    """A control that has taken a download; what ends the exchange comes while it is read back."""

    def __init__(self, receipt: Receipt, end: BaseException, *, all_or_nothing: bool = True) -> None:
        self.abilities = Abilities(all_or_nothing=all_or_nothing)
        self._receipt, self._end = receipt, end

    def identify(self, *_: object) -> ControlIdentity:
        return ControlIdentity("9pc", "test")

    def fetch(self, _exchange: object = None, stage: str = "upload") -> bytes:
        if stage == "verify":
            raise self._end
        return b"old"

    def send(self, *_: object, **__: object) -> Receipt:
        return self._receipt

    def wait_restarted(self, *_: object) -> bool:
        return True

    def close(self) -> None:
        """Nothing is open."""


@pytest.mark.parametrize(
    ("is_answered", "all_or_nothing", "end", "state"),
    [
        (False, True, KeyboardInterrupt(), "unknown"),
        (True, True, KeyboardInterrupt(), "new"),
        (False, False, CancelledError("stopped"), "unknown"),
        (True, False, CancelledError("stopped"), "new"),
        (False, True, MemoryError(), "unknown"),
    ],
)
def test_a_stop_behind_a_commit_that_was_not_answered_does_not_call_it_new(
    is_answered: bool, all_or_nothing: bool, end: BaseException, state: AtControl
) -> None:
    driver: ControlDriver = Stopped(Receipt(is_answered=is_answered), end, all_or_nothing=all_or_nothing)
    with pytest.raises(TransferError) as caught:
        download(driver, WantedContent(b"new", ""), lambda _: "kept")
    assert (caught.value.at_control, caught.value.kept) == (state, "kept")
