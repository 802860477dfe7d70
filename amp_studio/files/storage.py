"""Parameter files on disk.

The format is YAML: a header, then one line a value (``home.calibration@1: 0 mm``),
closed by the document end mark ``...``, without which a file counts as cut
off. Comments and keys that this program does not know survive every save.
"""

from __future__ import annotations

import io
import re
from dataclasses import dataclass
from functools import lru_cache
from pathlib import Path
from typing import Any

from amp_studio.schema import (
    Address,
    Parameter,
    Schema,
    UnitError,
    Value,
    ValueFault,
    dimension,
    load_schema,
    not_readable,
    read_address,
    read_number,
    read_value,
    shown,
    unit_named,
    write_value,
    written,
)
from amp_studio.schema.regular_file import read_file

from .atomic import Tell, digest, write_atomic
from .line_ends import as_before, plain
from .parameter_file import Header, ParameterFile

FORMAT = 1
"""Version of the file format; a file of a newer one is refused."""

_HEADER = ("name", "application", "revision", "machine", "units", "notes", "signature")
_KNOWN = {"amp_studio", "family", "values", "forced", *_HEADER}


_RARE = re.compile("[\x85\u2028\u2029\ufeff\r]")


class FileFault(ValueError):
    """A file that cannot be used: path, line and one clear sentence; nothing was changed."""

    def __init__(self, path: Path, line: int | None, what: str) -> None:
        self.path, self.line, self.what = path, line, what
        super().__init__(f"{path}{f', line {line}' if line else ''}: {what}")


@dataclass(frozen=True)
class Opened:
    """A file as it was read: what it holds, and what it was on disk."""

    file: ParameterFile
    path: Path
    digest: str


def open_file(path: Path) -> Opened:
    """Read a parameter file; raises FileFault and changes nothing when it cannot be used."""
    content = file_content(path)
    return Opened(read_content(path, content), path, digest(content))


def file_content(path: Path) -> bytes:
    """Return the bytes of a file; raises FileFault."""
    try:
        return read_file(path)
    except OSError as error:
        raise FileFault(path, None, f"cannot be read: {error.strerror}") from None


def read_content(path: Path, content: bytes) -> ParameterFile:
    """Read the content of a parameter file; ``path`` is for messages. Raises FileFault."""
    try:
        text = content.decode("utf-8")
    except UnicodeDecodeError as error:
        raise FileFault(path, content[: error.start].count(b"\n") + 1, "is not UTF-8 text") from None
    data = _parse(path, text)
    schema = _family(path, data)
    file = ParameterFile(schema, _header(path, text, schema, data))
    entries = data.get("values") or {}
    if not isinstance(entries, dict):
        raise FileFault(path, _line(text, "values:"), "'values' is not a list of parameters with values")
    _read_entries(path, text, file, entries)
    forced = data.get("forced") or {}
    if not isinstance(forced, dict):
        raise FileFault(path, _line(text, "forced:"), "'forced' is not a list of parameters with the reason")
    for key, why in forced.items():
        file.forced[read_address(str(key))] = str(why)
    return file


def _parse(path: Path, text: str) -> dict[str, Any]:
    from ruamel.yaml.error import MarkedYAMLError, YAMLError

    from .yaml_text import TextFault, read_texts

    try:
        data = read_texts(text)
    except TextFault as error:
        raise FileFault(path, error.line, str(error)) from None
    except MarkedYAMLError as error:
        if "amp_studio" in text and not text.rstrip().endswith("\n..."):
            raise _cut_off(path, text) from None
        mark = error.problem_mark
        raise FileFault(path, mark.line + 1 if mark else None, f"is not readable: {error.problem}") from None
    except (YAMLError, ValueError, RecursionError) as error:
        raise FileFault(path, None, f"is not readable: {str(error).splitlines()[0]}") from None
    if not isinstance(data, dict) or "amp_studio" not in data:
        raise FileFault(path, None, "is not an AMP Studio parameter file")
    version = data["amp_studio"]
    if not isinstance(version, str) or not re.fullmatch(r"[0-9]{1,9}", version):
        raise FileFault(path, _line(text, "amp_studio:"), f"'{version}' is no version of the file format")
    if int(version) > FORMAT:
        raise FileFault(
            path,
            _line(text, "amp_studio:"),
            f"was written by a newer AMP Studio (file format {version}, known: {FORMAT})",
        )
    if not text.rstrip().endswith("\n..."):
        raise _cut_off(path, text)
    return data


def _cut_off(path: Path, text: str) -> FileFault:
    return FileFault(path, text.count("\n") + 1, "ends without its end mark '...': it has been cut off")


def _family(path: Path, data: dict[str, Any]) -> Schema:
    try:
        return load_schema(str(data.get("family")))
    except KeyError:
        raise FileFault(
            path, None, f"is for the control family '{data.get('family')}', which is not known here"
        ) from None


def _header(path: Path, text: str, schema: Schema, data: dict[str, Any]) -> Header:
    header = Header(extra=_extra(text, data))
    for key in _HEADER:
        if data.get(key) is not None:
            setattr(header, key, str(data[key]))
    machines, systems = [m.key for m in schema.family.machines], list(schema.family.units)
    for key, said, known in (("machine", header.machine, machines), ("units", header.units, systems)):
        if data.get(key) is not None and known and said not in known:
            raise FileFault(
                path, _line(text, f"{key}:"), f"{key} is '{said}'; known here: {', '.join(known)}"
            )
    return header


def _extra(text: str, data: dict[str, Any]) -> dict[str, object]:
    """Return the keys this program does not know with their values as YAML means them, so that a save keeps their kind."""
    if not set(data) - _KNOWN:
        return {}
    from ruamel.yaml import YAML

    return {k: v for k, v in YAML(typ="safe").load(text).items() if k not in _KNOWN}


def _read_entries(path: Path, text: str, file: ParameterFile, entries: dict[Any, Any]) -> None:
    schema = file.schema
    machine = schema.family.machine_parameter
    ordered = sorted(entries, key=lambda k: k != machine)  # the machine type decides what the others are
    for key in ordered:
        address = read_address(str(key))
        said = _scalar(entries[key])
        if said is None:
            raise FileFault(path, _line(text, f"{key}:"), f"{key} has no single value")
        if address in file.values or str(key) in file.unknown:  # "x" and "x@", 1 and "1"
            raise FileFault(path, _line(text, f"{key}:"), f"'{written(address)}' stands twice")
        value = _value(schema, file, address, said)
        if isinstance(value, str):
            raise FileFault(path, _line(text, f"{key}:"), f"{key}: {value}")
        if value is None:
            file.unknown[str(key)] = said
        else:
            file.values[address] = value
    file.situation.forget()


def _value(schema: Schema, file: ParameterFile, address: Address, said: str) -> Value | str | None:
    """Return the value, None for an address the schema does not have, or what is wrong as a text."""
    parameter = schema.parameters.get(address[0])
    if parameter is None or address[1] not in schema.instances(parameter, file.machine):
        return None
    try:
        return _stored(schema, parameter.id, said)
    except ValueFault as error:
        return not_readable(parameter, error)


@lru_cache(maxsize=16_384)
def _stored(schema: Schema, parameter_id: str, said: str) -> Value:
    """Return what a text in a file means; the files of a shop have most of them in common."""
    return read_stored(schema, schema.parameters[parameter_id], said)


def read_stored(schema: Schema, parameter: Parameter, said: str) -> Value:
    """Read a stored value, which names its own unit; raises ValueFault."""
    if parameter.type == "text":
        return Value(said)  # with the blanks at its ends, which a person's entry would lose
    if parameter.choices or parameter.type == "format":
        return read_value(parameter, said, "")
    units = schema.units_of(parameter)
    named = "" if said.startswith(("0x", "0X", "$")) else read_number(said)[1]
    if not named and "" not in units:
        raise ValueFault(f"'{said}' has no unit: write {said} {shown(units[0])}")
    unit = named if named in units else units[0]
    return read_value(parameter, said, _alike(units, named, unit))


def _alike(units: tuple[str, ...], named: str, unit: str) -> str:
    """Return the unit of the parameter that measures the same as the one named, so that it is accepted."""
    try:
        wanted = dimension(unit_named(named))
    except UnitError:
        return unit
    return next((u for u in units if dimension(u) == wanted), unit)


def _scalar(value: object) -> str | None:
    if isinstance(value, bool):
        return "yes" if value else "no"
    if isinstance(value, (str, int, float)):
        return str(value)
    return None


def _line(text: str, start: str) -> int | None:
    """Return the line on which an entry stands."""
    for number, line in enumerate(text.splitlines(), 1):
        if line.strip().strip("'\"").startswith(start) or line.strip().startswith(
            (f"'{start[:-1]}'", f'"{start[:-1]}"')
        ):
            return number
    return None


def content_of(file: ParameterFile, previous: bytes | None = None) -> bytes:
    """Return a file's content; with the ``previous`` content its comments and order survive."""
    from ruamel.yaml import YAML
    from ruamel.yaml.comments import CommentedMap

    yaml = YAML(typ="rt")
    yaml.width, yaml.explicit_end = 4096, True
    tree: Any = yaml.load(previous.decode("utf-8")) if previous and b"#" in previous else CommentedMap()
    header: dict[str, Any] = {"amp_studio": FORMAT, "family": file.schema.family.family}
    header |= {key: getattr(file.header, key) for key in _HEADER if getattr(file.header, key)}
    header |= file.header.extra
    if len(tree) and "units" not in tree and file.header.units == Header.units:
        del header["units"]  # what goes without saying is not added to what a person wrote
    for key in [k for k in tree if k not in header and k not in ("values", "forced")]:
        _drop(tree, key)
    for key, value in header.items():
        if tree.get(key) != value or _is_rare(value):
            tree[key] = _quoted(value)
    _fill(tree, "values", _entries(file), CommentedMap)
    _fill(tree, "forced", {written(a): why for a, why in file.forced.items()}, CommentedMap)
    stream = io.StringIO()
    yaml.dump(tree, stream)
    return stream.getvalue().encode("utf-8")


def _entries(file: ParameterFile) -> dict[str, str]:
    order = {a: n for n, a in enumerate(file.addresses())}
    known = sorted(file.values, key=lambda a: order.get(a, len(order)))
    entries = {written(a): write_value(file.schema.parameters[a[0]], file.values[a]) for a in known}
    return entries | {key: text for key, text in file.unknown.items() if key not in entries}


def _fill(tree: Any, section: str, entries: dict[str, str], empty: type) -> None:
    """Bring one section of the tree to the entries, touching only what differs."""
    if not entries:
        if section in tree:
            _drop(tree, section)
        return
    if section not in tree or not isinstance(tree[section], dict):
        tree[section] = empty()
    part = tree[section]
    for key in [k for k in part if str(k) not in entries]:
        _drop(part, key)
    named = {str(key): key for key in part}
    for key, text in entries.items():
        if key not in named or _scalar(part[named[key]]) != text or _is_rare(text):
            part[named.get(key, key)] = _quoted(text)


def _is_rare(value: Any) -> bool:
    """Tell whether there is a sign in a text, or anywhere in a list or mapping, that YAML keeps as an escape only."""
    if isinstance(value, dict):
        return any(map(_is_rare, (*value.keys(), *value.values())))
    if isinstance(value, list):
        return any(map(_is_rare, value))
    return isinstance(value, str) and _RARE.search(value) is not None


def _quoted(value: Any) -> Any:
    """Return a value so that YAML keeps every sign of it: it folds the rarer line ends unless they are written as escapes."""
    from ruamel.yaml.scalarstring import DoubleQuotedScalarString

    if not _is_rare(value):
        return value
    if isinstance(value, dict):
        return {_quoted(key): _quoted(inside) for key, inside in value.items()}
    return (
        [_quoted(inside) for inside in value] if isinstance(value, list) else DoubleQuotedScalarString(value)
    )


def _drop(part: Any, key: Any) -> None:
    """Remove an entry of a YAML mapping; the comment lines below it, which belong to what follows, stay."""
    from ruamel.yaml.error import CommentMark
    from ruamel.yaml.tokens import CommentToken

    keys = list(part)
    at, below = keys.index(key), _comment_below(part, key)
    del part[key]
    if not below.strip():
        return
    if at > 0:
        comments, slot = _comments_after(part, keys[at - 1])
        before = comments[slot].value if comments[slot] else "\n"
        comments[slot] = CommentToken(before + below, CommentMark(0), None)
    elif len(keys) > 1:
        lines = [
            CommentToken(line.strip() + "\n", CommentMark(part.lc.col), None)
            for line in below.strip().split("\n")
        ]
        following = part.ca.items.setdefault(keys[1], [None, None, None, None])
        following[1] = lines + (following[1] or [])


def _comment_below(part: Any, key: Any) -> str:
    """Return the comment lines between an entry, with all that is in it, and the next one."""
    if not hasattr(part, "ca"):
        return ""
    comments, slot = _comments_after(part, key)
    return str(comments[slot].value).partition("\n")[2] if comments[slot] else ""


def _comments_after(part: Any, key: Any) -> tuple[list[Any], int]:
    """Return where ruamel keeps what stands after an entry: with the last thing in it. A list and the place in it."""
    from ruamel.yaml.comments import CommentedMap, CommentedSeq

    while (
        isinstance(inner := part[key], (CommentedMap, CommentedSeq)) and inner and not inner.fa.flow_style()
    ):
        part, key = inner, list(inner)[-1] if isinstance(inner, CommentedMap) else len(inner) - 1
    if isinstance(part, CommentedMap):
        return part.ca.items.setdefault(key, [None, None, None, None]), 2
    return part.ca.items.setdefault(key, [None, None]), 0


def save_file(
    file: ParameterFile, path: Path, expected: str | None = None, tell: Tell = lambda _said: None
) -> str:
    """Save a file, all or nothing; the previous file becomes the backup.

    ``expected`` is the digest the file had when it was opened, None for a new
    one; ``tell`` is called with what could not be kept. Returns the new digest; raises ChangedOnDisk or SaveFault.
    """
    file.header.signature = file.schema.signature
    notes: list[str] = []

    def made(previous: bytes | None) -> bytes:
        return as_before(content_of(file, plain(previous)), previous, notes.append)

    saved = write_atomic(path, made, expected, tell=tell)
    for said in notes:
        tell(f"{path.name}: {said}")
    return saved
