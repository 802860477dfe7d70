"""What is typed for a value may be an expression: exact, bounded,
and never of another quantity than the value.
"""

from pathlib import Path

import pytest

from amp_studio.files import ParameterFile, open_file
from amp_studio.schema import InvalidValueError, Value
from amp_studio.validate.cell_expression import Entered, enter, is_expression

EXCESS = ("servo.excess_error", "1")
RAPID = ("feedrate.rapid", "1")


@pytest.fixture(scope="module")
def file(checkout: Path) -> ParameterFile:
    """Return the example mill: rapid 10000 mm/min, excess error 11 mm on X, Y and Z."""
    return open_file(checkout / "examples" / "mill-1394" / "MILL_1394.amp").file


def typed(file: ParameterFile, text: str, address: tuple[str, str] = EXCESS) -> Entered:
    """Type a text for an address, by default the excess error of X."""
    return enter(file, address, text, lambda a: file.evaluation.unit(a, file.header.units))


@pytest.mark.parametrize(
    ("text", "number"),
    [
        ("25.4/5", 5.08),
        ("25,4/5", 5.08),
        ("=0.1+0.2", 0.3),  # in doubles 0.30000000000000004
        ("=3*1.1", 3.3),
        ("(1+2)*3", 9.0),
        ("1 in + 3 mm", 28.4),
        ("25.4 mm/5", 5.08),
        ("=2 × 3 ÷ 4 − 1", 0.5),
        ("=Y*1.5", 16.5),
        ("=excess_error@Z/2", 5.5),
        ('="Excess Error"@Z/2', 5.5),
        ("=#1750*2", 22.0),
        ("=min(1, 2)", 1.0),
        ("=min(3; 0,5)", 0.5),
        ("=max(0,5 mm; 0,7 mm)", 0.7),
        ("=abs(0,5)", 0.5),
        ("=max((0,5 + 1) * 2, 2)", 3.0),
        ("=max(Y, 1 in)", 25.4),
        ("=round(Y/2)", 6.0),
        ("=abs(1-Y)", 10.0),
        ("=figure(rapid)/1000", 10.0),
        ("=rapid/rapid", 1.0),
    ],
)
def test_an_expression_is_calculated_exactly_in_the_unit_of_the_cell(
    file: ParameterFile, text: str, number: float
) -> None:
    entered = typed(file, text)
    assert entered.value == Value(number, "mm")
    assert entered.expression == text.lstrip("=")


@pytest.mark.parametrize("text", ["=min(0,5 mm, 2 mm)", "=max(1,5)", "=min(3, 0,5)", "=max(Y, 2,5*3)"])
def test_a_comma_between_digits_of_several_values_is_not_guessed(file: ParameterFile, text: str) -> None:
    """``min(0,5 mm, 2 mm)`` was 0 mm, and ``max(1,5)`` 5 mm."""
    with pytest.raises(InvalidValueError, match=r"'\d,\d,?' can be read two ways: put semicolons between"):
        typed(file, text)


def test_a_name_is_the_value_in_the_unit_in_which_it_is_shown(file: ParameterFile) -> None:
    assert typed(file, "=rapid*0.8", RAPID).value == Value(8000.0, "mm/min")
    twin = file.copy()
    twin.set(("feedrate.rapid", "2"), Value(100.0, "in/min"))
    assert typed(twin, "=Y*2", RAPID).value == Value(5080.0, "mm/min")


def test_a_plain_value_stays_as_it_was_typed(file: ParameterFile) -> None:
    assert typed(file, "0.433 in") == Entered(Value(0.433, "in"), "")
    assert typed(file, "  ") == Entered(None, "")
    assert typed(file, "10 ipm", RAPID) == Entered(Value(10.0, "in/min"), "")
    assert not is_expression("-5")
    assert not is_expression("1e-5 mm")


def test_a_choice_can_be_that_of_another_axis(file: ParameterFile) -> None:
    assert typed(file, "=S", ("servo.position_loop_type", "1")).value == file.get(
        ("servo.position_loop_type", "5")
    )
    with pytest.raises(InvalidValueError, match="only the value of another one"):
        typed(file, "=1+1", ("servo.position_loop_type", "1"))


@pytest.mark.parametrize(
    ("text", "why"),
    [
        ("10 mm/min", "is given in mm, not in mm/min"),
        ("=rapid*0.8", "the result is in mm/min, and Excess Error is given in mm"),
        ("=1 mm + rapid", "cannot be added"),
        ("=1,234*2", "two ways: write 1234 or 1.234"),
        ("=1/0", "divides by 0"),
        ("=Y/(1-1)", "divides by 0"),
        ("=1e300*1e300", "too large"),
        ("=", "is empty"),
        ("=1+", "a value is missing behind '\\+' at the end"),
        ("=((1", "'\\)' is missing at the end"),
        ("=1 < 2", "'<' has no place"),
        ("=2**3", "a value is missing"),
        ("=__import__('os')", "is no parameter"),
        ("=gain*1", "several parameters: spindle.gain, sync.gain, deskew.gain"),
        ("=excess_error@9", "has @1 to @8"),
        ("=5 furlong*2", "'furlong' behind 5 is no unit"),
        ("=servo.position_loop_type*2", "is no number"),
        ("=eval(1)", "'eval' is no"),
        ("=" + "(" * 200 + "1" + ")" * 200, "the expression has 401 characters"),
        ("=" + "(" * 30 + "1" + ")" * 30, "more than 24 brackets"),
        ("=" + "-" * 250 + "1", "more than 100 operations"),
    ],
)
def test_what_cannot_be_understood_is_refused_in_a_sentence(file: ParameterFile, text: str, why: str) -> None:
    with pytest.raises(InvalidValueError, match=why):
        typed(file, text)


@pytest.mark.parametrize("text", ["=1310+1", "1310*2", "=(1 + 1310) mm"])
def test_a_bare_number_that_is_one_of_a_parameter_is_asked_about(file: ParameterFile, text: str) -> None:
    with pytest.raises(
        InvalidValueError, match=r"^1310 is also the number of .*: write #1310 .*, or 1310\.0 "
    ):
        typed(file, text)
    assert typed(file, text.replace("1310", "1310.0").replace(" mm", "")).value is not None
    assert typed(file, "=25*4").value == Value(100.0, "mm")  # 25 is the number of a parameter too


def test_the_minus_sign_of_a_pdf_is_a_minus(file: ParameterFile) -> None:
    assert typed(file, "\u221212,5 mm").value == Value(-12.5, "mm")
    assert typed(file, "1e\u22123").value == Value(0.001, "mm")
    assert typed(file, "=3 \u2212 5").value == Value(-2.0, "mm")


def test_a_value_that_is_not_set_is_not_0(file: ParameterFile) -> None:
    twin = file.copy()
    twin.set(("servo.excess_error", "2"), None)
    with pytest.raises(InvalidValueError, match="is not set"):
        typed(twin, "=Y*2")
    with pytest.raises(InvalidValueError, match="is not set"):
        typed(twin, "=Y")


def test_a_whole_number_is_not_rounded_in_silence(file: ParameterFile) -> None:
    counts = next(
        (p.id, i)
        for p in file.schema.parameters.values()
        if p.type == "integer" and not p.choices
        for i in file.machine_schema.instances(p)
        if not file.schema.units_of(p)[0]
    )
    assert typed(file, "=4096*2", counts).value == Value(8192)
    with pytest.raises(InvalidValueError, match=r"result is 0.5: use round\(…\)"):
        typed(file, "=1/2", counts)


def test_a_secret_is_in_no_expression(file: ParameterFile) -> None:
    secret = next(p for p in file.schema.parameters.values() if p.secret)
    with pytest.raises(InvalidValueError, match="is secret"):
        typed(
            file,
            f"={secret.id}@{i}*1" if (i := file.machine_schema.instances(secret)[0]) else f"={secret.id}*1",
        )


@pytest.mark.parametrize(
    ("text", "message"),
    [
        ("=1e-99123456789012345678999999", "too small"),
        ("=1e-300*1e-300", "too small"),
        ("=1e300*1e300", "too large"),
        ("=1" + "*1e300" * 40, "too large"),
    ],
)
@pytest.mark.parametrize("parameter_id", ["servo.excess_error", "servo.feed_forward"])
def test_a_result_that_no_number_has_is_refused(
    file: ParameterFile, text: str, message: str, parameter_id: str
) -> None:
    ids = {p.id: a for a in file.addresses() for p in [file.schema.parameters[a[0]]]}
    with pytest.raises(InvalidValueError, match=message):
        typed(file, text, ids[parameter_id])
