"""The record of exchanges: one line of JSON for each,
appended to ``exchanges.jsonl`` in the folder of the file.

Nothing is ever taken out of it. It goes where files do not, so it contains no secret in clear.
"""

from __future__ import annotations

import hashlib
import json
import os
from dataclasses import asdict, dataclass, fields
from pathlib import Path

from amp_studio.files import (
    BEFORE,
    ENDING,
    RECORD,
    ParameterFile,
    append_line,
    compare,
    local_time,
    now,
    real_path,
    text_of_name,
    user,
)
from amp_studio.schema import MASKED, Value, read_file, write_value, written
from amp_studio.transfer.content import decode_content
from amp_studio.transfer.errors import AtControl
from amp_studio.transfer.exchange import Exchange
from amp_studio.transfer.image import ImageError


@dataclass(frozen=True)
class RecordedExchange:
    """One exchange with a control.

    ``when``      UTC; ``who``: name of the user
    ``verb``      download, restore, upload or verify; ``file``: the name of the parameter file or copy
    ``control``   its address
    ``before``, ``after``  SHA-256 of what it contained, in hexadecimal; "" if not known
    ``state``     what it contains after it: "new", "old", "mixed", "defaults", "unknown"; "" where nothing
                  was to be sent
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


def add_exchange(beside: Path, exchange: RecordedExchange) -> str:
    """Append an exchange to the record in the folder of a file; returns why it could not be,
    empty where it was.

    An exchange that cannot be recorded has happened anyway.
    """
    try:
        place = record_path(beside)
        line = json.dumps(asdict(exchange), ensure_ascii=True) + "\n"
        append_line(place, line.encode(), like=place.parent)
    except OSError as error:
        return f"the exchange could not be recorded in {RECORD}: {error.strerror or error}"
    return ""


def record_look(verb: str, exchange: Exchange, family: str, control: str, content: bytes, text: str) -> None:
    """Record that a control was read and nothing replaced, where the exchange is recorded;
    notifies where it could not be.
    """
    if exchange.record is None:
        return
    digest = digest_of(content)
    entry = exchange_now(verb, exchange.record, family, control, before=digest, after=digest, text=text)
    if problem := add_exchange(exchange.record, entry):
        exchange.notify(problem)


def exchange_now(verb: str, file: Path, family: str, control: str, **facts: object) -> RecordedExchange:
    """Return an exchange of this moment by this user; ``facts`` are the other fields."""
    name = Path(os.path.realpath(file)).name  # by whatever link the file was reached
    return RecordedExchange(now(), user(), verb, text_of_name(name), family, control, **facts)  # type: ignore[arg-type]  # as asked for


def read_exchanges(folder: Path, file: str = "") -> list[RecordedExchange]:
    """Return the exchanges recorded in a folder, oldest first; of one file, or of all.
    A line that is none is left out.

    Raises OSError where there is a record that cannot be read.
    """
    try:
        content = read_file(folder / RECORD, follow=False, tail=True)
    except FileNotFoundError:
        return []
    found = [each for line in content.decode("utf-8", "replace").split("\n") if (each := _exchange(line))]
    return [each for each in found if file in ("", each.file, _file_of_copy(each.file))]


def file_of_exchange(exchange: RecordedExchange) -> str:
    """Return the name of the parameter file of an exchange, also where a copy of it was put back."""
    return _file_of_copy(exchange.file)


def _file_of_copy(name: str) -> str:
    """Return the file whose download a copy was kept of."""
    stem, before, _ = name.partition(BEFORE)
    return f"{stem}{ENDING}" if before else name


def _exchange(line: str) -> RecordedExchange | None:
    """Return the exchange of a line; None for what this program has not written so."""
    try:
        entry = json.loads(line)
        if not isinstance(entry, dict):
            return None
        changes = tuple((str(p), str(old), str(new)) for p, old, new in entry.pop("changes", ()))
        texts = {f.name: entry[f.name] for f in fields(RecordedExchange) if f.name in entry}
        if not all(isinstance(text, str) for text in texts.values()):
            return None
        return RecordedExchange(**texts, changes=changes)
    except (ValueError, TypeError, RecursionError):
        return None


def changes_of(before: bytes, after: bytes) -> tuple[tuple[str, str, str], ...]:
    """Return the parameters in which two contents of a control differ; none where one of them cannot be
    read.
    """
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


def digest_of(content: bytes) -> str:
    """Return the SHA-256 of a content in hexadecimal; "" for none."""
    return hashlib.sha256(content).hexdigest() if content else ""
