"""The published formulas as calculators, with arguments as a person writes them."""

import pytest

from amp_studio.cli import run
from amp_studio.schema import family_ids
from amp_studio.validate import calculate, calculators, formulas, shown_result


@pytest.mark.parametrize(
    ("name", "texts", "expected"),
    [
        ("gain_break_point", {"max_contouring": "5000", "gain": "1"}, "5"),
        ("gain_break_point", {"max_contouring": "5000", "gain": "0,5"}, "10"),  # a decimal comma
        (
            "synchronized_speed",
            {"requested": "1500", "controlling": "1000, 3000", "follower": "1800,3200"},
            "1800",
        ),
        (
            "synchronized_speed",
            {"requested": "1500", "controlling": "1000, 3000", "follower": "100,300"},
            "none",
        ),
        ("inside_zone", {"position": "5, 5", "limits": "[0, 10], [0, 10]"}, "yes"),
        ("sercos_cycles", {"scan_ms": "6"}, "1, 2, 3, 6"),
    ],
)
def test_a_formula_is_worked_out(name: str, texts: dict[str, str], expected: str) -> None:
    """Pages 7-22, 14-2, 6-4 and 7-4."""
    assert shown_result(calculate("9pc", name, texts)) == expected


@pytest.mark.parametrize(
    ("name", "texts", "message"),
    [
        ("nonsense", {}, "Unknown formula 'nonsense'"),
        ("gain_break_point", {"gain": "1"}, "needs max_contouring"),
        ("gain_break_point", {"max_contouring": "x", "gain": "1"}, "'x' is no max_contouring"),
        ("gain_break_point", {"max_contouring": "1 mm", "gain": "1"}, "'1 mm' is no max_contouring"),
        (
            "gain_break_point",
            {"max_contouring": "1", "gain": "1", "speed": "2"},
            "Unknown argument of gain_break_point 'speed'. Known: max_contouring, gain",
        ),
        ("gain_break_point", {"max_contouring": "1", "gain": "0"}, "greater than zero"),
        ("inside_zone", {"position": "5, 5", "limits": "0, 10"}, r"'0, 10' is no limits"),
        ("net_correction", {"corrections": '","'}, r"'\",\"' is no corrections"),
        ("net_correction", {"corrections": "[" * 100_000}, r"^'\[{59}…' is no corrections"),
        (
            "fine_scans_per_logic_scan",
            {
                "fine_ms": "1e-320",
                "fine_maximum_ms": "1e16",
                "activation_maximum_ms": "1e16",
                "logic_maximum_ms": "1",
            },
            "fine_scans_per_logic_scan cannot be calculated: a number is too large or too small",
        ),
    ],
)
def test_what_cannot_be_understood_is_reported_in_one_sentence(
    name: str, texts: dict[str, str], message: str
) -> None:
    with pytest.raises(ValueError, match=message):
        calculate("9pc", name, texts)


def test_every_formula_reports_itself_and_its_arguments() -> None:
    known = calculators("9pc")
    assert known.keys() == formulas("9pc").keys()
    assert [name for name, calculator in known.items() if not calculator.description.strip()] == []


def test_the_verb_lists_reports_and_works_out(capsys: pytest.CaptureFixture[str]) -> None:
    assert run(["calculate", "9pc"]) == 0
    assert len(capsys.readouterr().out.splitlines()) == len(formulas("9pc"))
    assert run(["calculate", "9pc", "gain_break_point"]) == 0
    assert "  gain=…" in capsys.readouterr().out
    assert run(["calculate", "9pc", "gain_break_point", "max_contouring=5000", "gain=1"]) == 0
    assert capsys.readouterr().out == "5\n"
    assert run(["calculate", "9pc", "gain_break_poin", "gain=1"]) == 2


EXAMPLES = {
    "float": "1",
    "int": "1",
    "bool": "yes",
    "str": "X",
    "tuple[float, float]": "0,1",
    "Sequence[float]": "1,2",
    "Sequence[tuple[float, float]]": "[1,2],[3,4]",
    "Iterable[float]": "1,2",
    "Sequence[str]": "X,X,Y",
    "Sequence[str | None]": "X0 1,none",
    "Iterable[tuple[str, float]]": "[REAL,1],[INT,4]",
    "float | None": "none",
    "Literal['leading', 'trailing']": "leading",
    "Sequence[Sequence[float]]": "[1,2],[3]",
    "Sequence[float | None]": "1,none",
}
"""Type of an argument -> how it is written."""


@pytest.mark.parametrize("family", family_ids())
def test_each_formula_takes_its_arguments_as_a_user_writes_them(family: str) -> None:
    for calculator in calculators(family).values():
        kinds = {
            a.name: getattr(a.kind, "__name__", "") if isinstance(a.kind, type) else str(a.kind)
            for a in calculator.arguments
        }
        texts = {
            name: EXAMPLES[kind.replace("collections.abc.", "").replace("typing.", "")]
            for name, kind in kinds.items()
        }
        answer = ""
        try:
            calculate(family, calculator.name, texts)
        except ValueError as error:  # these numbers may make no sense to it, but it was asked
            answer = f"{error} "
        assert not any(f"is no {name} " in answer for name in texts), f"{calculator.name}: {answer}"


def test_items_of_words_and_numbers_are_read() -> None:
    """28 + 1 x 4 and 28 + 4 x 2 bytes (page 34-4); consecutive jogs of an axis are one move (page 8-13)."""
    assert calculate("9pc", "watchlist_bytes", {"items": "[REAL,1],[INT,4]"}) == 68
    assert calculate("9pc", "watchlist_bytes", {"items": '[["REAL",1]]'}) == 32
    assert calculate("9pc", "remembered_retract_moves", {"jogged": "X,X,Y,X", "limit": "10"}) == 3
    assert calculate("9pc", "remembered_retract_moves", {"jogged": "1,1,2", "limit": "10"}) == 2
