"""Damaged files around a sheet of values to key in: its ticks,
and what somebody has written down from the screen.
"""

import json
from functools import cache
from pathlib import Path

from amp_studio.files import ParameterFile, new_file
from amp_studio.sheet import (
    ReadBackError,
    Sheet,
    Ticks,
    TicksError,
    compare_screen,
    make_sheet,
    read_screen_readings,
)

from .texts import mutants, violations

SCREENS = (
    "# as on the screen\n1750 203.20000\n1740 = 11,5\n399;1\n",
    (
        "step,number,name,now,key in,unit,value in the file,page,read back,notes\r\n1,1750,Excess"
        " Error,11,40,mm,,7-20,40.0,\r\n"
    ),
    "\ufeffstep;number;read back\r\n1;1740;'-3\r\n",
)


@cache
def _sheet() -> tuple[Sheet, ParameterFile]:
    present = new_file("9pc", "mill")
    wanted = present.copy()
    for number, text in (("1750", "150 mm"), ("1740", "140 mm"), ("399", "b")):
        address = wanted.find(number)
        wanted.set(address, wanted.read(address, text))
    return make_sheet(wanted, present), wanted


def fuzz_screens(seed: int, count: int) -> list[str]:
    """Damage what a person has written down: every entry is judged, or the line is named."""
    sheet, wanted = _sheet()

    def look(text: str) -> None:
        found = compare_screen(sheet, wanted, read_screen_readings(text))
        assert [each.entry for each in found] == list(sheet.entries)

    return violations(mutants(SCREENS, seed, count), look, (ReadBackError,))


def fuzz_ticks(folder: Path, seed: int, count: int) -> list[str]:
    """Damage the file of ticks: it is refused and left alone,
    or every tick in it belongs to an entry as it is.
    """
    sheet, _ = _sheet()
    path = folder / "mill.amp.ticks.json"
    kept = [
        {"number": e.number, "old": e.old, "new": e.new, "shown": "1", "ticked": True} for e in sheet.entries
    ]
    whole = json.dumps({"ticks": kept}, indent=1)

    def look(text: str) -> None:
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        before = path.read_bytes()
        try:
            assert Ticks(path, sheet).done <= len(sheet.entries)
        finally:
            assert path.read_bytes() == before

    return violations(mutants([whole], seed, count), look, (TicksError,))
