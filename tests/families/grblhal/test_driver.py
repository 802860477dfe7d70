"""Downloads and uploads over the Grbl driver, against an emulated control on a bench."""

import threading
from collections.abc import Callable
from dataclasses import replace
from functools import partial
from pathlib import Path

import pytest

from amp_studio.families.grblhal.aftermath import state_of
from amp_studio.families.grblhal.content import read_content, write_content
from amp_studio.families.grblhal.driver import GrblDriver
from amp_studio.families.grblhal.line import GrblLine
from amp_studio.families.grblhal.writing import Writing
from amp_studio.schema import Value
from amp_studio.transfer.client.exchange import WantedContent, download
from amp_studio.transfer.content import decode_content, kind_of
from amp_studio.transfer.errors import (
    CancelledError,
    ConnectionCutError,
    ControlSilentError,
    ImageChangedError,
    MovingError,
    ProtocolMismatchError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.progress import SILENT
from amp_studio.transfer.sent_values import SentValues
from amp_studio.transfer.waiting import Waiting
from tests.campaigns import some
from tests.families.grblhal.bench import Bench, Clock, current, edited, put, sent
from tests.families.grblhal.conversation import Player, answers, recorded
from tests.families.grblhal.faulty_grbl import download_with_faults


def test_the_control_is_identified_by_what_it_shows(bench: Bench) -> None:
    who = bench.driver.identify()
    assert (who.family, who.protocol, who.name) == ("grblhal", "grbl", "grblHAL on Emulated")
    assert (who.revision, who.axes, who.in_estop) == ("1.1f.20260817", ("X", "Y", "Z"), None)
    assert sent(bench) == []


def test_the_same_control_gives_the_same_bytes_and_its_file_gives_them_back(bench: Bench) -> None:
    first = bench.driver.fetch()
    file = decode_content(first)
    assert file.values[file.find("$130")].value == 200.0
    assert file.values[file.find("$22")].value == 0
    assert kind_of(first).encode(file, first) == first
    bench.driver.close()
    assert bench.driver.fetch() == first


def test_only_what_differs_is_sent_homing_before_what_needs_it(bench: Bench) -> None:
    outcome = put(bench, {130: "301.500", 20: "1", 22: "3", 110: "500.000"})
    assert outcome.verified
    assert sent(bench) == ["$22=3", "$20=1", "$130=301.500"]


def test_a_file_is_sent_by_the_numbers_of_its_settings(bench: Bench) -> None:
    file = edited(bench, n130=301.5, n11=0.0004)
    outcome = download(
        bench.driver,
        WantedContent(partial(bench.driver.encode, file), file.schema.signature),
        lambda _: "kept",
    )
    assert sent(bench) == ["$11=0.0004", "$130=301.500"]
    assert "$11 Junction deviation is shown as 0.000: what was sent, 0.0004, is finer" in outcome.text
    assert bench.firmware.settings.all[11].value == pytest.approx(0.0004)


def test_a_second_download_of_the_same_file_sends_nothing(bench: Bench) -> None:
    file = edited(bench, n130=301.5)
    wanted = WantedContent(partial(bench.driver.encode, file), "")
    send = partial(download, bench.driver, wanted, lambda _: "kept")
    assert send().written
    assert not send().written


@pytest.mark.parametrize(
    ("number", "value", "text"),
    [
        ("n26", 70000, r"\$26 Homing switch debounce delay takes 0 to 65535, not 70000"),
        ("n1", 70000, r"\$1 Step idle delay takes 0 to 65535, not 70000"),
        ("n44", 8, r"\$44 Axes homing, first phase takes 0 to 7, not 8"),
        ("n100", -1.0, r"\$100 X-axis travel resolution takes 0 and more, not -1"),
        ("n0", 1.5, r"\$0 Step pulse time takes 2 and more, not 1.5"),
        ("n130", 1e300, "is too large"),
    ],
)
def test_what_the_control_would_not_store_as_it_is_is_never_sent(
    bench: Bench, number: str, value: float, text: str
) -> None:
    file = edited(bench, **{number: value})
    with pytest.raises(ImageError, match=text):
        download(bench.driver, WantedContent(partial(bench.driver.encode, file), ""), lambda _: "kept")
    assert sent(bench) == []


def test_a_file_that_sets_only_homing_shows_what_goes_with_it(bench: Bench) -> None:
    put(bench, {22: "1", 20: "1", 676: "15"})
    file = edited(bench)
    for address in [a for a in file.values if a != file.find("$22")]:
        del file.values[address]
    file.take({file.find("$22"): Value(0)})
    outcome = download(bench.driver, WantedContent(partial(bench.driver.encode, file), ""), lambda _: "kept")
    assert outcome.verified, outcome.text


def test_a_refusal_is_a_sentence_with_the_name_of_the_setting_and_the_rest_is_old(bench: Bench) -> None:
    present = current(bench)
    wanted = write_content(replace(present, settings={**present.settings, 32: "1", 30: "250.000"}))
    bench.firmware.settings.all[32].labels = ("Normal",)  # it lists a mode that it refuses
    with pytest.raises(TransferError) as caught:
        download(bench.driver, WantedContent(wanted, ""), lambda _: "copy")
    assert (
        str(caught.value)
        == "the control refuses $32=1 (Mode of operation): the value is out of range (error 52); 1 of 2"
        " values were confirmed; the control contains the new $30 and the old values of the rest (what it"
        " contained before is kept in copy)"
    )
    assert (caught.value.at_control, caught.value.new) == ("mixed", ("$30",))


def test_a_machine_that_moves_is_not_touched(bench: Bench) -> None:
    content = bench.driver.fetch()
    bench.firmware.operate("state Run")
    with pytest.raises(MovingError, match="the machine moves"):
        bench.driver.fetch()
    bench.firmware.operate("state Idle")
    wanted = write_content(
        replace(read_content(content), settings={**read_content(content).settings, 130: "5.000"})
    )

    def starts(_: bytes) -> str:
        bench.firmware.operate("state Run")
        return "kept"

    with pytest.raises(
        TransferError,
        match=(
            "the control is in the state Run: it takes no settings then: bring it to rest first; nothing was"
        ),
    ):
        download(bench.driver, WantedContent(wanted, ""), starts)
    assert sent(bench) == []


def test_in_check_mode_nothing_is_written_because_it_would_not_last(bench: Bench) -> None:
    """The firmware answers "ok" there and keeps the setting
    in RAM only (protocol.c ``protocol_execute_realtime``).
    """
    bench.firmware.operate("state Check")
    with pytest.raises(
        TransferError, match=r"in the state Check: .* leave check mode \(\$C\) first"
    ) as caught:
        put(bench, {130: "301.500"})
    assert caught.value.at_control == "old"
    assert sent(bench) == []


def test_what_the_emulated_control_takes_in_check_mode_is_gone_after_the_power(bench: Bench) -> None:
    bench.firmware.operate("state Check")
    line = GrblLine(bench.open, Waiting(bench.clock, bench.clock.sleep))
    assert line.ask("$130=301.500") == []
    assert line.ask("$130") == ["$130=301.500"]
    bench.firmware.power_cycle()
    assert current(bench).settings[130] == "200.000"


def test_a_locked_control_keeps_what_is_written(bench: Bench) -> None:
    bench.firmware.operate("state Alarm")
    assert put(bench, {130: "301.500"}).verified
    bench.driver.close()
    bench.firmware.power_cycle()
    bench.firmware.answer()
    assert current(bench).settings[130] == "301.500"


@pytest.mark.parametrize(
    ("state", "words"), [("Hold:0", "in a feed hold it answers"), ("Door:0", "safety door")]
)
def test_a_control_that_reads_no_line_is_refused_at_once(bench: Bench, state: str, words: str) -> None:
    bench.firmware.operate(f"state {state}")
    for asks in (bench.driver.identify, bench.driver.fetch):
        with pytest.raises(TransferError, match=words):
            asks()
    assert bench.clock.now < 1.0


def test_a_control_in_a_hold_reports_its_state_and_answers_after_it(bench: Bench) -> None:
    for state in ("Hold:0", "Door:0"):
        bench.firmware.operate(f"state {state}")
        found = bench.driver.status()
        assert (found.state, [axis.axis for axis in found.axes]) == (state, ["X", "Y", "Z"])
    bench.firmware.operate("state Idle")
    assert bench.driver.status().state == "Idle"
    assert bench.driver.fetch()


def test_an_answer_that_comes_slowly_is_no_silence(bench: Bench) -> None:
    """Silence is shown only where no byte comes, however long an answer takes."""
    stages: list[str] = []

    def slow(data: bytes) -> bytes:
        bench.clock.now += 0.5
        return data

    bench.spoil_out = slow
    bench.driver.fetch(Exchange(lambda stage, done, total: stages.append(stage)))
    assert SILENT not in stages


def test_what_a_user_has_changed_meanwhile_is_not_overwritten(bench: Bench) -> None:
    present = current(bench)
    wanted = write_content(replace(present, settings={**present.settings, 130: "5.000"}))

    def approves(_: bytes) -> str:
        bench.firmware.settings.store(131, "7")
        return "kept"

    with pytest.raises(
        ImageChangedError,
        match="somebody has changed the settings since they were read; nothing was replaced",
    ):
        download(bench.driver, WantedContent(wanted, ""), approves)
    assert sent(bench) == []


def test_grbl_1_1_is_served_with_the_bundled_description(tmp_path: Path) -> None:
    bench = Bench(tmp_path, "grbl-1.1")
    who = bench.driver.identify()
    assert (who.name, who.revision, who.axes) == ("Grbl", "1.1h.20190830", ("X", "Y", "Z"))
    file = edited(bench, n130=301.5)
    assert file.machine == "grbl-1.1"
    assert download(
        bench.driver, WantedContent(partial(bench.driver.encode, file), ""), lambda _: "kept"
    ).verified
    assert sent(bench) == ["$130=301.500"]
    with pytest.raises(ImageError, match=r"\$1 takes 0 to 255, not 300"):
        download(
            bench.driver,
            WantedContent(partial(bench.driver.encode, edited(bench, n1=300)), ""),
            lambda _: "kept",
        )


def test_settings_that_need_a_restart_are_named_and_nothing_is_restarted(bench: Bench) -> None:
    outcome = put(bench, {398: "120"})
    assert outcome.restart == "needed"
    assert (
        "$398 Planner buffer blocks becomes active when the control is switched off and on." in outcome.text
    )
    put(bench, {398: "100"})
    everything = b"".join(bench.received)
    assert b"\x18" not in everything
    assert b"RST" not in everything


def test_power_lost_while_the_memory_is_written_is_reported_as_defaults(bench: Bench) -> None:
    put(bench, {130: "300.000", 131: "300.000", 132: "300.000", 30: "24000.000"})
    bench.firmware.answer()
    bench.spoil_out = _power_off_at_save(bench)
    with pytest.raises(ConnectionCutError) as caught:
        put(bench, {110: "600.000"})
    assert caught.value.at_control == "defaults"
    assert "the control has lost its memory and contains its defaults" in str(caught.value)
    assert current(bench).settings[130] == "200.000"


def _power_off_at_save(bench: Bench) -> Callable[[bytes], bytes]:
    def cut(data: bytes) -> bytes:
        if bench.firmware.is_writing:
            bench.firmware.power_cycle()
            bench.spoil_out = lambda data: data
            return b""
        return data

    return cut


def test_a_break_after_the_last_answer_is_reported_as_new_and_read(bench: Bench) -> None:
    present = current(bench)
    wanted = replace(present, settings={**present.settings, 110: "600.000"})

    def restart(stage: str, done: int, total: int) -> None:
        if (stage, done) == ("download", 1):
            bench.firmware.answer()  # the memory is written
            bench.firmware.power_cycle()

    with pytest.raises(
        ConnectionCutError, match="the control contains the new content, as it was read since"
    ) as caught:
        download(bench.driver, WantedContent(write_content(wanted), ""), lambda _: "copy", Exchange(restart))
    assert caught.value.at_control == "new"


def test_a_memory_that_cannot_be_written_ends_a_download_and_nothing_is_called_new(bench: Bench) -> None:
    """The control shows the new value, and loses it with its power."""
    bench.driver.identify()
    bench.spoil_out = lambda data: data.replace(b"ok\r\n", b"[MSG:Warning: EEPROM write failed]\r\nok\r\n")
    with pytest.raises(TransferError, match="the control cannot write its memory") as caught:
        put(bench, {110: "600.000"})
    assert caught.value.at_control == "unknown"


def test_a_cable_that_is_out_for_good_leaves_it_unknown(bench: Bench) -> None:
    def pull(stage: str, done: int, total: int) -> None:
        bench.is_cut = bench.is_cut or (stage, done) == ("download", 1)

    present = current(bench)
    wanted = replace(present, settings={**present.settings, 110: "600.000", 111: "600.000"})
    with pytest.raises(ConnectionCutError) as caught:
        download(bench.driver, WantedContent(write_content(wanted), ""), lambda _: "copy", Exchange(pull))
    assert (caught.value.at_control, caught.value.kept) == ("unknown", "copy")
    assert bench.clock.now < 60


def test_who_stops_while_a_broken_line_is_made_again_waits_for_nothing(bench: Bench) -> None:
    cancel = threading.Event()

    def pull(stage: str, done: int, total: int) -> None:
        if (stage, done) == ("download", 1):
            bench.is_cut = True
            cancel.set()

    present = current(bench)
    wanted = replace(present, settings={**present.settings, 110: "600.000", 111: "600.000"})
    began = bench.clock.now
    with pytest.raises(TransferError) as caught:
        download(
            bench.driver, WantedContent(write_content(wanted), ""), lambda _: "copy", Exchange(pull, cancel)
        )
    assert caught.value.at_control == "mixed"
    assert bench.clock.now - began < 1.0


def test_a_setting_that_is_never_answered_is_read_and_not_guessed(bench: Bench) -> None:
    present = current(bench)
    bench.firmware._ignores_settings = True  # as this build is after a soft reset
    wanted = replace(present, settings={**present.settings, 110: "600.000"})
    with pytest.raises(ControlSilentError) as caught:
        download(bench.driver, WantedContent(write_content(wanted), ""), lambda _: "copy")
    assert caught.value.at_control == "old"


def test_who_stops_between_two_settings_reads_which_are_new(bench: Bench) -> None:
    cancel = threading.Event()
    present = current(bench)
    wanted = replace(present, settings={**present.settings, 110: "600.000", 111: "600.000", 112: "600.000"})

    def stop(stage: str, done: int, total: int) -> None:
        if (stage, done) == ("download", 2):
            cancel.set()

    with pytest.raises(CancelledError) as caught:
        download(
            bench.driver, WantedContent(write_content(wanted), ""), lambda _: "copy", Exchange(stop, cancel)
        )
    assert (caught.value.at_control, caught.value.new) == ("mixed", ("$110", "$111"))
    assert [current(bench).settings[n] for n in (110, 111, 112)] == ["600.000", "600.000", "500.000"]


def test_a_line_that_changes_bytes_now_and_then_is_read_until_two_readings_agree(bench: Bench) -> None:
    first = current(bench)
    turns = iter([True] + [False] * 10_000)

    def spoil(data: bytes) -> bytes:
        return data.replace(b"$130=200", b"$130=300") if b"$130=200" in data and next(turns) else data

    bench.spoil_out = spoil
    assert current(bench) == first


def test_what_is_no_grbl_is_reported(bench: Bench) -> None:
    bench.spoil_out = lambda data: data.replace(b"[VER:", b"[XYZ:")
    with pytest.raises(ProtocolMismatchError, match="what answers there is no Grbl control"):
        bench.driver.identify()


def test_another_family_is_refused_before_anything_is_connected() -> None:
    with pytest.raises(WrongFamilyError, match="that of the family grblhal, not of num"):
        GrblDriver.at(parse_endpoint("tcp://127.0.0.1:1"), "num")


def test_the_driver_reads_the_recorded_firmware() -> None:
    from amp_studio.families.grblhal.driver import GrblDriver

    clock = Clock()
    content = read_content(GrblDriver(Player(clock.sleep).open, Waiting(clock, clock.sleep)).fetch())
    assert (content.version, content.axes, len(content.settings)) == ("1.1f.20260817", ("X", "Y", "Z"), 83)
    assert len(content.enumerations["$ES"]) == 83


def test_the_emulated_control_does_with_settings_what_the_recorded_firmware_did(bench: Bench) -> None:
    line = GrblLine(bench.open, Waiting(bench.clock, bench.clock.sleep))
    own_words = {"$I", "$EG", "$ES", "$ESH", "$EA", "$EE", "$G", "$SED=22"}
    for (command, identity_word), (_, real) in zip(answers(line), recorded(), strict=True):
        if command not in own_words:
            assert identity_word == [text for text in real if not text.startswith("[HOME:")], command


def test_a_fault_of_this_computer_between_two_settings_is_reported_with_what_the_control_contains(
    bench: Bench,
) -> None:
    def fails(data: bytes) -> bytes:
        if b"$111=" in data:
            raise MemoryError
        return data

    present = current(bench)
    wanted = replace(present, settings={**present.settings, 110: "600.000", 111: "600.000"})
    bench.spoil_in = fails
    with pytest.raises(
        TransferError,
        match=(
            r"broke off \(MemoryError\); 1 of 2 values were confirmed, \$111 was not answered; the control"
            r" contains the new \$110"
        ),
    ) as caught:
        download(bench.driver, WantedContent(write_content(wanted), ""), lambda _: "copy")
    assert caught.value.at_control == "mixed"


@pytest.mark.parametrize("seed", some(range(12), 2))
def test_whatever_fails_the_copy_is_whole_and_what_is_reported_is_true(seed: int, tmp_path: Path) -> None:
    assert download_with_faults(seed, tmp_path) == []


def test_a_description_that_the_line_has_damaged_is_asked_again(tmp_path: Path) -> None:
    assert download_with_faults(20_057, tmp_path, "swap") == []


def test_a_download_that_loses_its_line_reports_how_many_values_were_confirmed_and_which_was_not_answered(
    bench: Bench,
) -> None:
    present = current(bench)
    wanted = replace(present, settings={**present.settings, 110: "600.000", 111: "600.000", 112: "600.000"})

    def cut(stage: str, done: int, _total: int) -> None:
        bench.is_cut |= (stage, done) == ("download", 1)

    with pytest.raises(TransferError) as caught:
        download(bench.driver, WantedContent(write_content(wanted), ""), lambda _: "copy", Exchange(cut))
    assert caught.value.at_control == "unknown"
    assert "1 of 3 values were confirmed, $111 was not answered; which of the new values" in str(caught.value)
    assert "old or the new" not in str(caught.value)


def test_a_number_that_the_line_has_changed_is_written_again(bench: Bench) -> None:
    """The control takes ``$110=600`` as ``$111=600``, and answers ``ok``."""
    changed: list[bytes] = []

    def spoil(data: bytes) -> bytes:
        if b"$110=" not in data or changed:
            return data
        changed.append(data)
        return data.replace(b"$110=", b"$111=")

    bench.spoil_in = spoil
    assert put(bench, {110: "600.000"}).verified
    assert changed
    assert (current(bench).settings[110], current(bench).settings[111]) == ("600.000", "500.000")


@pytest.mark.parametrize(("others", "at"), [(2, "unknown"), (3, "defaults")])
def test_three_settings_that_were_not_touched_are_more_than_a_damaged_byte(
    bench: Bench, others: int, at: str
) -> None:
    present = current(bench)
    writing = Writing(
        replace(present, settings={**present.settings, 110: "600.000"}), present, {}, SentValues()
    )
    changed = dict.fromkeys((120, 121, 122)[:others], "7.000")
    found = replace(present, settings={**present.settings, **changed})
    assert state_of(writing, found)[0] == at
