"""The families whose databases are compared with their manuals: checks, counts of facts,
and what no check may miss.
"""

from collections.abc import Iterator
from dataclasses import replace
from functools import cache
from typing import Any

import checks_9pc
import checks_57c422b
import checks_acromill
import checks_num
import checks_syntec
import patch_9pc
from altered import OUT_OF_THE_WAY, Fact, Nested, each, left_out, only, together
from book_9pc import Reference
from family import AlteredEntry, AlteredFact, Family, printed
from manual_facts import PrintedNumber, PrintedRange

from amp_studio.schema import Choice, Parameter, load_schema


def parameter(family: str, parameter_id: str) -> Parameter:
    """Return a parameter of the database as it is."""
    return load_schema(family).parameters[parameter_id]


# -- 9/PC -------------------------------------------------------------------------------------------------

HOME, LOOP, ZONES = "home.calibration", "servo.position_loop_type", "zone.group"
MM, INCH = (-999999.99, 999999.99), (-39370.07835, 39370.07835)


def choices(parameter_id: str, **first: object) -> tuple[Choice, ...]:
    """Return the choices of a parameter with its first one changed, or without it."""
    one, *rest = parameter("9pc", parameter_id).choices or ()
    return (one.model_copy(update=first), *rest) if first else tuple(rest)


@cache
def number_of_another_section() -> dict[str, str]:
    """Return number -> one that another section describes."""
    tabled = [n.number for section in printed("9pc") for n in section.numbers if n.place == "table"]
    return dict(zip(tabled, [*tabled[20:], *tabled[:20]], strict=True))


def other_number(fact: PrintedNumber) -> Iterator[tuple[str, PrintedNumber]]:
    """Yield a described number as another one."""
    for number in (number_of_another_section()[fact.number], OUT_OF_THE_WAY):
        yield f"number {number}", replace(fact, number=number)


def other_place(fact: Fact) -> Iterator[tuple[str, Fact]]:
    """Yield a number with what is printed beside and above it altered."""
    other = {"process 1": "process 2", "process 2": "process 1", "single process": ""}
    for key in ("axis", "spindle", "pair", "process"):
        if (message := getattr(fact, key)) and (now := other.get(message, "9")):
            yield key, replace(fact, **{key: now})


NINEPC = Family(
    key="9pc",
    book_class=Reference,
    checks={
        "numbers": checks_9pc.check_numbers,
        "ranges": checks_9pc.check_ranges,
        "choices": checks_9pc.check_choices,
        "stored": patch_9pc.check_stored,
    },
    judges={
        "numbers": checks_9pc.numbers_of,
        "ranges": checks_9pc.ranges_of,
        "choices": checks_9pc.choices_of,
        "stored": patch_9pc.rows_of,
    },
    counts={"numbers": 1376, "ranges": 254, "choices": 857, "stored": 225},
    described=1330,
    facts=(
        AlteredFact("numbers", "numbers", only(lambda fact: fact.place == "table", other_number)),
        AlteredFact("numbers", "numbers", other_place),
        AlteredFact("ranges", "ranges", together(low=OUT_OF_THE_WAY)),
        AlteredFact("ranges", "ranges", together(low="Unheard-of Limit")),
        AlteredFact("ranges", "ranges", together(high=OUT_OF_THE_WAY)),
        AlteredFact("ranges", "ranges", together(high="Unheard-of Limit")),
        AlteredFact("ranges", "ranges", only(lambda fact: fact.unit != "Hz", each(unit=("Hz",)))),
        AlteredFact("choices", "choices", together(letter="z")),
        AlteredFact("choices", "choices", together(text="Unheard of")),
        # A screen shows what a table prints.
        AlteredFact("choices", "choices", only(lambda fact: not fact.number, left_out)),
    ),
    entries=(
        AlteredEntry("numbers", HOME, {"numbers": Nested(start=1301)}, "1300"),
        AlteredEntry("numbers", HOME, {"name": "Homing Calibration"}, "is named 'Homing Calibration'"),
        AlteredEntry("numbers", HOME, {"page": "5-11"}, "has page 5-11"),
        AlteredEntry("numbers", HOME, {"instances": ("1", "2", "3")}, "8300"),
        AlteredEntry("ranges", HOME, {"ranges": {"mm": (MM[0], 999999.9), "in": INCH}}, "line 2280"),
        AlteredEntry("ranges", HOME, {"ranges": {"mm": MM}}, "line 2284"),
        AlteredEntry(
            "ranges", HOME, {"ranges": {"mm": MM, "in": INCH, "deg": (0.0, 360.0)}}, f"{HOME} [deg]"
        ),
        AlteredEntry("choices", ZONES, {"choices": choices(ZONES)}, "(a) Belongs to no groups"),
        AlteredEntry("choices", ZONES, {"choices": choices(ZONES, code="z")}, "(a) Belongs to no groups"),
        AlteredEntry(
            "choices", ZONES, {"choices": choices(ZONES, label="Belongs to none")}, "(a) Belongs to no groups"
        ),
        AlteredEntry("stored", HOME, {"default": Nested(value=1.0)}, "default 1.0 mm"),
        AlteredEntry("stored", HOME, {"default": None}, "has no default"),
        AlteredEntry(
            "stored", HOME, {"ranges": {"mm": (MM[0], 999999.9), "in": INCH}}, "high bound 999999.99000 mm"
        ),
        AlteredEntry("stored", HOME, {"storage": Nested(unit="in")}, "is kept in in"),
        AlteredEntry("stored", HOME, {"patchable": False}, "does not call it patchable"),
        AlteredEntry("stored", ZONES, {"patchable": True}, "calls it patchable"),
        AlteredEntry("stored", LOOP, {"choices": choices(LOOP, raw=9)}, "has no code 9"),
        AlteredEntry("stored", LOOP, {"default": Nested(value="off")}, "default Servo Off"),
    ),
)

# -- NUM --------------------------------------------------------------------------------------------------

GROUPS, MEASURED, LINE = "axes.cnc_groups", "axes.measured", "comm.master_line"


def is_judged(fact: PrintedRange) -> bool:
    """Return whether a bound must be in the database: a recommendation need not,
    and the range of a type is the limit of others.
    """
    return fact.note != "recommended" and not fact.applies.startswith("type ")


NUM = Family(
    key="num",
    book_class=checks_num.Words,
    checks={
        "list": checks_num.check_list,
        "words": checks_num.check_words,
        "bits": checks_num.check_bits,
        "codes": checks_num.check_codes,
        "defaults": checks_num.check_defaults,
        "ranges": checks_num.check_ranges,
    },
    judges={
        "list": checks_num.listed_of,
        "words": checks_num.words_of,
        "bits": checks_num.bits_of,
        "codes": checks_num.codes_of,
        "defaults": checks_num.defaults_of,
        "ranges": checks_num.ranges_of,
    },
    counts={
        "listed": 111,
        "sizes": 88,
        "words": 592,
        "bits": 42,
        "choices": 28,
        "defaults": 55,
        "ranges": 34,
    },
    described=0,
    facts=(
        AlteredFact("list", "listed", together(number="P999")),
        AlteredFact("list", "listed", together(type="3")),
        AlteredFact("list", "listed", together(page="1-1")),
        AlteredFact("list", "listed", together(category="Unheard of")),
        AlteredFact("words", "sizes", together(words=9999)),
        AlteredFact("words", "sizes", together(type="3")),
        AlteredFact("words", "sizes", together(number="P999")),
        AlteredFact("words", "words", together(word="N99")),
        AlteredFact("words", "words", together(number="P999")),
        AlteredFact("bits", "bits", together(bits="77")),
        AlteredFact("bits", "bits", together(word="N99")),
        AlteredFact("codes", "choices", together(letter="1000")),
        AlteredFact("codes", "choices", together(text="Unheard of")),
        AlteredFact("codes", "choices", together(applies="29-28")),
        AlteredFact("defaults", "defaults", together(value="87654")),
        AlteredFact("defaults", "defaults", together(word="N99", value="87654")),
        AlteredFact("ranges", "ranges", only(is_judged, together(low="87654"))),
        AlteredFact("ranges", "ranges", only(is_judged, together(high="87654"))),
        AlteredFact("ranges", "ranges", only(is_judged, together(applies="P97 N99"))),
    ),
    entries=(
        AlteredEntry("list", MEASURED, {"page": "4-10"}, "page 4-10"),
        AlteredEntry("list", MEASURED, {"storage": Nested(code=0)}, "type 0"),
        AlteredEntry("list", MEASURED, {"numbers": Nested(format="P121N0")}, "P121"),
        AlteredEntry("words", GROUPS, {"numbers": Nested(format="P97N2")}, "has N2"),
        AlteredEntry("words", GROUPS, {"numbers": Nested(format="P97N1")}, "lacks N0"),
        AlteredEntry("words", GROUPS, {"storage": Nested(code=7)}, "type 7"),
        AlteredEntry("bits", "misc.functions_more", {"bits": None, "storage": Nested(bits=4)}, "bit 4"),
        AlteredEntry("codes", "measure.channel_check", {"bits": None}, "000 32 µs"),
        AlteredEntry("defaults", LINE, {"default": None}, "default $FF"),
        AlteredEntry("defaults", "misc.block_time", {"default": Nested(value=21)}, "default 20 ms"),
        AlteredEntry("defaults", "misc.block_time", {"default": Nested(unit="s")}, "default 20 ms"),
        AlteredEntry("ranges", GROUPS, {"ranges": {"": (1, 9)}}, "1 to 8"),
        AlteredEntry("ranges", "axes.increment", {"ranges": {"": (0, 65534)}}, "65534"),
    ),
)

# -- 57C422B ----------------------------------------------------------------------------------------------

MODULE = Family(
    key="57c422b",
    book_class=checks_57c422b.Module,
    checks={
        "numbers": checks_57c422b.check_numbers,
        "choices": checks_57c422b.check_choices,
        "ranges": checks_57c422b.check_ranges,
        "stored": checks_57c422b.check_stored,
    },
    counts={"numbers": 267, "ranges": 15, "choices": 124, "stored": 17},
    described=56,
    facts=(
        AlteredFact("numbers", "numbers", each(number=("7654", "7654,7655"), name=("Unheard of",))),
        AlteredFact("choices", "choices", each(letter=("99",), text=("Unheard of",), number=("7654",))),
        AlteredFact("ranges", "ranges", each(low=(OUT_OF_THE_WAY,), high=(OUT_OF_THE_WAY,))),
        AlteredFact("stored", "stored", each(default=(OUT_OF_THE_WAY,), unit=("Hz",), numbers=(("7654",),))),
    ),
    entries=(
        AlteredEntry("numbers", "setup.in_position_tolerance", {"page": "4-11"}),
        AlteredEntry("numbers", "setup.in_position_tolerance", {"name": "Window"}),
        AlteredEntry("numbers", "setup.overtravel_positive", {"storage": None}),
        AlteredEntry("numbers", "cam.time_points", {"page": "4-58"}),
        AlteredEntry("choices", "control.mode", {"bits": ()}),
        AlteredEntry("ranges", "output.max_voltage", {"ranges": {"V": (0.0, 12.0)}}),
        AlteredEntry("ranges", "setup.in_position_tolerance", {"ranges": {"counts": (0.0, 9.0)}}),
        AlteredEntry("stored", "status.velocity_period", {"default": None}),
        AlteredEntry("stored", "setup.in_position_tolerance", {"storage": None}),
    ),
)

# -- Syntec -----------------------------------------------------------------------------------------------


def moved_end(fact: PrintedNumber) -> Iterator[tuple[str, PrintedNumber]]:
    """Yield a span of numbers that begins later, and one that ends earlier."""
    first, _, last = fact.number.partition("~")
    for number in (f"{int(first) + 1}~{last}", f"{first}~{int(last) - 1}") if last else ():
        yield f"number {number}", replace(fact, number=number)


SYNTEC = Family(
    key="syntec",
    book_class=checks_syntec.Slides,
    checks={
        "numbers": checks_syntec.check_numbers,
        "choices": checks_syntec.check_choices,
        "ranges": checks_syntec.check_ranges,
        "stored": checks_syntec.check_stored,
    },
    counts={"numbers": 106, "ranges": 2, "choices": 30, "stored": 11},
    described=27,
    facts=(
        AlteredFact("numbers", "numbers", each(number=("7654", "7654~7673"), name=("Unheard of",))),
        AlteredFact("numbers", "numbers", moved_end),
        AlteredFact("choices", "choices", each(letter=("9",), text=("Unheard of",), number=("7654",))),
        AlteredFact("ranges", "ranges", each(low=(OUT_OF_THE_WAY,), high=(OUT_OF_THE_WAY,), unit=("Hz",))),
        AlteredFact(
            "stored", "stored", each(default=(OUT_OF_THE_WAY,), unit=("Hz",), codes=({"21 series": "77"},))
        ),
    ),
    entries=(
        AlteredEntry("numbers", "home.offset", {"page": "2.2.2.1"}),
        AlteredEntry("numbers", "home.offset", {"name": "Shift"}),
        AlteredEntry("numbers", "home.zero_speed_window", {"page": "2.2.5.1"}),
        AlteredEntry("numbers", "home.zero_speed_window", {"instances": ("1", "2")}),
        AlteredEntry("choices", "resolution.multiplication", {"choices": None}),
        AlteredEntry("ranges", "limit.first_positive", {"ranges": {"BLU": (0, 1)}}),
        AlteredEntry("ranges", "limit.second_positive", {"ranges": {"BLU": (0, 1)}}),
        AlteredEntry("stored", "limit.first_positive", {"default": None}),
        AlteredEntry("stored", "mpg.acceleration_time", {"unit": "s"}),
        AlteredEntry("stored", "mpg.port", {"unit": "ms"}),
    ),
)

# -- AcroMill ---------------------------------------------------------------------------------------------

ACROMILL = Family(
    key="acromill",
    book_class=checks_acromill.Guide,
    checks={
        "names": checks_acromill.check_names,
        "values": checks_acromill.check_values,
        "ranges": checks_acromill.check_ranges,
        "typical": checks_acromill.check_typical,
        "runs": checks_acromill.check_runs,
    },
    counts={"ranges": 3, "choices": 3, "stored": 268, "defaults": 108},
    described=0,
    facts=(
        AlteredFact("names", "stored", each(name=("Unheard of",))),
        AlteredFact("values", "stored", each(default=(OUT_OF_THE_WAY,), unit=("Hz",))),
        AlteredFact(
            "ranges", "ranges", each(low=(OUT_OF_THE_WAY,), high=(OUT_OF_THE_WAY,), applies=("Unheard of",))
        ),
        AlteredFact("ranges", "choices", each(letter=("99",), number=("Unheard of",))),
        AlteredFact("typical", "stored", each(codes=({"typical": OUT_OF_THE_WAY},))),
        AlteredFact("runs", "defaults", each(number=("Unheard of",), value=(OUT_OF_THE_WAY,))),
    ),
    entries=(
        AlteredEntry("names", "home.preset", {"name": "Shift"}),
        AlteredEntry("names", "axes.inposition_band", {"page": "61"}),
        AlteredEntry("values", "jog.rapid", {"default": None}),
        AlteredEntry("values", "jog.rapid", {"quantity": "length"}),
        AlteredEntry("values", "home.stop", {"quantity": "velocity"}),
        AlteredEntry(
            "values", "fov.increment_percent", {"default": parameter("acromill", "jog.rapid").default}
        ),
        AlteredEntry("ranges", "control.path_color", {"ranges": {"": (0.0, 14.0)}}),
        AlteredEntry(
            "typical",
            "jog.deceleration",
            {"help": parameter("acromill", "jog.stop").help.model_copy(update={"find": ""})},
        ),
    ),
)

FAMILIES: dict[str, Family[Any]] = {family.key: family for family in (NINEPC, NUM, MODULE, SYNTEC, ACROMILL)}
