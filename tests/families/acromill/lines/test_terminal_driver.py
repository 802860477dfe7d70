"""An ACR card is set over its terminal: each line's echo compared, each setting read back, saved;
nothing is half obeyed.
"""

import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path
from unittest import mock

import pytest

from amp_studio.families.acromill.emulated.card import AcrCard
from amp_studio.families.acromill.lines import driver
from amp_studio.families.acromill.lines.driver import TerminalDriver
from amp_studio.files import ParameterFile
from amp_studio.schema import load_schema
from amp_studio.schema.values import read_value
from amp_studio.transfer import Waiting
from amp_studio.transfer.client.exchange import Outcome, WantedContent, download, upload
from amp_studio.transfer.client.parameters import download_file
from amp_studio.transfer.emulated.faults import Faults, FaultyLink
from amp_studio.transfer.errors import (
    CancelledError,
    ConnectionCutError,
    ControlFullError,
    ControlSilentError,
    ImageDamagedError,
    ImageRejectedError,
    KeepFailedError,
    ProtocolMismatchError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import Link

from .bench import CardBench


@pytest.fixture
def bench(tmp_path: Path) -> CardBench:
    return CardBench(tmp_path)


def small_file(**settings: str) -> ParameterFile:
    """Return a file that sets nothing but these; ``X`` of gains, scales and tables."""
    ids = {
        "ppu": "axes.pulses_per_unit",
        "pgain": "servo.p_gain",
        "exc": "axes.excess_error_band",
        "notch": "tuning.notch_frequency",
        "width": "tuning.notch_width",
        "lopass": "tuning.lopass_frequency",
        "table": "ballscrew.table",
        "units": "control.default_units",
    }
    file = ParameterFile(load_schema("acromill"))
    for name, text in settings.items():
        parameter = file.schema.parameters[ids[name]]
        unit = {"ppu": "counts/in", "exc": "in"}.get(name, next(iter(file.schema.units_of(parameter)), ""))
        file.take({(ids[name], "" if name == "units" else "X"): read_value(parameter, text, unit)})
    return file


def send(
    bench: CardBench,
    file: ParameterFile,
    kept: list[bytes],
    cancel: threading.Event | None = None,
    progress: Callable[[str, int, int], None] = lambda *_: None,
) -> Outcome:
    def keep(old: bytes) -> str:
        kept.append(old)
        return "kept"

    return download(
        bench.driver,
        WantedContent(partial(bench.driver.encode, file), file.schema.signature),
        keep,
        Exchange(progress, cancel),
    )


def test_what_differs_is_sent_line_by_line_read_back_and_saved(bench: CardBench) -> None:
    kept: list[bytes] = []
    before = upload(bench.driver)
    bench.lines[0].sent.clear()
    outcome = send(bench, small_file(pgain="0.08", ppu="4096", exc="0.25"), kept)
    assert (
        outcome.text
        == "Download complete and read back equal. The card has saved it (ESAVE). What it contained before is"
        " kept in kept."
    )
    commands = bytes(bench.lines[0].sent).decode().split("\r")
    sets = commands[commands.index("PPU X4096") :][:10]
    assert sets == [
        "PPU X4096",
        "PPU X",
        "PPU X",
        "EXC AXIS0 0.25",
        "EXC AXIS0",
        "EXC AXIS0",
        "PGAIN X0.08",
        "PGAIN X",
        "PGAIN X",
        "ESAVE",
    ]
    assert kept == [before]
    assert bench.switch_on().settings.values["PGAIN X"] == "0.08"


def test_a_copy_that_was_kept_goes_back(bench: CardBench) -> None:
    kept: list[bytes] = []
    send(bench, small_file(pgain="0.08", table="X0E.00325 X1E-.00100"), kept)
    bench.execute("PGAIN X0.09")
    now = upload(bench.driver)
    outcome = download(
        bench.driver,
        WantedContent(
            partial(bench.driver.refit, now.replace(b"PGAIN X0.09", b"PGAIN X0.000000199")),
            load_schema("acromill").signature,
        ),
        lambda _: "kept",
    )
    assert outcome.verified
    assert bench.card.settings.values["PGAIN X"] == "1.99E-07"
    with pytest.raises(
        ImageError, match=r"the card has BSC X0, BSC X1 too, and how positions are taken out is not printed"
    ):
        bench.driver.refit(kept[0], upload(bench.driver))


def test_ballscrew_words_are_sent_behind_their_command_and_listed(bench: CardBench) -> None:
    assert send(bench, small_file(table="X0E.00325 X1E-.00250"), []).verified
    assert b"BSC X0E.00325\r" in bench.lines[0].sent
    assert upload(bench.driver).endswith(b"BSC X0E.00325\nBSC X1E-.00250\nend 130\n")
    assert send(bench, small_file(table="X0E.00325 X1E-.00250 X2E.00001"), []).verified


def test_a_long_table_on_a_slow_line_is_read_back_once(bench: CardBench) -> None:
    """60 positions are 720 bytes an answer, 0.75 s at 9600 bit/s."""
    words = " ".join(f"X{n}E.{n:05d}" for n in range(60))
    bench.wrap = lambda link: setattr(link, "bytes_per_second", 960) or link
    assert send(bench, small_file(table=words), []).verified
    asked = bytes(bench.lines[0].sent).decode().split("\r")
    after = asked[asked.index("BSC X59E.00059") :]
    assert after[:4] == ["BSC X59E.00059", "BSC X", "BSC X", "ESAVE"]


def test_a_position_that_the_card_takes_otherwise_is_named(bench: CardBench) -> None:
    refuse(bench, "BSC X1E-.00250", [])
    with pytest.raises(
        ImageRejectedError,
        match=r"line 132 of the script, 'BSC X1E-\.00250': the card takes it and shows nothing",
    ):
        send(bench, small_file(table="X0E.00325 X1E-.00250"), [])


def test_a_filter_is_switched_on_and_not_off(bench: CardBench) -> None:
    kept: list[bytes] = []
    assert send(bench, small_file(notch="500", width="50", lopass="1000"), kept).verified
    assert bench.card.settings.values["NOTCH X"] == "500, 50"
    assert b"LOPASS X\n" in kept[0]
    with pytest.raises(ImageError, match="LOPASS X, NOTCH X is off in the copy and on at the card"):
        bench.driver.refit(kept[0], upload(bench.driver))
    assert send(bench, small_file(notch="400"), []).verified, "the width stays as the card has it"
    assert bench.card.settings.values["NOTCH X"] == "400, 50"
    with pytest.raises(ImageError, match="NOTCH X has several figures"):
        bench.driver.encode(small_file(notch="400"), kept[0])


def test_more_digits_than_the_card_shows_are_no_difference(bench: CardBench) -> None:
    assert send(bench, small_file(pgain="0.00244140625"), []).verified
    assert bench.card.settings.values["PGAIN X"] == "0.002441406"
    again = send(bench, small_file(pgain="0.00244140625"), [])
    assert not again.written


def test_the_unit_of_the_figures_is_the_persons_word(bench: CardBench, tmp_path: Path) -> None:
    current = upload(bench.driver)
    with pytest.raises(ImageError, match="the figures of the file are metric, and the card was read as inch"):
        bench.driver.encode(small_file(units="metric", ppu="100"), current)
    metric = CardBench(tmp_path / "metric", "metric")
    assert send(metric, small_file(units="metric", ppu="100 counts/mm"), []).verified
    assert metric.card.settings.values["PPU X"] == "100"
    assert (
        str(metric.driver.decode(upload(metric.driver)).values["axes.pulses_per_unit", "X"].unit)
        == "counts/mm"
    )


def refuse(bench: CardBench, line: str, rows: list[str]) -> None:
    """Have the card answer a line with words instead of obeying it."""
    execute = bench.card.settings.execute
    bench.card.settings.execute = lambda text: rows if text == line else execute(text)


def test_a_command_that_the_card_refuses_is_named_with_its_line_and_all_is_read_again(
    bench: CardBench,
) -> None:
    refuse(bench, "PGAIN X0.08", ["Number out of range"])
    with pytest.raises(ImageRejectedError) as caught:
        send(bench, small_file(pgain="0.08", ppu="4096"), [])
    assert (
        str(caught.value)
        == "line 83 of the script, 'PGAIN X0.08': the card answers 'Number out of range'; 1 of 2 values were"
        " confirmed; the control contains the new PPU X and the old values of the rest (what it contained"
        " before is kept in kept)"
    )
    assert bench.switch_on().settings.values["PPU X"] == "10000", "nothing was saved"


def test_a_setting_that_the_card_takes_otherwise_is_named(bench: CardBench) -> None:
    refuse(bench, "PPU X4096", [])
    with pytest.raises(
        ImageRejectedError,
        match=(
            "line 3 of the script, 'PPU X4096': the card takes it and shows 10000; 0 of 1 values were"
            " confirmed; noth"
        ),
    ):
        send(bench, small_file(ppu="4096"), [])


def test_a_save_that_fails_is_reported(bench: CardBench) -> None:
    bench.card.settings._memory.full_at = 0
    with pytest.raises(ControlFullError, match="the card answers ESAVE with 'EEPROM failure") as caught:
        send(bench, small_file(ppu="4096"), [])
    assert caught.value.at_control == "new"


def test_a_card_without_some_settings_is_read_and_what_it_does_not_have_is_named(bench: CardBench) -> None:
    for n, axis in enumerate("ZABCUV", 2):
        del bench.card.settings.values[f"PGAIN {axis}"], n
    execute = bench.card.settings.execute

    def missing(text: str) -> list[str]:
        return ["Axis not attached"] if text.startswith(("PGAIN X", "BSC")) else execute(text)

    bench.card.settings.values.update({f"PGAIN {axis}": "0" for axis in "ZABCUV"})
    bench.card.settings.execute = missing
    current = upload(bench.driver)
    assert b"PGAIN X" not in current
    assert b"PGAIN Y0.00244" in current
    with pytest.raises(ImageError, match="the card does not have PGAIN X, which the file sets"):
        bench.driver.encode(small_file(pgain="0.08"), current)


class Repeating(FaultyLink):
    """A line on which each answer of one setting comes with a byte of its figure twice."""

    def __init__(self, link: Link, answer: bytes, times: list[int]) -> None:
        super().__init__(link, Faults(), cut=False)
        self._answer, self._times = answer, times

    def _pass(self, way: str, data: bytes) -> bytes:
        if way == "in" and self._times[0] and self._answer in data:
            self._times[0] -= 1
            return data.replace(self._answer, self._answer.replace(b".", b".."))
        return data


def test_an_answer_that_the_line_has_damaged_twice_does_not_make_a_short_copy(bench: CardBench) -> None:
    bench.execute("PGAIN X0.07125")
    bench.execute("BSC X0E.00325")
    whole = upload(bench.driver)
    bench.driver.close()
    for answer in (b"0.07125", b"X0E.00325"):
        times = [2]
        bench.wrap = lambda link, a=answer, t=times: Repeating(link, a, t)
        assert upload(bench.driver) == whole
        assert times == [0], "the damage has come"
        bench.driver.close()


def test_a_setting_that_stays_unreadable_ends_the_reading(bench: CardBench) -> None:
    bench.execute("PGAIN X0.07125")
    bench.wrap = lambda link: Repeating(link, b"0.07125", [1_000])
    with pytest.raises(ImageDamagedError, match=r"answers 'PGAIN X' with '0\.\.07125', which is neither"):
        upload(bench.driver)


def test_a_setting_is_missing_only_where_a_second_reading_lacks_it_too(bench: CardBench) -> None:
    execute, refused = bench.card.settings.execute, [2]

    def silent(text: str) -> list[str]:
        if text == "PGAIN Y" and refused[0]:
            refused[0] -= 1
            return []
        return execute(text)

    bench.card.settings.execute = silent
    with pytest.raises(ImageDamagedError, match="PGAIN Y in one reading and not in another"):
        upload(bench.driver)
    assert refused == [0]
    refused[0] = 0
    assert b"PGAIN Y0.00244" in upload(bench.driver)
    refused[0] = 1_000
    with pytest.raises(ImageDamagedError, match="PGAIN Y in one reading and not in another"):
        upload(bench.driver)


def another_run(bench: CardBench, file: ParameterFile, folder: Path) -> Outcome:
    """Download a file as a program does that has just been started; copies and record are in the folder."""
    bench.driver = TerminalDriver(bench._open, Waiting(bench.clock, bench.clock.sleep))
    with mock.patch("amp_studio.transfer.client.parameters.open_driver", return_value=bench.driver):
        return download_file(
            file, "tcp://card:23", Exchange(keep=folder / "router", record=folder / "router.amp")
        )


def test_a_reading_that_is_shorter_than_the_last_copy_stops_the_download_of_another_run(
    bench: CardBench, tmp_path: Path
) -> None:
    folder = tmp_path / "project"
    folder.mkdir()
    assert another_run(bench, small_file(ppu="4096"), folder).verified
    (whole,) = folder.glob("*.img")
    known = driver.settings()
    with (
        mock.patch.object(driver, "settings", return_value=known[:-1]),
        pytest.raises(KeepFailedError, match=f"lacks FFACC V, which {whole.name} has") as caught,
    ):
        another_run(bench, small_file(ppu="5000"), folder)
    assert (caught.value.at_control, bench.execute("PPU X")) == ("old", ["4096"])
    assert list(folder.glob("*.img")) == [whole]
    assert another_run(bench, small_file(ppu="5000"), folder).verified


def test_a_short_reading_of_another_card_goes_to_another_folder(bench: CardBench, tmp_path: Path) -> None:
    project, other = tmp_path / "project", tmp_path / "other"
    project.mkdir()
    other.mkdir()
    another_run(bench, small_file(ppu="4096"), project)
    (project / "exchanges.jsonl").rename(other / "exchanges.jsonl")
    with mock.patch.object(driver, "settings", return_value=driver.settings()[:-1]):
        assert another_run(bench, small_file(ppu="5000"), other).verified


def test_a_short_copy_is_not_put_back_as_if_it_were_whole(bench: CardBench) -> None:
    current = upload(bench.driver)
    short = current.replace(b"PGAIN Y0.00244\n", b"").replace(b"end 128", b"end 127")
    assert short != current
    with pytest.raises(ImageError, match="the copy does not have PGAIN Y, which the card has"):
        bench.driver.refit(short, current)


@pytest.mark.parametrize("program", [0, 3])
def test_half_a_line_that_a_user_left_is_taken_away(bench: CardBench, program: int) -> None:
    bench.card.receive(b"PROG%d\rPPU X40" % program)
    assert bench.driver.identify().revision == "1.17.08"
    assert bench.card.settings.values["PPU X"] == "10000"
    bench.driver.fetch()
    assert bench.card._program == 0


def test_half_a_line_is_spoiled_where_the_card_knows_no_backspace(bench: CardBench) -> None:
    bench.card.receive(b"PPU X40")
    receive = bench.card.receive
    bench.card.receive = lambda data: receive(data.replace(b"\b", b""))
    bench.driver.identify()
    assert bench.card.settings.values["PPU X"] == "10000"


class Changing(FaultyLink):
    """A line on which every so-many-th byte of one way has a bit changed."""

    def __init__(self, link: Link, to_card: int = 0, to_client: int = 0) -> None:
        super().__init__(link, Faults(), cut=False)
        self._every, self._count = {"in": to_client, "out": to_card}, {"in": 0, "out": 0}

    def _pass(self, way: str, data: bytes) -> bytes:
        changed = bytearray(data)
        for n in range(len(data)):
            self._count[way] += 1
            if self._every[way] and self._count[way] % self._every[way] == 0:
                changed[n] ^= 1 << self._count[way] % 7
        return bytes(changed)


@pytest.mark.parametrize(("to_card", "to_client"), [(97, 0), (0, 97), (151, 173)])
def test_a_line_that_changes_signs_changes_no_setting(bench: CardBench, to_card: int, to_client: int) -> None:
    bench.wrap = lambda link: Changing(link, to_card, to_client)
    values = dict(bench.card.settings.values)
    assert send(bench, small_file(pgain="0.08", ppu="4096", exc="0.25"), []).verified
    assert bench.card.settings.values == values | {"PGAIN X": "0.08", "PPU X": "4096", "EXC AXIS0": "0.25"}


def test_a_line_that_is_cut_is_made_again(bench: CardBench) -> None:
    bench.wrap = lambda link: FaultyLink(link, Faults(drop_after_bytes=3_001), cut=True)
    assert send(bench, small_file(pgain="0.08"), []).verified
    assert len(bench.lines) > 2


def test_a_card_that_loses_its_power_between_two_settings_is_set_again_before_it_saves(
    bench: CardBench,
) -> None:
    def progress(stage: str, done: int, total: int) -> None:
        if (stage, done) == ("download", 1):
            bench.switch_on()
            bench.lines[-1].close()

    assert send(bench, small_file(pgain="0.08", ppu="4096"), [], progress=progress).verified
    assert bench.switch_on().settings.values["PPU X"] == "4096"


def test_a_card_that_does_not_come_back_is_not_known(bench: CardBench) -> None:
    def progress(stage: str, done: int, total: int) -> None:
        if (stage, done) == ("download", 1):
            bench.is_up = False
            bench.lines[-1].close()

    with pytest.raises(ConnectionCutError) as caught:
        send(bench, small_file(pgain="0.08", ppu="4096"), [], progress=progress)
    assert caught.value.at_control == "unknown"
    assert bench.clock.now < 60


@pytest.mark.parametrize(("done", "state", "new"), [(0, "old", ()), (1, "mixed", ("PPU X",)), (2, "new", ())])
def test_ctrl_c_stops_between_two_settings_and_shows_which_are_new(
    bench: CardBench, done: int, state: str, new: tuple[str, ...]
) -> None:
    cancel = threading.Event()

    def progress(stage: str, at: int, total: int) -> None:
        if (stage, at) == ("download", done) or (done == 0 and stage == "keep" and at == total):
            cancel.set()

    with pytest.raises(CancelledError) as caught:
        send(bench, small_file(pgain="0.08", ppu="4096"), [], cancel, progress)
    assert (caught.value.at_control, caught.value.new) == (state, new)
    assert "loses it with its power" in str(caught.value) or state == "old"
    assert not bench.card._line, "no half line is left"


def test_ctrl_c_while_the_card_is_silent_ends_at_once(bench: CardBench) -> None:
    upload(bench.driver)
    cancel, began = threading.Event(), bench.clock.now
    bench.card.receive = lambda _: cancel.set()
    with pytest.raises(CancelledError):
        bench.driver.fetch(Exchange(cancel=cancel))
    assert bench.clock.now - began < 0.3


class Hostile:
    bytes_per_second = None

    def __init__(self, bench: CardBench, answer: Callable[[int, bytes], bytes]) -> None:
        self._bench, self._answer, self._count, self._last = bench, answer, 0, b""

    def read(self, timeout: float) -> bytes:
        self._count += 1
        data = self._answer(self._count, self._last)
        self._last = b""
        self._bench.clock.sleep(0.001 if data else timeout)
        return data

    def write(self, data: bytes) -> None:
        self._last = data

    def close(self) -> None:
        pass


@pytest.mark.parametrize(
    ("answer", "kind"),
    [
        (lambda _n, _last: b"", ControlSilentError),
        (lambda _n, _last: b"\xff" * 1_000, ProtocolMismatchError),
        (lambda _n, _last: b"\r\nP00>", ProtocolMismatchError),
        (lambda _n, _last: b"P00>" if _n % 3 == 0 else b"", ControlSilentError),
        (lambda _n, last: last, ControlSilentError),
        (lambda _n, last: b"\r\nP00>" if b"\r" in last else last, ProtocolMismatchError),
        (lambda n, last: b"\r\n%d\r\nP00>" % n if b"\r" in last else last, ImageDamagedError),
        (
            lambda n, last: b"\r\n\x1b[2J\r\nP00>" if last == b"\r" else b"\r\nP00>" if last else b"",
            ControlSilentError,
        ),
    ],
)
def test_a_hostile_other_end_is_bounded(
    bench: CardBench, answer: Callable[[int, bytes], bytes], kind: type[TransferError]
) -> None:
    driver = TerminalDriver(lambda _: Hostile(bench, answer), Waiting(bench.clock, bench.clock.sleep))
    with pytest.raises(kind):
        upload(driver)
    assert bench.clock.now < 120


def test_silence_is_reported_each_second_and_ends(bench: CardBench) -> None:
    bench.card.receive = lambda _: None
    reported: list[tuple[str, int]] = []
    with pytest.raises(ControlSilentError, match="the card does not take 'VER': the card does not answer"):
        bench.driver.identify(Exchange(lambda stage, done, _: reported.append((stage, done))))
    assert reported[:2] == [("silent", 2), ("silent", 3)]


def test_a_content_that_was_cut_off_or_is_no_script_is_refused(bench: CardBench) -> None:
    current = upload(bench.driver)
    for damaged in (
        b"",
        b"ACR script 1\n",
        current[:-1],
        current[:-9],
        current.replace(b"PPU X10000\n", b""),
        current.replace(b"PPU X10000", b"PPU X10000 Y5"),
        current.replace(b"PPU Y", b"PPU X"),
        current + b"\n",
        current.replace(b"inch", b"ells"),
        current.replace(b"PPU X10000", b"X4\nPPU X10000"),
    ):
        with pytest.raises(ImageError):
            bench.driver.decode(damaged)


def test_a_long_line_of_a_copy_is_refused_at_once(bench: CardBench) -> None:
    current = upload(bench.driver)
    for digits in (b"1" * 200_000 + b"x", b"1" * 200_000, b"(" * 200_000):
        with pytest.raises(ImageError, match="line 3 of the script of the card sets nothing that is known"):
            bench.driver.decode(current.replace(b"PPU X10000", b"PPU X" + digits))


def test_a_prompt_may_have_a_blank_and_lines_may_end_with_a_line_feed_alone(bench: CardBench) -> None:
    answer = bench.card.answer
    bench.card.answer = lambda: answer().replace(b"\r\n", b"\n").replace(b">", b"> ")
    assert b"PPU X10000\n" in upload(bench.driver)


def test_the_driver_is_for_acr_cards() -> None:
    with pytest.raises(WrongFamilyError):
        TerminalDriver.at(parse_endpoint("tcp://127.0.0.1:1?protocol=terminal"), "num")


def test_the_emulated_card_is_delivered_with_the_printed_defaults(bench: CardBench) -> None:
    assert isinstance(bench.card, AcrCard)
    file = bench.driver.decode(upload(bench.driver))
    assert [str(file.values[key, "X"].value) for key in ("axes.pulses_per_unit", "servo.p_gain")] == [
        "10000.0",
        "0.00244",
    ]
