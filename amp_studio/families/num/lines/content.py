"""What a NUM control contains: its parameter table, as it unloads it (page 13-14),
under a line that names the kind.
"""

from __future__ import annotations

import re

from amp_studio.families.num.formats.lines import blocks_of, split_table
from amp_studio.families.num.formats.table import FORMAT, KEY
from amp_studio.families.num.formats.words import name_of
from amp_studio.files import ParameterFile
from amp_studio.formats import FormatError, ReadOptions, file_of
from amp_studio.schema import load_schema
from amp_studio.transfer import ImageError, TakesAllOrRefuses

KIND = "NUM table 1"
FAMILY = "num"
_START = f"{KIND}\n".encode()
TEXT = 8
"""The type of words that are texts (page 1-3)."""
_LEADING = re.compile(r"^([+-]?)0+(?=[0-9A-F])")
_NAMED = 5
"""Words that a message names."""


class NumTableContent(TakesAllOrRefuses):
    """Between a parameter file and the table of one control."""

    has_header = False

    def decode(self, content: bytes) -> ParameterFile:
        """Return what a table means; words that the schema does not have are kept. Raises ImageError."""
        try:
            return file_of(
                load_schema(FAMILY),
                FORMAT.read(table_text(content), load_schema(FAMILY), ReadOptions(keep_unknown=True)),
                "control",
            )
        except FormatError as error:
            raise ImageError(f"the parameter table of the control: {error}") from None

    def encode(self, file: ParameterFile, current: bytes) -> bytes:
        """Return the table of the control with the values of a file in it; raises ImageError."""
        present = self.decode(current)
        try:
            before = FORMAT.write(present)
            # What this program cannot write back byte for byte it would change unasked: such a table is
            # not touched.
            if before != table_text(current):
                raise ImageError(
                    "this program would write the table of this control otherwise than the control does"
                )
            _check_reference(file, present)
            present.take(file.values)
            after = FORMAT.write(present)
        except FormatError as error:
            raise ImageError(f"the parameter table of the control: {error}") from None
        content = _START + after.encode("ascii")
        # A word that the CNC has not cannot be added by a load; it would only come out as a difference
        # later.
        added = words_of_table(content).keys() - words_of_table(current).keys()
        if added:
            raise ImageError(f"the control does not have {_names(sorted(added))}, which the file sets")
        return content

    def lacks(self, content: bytes, earlier: bytes) -> str:
        """Return the words that the CNC had; those of another one, by its job reference, do not count.
        Raises ImageError.
        """
        if reference_of(content) != reference_of(earlier):
            return ""
        present = words_of_table(content)
        return _names([word for word in words_of_table(earlier) if word not in present])

    def refit(self, content: bytes, current: bytes) -> bytes:
        """Return a table that was kept, if it is of the CNC that contains ``current``; raises ImageError."""
        there, here = reference_of(content), reference_of(current)
        if current and there != here:
            raise _other_reference("the copy", there, here)
        if current and (other := words_of_table(content).keys() ^ words_of_table(current).keys()):
            raise ImageError(f"the copy and the control do not have the same words: {_names(sorted(other))}")
        return content

    def difference(self, content: bytes, found: bytes) -> str:
        """Return the words that differ, in a few words."""
        if content == found:
            return ""
        try:
            wanted, present = words_of_table(content), words_of_table(found)
        except ImageError:
            return "so much that it cannot be read"
        different = [word for word in {**wanted, **present} if wanted.get(word) != present.get(word)]
        if different:
            return f"in {_names(different)}"
        there, here = reference_of(content), reference_of(found)
        return "" if there == here else f"in the job reference ({here}, not {there})"


def content_of_table(table: str) -> bytes:
    """Return the content of a table that has come.

    What a person typed behind the job reference is left out of it, and Xoff is on a line alone: both would be
    another content of the same control.
    """
    first, end, rest = table.partition("\n")
    if end and not rest.endswith("\n\x13") and rest != "\x13":
        ending = "\r\n" if first.endswith("\r") else "\n"
        rest = f"{rest.removesuffix(chr(0x13)).removesuffix(ending[:-1])}{ending}\x13"
    if match := re.match(r"%[0-9]{8}", first):
        ending = "\r" if first.endswith("\r") else ""
        first = f"{match[0]};09{ending}"
    return _START + f"{first}{end}{rest}".encode("ascii")


def table_text(content: bytes) -> str:
    """Return the table itself; raises ImageError for a content of another kind."""
    if not content.startswith(_START):
        raise ImageError("this is not the parameter table of a NUM control")
    try:
        return content[len(_START) :].decode("ascii")
    except UnicodeDecodeError:
        raise ImageError("the parameter table of the control contains more than ASCII") from None


def reference_of(content: bytes) -> str:
    """Return the job reference of a table, its eight digits."""
    return content[len(_START) + 1 : len(_START) + 9].decode("ascii", errors="replace")


def words_of_table(content: bytes) -> dict[str, str]:
    """Return every word of a table by its number, without leading zeros of a number; raises ImageError."""
    words: dict[str, str] = {}
    try:
        lines, _ = split_table(table_text(content))
        for block in blocks_of(lines):
            parameter, first = block.first
            texts = block.data.split(" ")
            # A CNC pads its figures as it likes; in a text a zero is a character.
            if block.code is not None and block.code != TEXT:
                texts = [_LEADING.sub(r"\1", text) for text in texts]
            words.update((name_of((parameter, n)), text) for n, text in enumerate(texts, first))
    except FormatError as error:
        raise ImageError(f"the parameter table of the control: {error}") from None
    return words


def _check_reference(file: ParameterFile, present: ParameterFile) -> None:
    """Refuse a file that was read from a CNC with another job reference,
    as the control itself does (page 13-10).
    """
    there, here = (_reference(each) for each in (file, present))
    if there is not None and there != (here or "00000000"):
        raise _other_reference("the file", there, here or "00000000")


def _reference(file: ParameterFile) -> str | None:
    header = file.header.extra.get(KEY)
    number = header.get("job_reference") if isinstance(header, dict) else None
    return None if number is None else f"{number:08d}" if isinstance(number, int) else str(number)


def _other_reference(what: str, there: str, here: str) -> ImageError:
    return ImageError(
        f"{what} is of a CNC with the job reference {there}, and this one has {here} (NUM parameter manual,"
        " page 13-10)"
    )


def _names(words: list[str]) -> str:
    more = len(words) - _NAMED
    return ", ".join(words[:_NAMED]) + (f" and {more} more" if more > 0 else "")
