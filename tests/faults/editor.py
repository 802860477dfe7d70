"""What the editor and its documents take from others: blocks of the clipboard, expressions in cells,
templates of a project.
"""

import random
from collections.abc import Iterator
from functools import cache
from pathlib import Path
from unittest import mock

from amp_studio.files import ParameterFile, new_file
from amp_studio.formats.spreadsheet_block import (
    BlockCell,
    BlockError,
    block_html,
    block_text,
    cells_of,
    read_block,
    two_ways,
)
from amp_studio.report.build import build_report
from amp_studio.report.model import Report
from amp_studio.report.output.page import render_html
from amp_studio.report.output.pdf import render_pdf
from amp_studio.report.templating import templates as templating
from amp_studio.report.templating.templates import TemplateMistakeError
from amp_studio.schema import InvalidValueError
from amp_studio.validate.cell_expression import enter, is_expression

from .texts import NUMBERS, TOKENS, mutants, violations

_SHEET = [
    [BlockCell("11 mm", 11.0, "mm"), BlockCell("0.433 in", 0.433, "in"), BlockCell("2097152", 2097152)],
    [BlockCell("=1+1"), BlockCell('two\nlines\tand "quotes"'), BlockCell("4 °", 4, "°")],
]
BLOCKS = (block_text(_SHEET), "1.234,50\t0,5\r\n12-Nov\t−7\r\n", '"a ""b""\n"\t\'=X\n\t\t\n')
MARKUPS = (
    "",
    block_html(_SHEET, heads=1),
    "<table><![x[ ]]><![if !x]><!DOCTYPE [<!x]><?x ?></ ><td a='>1</table><td>2",
    (
        '<html><head><style>td {}</style></head><table><tr><td colspan=2 rowspan="3" sdval="0.5">50%</td><td'
        ' x:num="1e3">1.000,0 mm</td></tr><tr><th>&lt;&#x0;&#99999999;<br><!-- -'
        " --><table><td></table></tr></table>"
    ),
)


def fuzz_blocks(seed: int, count: int) -> list[str]:
    """Paste damaged blocks: each is refused in one sentence,
    or is a rectangle that is copied and pasted as itself.
    """
    texts = mutants(BLOCKS, seed, count)
    markups = mutants([m for m in MARKUPS if m], seed + 1, count)
    chance = random.Random(seed)
    pairs = ((text, chance.choice(("", markup))) for text, markup in zip(texts, markups, strict=True))

    def look(pair: tuple[str, str]) -> None:
        rows = read_block(*pair)
        assert len({len(row) for row in rows}) <= 1, "the rows differ in length"
        two_ways(rows)
        cells = list(cells_of(rows))
        again = read_block(block_text([[BlockCell(cell) for cell in row] for row in rows]))
        assert list(cells_of(again)) == cells, f"it is pasted as {again!r:.300}"

    return violations(pairs, look, (BlockError,))


EXPRESSIONS = (
    "25.4/5",
    "=rapid*0.8",
    "=X",
    '="Excess Error"@Y / 2',
    "=min(1 mm, 0.5 in, Z)",
    "=round(2.5)*figure(rapid)",
    "(1+2)*3",
    "=#1750",
    "=2 × 3 ÷ 4 − 1",
    "=abs(-Y)",
    "1 in + 3 mm",
    "=servo.excess_error@1",
    "1.234,5*2",
    "10 mm/min",
    "=feedrate.rapid/60",
    "-(1)",
)
PIECES = (
    "+",
    "-",
    "*",
    "/",
    "×",
    "÷",
    "(",
    ")",
    ",",
    "=",
    "==",
    "@",
    "@Y",
    "#",
    "'",
    '"',
    "mm",
    "in",
    " mm/min",
    "°",
    "X",
    "Z",
    "rapid",
    "min(",
    "max(",
    "abs(",
    "round(",
    "figure(",
    "0",
    "1e308",
    "1e-320",
    "e",
    "1e999999999",
    "(" * 200,
    "-" * 290,
    "*1e300" * 40,
    "/3" * 140,
    "v0_",
    "v1_",
    "$100",
    "#399",
    "٣",
    "√",
    "**",
    "&&",
    "[0]",
    ".all(g, g)",
)


@cache
def _machine(family: str, machine: str) -> ParameterFile:
    return new_file(family, machine)


def fuzz_cell_expressions(seed: int, count: int) -> list[str]:
    """Type damaged expressions for any parameter: each is refused,
    or gives a value that the file takes and writes.
    """
    chance = random.Random(seed)

    def cases() -> Iterator[str]:
        for text in mutants(EXPRESSIONS, seed, count):
            at = chance.randrange(len(text) + 1)
            yield text[:at] + chance.choice(("", chance.choice((*PIECES, *NUMBERS, *TOKENS)))) + text[at:]

    def look(text: str) -> None:
        file = _machine(*chance.choice((("9pc", "mill"), ("57c422b", "module"), ("num", "cnc"))))
        address = chance.choice(file.addresses())
        unit = file.evaluation.unit(address, file.header.units)
        is_expression(text)
        entered = enter(file, address, text, lambda a: file.evaluation.unit(a, file.header.units))
        if entered.value is not None and entered.expression:
            assert "\n" not in str(entered.value)
            assert (
                entered.value.unit == unit
                or not entered.value.unit
                or isinstance(entered.value.value, float | int)
            )

    return violations(cases(), look, (InvalidValueError,))


PAGES = (
    (
        '{% extends "standard/report.html.j2" %}\n{% block chapters %}<h2>{{ report.title|upper }}</h2>\n{%'
        " endblock %}"
    ),
    "{% for part in report.chapters %}{{ loop.index }} {{ part }}\n{% endfor %}",
    (
        "{% set n = namespace(a=1) %}{% macro m(x) %}{{ x * 2 }}{% endmacro %}{{ m(n.a) }}{% if n.a %}a{%"
        " endif %}"
    ),
)
PAPERS = (
    "#set page(width: 8cm, height: 4cm)\n= Service\nCall #{{ report.title }}.\n",
    '#let a = rgb("#006633")\n#for n in range(4) [#n #text(fill: a)[{{ report.title|length }}]]\n',
)
CODE = (
    "{{ report }}",
    "{{ report.__class__ }}",
    "{{ ''.__class__.__mro__ }}",
    "{{ 9**9**9 }}",
    "{{ 'x' * 10**11 }}",
    "{{ [0] * 10**11 }}",
    "{{ '%9999999999d' % 1 }}",
    "{{ '{:>9999999999}'.format(1) }}",
    "{{ 'x'|center(9999999999) }}",
    "{{ range(99999)|list|length }}",
    "{% for a in range(99999) %}{% for b in range(99999) %}{% endfor %}{% endfor %}",
    "{{ '\\ud800' }}",
    "\ud800",
    "{{ 1 // 0 }}",
    "{% macro f(n) %}{{ f(n) }}{{ f(n) }}{% endmacro %}{{ f(1) }}",
    "{% include 'report.html.j2' %}",
    "{{ lipsum(9999) }}",
    "{% set a = 'x' %}",
    "{{ 'a'|indent(9999999999) }}",
    "{{ ('x' * 9999)|wordwrap(1) }}",
    "{{ [1, 2]|batch(9999999999)|list }}",
    "{{ report.chapters|map(attribute='__class__')|list }}",
    "{% import 'standard/report.typ.j2' as t %}",
    "{{ self }}",
    "{{ caller() }}",
    "{{ _('x') }}",
    "{{ counted(1) }}",
    "{{ counted('x', []) }}",
    "{{ [1]|sum(start=[]) }}",
    "{{ 5|drawing }}",
    "{{ {}|listing }}",
    "{% if 1 is listing %}{% endif %}",
    "{{ 1|format }}",
    "{{ 'x'|int(base=99) }}",
    "{{ [1]|first|attr('x') }}",
    "{{",
    "{%",
    "{#",
    "-%}",
    "{{ 'é'.encode('utf-16').decode('ascii') }}",
    "{{ joiner()() }}",
    "{{ [[]]|sort }}",
    "{{ [1, 'a']|sort }}",
    "{{ 'x'|batch('y') }}",
    "{% for a in 5 %}{% endfor %}",
    "{{ 1 << 99999999999 }}",
    "{{ report.title[10**9] }}",
    "{{ '9' * 5000 |int }}",
    "{{ ('9' * 5000)|int }}",
    "{% for a in [1] recursive %}{{ loop([1]) }}{% endfor %}",
    "{{ cycler() }}",
    "{{ 'x'|truncate(-5) }}",
    "{{ (2**99999)|string }}",
)
TYPST = (
    "#while true {}",
    "#let f(n) = f(n)\n#f(1)",
    '#read("/etc/passwd")',
    '#image("../x.svg")',
    "#pagebreak()",
    "#panic(1)",
    "$x^2",
    "#{",
    "#(1 / 0)",
    "#(9999999999999999999 * 9)",
    '#import "@preview/a:0.0.1": *',
    '#import "/x.typ"',
    "#[#h(1e99pt)]",
    "#text(size: 1e9pt)[x]",
    "#set page(width: auto)",
    "#set page(height: 0pt)",
    "#v(-1e300cm)",
    "#table(columns: 0)",
    '#eval("#")',
    "#str.from-unicode(55296)",
    '#plugin("x")',
)


@cache
def _report() -> Report:
    file = new_file("57c422b", "module")
    file.header.name = "Bench"
    return build_report(file)


def fuzz_templates(folder: Path, seed: int, count: int) -> list[str]:
    """Write reports by damaged and hostile templates of a project: each writes a report,
    or its mistake is reported with its file.
    """
    (folder / "templates").mkdir(exist_ok=True)
    chance = random.Random(seed)

    def hostile(text: str, parts: tuple[str, ...]) -> str:
        at = chance.randrange(len(text) + 1)
        return text[:at] + (chance.choice(parts) if chance.random() < 0.7 else "") + text[at:]

    def cases() -> Iterator[tuple[str, str]]:
        pages, papers = mutants(PAGES, seed, count), mutants(PAPERS, seed, count)
        for page, paper in zip(pages, papers, strict=True):
            if chance.random() < 0.5:
                yield "report.html.j2", hostile(page, CODE)
            else:
                yield "report.typ.j2", hostile(paper, (*CODE, *TYPST))

    def look(case: tuple[str, str]) -> None:
        name, text = case
        own = folder / "templates" / name
        own.write_bytes(text.encode("utf-8", "surrogatepass"))
        content = render_html(_report(), own) if name == "report.html.j2" else render_pdf(_report(), own)
        assert isinstance(content, bytes)

    with mock.patch.object(templating, "_PATIENCE_S", 0.2):
        return violations(cases(), look, (TemplateMistakeError,))
