"""Whether a control contains a file: its values, and every byte of its image."""

from __future__ import annotations

from contextlib import closing
from dataclasses import dataclass, replace

from amp_studio.files import Comparison, Difference, ParameterFile, compare
from amp_studio.schema import Address, Value, same_value
from amp_studio.transfer.content import kind_of
from amp_studio.transfer.driver import ShowsValuesInUse
from amp_studio.transfer.exchange import QUIET, Exchange
from amp_studio.transfer.image import ImageError, head_of

from .drivers import open_driver_at
from .exchange import upload


@dataclass(frozen=True)
class HeadDifference:
    """A line of an image's head (``revision``) with what is there on both sides."""

    line: str
    a: str
    b: str


@dataclass(frozen=True)
class ImageComparison:
    """A file's image compared with the one of a control.

    ``is_same``     whether it contains all of the file, every byte where it contains an image
    ``values``      the values that differ; none are listed where the control's image cannot be read
    ``other_units`` values that are the same in another unit
    ``head``        lines of the head that differ
    ``unreadable``  why the control's image cannot be compared with the file, else ""
    ``missing``      what the file sets and the control does not have, in a sentence, else ""
    ``stays``       which bits of masks the file does not have, so that they were not compared, else ""
    ``in_use``      what the program of the control uses otherwise since it was started, where it shows that:
                    the value of the file beside the one in use
    ``is_whole``    whether every byte was compared; else a control shows some values coarser than they are
    ``outside``     what the file sets and no control of this kind keeps: it is neither sent nor compared
    ``not_compared`` how many values of the control the file does not set, where those stay as they are
    """

    is_same: bool
    values: Comparison
    other_units: tuple[Difference, ...] = ()
    head: tuple[HeadDifference, ...] = ()
    unreadable: str = ""
    missing: str = ""
    outside: tuple[Address, ...] = ()
    is_whole: bool = True
    stays: str = ""
    in_use: tuple[Difference, ...] = ()
    not_compared: int = 0

    @property
    def agrees(self) -> bool:
        """Whether the control contains the file and uses nothing else."""
        return self.is_same and not self.in_use

    def summary(self) -> str:
        """Return how it came out in one sentence, and how much of the file was not compared."""
        text = self._summary()
        if self.in_use:
            text += f" The program that runs uses {len(self.in_use)} other values: start it again."
        if self.outside:
            text += f" {len(self.outside)} values of the file are not kept by this control."
        if self.not_compared:
            text += f" {self.not_compared} values of the control are not set in the file,"
            text += " and were not compared."
        if self.stays:
            text += f" Not in the file, and not compared: {self.stays}."
        return text

    def _summary(self) -> str:
        """Return in one sentence how much is the same, or that the control contains something else."""
        if self.is_same:
            much = "are the same"
            if not self.is_whole:
                much += " as far as the control shows them"
            elif not self.not_compared:
                much = "and every byte are the same"
            return f"Nothing differs: {self.values.same} values {much}."
        if self.unreadable:
            return f"The control contains something else: {self.unreadable}."
        if self.missing:
            return f"The control cannot contain this file: {self.missing}."
        if self.values.differences:
            return "The control contains other values."
        parts = []
        if self.head:
            parts.append(f"the header ({', '.join(d.line for d in self.head)})")
        if self.other_units:
            parts.append("the units of some values")
        return (
            f"All values are the same; only {' and '.join(parts)}"
            f" {'differ' if self.other_units else 'differs'}."
        )


def verify_at(
    address: str, file: ParameterFile, exchange: Exchange = QUIET, family: str = ""
) -> tuple[ImageComparison, bytes]:
    """Return how a file compares with the control at an address, and what that contains;
    raises TransferError.
    """
    with closing(open_driver_at(address, family, exchange)) as driver:
        fetched = upload(driver, exchange)
        found = verify_content(file, fetched)
        if not isinstance(driver, ShowsValuesInUse) or found.unreadable:
            return found, fetched
        used = driver.in_use(fetched).items()
        pairs = [Difference(address, file.get(address), value) for address, value in used]
        other = tuple(d for d in pairs if d.a is None or d.b is None or not same_value(d.a, d.b))
        return replace(found, in_use=other), fetched


def verify_content(file: ParameterFile, fetched: bytes) -> ImageComparison:
    """Compare a file with what a control contains."""
    kind = kind_of(fetched)
    try:
        present = kind.decode(fetched)
    except ImageError as error:
        return _not_compared(str(error) if fetched else "nothing")
    if present.schema.family.family != file.schema.family.family:
        return _not_compared(f"a file for {present.schema.family.name}")
    missing, stays, is_same, is_whole, wanted = "", "", False, True, file
    try:
        content, missing = kind.encode(file, fetched), kind.left_out(file, fetched)
        stays = kind.stays(file, fetched)
        is_same, is_whole = not missing and not kind.difference(content, fetched), content == fetched
        # In the control's own units, with what the file leaves as it is, and as coarse as it is shown.
        wanted = present if is_same else kind.decode(kind.displayed(content, fetched))
    except ImageError as error:
        missing = str(error)
    head = _head_differences(file, present) if kind.has_header else ()
    ours, theirs = _known(file, wanted), _known(file, present)
    found = compare(file.schema, ours, theirs)
    outside = tuple(a for a in file.values if a not in wanted.values)
    # An image replaces all of a control. Where values are sent one by one, what the file does not set is
    # as the control has it on both sides: the same without having been compared.
    others = () if kind.has_header else theirs.keys() - file.values.keys()
    not_compared = sum(same_value(ours.get(a), theirs[a]) for a in others)
    return ImageComparison(
        is_same,
        replace(found, same=found.same - not_compared),
        _other_units(wanted, present),
        head,
        missing=missing,
        outside=outside,
        is_whole=is_whole,
        stays=stays,
        not_compared=not_compared,
    )


def completed(content: ParameterFile, image: bytes, file: ParameterFile) -> ParameterFile:
    """Return the content of a control to be compared with a file:
    what no control of its kind keeps is as the file has it, and so is what this one shows coarser.

    ``image`` are the bytes that show of which kind the control is; empty where they are not known. Both files
    are of one schema; header, marks and what the schema does not know are the file's own.
    """
    found = file.copy()
    found.values.clear()
    found.take(content.values)
    if image:
        try:
            kind = kind_of(image)
            wanted = kind.encode(file, image)
            sent, displayed = kind.decode(wanted).values, kind.decode(kind.displayed(wanted, image)).values
        except ImageError:  # the control cannot take the file: all that differs is shown
            return found
        is_file = {a for a in file.values if a not in sent and a not in content.values}
        is_file |= {a for a, value in sent.items() if a in file.values and value != displayed.get(a)}
        found.take({a: file.values[a] for a in is_file})
    return found


def _known(file: ParameterFile, other: ParameterFile) -> dict[Address, Value]:
    """Return the values of another file that the schema of this one has."""
    return {a: v for a, v in other.values.items() if a[0] in file.schema.parameters}


def _not_compared(why: str) -> ImageComparison:
    return ImageComparison(is_same=False, values=Comparison((), 0), unreadable=why)


def _head_differences(a: ParameterFile, b: ParameterFile) -> tuple[HeadDifference, ...]:
    pairs = [(x.partition(" "), y.partition(" ")) for x, y in zip(head_of(a), head_of(b), strict=True)]
    return tuple(HeadDifference(key, text, other) for (key, _, text), (_, _, other) in pairs if text != other)


def _other_units(a: ParameterFile, b: ParameterFile) -> tuple[Difference, ...]:
    pairs = [(address, value, b.values.get(address)) for address, value in a.values.items()]
    return tuple(Difference(*pair) for pair in pairs if pair[1] != pair[2] and same_value(pair[1], pair[2]))
