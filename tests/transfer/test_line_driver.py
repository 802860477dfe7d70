"""What every driver of single values does alike: of which family it is,
and what an error reports of the control.
"""

import threading

import pytest

from amp_studio.transfer.driver import ControlIdentity, Receipt
from amp_studio.transfer.errors import (
    CancelledError,
    Confirmed,
    ConnectionCutError,
    ImageRejectedError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.exchange import Exchange, Replacement
from amp_studio.transfer.line_driver import LineDriver
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import LinkError
from amp_studio.transfer.sent_values import SentValues

OLD, NEW = b"A=1 B=1 C=1", b"A=2 B=2 C=2"


class Register(LineDriver):
    """Three values in memory; the second one ends the download with ``fault``,
    before or after the control has it.
    """

    family, protocol = "small", "register"

    def __init__(self, fault: BaseException | None = None, *, is_taken: bool = False) -> None:
        super().__init__(lambda _: pytest.fail("nothing is connected"))
        self.values = self._names(OLD)
        self.fault, self.is_taken, self.is_gone = fault, is_taken, False

    def close(self) -> None:
        """Nothing is open."""

    def _identity(self) -> ControlIdentity:
        return ControlIdentity(self.family, self.protocol)

    def _names(self, content: bytes) -> dict[str, str]:
        return dict(word.split("=") for word in content.decode().split())

    def _fetched(self, stage: str) -> bytes:
        if self.is_gone:
            raise ConnectionCutError("gone")
        return " ".join(f"{name}={text}" for name, text in self.values.items()).encode()

    def _send(self, replacement: Replacement, sent: SentValues) -> Receipt:
        wanted = self._names(replacement.content)
        sent.total = len(wanted)
        for name, text in wanted.items():
            self._waiting.look()
            sent.begin(name)
            if name == "B" and self.fault is not None:
                self.values |= {name: text} if self.is_taken else {}
                raise self.fault
            self.values[name] = text
            sent.confirm(name)
        return Receipt()


def error_of(driver: Register, exchange: Exchange | None = None) -> TransferError:
    """Return the error of a download."""
    with pytest.raises(TransferError) as caught:
        driver.send(Replacement(NEW, OLD), exchange or Exchange())
    return caught.value


def test_a_driver_is_of_one_family_and_shows_it_before_it_connects() -> None:
    assert Register.abilities.all_or_nothing is False
    with pytest.raises(
        WrongFamilyError, match=r"^the protocol register is that of the family small, not of num$"
    ):
        Register.at(parse_endpoint("tcp://127.0.0.1:1"), "num")


def test_after_a_break_the_control_is_read_and_the_error_names_the_new_values() -> None:
    for is_taken, new in ((False, ("A",)), (True, ("A", "B"))):
        error = error_of(Register(ConnectionCutError("the line broke"), is_taken=is_taken))
        assert (error.at_control, error.new) == ("mixed", new)
        assert "1 of 3 values were confirmed, B was not answered" in str(error)


def test_a_value_that_is_refused_was_answered() -> None:
    error = error_of(Register(ImageRejectedError("B is too large")))
    assert str(error).startswith(
        "B is too large; 1 of 3 values were confirmed; the control contains the new A "
    )


def test_what_cannot_be_read_again_is_not_known() -> None:
    driver = Register(LinkError("register", "out of handles"))
    driver.is_gone = True
    error = error_of(driver)
    assert (error.at_control, error.what) == ("unknown", "the download broke off (register: out of handles)")


def test_what_a_driver_has_found_out_itself_is_not_asked_again() -> None:
    """A control that is gone after its answer leaves what it has answered known."""
    refusal = ImageRejectedError("B is too large", "mixed", new=("A",))
    refusal.confirmed = Confirmed(1, 3)
    driver = Register(refusal)
    driver.is_gone = True
    error = error_of(driver)
    assert (error.at_control, error.new) == ("mixed", ("A",))


def test_who_stops_is_reported_what_the_answers_prove_and_does_not_wait() -> None:
    driver, stop = Register(CancelledError("stopped")), threading.Event()
    driver.is_gone = True
    error = error_of(driver)
    assert (error.at_control, error.new) == ("unknown", ("A",)), "B is under way"
    stop.set()
    error = error_of(Register(), Exchange(cancel=stop))
    assert (error.at_control, error.confirmed, str(error)) == (
        "old",
        None,
        "stopped; nothing was replaced in the control",
    )


def test_a_control_that_answers_at_once_is_read_after_a_stop_too() -> None:
    class Quick(Register):
        is_read_when_stopped = True

    error = error_of(Quick(CancelledError("stopped")))
    assert (error.at_control, error.new) == ("mixed", ("A",))
