"""The pictures of README and the pages: each is there, small, drawn by ``make screenshots``,
and shown somewhere.
"""

import re
import struct
from pathlib import Path

import page_pictures
import pytest
from page_pictures import PICTURES, with_palette
from PySide6.QtGui import QColor, QImage

ROOT = Path(__file__).parents[2]
IMAGES = ROOT / "docs/images"
MAX_BYTES = 120_000
PALETTE = 3
"""Type of colours in the head of a PNG."""


def displayed() -> dict[str, str]:
    """Return picture -> a page that shows it."""
    pages = [ROOT / "README.md", ROOT / "CONTRIBUTING.md", *sorted((ROOT / "docs").rglob("*.md"))]
    texts = ((page.relative_to(ROOT).as_posix(), page.read_text(encoding="utf-8")) for page in pages)
    return {
        name: page for page, text in texts for name in re.findall(r"!\[[^\]]+\]\((\S*images/\S+)\)", text)
    }


def test_every_picture_that_a_page_shows_is_there_and_every_one_that_is_there_is_shown() -> None:
    found = {((ROOT / page).parent / name).resolve() for name, page in displayed().items()}
    assert found == {path.resolve() for path in IMAGES.iterdir()}
    assert len(found) > 5


def test_the_script_of_screenshots_draws_each_of_them() -> None:
    assert {path.stem for path in IMAGES.iterdir()} == set(PICTURES)


@pytest.mark.parametrize("name", sorted(PICTURES))
def test_a_picture_is_a_small_png_with_a_palette(name: str) -> None:
    content = (IMAGES / f"{name}.png").read_bytes()
    assert content[:8] == b"\x89PNG\r\n\x1a\n"
    width, height, _depth, colours = struct.unpack(">IIBB", content[16:26])
    assert colours == PALETTE
    assert (width, height) <= page_pictures.SIZE
    assert len(content) < MAX_BYTES


def test_the_most_frequent_colours_stay_and_the_others_become_the_nearest_of_them() -> None:
    image = QImage(256, 3, QImage.Format.Format_RGB32)
    for x in range(256):
        for y in range(2):
            image.setPixelColor(x, y, QColor(x, 20, 30))
        image.setPixelColor(x, 2, QColor(x, 22, 31))
    few = with_palette(image)
    assert few.format() == QImage.Format.Format_Indexed8
    assert len(few.colorTable()) == page_pictures.COLOURS
    assert [few.pixelColor(x, 2) for x in (0, 7, 255)] == [
        QColor(0, 20, 30),
        QColor(7, 20, 30),
        QColor(255, 20, 30),
    ]
