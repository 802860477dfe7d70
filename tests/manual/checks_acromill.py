"""Names, units, defaults, typical values and ranges of the AcroMill database against the tabs of its guide,
pictures included, and the lists of gains of its appendix C.
"""

import re
from collections.abc import Iterator

from disagreements import Disagreement, at_line, nowhere
from manual_facts import PrintedChoice, PrintedRange, Section, StoredRow
from printed_book import Book, mentions, squashed

from amp_studio.schema import Parameter

KINDS = {"Boolean": "boolean", "Integer": "integer", "Float": "real", "Sign": "choice", "NA": ""}
"""Words of the column of units that are no units, and the type they mean."""
UNITS = {
    "volts/pulses of following error": "V/count",
    "volts/second/pulses of following error": "V/count/s",
    "volts/pulses of following error/second": "Vs/count",
    "volts/incoming setpoint pulses/second": "Vs/count",
    "volts/incoming setpoint pulses/sec ²": "Vs2/count",
    "Inch or mm per minute": "in/min",
    "Inch or mm per second": "in/min",
    "Inch or mm per sec per second": "in/s2",
    "Inch or mm per sec per sec": "in/s2",
    "Inch or mm": "in",
    "Degrees": "deg",
    "Radians": "rad",
    "second": "s",
    "volts": "V",
}
REPEATED = {"104": "61"}
"""The page of a chapter that repeats rows of a tab, and that of the tab."""
NOT_TYPICAL = {"", "NA", "Machine+", "Machine-", "User Choice", "User Defined", "X,Y...."}
"""Words of the column of typical values that name none."""
NO_FIGURES = {"Disable": "-1"}
"""What an integer without a figure is in the database (erratum e-io-disable)."""
SHORT = {
    "spd": "speed",
    "mach": "machine",
    "for": "forward",
    "back": "backward",
    "upm": "",
    "reqd": "required",
    "src": "source",
    "mult": "multiplier",
    "tangen": "tangent",
    "compensat": "compensation",
    "pos": "position",
    "excesserr": "excesserror",
    "units": "",
    "per": "",
    "linear": "",
    "unit": "",
    "travel": "",
    "in": "",
    "sec": "",
    "msec": "",
    "disp": "display",
    "big": "",
    "small": "",
    "stp": "stop",
    "colorviadcodes": "colorviadcodes",
}


def long(name: str) -> str:
    """Return a name with its short forms spelled out, squashed."""
    return "".join(SHORT.get(word, word) for word in re.findall(r"[a-z]+|[^a-z\s./()]+", name.lower()))


class Guide(Book):
    """The facts of the tabs and the database they are compared with."""

    def of_tab(self, section: Section) -> list[Parameter]:
        page = REPEATED.get(section.page, section.page)
        return [p for p in self.schema.parameters.values() if p.page == page]

    def called(self, section: Section, name: str) -> list[Parameter]:
        """Return what a name of a tab means: the same name, a longer form of it, or one named by an
        erratum.
        """
        here = self.of_tab(section)
        if found := [p for p in here if squashed(p.name) == squashed(name)]:
            return found
        if numbered := re.fullmatch(r"Pos (\d+)", name):
            positions = [p for p in here if p.name == f"{section.heading} Position"]
            return [p for p in positions if numbered[1] in self.schema.on("mill").instances(p)]
        if found := [p for p in here if long(name) in {long(p.name), long(section.heading + " " + p.name)}]:
            return found
        return [p for p in here if self.told(p, name)]

    def told(self, parameter: Parameter, name: str) -> bool:
        """Return whether an erratum of the parameter names what is printed."""
        readings = [r.says for key in parameter.errata for r in self.schema.errata[key].readings]
        return any(mentions(says, name) for says in readings)


def check_names(book: Guide) -> Iterator[Disagreement]:
    """Every printed name is that of one parameter of its tab, and every parameter of a tab is printed."""
    printed: set[str] = set()
    for section in book.sections:
        for row in section.stored:
            found = book.called(section, row.name)
            if len(found) != 1:
                content = ", ".join(parameter.id for parameter in found) or "nothing"
                yield at_line(
                    "names", section, row.line, row.name, f"is called {row.name!r}", f"calls so {content}"
                )
            elif (
                row.default
                and squashed(found[0].name) != squashed(row.name)
                and not book.told(found[0], row.name)
            ):
                yield at_line(
                    "names", section, row.line, row.name, f"is {row.name!r}", f"is {found[0].name!r}"
                )
            printed |= {parameter.id for parameter in found}
    pages = {section.page for section in book.sections}
    for parameter in book.schema.parameters.values():
        if parameter.page in pages and parameter.id not in printed:
            yield nowhere("names", parameter.id, f"is called {parameter.name!r}", "the tabs")


def check_values(book: Guide) -> Iterator[Disagreement]:
    """Every printed default and unit is in the database or explained, and every default there is printed."""
    printed: set[str] = set()
    for section in book.sections:
        for row in section.stored:
            for parameter in book.called(section, row.name)[:1]:
                printed |= {parameter.id} if row.default not in {"", "NA"} else set()
                yield from value_of(book, section, row, parameter)
    pages = {section.page for section in book.sections}
    for parameter in book.schema.parameters.values():
        if parameter.page in pages and parameter.default and parameter.id not in printed:
            yield nowhere("values", parameter.id, f"default {parameter.default.value}", "the tabs")


def value_of(book: Guide, section: Section, row: StoredRow, parameter: Parameter) -> Iterator[Disagreement]:
    """Yield the disagreements on a printed default, unit or value of a picture."""
    default = parameter.default
    labels = {choice.key: choice.label for choice in parameter.choices or ()}
    content = labels.get(str(default.value), str(default.value)) if default else "NA"
    errata = [book.schema.errata[key] for key in parameter.errata]
    if row.default and not alike(
        row.default if parameter.choices else NO_FIGURES.get(row.default, row.default), content
    ):
        doubted = any(
            any(mentions(reading.says, row.default) for reading in erratum.readings)
            and mentions(erratum.taken, content)
            for erratum in errata
        )
        if not doubted:
            yield at_line(
                "values", section, row.line, row.name, f"default {row.default}", f"default {content}"
            )
    if row.unit in KINDS:
        types = {KINDS[row.unit] or parameter.type, "bits" if row.unit == "Integer" else ""}
        if parameter.type not in types:
            yield at_line("values", section, row.line, row.name, row.unit, f"is {parameter.type}")
    elif row.unit:
        units = book.schema.units_of(parameter)
        doubts = [e.taken for e in errata if any(mentions(reading.says, row.unit) for reading in e.readings)]
        decided = [taken.replace("²", "2") for taken in doubts if "/" in taken]  # in/s² or mm/s²
        right = (
            any(unit in taken for unit in units for taken in decided)
            if decided
            else UNITS.get(row.unit) in units
        )
        if not right and not (parameter.choices and row.unit in UNITS):
            yield at_line("values", section, row.line, row.name, f"unit {row.unit}", f"units {units}")
    shown = row.codes.get("shown", "")
    known = {"Disable", *labels.values(), *(choice.code for choice in parameter.choices or ())}
    if (
        shown
        and parameter.choices
        and not any(one and shown.casefold().startswith(one.casefold()) for one in known)
    ):
        yield at_line("values", section, row.line, row.name, f"shows {shown}", f"has {labels}")


def check_typical(book: Guide) -> Iterator[Disagreement]:
    """Every typical value that is not the default is in the help."""
    for section in book.sections:
        for row in section.stored:
            typical = row.codes.get("typical", "")
            if typical in NOT_TYPICAL or typical == row.default:
                continue
            found = book.called(section, row.name)
            if not any(typical in f"{p.help.what} {p.help.find} {p.help.wrong}" for p in found):
                yield at_line(
                    "typical", section, row.line, row.name, f"typically {typical}", "does not tell it"
                )


def check_runs(book: Guide) -> Iterator[Disagreement]:
    """The runs of the tuning procedure are the printed lists of gains, one behind the other."""
    table = book.schema.tables["tuning-runs"]
    printed: dict[str, list[float]] = {name: [] for name in table.head[1:-1]}
    for section in book.sections:
        if section.defaults and section.page != table.page:
            yield at_line(
                "runs", section, section.line, table.title, "lists of gains", f"is of page {table.page}"
            )
        for fact in section.defaults:
            printed.setdefault(fact.number, []).append(float(fact.value))
    for name, values in printed.items():
        content = list(table.column(name) or ())
        if values != content:
            yield Disagreement("runs", 0, name, "the tuning procedure", f"{values}", f"{content}")


def alike(printed: str, content: str) -> bool:
    """Return whether a printed value is that of the database, as a figure or as a word."""
    try:
        return float(printed) == float(content)
    except ValueError:
        return printed.casefold() == content.casefold()


def check_ranges(book: Guide) -> Iterator[Disagreement]:
    """Every range in brackets is in the database."""
    for section in book.sections:
        for fact in section.ranges:
            yield from range_of(book, section, fact)
        for choice in section.choices:
            yield from choice_of(book, section, choice)


def range_of(book: Guide, section: Section, fact: PrintedRange) -> Iterator[Disagreement]:
    found = book.called(section, fact.applies)
    content = [tuple(both) for p in found for both in (p.ranges or {}).values()]
    if (float(fact.low), float(fact.high)) not in content:
        yield at_line("ranges", section, fact.line, fact.applies, f"{fact.low} to {fact.high}", f"{content}")


def choice_of(book: Guide, section: Section, fact: PrintedChoice) -> Iterator[Disagreement]:
    """Yield where a value that is explained in words is in no help."""
    found = book.called(section, fact.number)
    told = " ".join(f"{p.help.what} {p.help.find}" for p in found)
    if not any(mentions(told, fact.letter) and p.type == "integer" for p in found):
        yield at_line(
            "ranges", section, fact.line, fact.number, f"{fact.letter} {fact.text}", "does not tell it"
        )
