"""Orders at the emulated controls in any sequence: nothing that an operator gives ends a control, a homed
axis stays inside its travel, and an order that comes later takes the place of what was still to follow.
"""

import contextlib
import math
import random
from collections.abc import Callable
from pathlib import Path

import pytest

from amp_studio.families.acromill.emulated.settings import CommandError
from tests.families.acromill.lines.bench import CardBench
from tests.families.grblhal.test_emulated_motion import Bench as GrblBench
from tests.families.ninepc.test_emulated_machine_keys import Bench as PanelBench
from tests.families.num.emulated.test_manual_keys import Bench as NumBench
from tests.families.test_emulated_homing import GAINS

ORDERS = 60
PAUSES = (0.0, 0.1, 0.5, 3.0)
"""s of the machine's time after an order."""
NUM = (
    "jog X+ slow|jog X- fast|jog Y+ normal|jog Z- reduced|jog B+|release|homing X|homing Y|homing B|position|"
    "fault drive X|fault feedback Y|jog Q+|jog X|homing|fault|jog X+ 7"
)
NINE_PC = (
    "jog X+ second|jog X- increment largest|jog Y+|jog Z-|release|manual-home X|mdi G28 X0|mdi G28 X5 Y5 Z-3|"
    "mdi G0 X10 Y5|mdi G1 X100 F5000|mdi G1 X900 F9000|mdi G0 Z-1000|mdi G0 B370|fault drive X|mdi G1 X5|"
    "mdi G0 F5|jog S+|mdi G0 X."
)
CARD = (
    "JOG FWD X|JOG REV X|JOG OFF X|JOG ABS X2|JOG INC Y-1|JOG VEL X3|JOG ACC X0|MOV X1 Y2|HALT|RES X0|VEL 2|"
    "VEL|JOG|JOG FWD Q|MOV X|?P12294|PPU X4096|PPU X0|op:home X|op:home XYZ|op:mdi G0 X1|op:mdi G1 Y2 F30|"
    "op:mdi G28 X0 Y0|op:status|op:fault drive X|op:stop"
)
GRBL = (
    "$H|$X|$J=G91 X10 F3000|$J=X-500 F6000|G0 X-50 Y-50|G91 G1 X30 F2000|G28|!|~|\x18|\x85|$$|$110=100|"
    "G0 X9999|G1 X1e9 F1|$20=0|$20=1|\x84|$J=|G0 X..|%"
)


def orders(words: str, seed: int, give: Callable[[str], object], after: Callable[[float], object]) -> None:
    """Give random orders, and let the machine move after each; a refusal is an answer."""
    chance = random.Random(seed)
    for _ in range(ORDERS):
        with contextlib.suppress(ValueError, CommandError):
            give(chance.choice(words.split("|")))
        after(chance.choice(PAUSES))


@pytest.mark.parametrize("seed", [1, 2])
def test_the_panel_of_a_num_keeps_its_homed_axes_inside(tmp_path: Path, seed: int) -> None:
    """P17 of the example is -1 to 600 mm; the fastest jog runs over it by its following error, 6 mm."""
    bench = NumBench(tmp_path)

    def after(seconds: float) -> None:
        bench.after(seconds)
        for axis in bench.control.screen().axes:
            assert axis.position is not None
            assert math.isfinite(axis.position)
            if axis.axis == "X" and "homed" in axis.states:
                assert -13.0 < axis.position < 612.0

    orders(NUM, seed, bench.control.operate, after)


@pytest.mark.parametrize("seed", [1, 2])
def test_the_panel_of_a_9pc_keeps_its_homed_axes_inside(tmp_path: Path, seed: int) -> None:
    """The overtravels of X are -500 and 8 mm, and a rapid stops 10 mm behind them."""
    bench = PanelBench(tmp_path / "state")

    def after(seconds: float) -> None:
        bench.control.set_estop(False)
        bench.after(seconds)
        for axis in bench.panel.screen(bench.control).axes:
            assert axis.position is not None
            assert math.isfinite(axis.position)
            if axis.axis == "X" and "homed" in axis.states:
                assert -512.0 < axis.position < 20.0

    try:
        orders(NINE_PC, seed, bench.give, after)
    finally:
        bench.control.close()


def card_bench(folder: Path) -> CardBench:
    bench = CardBench(folder)
    for line in GAINS.split("|"):
        bench.card._done(line)
    return bench


@pytest.mark.parametrize("seed", [1, 2])
def test_a_card_answers_whatever_is_asked_of_it(tmp_path: Path, seed: int) -> None:
    card = card_bench(tmp_path).card

    def give(line: str) -> object:
        return card.operate(line[3:]) if line.startswith("op:") else card._done(line)

    def after(seconds: float) -> None:
        card.advance(seconds)
        assert math.isfinite(float(card._done("?P6144")[0]))

    orders(CARD, seed, give, after)


@pytest.mark.parametrize("seed", [1, 2])
def test_a_grbl_reports_whatever_is_asked_of_it(tmp_path: Path, seed: int) -> None:
    bench = GrblBench(tmp_path)

    def after(seconds: float) -> None:
        bench.after(seconds)
        assert all(math.isfinite(place) for place in bench.status()[1])

    orders(GRBL, seed, bench.identity_word, after)


def test_a_setting_that_makes_no_axis_ends_what_was_to_follow_and_not_the_card(tmp_path: Path) -> None:
    card = card_bench(tmp_path).card
    card.operate("home X")
    for _ in range(85):
        card.advance(0.1)
    card.operate("mdi G28 X2")
    card.advance(0.1)
    card._done("PPU X0")
    for _ in range(100):
        card.advance(0.1)
    assert "at rest" in card.operate("status")


def test_an_incremental_jog_takes_the_place_of_the_way_home(tmp_path: Path) -> None:
    """G28 goes over a point (5-13); a key that is pressed before it is there ends that."""
    bench = PanelBench(tmp_path / "state")
    try:
        bench.give("mdi G28 X0")
        bench.after(20.0)
        bench.give("mdi G28 X-100")
        bench.after(0.3)
        bench.give("jog X- increment largest")
        bench.after(10.0)
        there = bench.panel.screen(bench.control).axes[0].position
    finally:
        bench.control.close()
    assert there is not None
    assert there < 0.0
