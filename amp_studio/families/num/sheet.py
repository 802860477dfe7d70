"""How values are keyed into a NUM 1020/1040/1060: the editor of utility 5 (13.2.2)."""

from __future__ import annotations

import re

from amp_studio.files import ParameterFile
from amp_studio.schema import Address, InvalidValueError, Value
from amp_studio.sheet import Instruction, Keyed, Keying

from .formats.words import WordMeaning, words_of


def _text(file: ParameterFile, address: Address, value: Value) -> Keyed | None:
    """Return the word as the editor shows it, which is as a parameter table spells it (page 13-14)."""
    number = re.fullmatch(r"P([0-9]+)N[0-9]+", file.machine_schema.number(address) or "")
    form = words_of(file.schema, file.machine).forms.get(int(number[1])) if number else None
    if form is None:
        return None
    try:
        text = form.spell(WordMeaning.of(file.schema, address).content(file, value))
    except InvalidValueError:
        return None
    return Keyed(text, "" if form.base == 10 else "hexadecimal", form.base)


def _obstacle(file: ParameterFile, address: Address) -> str:
    return "" if file.machine_schema.number(address) else "it has no number by which the editor finds it"


KEYING = Keying(
    title="Sheet for the parameter editor of utility 5",
    obstacle=_obstacle,
    text=_text,
    before=(
        Instruction("Unload the parameter table first, so that the old one is kept.", "13-12"),
        Instruction(
            "Call utility 5 and choose the change of parameters in the menu MACHINE SETUP DATA.", "13-3, 13-8"
        ),
        Instruction(
            "For each line: Pn_Nn selects the word; open the dialogue line, key in the value; tick it.",
            "13-8",
        ),
    ),
    after=(
        Instruction("Leave the editor, confirm the changes, and reset the CNC.", "13-9"),
        Instruction("Display each word again, write down what the screen shows, and compare.", "13-6"),
        Instruction("Unload the new table or print it.", "13-8"),
    ),
)
