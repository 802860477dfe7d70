"""Whatever numbers a file contains, its pictures are drawn or have a note."""

from pathlib import Path

import pytest

from amp_studio.drawing import scene_svg
from amp_studio.files import open_file
from amp_studio.pictures import pictures_of
from tests.campaigns import CAMPAIGN, some

EXAMPLES = sorted((Path(__file__).parents[2] / "examples").glob("*/*.amp"))


def _whole(number: float) -> int:
    """Return the nearest whole number that a file can contain."""
    return round(max(min(number, 2.0**53 - 1.0), 1.0 - 2.0**53))


NUMBERS = (-123456.789, 1e300, 1e-300, 0.0, -1e300, 5e-324)


@pytest.mark.parametrize(
    ("example", "number"),
    some(
        [
            pytest.param(example, number, id=f"{example.stem}-{number}")
            for n, example in enumerate(EXAMPLES)
            for number in (NUMBERS if CAMPAIGN else NUMBERS[n % 3 :: 3])
        ]
    ),
)
def test_every_number_the_same(example: Path, number: float) -> None:
    file = open_file(example).file
    for address, value in list(file.values.items()):
        if not isinstance(value.value, (str, bool)):
            is_real = file.schema.parameters[address[0]].type == "real"
            file.set(address, type(value)(number if is_real else _whole(number), value.unit))
    for picture in pictures_of(file):
        for part, _ in picture.parts:
            svg = scene_svg(picture.scene(part))
            assert "nan" not in svg, (picture.name, part)
            assert "inf" not in svg.replace("infinit", ""), (picture.name, part)
