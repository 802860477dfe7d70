"""A session ends well over bad lines, and where it cannot, it reports truly what the control contains."""

import random
from collections.abc import Callable
from typing import Any

import pytest
from hypothesis import HealthCheck, given, settings
from hypothesis import strategies as st

from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.errors import ConnectionCutError, ControlSilentError, TransferError
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.links.link import LinkError
from tests.campaigns import CAMPAIGN, examples
from tests.transfer.images import NEW, OLD, send

STRIDE = 1 if CAMPAIGN else 4
"""Bytes between two cuts."""


def test_a_line_cut_at_any_byte_is_made_again_and_the_download_done(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    cut_at, was_cut, resumed = -STRIDE, True, 0
    while was_cut:
        cut_at += STRIDE
        made = rig(Faults(drop_after_bytes=cut_at), control=new_control(initial=OLD))
        sent = send(made.session())
        was_cut = made.modem.lines > 1
        resumed += sent.reconnections > 1
        assert made.control.image == NEW, f"cut at byte {cut_at}"
        assert made.control.memory.read("previous.img") == OLD
        assert made.control.boot_count <= 2, "one commit, one restart"
        made.control.close()
    assert cut_at > 400, "the whole exchange was cut through"
    assert resumed > 250 / STRIDE


def test_a_line_cut_at_any_byte_for_good_ends_with_the_truth(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    cut_at, was_cut, ends = -STRIDE, True, set()
    while was_cut:
        cut_at += STRIDE
        made = rig(Faults(drop_after_bytes=cut_at), control=new_control(initial=OLD), lines=1)
        try:
            send(made.session())
            at_control = "new"
            was_cut = False
        except ConnectionCutError as error:
            at_control = error.at_control
        truth = {OLD: "old", NEW: "new"}[made.control.image]
        assert at_control in {truth, "unknown"}, f"cut at byte {cut_at}: said {at_control}, and it is {truth}"
        ends.add((at_control, truth))
        made.control.close()
    assert ends == {("old", "old"), ("unknown", "old"), ("unknown", "new"), ("new", "new")}


def test_a_line_that_is_cut_again_and_again_still_gets_there(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(Faults(drop_after_bytes=480, drops=0), control=control())
    send(made.session(), NEW * 12)
    assert made.control.image == NEW * 12
    assert made.modem.lines > 5


def test_an_upload_goes_on_with_what_has_come(
    rig: Callable[..., Any], new_control: Callable[..., Any]
) -> None:
    image = random.Random(5).randbytes(20_000)
    made = rig(
        Faults(drop_after_bytes=6_000, drops=0), control=new_control(initial=image), bytes_per_second=11_520
    )
    told: list[int] = []
    stages: list[str] = []

    def note(stage: str, done: int, total: int) -> None:
        stages.append(stage)
        if stage == "upload":
            told.append(done)

    assert made.session().fetch(Exchange(note)) == image
    assert stages.count("cut") == stages.count("silent") == made.modem.lines - 1 > 2, (
        "each cut is told, and its end"
    )
    assert told == sorted(told), "nothing was read twice"


@pytest.mark.parametrize("latency", [0.0, 0.016])
@pytest.mark.parametrize(
    "faults",
    [
        Faults(corrupt_every=1_009),
        Faults(corrupt_every=331),
        Faults(corrupt_every=211, drop_after_bytes=700),
        Faults(lose_every=401),
        Faults(lose_every=503, corrupt_every=307),
    ],
    ids=str,
)
def test_dirty_lines_give_the_exact_image(
    rig: Callable[..., Any], control: Callable[..., Any], faults: Faults, latency: float
) -> None:
    image = random.Random(3).randbytes(4_000)
    made = rig(faults, control=control(), bytes_per_second=11_520, latency=latency, patience=120)
    session = made.session()
    send(session, image)
    session.wait_restarted(1, 60)
    assert session.fetch() == image


def test_a_hopeless_line_ends_in_time_and_with_the_truth(
    rig: Callable[..., Any], control: Callable[..., Any]
) -> None:
    made = rig(Faults(corrupt_every=13), control=control(), patience=20)
    with pytest.raises(ControlSilentError) as caught:
        send(made.session())
    assert caught.value.at_control == "old"
    assert "nothing was replaced" in str(caught.value)
    assert made.control.image == OLD
    assert made.clock.now < 60


class NoisyLink:
    """A link on which bytes change, vanish and appear, and which is cut now and then."""

    bytes_per_second = 11_520.0

    def __init__(self, link: Any, chance: random.Random, one_in: int) -> None:
        self._link = link
        self._chance = chance
        self._one_in = one_in

    def read(self, timeout: float) -> bytes:
        return self._corrupt(self._link.read(timeout))

    def write(self, data: bytes) -> None:
        self._link.write(self._corrupt(data))

    def close(self) -> None:
        self._link.close()

    def _corrupt(self, data: bytes) -> bytes:
        out, random_up_to = bytearray(), self._chance.randrange
        for byte in data:
            if random_up_to(self._one_in):
                out.append(byte)
            elif (what := random_up_to(4)) == 0:
                out.append(random_up_to(256))
            elif what == 1:
                out += bytes((byte, random_up_to(256)))
            elif what == 2:
                raise LinkError("noise", "cut")
        return bytes(out)


@settings(max_examples=examples(60), suppress_health_check=[HealthCheck.function_scoped_fixture])
@given(chance=st.randoms(use_true_random=False), one_in=st.integers(60, 2_000))
def test_noise_of_any_kind_never_gives_a_wrong_image(
    rig: Callable[..., Any], new_control: Callable[..., Any], chance: random.Random, one_in: int
) -> None:
    made = rig(control=new_control(initial=OLD), bytes_per_second=11_520, patience=30)
    connect = made.modem.connect
    made.modem.connect = lambda: NoisyLink(connect(), chance, one_in)
    try:
        send(made.session())
        said = "new"
    except TransferError as error:
        said = error.at_control
    truth = {OLD: "old", NEW: "new"}[made.control.image]
    made.control.close()
    assert said in {truth, "unknown"}


def test_a_download_fills_the_line(rig: Callable[..., Any], control: Callable[..., Any]) -> None:
    """32 KiB at 115200 bit/s: at least nine tenths of the line, and 85 % with 16 ms each way."""
    image = random.Random(1).randbytes(32_768)
    for latency, least in ((0.0, 0.90), (0.016, 0.85)):
        made = rig(control=control(), bytes_per_second=11_520, latency=latency, window=16, chunk=512)
        session = made.session()
        session.hello()
        send(session, image)
        assert len(image) / 11_520 / made.clock.now >= least
        made.control.close()
