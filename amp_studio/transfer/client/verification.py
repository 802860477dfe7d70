"""Whether a control contains a file: its values, and every byte of its image."""

from __future__ import annotations

from dataclasses import dataclass

from amp_studio.files import Comparison, Difference, ParameterFile, compare
from amp_studio.schema import same_value
from amp_studio.transfer.image import ImageError, decode_image, head_of


@dataclass(frozen=True)
class HeadDifference:
    """A line of an image's head (``revision``) with what is there on both sides."""

    line: str
    a: str
    b: str


@dataclass(frozen=True)
class ImageComparison:
    """A file's image compared with the one of a control.

    ``is_same``     whether every byte is the same
    ``values``      the values that differ; none are listed where the control's image cannot be read
    ``other_units`` values that are the same in another unit
    ``head``        lines of the head that differ
    ``unreadable``  why the control's image cannot be compared with the file, else ""
    """

    is_same: bool
    values: Comparison
    other_units: tuple[Difference, ...] = ()
    head: tuple[HeadDifference, ...] = ()
    unreadable: str = ""

    def summary(self) -> str:
        """Return how it came out in one sentence."""
        if self.is_same:
            return f"Nothing differs: {self.values.same} values and every byte are the same."
        if self.unreadable:
            return f"The control contains something else: {self.unreadable}."
        if self.values.differences:
            return "The control contains other values."
        parts = []
        if self.head:
            parts.append(f"the header ({', '.join(d.line for d in self.head)})")
        if self.other_units:
            parts.append("the units of some values")
        return f"All values are the same; only {' and '.join(parts)} {'differ' if self.other_units else 'differs'}."


def verify_images(image: bytes, fetched: bytes) -> ImageComparison:
    """Compare the image of a file with what a control contains; raises ImageError where the file's own cannot be read."""
    a = decode_image(image)
    try:
        b = decode_image(fetched)
    except ImageError as error:
        return ImageComparison(
            is_same=False, values=Comparison((), 0), unreadable=str(error) if fetched else "nothing"
        )
    if b.schema is not a.schema:
        name = b.schema.family.name
        return ImageComparison(is_same=False, values=Comparison((), 0), unreadable=f"a file for {name}")
    found = compare(a.schema, a.values, b.values)
    return ImageComparison(image == fetched, found, _other_units(a, b), _head_differences(a, b))


def _head_differences(a: ParameterFile, b: ParameterFile) -> tuple[HeadDifference, ...]:
    pairs = [(x.partition(" "), y.partition(" ")) for x, y in zip(head_of(a), head_of(b), strict=True)]
    return tuple(HeadDifference(key, text, other) for (key, _, text), (_, _, other) in pairs if text != other)


def _other_units(a: ParameterFile, b: ParameterFile) -> tuple[Difference, ...]:
    pairs = [(address, value, b.values.get(address)) for address, value in a.values.items()]
    return tuple(Difference(*pair) for pair in pairs if pair[1] != pair[2] and same_value(pair[1], pair[2]))
