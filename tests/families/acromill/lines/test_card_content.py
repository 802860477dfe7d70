"""Figures of an ACR card: signs, exponents, the digits that it shows, and settings of several figures."""

from functools import partial
from pathlib import Path

import pytest

from amp_studio.families.acromill.lines.content import CardContent, plain_figure, same_figures
from amp_studio.families.acromill.lines.driver import _figures_in
from amp_studio.schema import Value
from amp_studio.transfer.client.exchange import WantedContent, download, upload

from .bench import CardBench
from .test_terminal_driver import send, small_file


@pytest.mark.parametrize(
    ("answered", "plain"),
    [
        ("-0", "0"),
        ("-0.0", "0"),
        ("5.0", "5"),
        ("100", "100"),
        ("-1.5E-3", "-0.0015"),
        ("+4.50", "4.5"),
        ("1.5E+3", "1500"),
        ("2E12", "2000000000000"),
        (".5", "0.5"),
    ],
)
def test_a_figure_keeps_its_sign_and_loses_its_exponent(answered: str, plain: str) -> None:
    assert plain_figure(answered) == plain
    assert _figures_in(f"PGAIN X {answered}", "PGAIN X") == (plain,)
    assert _figures_in(f"({answered}, -7)", "NOTCH X") == (plain, "-7")


@pytest.mark.parametrize(
    ("one", "other", "same"),
    [
        (("1",), ("-1",), False),
        (("1", "2"), ("2", "1"), False),
        (("1.000001",), ("1",), False),
        (("1.0000001",), ("1",), True),
        (("-1234567.1",), ("-1234567",), True),
        (("0.001234567",), ("0.001234568",), False),
        (("0",), ("-0.0",), True),
        (("1",), (), False),
    ],
)
def test_figures_are_the_same_in_seven_digits_sign_and_order(
    one: tuple[str, ...], other: tuple[str, ...], same: bool
) -> None:
    """A card shows seven digits (pages 92 and 94)."""
    assert same_figures(one, other) is same
    assert same_figures(other, one) is same


def test_a_negative_gain_is_read_sent_and_put_back_with_its_sign(tmp_path: Path) -> None:
    bench = CardBench(tmp_path)
    bench.execute("PGAIN X-0.08")
    content = upload(bench.driver)
    assert bench.driver.decode(content).get(("servo.p_gain", "X")) == Value(-0.08, "V/count")
    assert send(bench, small_file(pgain="0.08"), []).verified
    back = WantedContent(partial(bench.driver.refit, content), small_file().schema.signature)
    assert download(bench.driver, back, lambda _: "kept").verified
    assert bench.card.settings.values["PGAIN X"] == "-0.08"


def test_a_figure_that_a_file_leaves_open_stays_as_the_card_has_it(tmp_path: Path) -> None:
    bench = CardBench(tmp_path)
    bench.execute("NOTCH X(500, 50)")
    current = upload(bench.driver)
    for file, figures in ((small_file(notch="600"), ("600", "50")), (small_file(width="70"), ("500", "70"))):
        assert CardContent.read(bench.driver.encode(file, current)).figures["NOTCH X"] == figures


def test_positions_of_a_table_are_sent_by_their_numbers() -> None:
    card = CardContent("inch", {}, {"BSC X10": "-.00100", "BSC X2": ".00325"})
    assert list(card.lines().values()) == ["BSC X2E.00325", "BSC X10E-.00100"]
    assert CardContent.read(card.written()) == card


def test_a_table_of_one_axis_read_again_leaves_that_of_another(tmp_path: Path) -> None:
    bench = CardBench(tmp_path)
    bench.execute("BSC X0E.00325")
    bench.execute("BSC Y0E-.00200")
    found = CardContent("inch", {}, {"BSC X0": ".00999", "BSC X7": ".00001", "BSC Y0": "-.00200"})
    bench.driver._read_into(found, "X")
    assert found.ballscrew == {"BSC X0": ".00325", "BSC Y0": "-.00200"}
