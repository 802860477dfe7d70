"""What the bytes mean that a control contains: each kind is recognised by its first line.

A copy that was kept years ago is so read, shown and put back without asking over which protocol it came.
Nothing here talks to a control.
"""

from __future__ import annotations

from typing import ClassVar, Protocol

from amp_studio.files import ParameterFile
from amp_studio.schema import load_part, registered_families, registration_of

from .image import MAGIC, decode_image, encode_image

_GENERAL = {MAGIC: "amp_studio.transfer.content:HouseContent"}
"""First line -> how it is read, for the kinds of every family."""


class ContentKind(Protocol):
    """One kind of content: between a parameter file and the bytes that a control contains."""

    @property
    def has_header(self) -> bool:
        """Whether the application and the revision of a file are part of it."""

    def decode(self, content: bytes) -> ParameterFile:
        """Return what these bytes mean; raises ImageError."""

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        """Return what a control that contains ``current`` contains after a download of ``file``.

        What the file does not set stays as ``current`` has it, where single values are sent. Raises
        ImageError, which names what the control cannot take.
        """

    def left_out(self, file: ParameterFile, current: bytes) -> str:
        """Return what of a file a control that contains ``current`` does not have, and what is sent
        without it; "" for nothing.
        """

    def stays(self, file: ParameterFile, current: bytes) -> str:
        """Return which parts of the values that a file sets stay as ``current`` has them:
        bits of axes it does not have; "" for none.
        """

    def lacks(self, content: bytes, earlier: bytes) -> str:
        """Return what of an ``earlier`` content of the same control is not in this one,
        which may be read short; "" for nothing.

        Raises ImageError.
        """

    def refit(self, content: bytes, current: bytes) -> bytes:
        """Return what a control that contains ``current`` contains once ``content`` is put back;
        raises ImageError.
        """

    def difference(self, content: bytes, found: bytes) -> str:
        """Return where a control that contains ``found`` is not proved to contain ``content``:
        "from byte 7 on"; "" if it is.
        """

    def displayed(self, content: bytes, found: bytes) -> bytes:
        """Return ``content`` as a control that contains ``found`` shows it: what that is coarser of, and not
        other than.
        """


class TakesAllOrRefuses:
    """What a kind is whose control takes all of a file, or is sent nothing."""

    def left_out(self, file: ParameterFile, current: bytes) -> str:  # noqa: ARG002  # other kinds need them
        """Return ""."""
        return ""

    def stays(self, file: ParameterFile, current: bytes) -> str:  # noqa: ARG002  # other kinds need them
        """Return "": a file of such a control has all of each value."""
        return ""

    def lacks(self, content: bytes, earlier: bytes) -> str:  # noqa: ARG002  # other kinds need them
        """Return "": what is read of such a control is whole."""
        return ""

    def displayed(self, content: bytes, found: bytes) -> bytes:  # noqa: ARG002  # controls that round need it
        """Return the content itself: the control shows all of it."""
        return content


class WholeContent(TakesAllOrRefuses):
    """What a kind is that a control takes as it is and gives back byte for byte."""

    has_header: ClassVar[bool] = False

    def refit(self, content: bytes, current: bytes) -> bytes:  # noqa: ARG002  # other kinds need it
        """Return the content itself."""
        return content

    def difference(self, content: bytes, found: bytes) -> str:
        """Return the first byte that differs, in words."""
        at = first_difference(content, found)
        return "" if at is None else f"from byte {at} on"


class HouseContent(WholeContent):
    """The control image (docs/protocols/image.md), which replaces another as a whole."""

    has_header = True

    def decode(self, content: bytes) -> ParameterFile:
        """Return the file of an image; raises ImageError."""
        return decode_image(content)

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        """Return the image of a file; raises ImageError."""
        image = encode_image(file)
        if image != current:
            decode_image(image)  # what cannot be read again is not sent
        return image


def kind_of(content: bytes) -> ContentKind:
    """Return how a content is read; as an image of the house
    where its first line names no kind that is known.
    """
    family, first = family_of(content), _first_line(content)
    place = registration_of(family).contents[first] if family else _GENERAL[MAGIC]
    kind: ContentKind = load_part(place)()
    return kind


def family_of(content: bytes) -> str:
    """Return the family whose own kind a content is; "" for the image of the house, which every family
    has.
    """
    first = _first_line(content)
    return next((f for f in registered_families() if first in registration_of(f).contents), "")


def _first_line(content: bytes) -> str:
    return content[:80].split(b"\n")[0].decode("latin-1")


def decode_content(content: bytes) -> ParameterFile:
    """Return what a control contains as a file, whatever the kind; raises ImageError."""
    return kind_of(content).decode(content)


def first_difference(a: bytes, b: bytes) -> int | None:
    """Return where two contents first differ, None when they are equal.

    Where one goes on and the other ends, that is the length of the shorter.
    """
    if a == b:
        return None
    pairs = enumerate(zip(a, b, strict=False))
    return next((at for at, (x, y) in pairs if x != y), min(len(a), len(b)))
