"""The driver of live registers: what it reads, writes and never writes, the handshake,
and its state after a break.
"""

import re
import threading
from pathlib import Path
from typing import Any

import pytest

from amp_studio.families.servo57c422b.lines.content import (
    KIND,
    LIVE,
    RegisterContent,
    settings,
    words_of_content,
    written_content,
)
from amp_studio.families.servo57c422b.lines.register_line import framed, unframed
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value
from amp_studio.transfer.client.exchange import Outcome, WantedContent, download
from amp_studio.transfer.content import decode_content, kind_of
from amp_studio.transfer.errors import (
    CancelledError,
    Confirmed,
    ControlSilentError,
    ImageRejectedError,
    NotInEmergencyStopError,
    ProtocolMismatchError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import Link

from .bench import RackBench


@pytest.fixture
def bench(tmp_path: Path) -> RackBench:
    """Return a driver at a rack that has just been switched on."""
    return RackBench(tmp_path)


def gains(x: int = 17595, y: int = 4000) -> ParameterFile:
    """Return a file that sets a gain of each axis, and a mode that no download may write."""
    file = ParameterFile(new_file("57c422b").schema)
    for instance, value in (("X", x), ("Y", y)):
        file.set(file.find("R3" if instance == "X" else "R2051"), Value(value))
    file.set(file.find("R65"), Value(1))
    return file


def loaded(bench: RackBench, file: ParameterFile, **how: Any) -> Outcome:
    return download(
        bench.driver,
        WantedContent(lambda current: bench.driver.encode(file, current), file.schema.signature),
        lambda _: "kept",
        Exchange(**how),
    )


def test_the_rack_names_itself_and_the_version_in_99_to_103(bench: RackBench) -> None:
    control = bench.driver.identify()
    assert (control.family, control.protocol, control.revision) == ("57c422b", "registers", "EMULATED 1")


def test_a_download_writes_what_differs_and_both_axes_take_their_setups_over(bench: RackBench) -> None:
    outcome = loaded(bench, gains())
    assert (outcome.at_control, outcome.verified, outcome.restart) == ("new", True, "not needed")
    assert (bench.words[3], bench.words[2051]) == (17595, 4000)
    assert bench.rack.module.setups["X"][3] == 17595
    assert bench.rack.module.setups["Y"][3] == 4000
    assert "Axis X has taken its setups over" in outcome.text
    assert "lose it with the power of the rack" in outcome.text


def test_an_axis_without_a_change_is_given_no_command(bench: RackBench) -> None:
    loaded(bench, gains(y=0))
    assert set(bench.rack.module.setups) == {"X"}


def test_registers_that_start_motions_are_no_part_of_a_content_and_are_never_written(
    bench: RackBench,
) -> None:
    assert LIVE.isdisjoint(register % 2048 for register in settings())
    loaded(bench, gains())
    assert bench.words[65] == 0, "the file sets R65 to enable the loop"
    assert [bench.words[axis + register] for axis in (0, 2048) for register in (66, 67)] == [0] * 4


def test_nothing_is_written_while_a_control_loop_is_on(bench: RackBench) -> None:
    bench.rack.operate("patch R2113=1")
    before = list(bench.words)
    with pytest.raises(NotInEmergencyStopError, match=r"axis Y is on \(R2113, bit 0\)"):
        loaded(bench, gains())
    assert bench.words == before


@pytest.mark.parametrize("automatic", [0, 1])
def test_the_handshake_ends_with_clear_command_registers_whoever_clears_them(
    bench: RackBench, automatic: int
) -> None:
    """Pages 4-22 and 4-36: the application clears the command, or register 63 has the module do it."""
    bench.rack.operate(f"patch R63={automatic}")
    file = gains(y=0)
    file.set(file.find("R63"), Value(automatic))
    assert loaded(bench, file).verified
    assert (bench.words[66], bench.words[72] >> 15) == (0, 0)


def test_a_module_that_does_not_acknowledge_is_reported_with_what_it_contains(bench: RackBench) -> None:
    bench.rack.module._execute = lambda axis: None
    with pytest.raises(
        ControlSilentError, match=r"axis X does not acknowledge the command \(R72, bit 15\)"
    ) as caught:
        loaded(bench, gains())
    assert caught.value.at_control == "new"
    assert bench.words[66] == 0, "no command is left behind"


def test_a_command_that_is_there_already_is_not_written_over(bench: RackBench) -> None:
    bench.words[66] = 1 << 6
    with pytest.raises(ProtocolMismatchError, match="a command is in R66 or R67 already"):
        loaded(bench, gains())
    assert bench.words[66] == 1 << 6


def test_a_fault_that_the_setups_bring_is_an_error_with_its_bits(bench: RackBench) -> None:
    take = bench.rack.module._take_setups
    bench.rack.module._take_setups = lambda axis: (take(axis), bench.rack.module._set(axis + 73, 1 << 8))
    with pytest.raises(ImageRejectedError, match=r"axis X shows a fault for its setups \(R73, b8\)"):
        loaded(bench, gains())


def test_a_register_that_does_not_take_a_number_is_named(bench: RackBench) -> None:
    write = bench.rack.module.write
    bench.rack.module.write = lambda register, word: None if register == 2051 else write(register, word)
    with pytest.raises(
        ImageRejectedError, match="register 2051 contains 0 after 4000 was written to it"
    ) as caught:
        loaded(bench, gains())
    assert (caught.value.at_control, caught.value.new) == ("mixed", ("R3",))
    assert caught.value.confirmed == Confirmed(1, 2)


@pytest.mark.parametrize("answered", [0, 17595])
@pytest.mark.parametrize("lost", [0, 2, 3])
def test_a_register_is_read_whatever_its_writing_was_answered_with(
    bench: RackBench, answered: int, lost: int
) -> None:
    """A mutant that compared the answer alone survived: the rack may repeat what it was sent."""
    answer, left = bench.rack._answer, [lost]

    def answered_so(found: re.Match[bytes]) -> str:
        if found[5] is None or int(found[5]) != 3:
            return answer(found)
        if left[0]:
            left[0] -= 1
        else:
            bench.words[3] = int(found[6])
        return f"W 3 {answered}"

    bench.rack._answer = answered_so
    if lost < 3:
        assert loaded(bench, gains(y=0)).verified
        return
    with pytest.raises(ImageRejectedError, match="register 3 contains 0 after 17595 was written") as caught:
        loaded(bench, gains(y=0))
    assert caught.value.at_control == "old"


def test_a_late_answer_of_an_earlier_request_is_not_taken_for_this_one(bench: RackBench) -> None:
    class Late:
        bytes_per_second = None

        def __init__(self, link: Link) -> None:
            self._link, self._late = link, b""
            self.write, self.close = link.write, link.close

        def read(self, timeout: float) -> bytes:
            """Return what has come before once more, and then what is new."""
            late, self._late = self._late, self._link.read(timeout)
            return late + self._late

    bench.wrap = Late
    assert loaded(bench, gains()).verified


def test_registers_that_differ_are_named_either_way(bench: RackBench) -> None:
    content = bench.driver.fetch()
    words = words_of_content(content)
    names = [f"R{register}" for register in settings()]
    assert bench.driver.difference(content, content) == ""
    for count, more in ((5, ""), (7, " and 2 more")):
        other = written_content(words | {register: words[register] + 1 for register in settings()[:count]})
        for one, two in ((content, other), (other, content)):
            assert bench.driver.difference(one, two) == f"in {', '.join(names[:5])}{more}"
    assert bench.driver.difference(content, b"") == "so much that it cannot be read"


def test_who_stops_in_the_handshake_leaves_no_command_behind(bench: RackBench) -> None:
    cancel = threading.Event()
    execute = bench.rack.module._execute

    def stop(axis: int) -> None:
        cancel.set()
        execute(axis)

    bench.rack.module._execute = stop
    with pytest.raises(CancelledError) as caught:
        loaded(bench, gains(y=0), cancel=cancel)
    assert caught.value.at_control == "new"
    assert bench.words[66] == 0


def test_a_line_that_is_cut_is_made_again_and_one_that_stays_cut_is_unknown(bench: RackBench) -> None:
    current = bench.driver.fetch()
    write = bench.rack.module.write

    def cut(register: int, word: int) -> None:
        write(register, word)
        if register == 3:
            bench.is_up = False
            bench.driver.close()

    bench.rack.module.write = cut
    with pytest.raises(TransferError) as caught:
        loaded(bench, gains())
    assert caught.value.at_control == "unknown"
    bench.is_up = True
    assert words_of_content(bench.driver.fetch()) == {**words_of_content(current), 3: 17595}


def test_a_copy_is_recognised_decoded_and_put_back(bench: RackBench) -> None:
    loaded(bench, gains())
    content = bench.driver.fetch()
    assert content.startswith(KIND.encode())
    assert isinstance(kind_of(content), RegisterContent)
    assert decode_content(content).get(gains().find("R3")) == Value(17595)
    bench.rack.operate("power")
    outcome = download(
        bench.driver,
        WantedContent(lambda current: bench.driver.refit(content, current), gains().schema.signature),
        lambda _: "kept",
    )
    assert (outcome.verified, bench.driver.fetch()) == (True, content)


@pytest.mark.parametrize(
    "damage",
    [
        lambda c: c[:-1],
        lambda c: c + b"R1 1\n",
        lambda c: c.replace(b"R3 ", b"R3  "),
        lambda c: c.replace(b"R3 0", b"R3 65536"),
        lambda c: c.replace(b"R3 0\n", b""),
        lambda c: c.replace(b"R3 0", b"R3 00"),
        lambda c: c.replace(b"R3 0", b"R3 \xb2"),
    ],
)
def test_a_damaged_content_is_refused(bench: RackBench, damage) -> None:
    content = bench.driver.fetch()
    assert damage(content) != content
    with pytest.raises(ImageError):
        bench.driver.decode(damage(content))


def test_a_family_that_has_no_registers_is_refused() -> None:
    from amp_studio.families.servo57c422b.lines.driver import RegisterDriver

    with pytest.raises(WrongFamilyError):
        RegisterDriver.at(parse_endpoint("tcp://127.0.0.1:1"), "9pc")


def test_a_line_is_whole_or_none() -> None:
    line = framed(7, "R 72 1")
    assert line == b"7 R 72 1*DBF9\r\n"
    assert unframed(line[:-2]) == (7, "R 72 1")
    for at in range(len(line) - 2):
        for bit in range(8):
            broken = bytearray(line[:-2])
            broken[at] ^= 1 << bit
            assert unframed(bytes(broken)) is None
