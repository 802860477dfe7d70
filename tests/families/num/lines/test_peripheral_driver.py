"""The tool as the peripheral of a NUM control: it loads, unloads and shows the person what to press;
nothing is half done.
"""

import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path

import pytest

from amp_studio.families.num.lines.driver import (
    CHECK_TEXT,
    LOAD_TEXT,
    STOPPED_TEXT,
    UNLOAD_TEXT,
    PeripheralDriver,
)
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import load_schema
from amp_studio.schema.storage import value_of_stored
from amp_studio.transfer import Waiting
from amp_studio.transfer.client.exchange import Outcome, WantedContent, download, upload
from amp_studio.transfer.emulated.faults import Faults, FaultyLink
from amp_studio.transfer.errors import (
    CancelledError,
    ConnectionCutError,
    ControlSilentError,
    ImageDamagedError,
    ImageRejectedError,
    TransferError,
    WrongFamilyError,
)
from amp_studio.transfer.exchange import Exchange, Replacement
from amp_studio.transfer.image import ImageError
from amp_studio.transfer.links.endpoint import parse_endpoint
from amp_studio.transfer.links.link import Link
from tests.campaigns import some

from .bench import NumBench


@pytest.fixture
def bench(tmp_path: Path) -> NumBench:
    return NumBench(tmp_path)


def small_file(*settings: str) -> ParameterFile:
    """Return a file that sets nothing but these: ``P9N0=1``."""
    file = ParameterFile(load_schema("num"))
    for text in settings or ("P9N0=07",):
        number, _, value = text.partition("=")
        address = file.find(number)
        parameter = file.schema.parameters[address[0]]
        file.take({address: value_of_stored(parameter, int(value, 16), turns=False)})
    return file


def send(
    bench: NumBench, file: ParameterFile, kept: list[bytes], cancel: threading.Event | None = None
) -> Outcome:
    def keep(old: bytes) -> str:
        kept.append(old)
        return "kept"

    return download(
        bench.driver,
        WantedContent(partial(bench.driver.encode, file), file.schema.signature),
        keep,
        Exchange(bench.progress, cancel),
    )


@pytest.mark.parametrize("parity", some(["none", "even", "odd"], 2))
def test_a_download_is_an_unload_a_load_and_an_unload(tmp_path: Path, parity: str) -> None:
    bench = NumBench(tmp_path, parity=parity, is_checked=True)
    before, kept = upload(bench.driver, Exchange(bench.progress)), list[bytes]()
    bench.texts.clear()
    outcome = send(bench, small_file("P9N0=07", "P9N31=08"), kept)
    assert outcome.verified
    assert bench.texts == [UNLOAD_TEXT, LOAD_TEXT, UNLOAD_TEXT]
    assert (bench.words(9)[0], bench.words(9)[31]) == ("7", "8")
    assert kept == [before]
    assert before.startswith(b"NUM table 1\n%00000000;09\nP0N0:t6n1;09\n")
    assert before.endswith(b"\n\x13")
    after = upload(bench.driver, Exchange(bench.progress))
    assert after == before.replace(
        b"#0 0 0 0 0 0 0 0 0 0;14\nP9N10:", b"#7 0 0 0 0 0 0 0 0 0;14\nP9N10:"
    ).replace(b"P9N30:t0n32;0B\n#0 0;04", b"P9N30:t0n32;0B\n#0 8;04")


def test_a_copy_that_was_kept_goes_back(bench: NumBench) -> None:
    kept: list[bytes] = []
    send(bench, small_file("P9N0=07"), kept)
    driver, signature = bench.driver, load_schema("num").signature
    outcome = download(
        driver,
        WantedContent(partial(driver.refit, kept[0]), signature, is_return=True),
        lambda _: "again",
        Exchange(bench.progress),
    )
    assert outcome.verified
    assert bench.words(9)[0] == "0"


def test_without_parity_on_a_serial_line_two_unloads_are_compared(tmp_path: Path) -> None:
    bench = NumBench(tmp_path, parity="none")
    upload(bench.driver, Exchange(bench.progress))
    assert len(bench.texts) == 2
    assert bench.texts[1].startswith("Nothing on this line (no parity) shows a damaged character")


def test_the_control_checks_each_unload_where_the_user_asks_for_it(tmp_path: Path) -> None:
    bench = NumBench(tmp_path, parity="none", has_checked=True)
    upload(bench.driver, Exchange(bench.progress))
    assert [text[:52] for text in bench.texts] == [UNLOAD_TEXT[:52], CHECK_TEXT[:52]]
    assert bench.screen[-3:] == ["(VERI) P119", "(VERI) P120", "MACHINE SETUP DATA"]


def test_a_check_that_stops_at_a_word_has_the_table_unloaded_again(tmp_path: Path) -> None:
    bench = NumBench(tmp_path, parity="none", has_checked=True)
    bench.wrap = lambda link: OneFault(link, 9_003, 1)
    content = upload(bench.driver, Exchange(bench.progress))
    assert bench.texts[2].startswith("The control has stopped the table.")
    assert bench.texts[3].startswith(
        "The control has found another table than its own: unload it once more. "
    )
    assert [line for line in bench.screen if "FILE ERROR" in line] == [
        "dialogue line: FILE ERROR (INCORRECT TAPE?)  [line 445: P89N12 differs]"
    ]
    bench.driver = PeripheralDriver(bench._open, Waiting(bench.clock, bench.clock.sleep))
    bench.driver.is_checked = True
    bench.wrap = lambda link: link
    assert upload(bench.driver, Exchange(bench.progress)) == content


def test_what_the_operator_types_behind_the_job_reference_is_no_content(bench: NumBench) -> None:
    plain = upload(bench.driver, Exchange(bench.progress))
    bench.unload_keys = ["comment machine 7"]
    assert upload(bench.driver, Exchange(bench.progress)) == plain


def test_a_load_that_another_job_reference_stops_goes_on_when_the_operator_has_corrected_it(
    bench: NumBench,
) -> None:
    bench.unload_keys = ["reference 00000001"]
    original: Callable[[str, int, int], None] = bench.progress

    def progress(stage: str, done: int, total: int) -> None:
        if stage == STOPPED_TEXT:
            assert bench.screen[-1] == "dialogue line: %00000001"
            bench.press("reference 00000000")
        original(stage, done, total)

    bench.progress = progress
    assert send(bench, small_file(), []).verified
    assert bench.words(9)[0] == "7"


def test_a_load_that_the_control_stops_for_good_is_reported_and_what_it_contains_is_read(
    bench: NumBench,
) -> None:
    """P9N0 and P9N31 are in two data lines; a character of the line between them is damaged on its way."""
    damage = iter([b"P9N10"])

    class Damaging(FaultyLink):
        def write(self, data: bytes) -> None:
            plain = bytes(byte & 0x7F for byte in data)
            found = next(damage) if plain.startswith(b"P9N10:") else None
            super().write(data[:3] + bytes((data[3] ^ 1,)) + data[4:] if found else data)

    bench.wrap = lambda link: Damaging(link, Faults(), cut=False)
    with pytest.raises(ImageRejectedError) as caught:
        send(bench, small_file("P9N0=07", "P9N31=08"), [])
    assert (
        str(caught.value)
        == "the control has stopped the table for 300 s; the control contains the new P9N0 and the old values"
        " of the rest (what it contained before is kept in kept)"
    )
    assert bench.texts[-3:-1] == [
        STOPPED_TEXT,
        "the control has stopped the table for 300 s. End the load at the control",
    ]
    (displayed,) = [line for line in bench.screen if "FILE ERROR" in line]
    assert displayed.endswith(": a character with a parity error]")


def test_after_a_break_without_an_unload_it_is_reported_as_not_known(bench: NumBench) -> None:
    seen = 0

    class Cutting(FaultyLink):
        def write(self, data: bytes) -> None:
            nonlocal seen
            seen += len(data)
            if seen > 2_000:
                bench.refuses.add("unload")
                self.close()
            super().write(data)

    bench.wrap = lambda link: Cutting(link, Faults(), cut=False)
    with pytest.raises(ConnectionCutError) as caught:
        send(bench, small_file(), [])
    assert caught.value.at_control == "unknown"
    assert bench.clock.now < 200


def test_a_load_that_was_not_begun_at_the_control_is_noticed(bench: NumBench) -> None:
    bench.refuses.add("load")
    outcome = send(bench, small_file(), [])
    assert (outcome.verified, outcome.at_control) == (False, "old")
    assert outcome.text == "The control has taken nothing of it: nothing was replaced in the control."


def test_ctrl_c_before_the_last_unload_does_not_claim_that_the_control_has_taken_it(bench: NumBench) -> None:
    cancel, original = threading.Event(), bench.progress

    def progress(stage: str, done: int, total: int) -> None:
        original(stage, done, total)
        if stage == UNLOAD_TEXT and bench.texts.count(UNLOAD_TEXT) == 2:
            cancel.set()

    bench.refuses.add("load")
    bench.progress = progress
    with pytest.raises(CancelledError) as caught:
        send(bench, small_file(), [], cancel)
    assert caught.value.at_control == "unknown"


@pytest.mark.parametrize(
    ("lines", "state"), some([(0, "old"), (2, "old"), (3, "unknown"), (200, "unknown")], 2)
)
def test_ctrl_c_leaves_no_half_line_and_shows_what_is_known(bench: NumBench, lines: int, state: str) -> None:
    cancel = threading.Event()
    original = bench.progress

    def progress(stage: str, done: int, total: int) -> None:
        original(stage, done, total)
        if (stage, done) == ("download", lines) or (lines == 0 and stage == LOAD_TEXT):
            cancel.set()

    bench.progress = progress
    with pytest.raises(CancelledError) as caught:
        send(bench, small_file(), [], cancel)
    assert caught.value.at_control == state
    sent = bytes(byte & 0x7F for byte in bench.lines[0].sent)
    assert sent.count(b"\n") == lines
    assert sent == b"" or sent.endswith(b"\n"), "the line that was begun is whole"


class OneFault(FaultyLink):
    """A line on which one byte of what the control sends is changed, or lost where ``bit`` is 0."""

    def __init__(self, link: Link, at: int, bit: int) -> None:
        super().__init__(link, Faults(), cut=False)
        self._at, self._bit = at, bit

    def read(self, timeout: float) -> bytes:
        data = super().read(timeout)
        at, self._at = self._at, self._at - len(data)
        if not 0 <= at < len(data):
            return data
        changed = bytes((data[at] ^ self._bit,)) if self._bit else b""
        return data[:at] + changed + data[at + 1 :]


def test_a_damaged_unload_is_asked_for_again(bench: NumBench) -> None:
    bench.wrap = lambda link: OneFault(link, 9_000, 4)
    upload(bench.driver, Exchange(bench.progress))
    assert bench.texts == [
        UNLOAD_TEXT,
        "the table has arrived damaged: a character with a parity error in line 445: unload it once more. "
        + UNLOAD_TEXT,
    ]


def test_a_lost_byte_is_found_by_the_length_of_its_line(bench: NumBench) -> None:
    bench.wrap = lambda link: OneFault(link, 9_000, 0)
    upload(bench.driver, Exchange(bench.progress))
    assert (
        "the table has arrived damaged (the parameter table of the control: line 445, column"
        in bench.texts[1]
    )


class Hostile:
    """An other end that sends what a function makes of how often it was read."""

    bytes_per_second = None

    def __init__(self, bench: NumBench, answer: Callable[[int], bytes]) -> None:
        self._bench, self._answer, self._count = bench, answer, 0

    def read(self, timeout: float) -> bytes:
        self._count += 1
        data = self._answer(self._count)
        self._bench.clock.sleep(0.01 if data else timeout)
        return data

    def write(self, data: bytes) -> None:
        pass

    def close(self) -> None:
        pass


@pytest.mark.parametrize(
    ("answer", "kind"),
    some(
        [
            (lambda _: b"", ControlSilentError),
            (lambda _: b"\0" * 1_000, ImageDamagedError),
            (lambda _: b"%" * 1_000, ImageDamagedError),
            (lambda _: b"\xff" * 1_000, ImageDamagedError),
            (lambda n: b"%00000000;09\n" if n == 1 else b"\x11" * 10, ImageDamagedError),
            (lambda n: b"%00000000;09\n" if n == 1 else b"" if n % 100 else b"P", ImageDamagedError),
            (lambda n: b"x" if n % 150 == 0 else b"", ImageDamagedError),
        ],
        2,
    ),
)
def test_a_hostile_other_end_is_bounded(
    bench: NumBench, answer: Callable[[int], bytes], kind: type[TransferError]
) -> None:
    def open_link(_look: Callable[[], None]) -> Link:
        return Hostile(bench, answer)

    driver = PeripheralDriver(open_link, Waiting(bench.clock, bench.clock.sleep))
    with pytest.raises(kind):
        driver.identify()
    assert bench.clock.now < 3_700


def test_a_control_that_pauses_a_load_for_ever_is_left(bench: NumBench) -> None:
    content = upload(bench.driver, Exchange(bench.progress))

    def open_link(_look: Callable[[], None]) -> Link:
        return Hostile(bench, lambda n: b"\x11" if n == 2 else b"\x13")

    driver = PeripheralDriver(open_link, Waiting(bench.clock, bench.clock.sleep))
    with pytest.raises(TransferError) as caught:
        driver.send(Replacement(content, content))
    assert caught.value.at_control == "old", "no data line was sent"
    assert bench.clock.now < 5_000


def test_what_the_control_does_not_have_is_named(bench: NumBench) -> None:
    current = upload(bench.driver, Exchange(bench.progress))
    shorter = current.replace(b"P9N30:t0n32;0B\n#0 0;04\n", b"")
    assert b"P9N30" not in shorter
    with pytest.raises(ImageError, match="the control does not have P9N31, which the file sets"):
        bench.driver.encode(small_file("P9N31=08"), shorter)


def test_a_file_of_another_cnc_is_refused_as_the_control_would(bench: NumBench) -> None:
    current = upload(bench.driver, Exchange(bench.progress))
    other = current.replace(b"%00000000", b"%00000002")
    file = bench.driver.decode(other)
    with pytest.raises(ImageError, match="job reference 00000002, and this one has 00000000"):
        bench.driver.encode(file, current)
    with pytest.raises(ImageError, match="the copy is of a CNC with the job reference 00000002"):
        bench.driver.refit(other, current)


def test_a_new_file_is_loaded_under_the_job_reference_of_the_control(bench: NumBench) -> None:
    current = upload(bench.driver, Exchange(bench.progress)).replace(b"%00000000", b"%00000003")
    assert bench.driver.encode(new_file("num"), current).startswith(b"NUM table 1\n%00000003;09\n")


def test_the_driver_is_for_num_controls_and_sees_parity_itself() -> None:
    with pytest.raises(WrongFamilyError):
        PeripheralDriver.at(parse_endpoint("serial:/dev/none?protocol=peripheral"), "9pc")
    driver = PeripheralDriver.at(parse_endpoint("serial:/dev/none?bits=7&parity=even&stop=2"), "num")
    with pytest.raises(
        TransferError, match=r"no connection to the control: serial:/dev/none\?baud=9600&bits=8"
    ):
        driver.identify()
