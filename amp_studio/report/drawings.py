"""The pictures of a file as drawings on paper."""

from __future__ import annotations

from collections import Counter
from collections.abc import Iterator

from amp_studio.drawing import Scene, scene_in_words, scene_svg
from amp_studio.files import ParameterFile
from amp_studio.pictures import FilePicture, pictures_of

from .axes import axis_label
from .language import ENGLISH, Language
from .model import PrintedFigure

WIDTH, HEIGHT = 620.0, 316.0
"""Size of a drawing in points of its letters: in the width of a page they are 8.5 points or more."""
_ROW = 29.0
"""Height of a row of a diagram, whose axes are not written: its texts keep their rows, and two diagrams of 13
rows are on a page."""
CUTTING = 10
"""%: share of the rapid feedrate near that of cutting, at which signals are printed too."""
_MAX_PARTS = 8
"""Most parts of a picture that are all printed; of more (pairs of axes), each axis once."""


def drawings(file: ParameterFile, language: Language = ENGLISH) -> tuple[PrintedFigure, ...]:
    """Return each picture of a file that shows something, part by part, in a language."""
    return tuple(figure for picture in pictures_of(file) for figure in _drawn(picture, language))


def _drawn(picture: FilePicture, language: Language) -> Iterator[PrintedFigure]:
    """Yield the parts of a picture; one that a spindle without signals shows at two speeds alike, once."""
    by_drawing: dict[str, tuple[str, Scene, tuple[str, ...]]] = {}
    for part in _parts(picture):
        found = picture.scene(part)
        scene = scene_in_words(found, language.sentence, language.unit)
        if _shows(scene):
            title = f"{scene.title} {_name(picture, part, scene)}" if part else scene.title
            height = HEIGHT if scene.y.is_written else max(HEIGHT, _ROW * (scene.y.high - scene.y.low))
            drawn = scene_svg(scene, WIDTH, height, notes=False)
            by_drawing[drawn] = title, scene, tuple(language.sentence(note.text) for note in found.notes)
    titles = Counter(title for title, _, _ in by_drawing.values())
    for drawn, (title, scene, notes) in by_drawing.items():
        named = f"{title}, {_apart(scene)}" if titles[title] > 1 else title
        yield PrintedFigure(named, drawn, notes)


def _name(picture: FilePicture, part: str, scene: Scene) -> str:
    """Return which part a drawing shows: its axis as the tables name it, its axes, its spindle."""
    return axis_label(picture.file, part) if picture.axes == 1 else scene.subtitle.partition(",")[0]


def _apart(scene: Scene) -> str:
    """Return in what two drawings of one axis differ: the speed of loops, the quantity of a cam."""
    return scene.y.label if scene.y.is_written else scene.subtitle.split(", ")[1]


def _shows(scene: Scene) -> bool:
    return bool(scene.handles or scene.areas or scene.curves)


def _parts(picture: FilePicture) -> Iterator[str]:
    """Yield what to draw of a picture: its parts, and those with signals at the speed of cutting too."""
    drawn: set[str] = set()
    for part, _ in picture.parts:
        axes = set(part.split("+"))
        if len(picture.parts) <= _MAX_PARTS or not axes & drawn:
            drawn |= axes
            yield part
            if picture.has_speed:
                yield f"{part}@{CUTTING}"
