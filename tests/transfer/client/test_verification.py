"""A result names no more than what is known of a control."""

from dataclasses import replace

import pytest

from amp_studio.families.grblhal.settings import addresses_by_number
from amp_studio.files import ParameterFile
from amp_studio.schema import Value, load_schema
from amp_studio.schema.values import read_value
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.client.verification import completed, verify_content
from amp_studio.transfer.content import HouseContent, kind_of
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


GRBL = b"""grblHAL settings 1
> $I
[VER:1.1h.20190830:]
> $$
$0=10
$11=0.010
$110=500.000
> $#
[G54:0.000,0.000,0.000]
> $N
$N0=
end 11
"""


def of_grbl(**settings: str) -> ParameterFile:
    file = kind_of(GRBL).decode(GRBL).copy()
    known = addresses_by_number(file.schema.on(file.machine))
    for name, text in settings.items():
        address = known[int(name[1:])]
        parameter = file.schema.parameters[address[0]]
        file.take({address: read_value(parameter, text, file.values[address].unit)})
    return file


def test_a_setting_that_the_control_does_not_have_is_a_difference() -> None:
    """All that it has is the same."""
    file = of_grbl(n110="500")
    assert verify_content(file, GRBL).is_same
    file.set(addresses_by_number(file.schema.on(file.machine))[131], Value(200.0, "mm"))
    found = verify_content(file, GRBL)
    assert (found.is_same, found.agrees) == (False, False)
    assert found.missing == "the control does not have $131"


def test_what_a_control_shows_coarser_is_no_difference_beside_one_that_is() -> None:
    finer = verify_content(of_grbl(n11="0.0104"), GRBL)
    assert (finer.is_same, finer.is_whole, finer.values.differences) == (True, False, ())
    both = verify_content(of_grbl(n11="0.0104", n110="700"), GRBL)
    assert not both.is_same
    assert [d.address for d in both.values.differences] == [("axis.max_rate", "X")]
    assert both.values.same == finer.values.same - 1
    compared = completed(kind_of(GRBL).decode(GRBL), GRBL, of_grbl(n11="0.0104", n110="700"))
    assert compared.values["general.junction_deviation", ""].value == 0.0104
    assert compared.values["axis.max_rate", "X"].value == 500
    card = kind_of(CARD)
    file = card.decode(CARD).copy()
    file.take({a: replace(v, value=v.value + 1e-9) for a, v in file.values.items() if a[1] == "X"})
    assert verify_content(file, CARD).is_same


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
