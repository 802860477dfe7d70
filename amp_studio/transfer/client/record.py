"""The record of exchanges: one line of JSON for each, appended to ``exchanges.jsonl`` in the folder of the file.

Nothing is ever taken out of it. It goes where files do not, so it contains no secret in clear.
"""

from __future__ import annotations

import hashlib
import json
import os
from collections.abc import Callable
from dataclasses import asdict, dataclass, fields
from pathlib import Path
from typing import TYPE_CHECKING

from amp_studio.files import ENDING, ParameterFile, compare, real_path, text_of_name
from amp_studio.files.atomic import append_line
from amp_studio.files.local_time import local_time
from amp_studio.files.lock import now, user
from amp_studio.schema import MASKED, Value, write_value, written
from amp_studio.schema.regular_file import read_file
from amp_studio.transfer.content import ContentKind, decode_content
from amp_studio.transfer.errors import AtControl, TransferError
from amp_studio.transfer.image import ImageError

from .kept import BEFORE, CopyError, open_copy

if TYPE_CHECKING:  # a report reads the record, and connects to nothing
    from .exchange import Outcome

RECORD = "exchanges.jsonl"


@dataclass(frozen=True)
class Exchange:
    """One exchange with a control.

    ``when``      UTC; ``who``: name of the user
    ``verb``      download, restore, upload or verify; ``file``: the name of the parameter file or copy
    ``control``   its address
    ``before``, ``after``  SHA-256 of what it contained, in hexadecimal; "" if not known
    ``state``     what it contains after it: "new", "old", "mixed", "defaults", "unknown"; "" where nothing was to be sent
    ``kept``      the copy of what it contained before; "" where nothing was replaced
    ``text``      how it ended
    ``changes``   (parameter, before, after) of what was sent; a secret is masked
    """

    when: str
    who: str
    verb: str
    file: str
    family: str
    control: str
    before: str = ""
    after: str = ""
    state: AtControl = ""
    kept: str = ""
    text: str = ""
    changes: tuple[tuple[str, str, str], ...] = ()

    def line(self) -> str:
        """Return the exchange in one line for a person."""
        digests = f"{self.before[:12] or '?'} → {self.after[:12] or '?'}" if self.state else self.after[:12]
        return f"{local_time(self.when)}  {self.who}  {self.verb}  {self.file}  {self.control}  {digests}"


def record_path(beside: Path) -> Path:
    """Return where the exchanges of a file are recorded. Raises OSError."""
    return real_path(beside).parent / RECORD


def add_exchange(beside: Path, exchange: Exchange) -> str:
    """Append an exchange to the record in the folder of a file; returns why it could not be, empty where it was.

    An exchange that cannot be recorded has happened anyway.
    """
    try:
        place = record_path(beside)
        line = json.dumps(asdict(exchange), ensure_ascii=True) + "\n"
        append_line(place, line.encode(), like=place.parent)
    except OSError as error:
        return f"the exchange could not be recorded in {RECORD}: {error.strerror or error}"
    return ""


def add_look(verb: str, beside: Path, family: str, control: str, content: bytes, text: str) -> str:
    """Record an exchange that replaced nothing; returns as ``add_exchange``."""
    digest = _digest(content)
    return add_exchange(
        beside, exchange_now(verb, beside, family, control, before=digest, after=digest, text=text)
    )


def exchange_now(verb: str, file: Path, family: str, control: str, **facts: object) -> Exchange:
    """Return an exchange of this moment by this user; ``facts`` are the other fields."""
    name = Path(os.path.realpath(file)).name  # by whatever link the file was reached
    return Exchange(now(), user(), verb, text_of_name(name), family, control, **facts)  # type: ignore[arg-type]  # as asked for


def read_exchanges(folder: Path, file: str = "") -> list[Exchange]:
    """Return the exchanges recorded in a folder, oldest first; of one file, or of all. A line that is none is left out.

    Raises OSError where there is a record that cannot be read.
    """
    try:
        content = read_file(folder / RECORD, follow=False, tail=True)
    except FileNotFoundError:
        return []
    found = [each for line in content.decode("utf-8", "replace").split("\n") if (each := _exchange(line))]
    return [each for each in found if file in ("", each.file, _file_of_copy(each.file))]


def file_of_exchange(exchange: Exchange) -> str:
    """Return the name of the parameter file of an exchange, also where a copy of it was put back."""
    return _file_of_copy(exchange.file)


def _file_of_copy(name: str) -> str:
    """Return the file whose download a copy was kept of."""
    stem, before, _ = name.partition(BEFORE)
    return f"{stem}{ENDING}" if before else name


def _exchange(line: str) -> Exchange | None:
    """Return the exchange of a line; None for what this program has not written so."""
    try:
        entry = json.loads(line)
        if not isinstance(entry, dict):
            return None
        changes = tuple((str(p), str(old), str(new)) for p, old, new in entry.pop("changes", ()))
        texts = {f.name: entry[f.name] for f in fields(Exchange) if f.name in entry}
        if not all(isinstance(text, str) for text in texts.values()):
            return None
        return Exchange(**texts, changes=changes)
    except (ValueError, TypeError, RecursionError):
        return None


def check_whole(kind: ContentKind, content: bytes, beside: Path | None, control: str, folder: Path) -> None:
    """Refuse to keep less than the newest copy of the same control has; raises CopyError.

    The record of the file ``beside`` leads to that copy, in the ``folder`` where the next one is kept. Where there is none that
    can be read, there is nothing to compare.
    """
    try:
        exchanges = read_exchanges(record_path(beside).parent) if beside is not None else []
    except OSError:
        return
    names = (Path(each.kept).name for each in reversed(exchanges) if each.control == control and each.kept)
    for path in (folder / name for name in names):
        try:
            earlier = open_copy(path).image
            is_alike = earlier.partition(b"\n")[0] == content.partition(b"\n")[0]
            lacking = kind.lacks(content, earlier) if is_alike else ""
        except (OSError, ValueError):
            continue
        if lacking:
            raise CopyError(
                f"this reading lacks {lacking}, which {path.name} has: try once more; where another control is connected there "
                "now, keep its copies in another folder"
            )
        return


def changes_of(before: bytes, after: bytes) -> tuple[tuple[str, str, str], ...]:
    """Return the parameters in which two contents of a control differ; none where one of them cannot be read."""
    try:
        old, new = (decode_content(content) if content else None for content in (before, after))
    except ImageError:
        return ()
    if new is None or (old is not None and old.schema is not new.schema):
        return ()
    found = compare(new.schema, old.values if old else {}, new.values)
    return tuple(
        (written(d.address), _text(new, d.address[0], d.a), _text(new, d.address[0], d.b))
        for d in found.differences
    )


def _text(file: ParameterFile, parameter_id: str, value: Value | None) -> str:
    parameter = file.schema.parameters[parameter_id]
    if value is None:
        return ""
    return MASKED if parameter.secret else write_value(parameter, value)


class Recording:
    """Records one download or restore, however it ends.

    ``make`` gives what the control shall contain, of what it contains; ``beside`` is the file in whose folder the record is,
    None for none; ``notify`` is called with the reason if it could not be written.
    """

    def __init__(
        self, verb: str, beside: Path | None, family: str, control: str, make: Callable[[bytes], bytes],
        notify: Callable[[str], object],
    ) -> None:  # fmt: skip
        self._verb, self._beside, self._family, self._control = verb, beside, family, control
        self._make, self._notify = make, notify
        self._held: bytes | None = None
        self._wanted = b""

    def wanted(self, held: bytes) -> bytes:
        """Return what a control that contains ``held`` shall contain."""
        content = self._make(held)
        self._held, self._wanted = held or None, content
        return content

    def run(self, download: Callable[[], Outcome]) -> Outcome:
        """Run the exchange and record it; one that ended before the control was read is left out. Raises what it raises."""
        try:
            outcome = download()
        except TransferError as error:
            if self._held is not None or error.at_control not in ("", "old"):
                self._add(error.at_control, error.kept, str(error))
            raise
        self._add(outcome.at_control, outcome.kept, outcome.text, outcome.verified)
        return outcome

    def _add(self, state: AtControl, kept: str | None, text: str, is_proven: bool = False) -> None:
        if self._beside is None:
            return
        held, wanted = self._held or b"", self._wanted
        after = _digest(wanted) if is_proven else _digest(held) if state == "old" else ""
        changes = () if state == "old" else changes_of(held, wanted)
        note = add_exchange(self._beside, exchange_now(
            self._verb, self._beside, self._family, self._control, before=_digest(held), after=after, state=state,
            kept=kept or "", text=text, changes=changes))  # fmt: skip
        if note:
            self._notify(note)


def _digest(content: bytes) -> str:
    return hashlib.sha256(content).hexdigest() if content else ""
