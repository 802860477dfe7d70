"""Harvest the settings of grblHAL and its plugins from their sources: numbers, names, units, bounds,
bits and build conditions.

    python scripts/harvest_grblhal.py FOLDER/core FOLDER/Plugins_motor … [--write | --counts]

Each folder is a checkout, or a git directory, of one repository; the core is the first. Only facts are taken,
none of the sources' help. What parameter_db describes by hand stays as it is; of it, a mask or a choice that
is wider in some build is listed. ``--write`` writes the rest to ``parameter_db/grblhal/groups``,
one file a group. ``--counts`` counts settings, numbers, bits, alarms and errors, and lists those that
parameter_db does not have.
"""

import argparse
import re
from collections.abc import Iterator
from pathlib import Path

from grblhal_sources import (
    Found,
    Sources,
    files_of,
    read_numbers,
    read_settings,
    read_texts,
    without_comments,
)

from amp_studio.schema import Parameter, Schema, load_schema
from amp_studio.schema.units import UnitError, unit_named

GROUPS = Path(__file__).parents[1] / "parameter_db" / "grblhal" / "groups"
AXES = ("X", "Y", "Z", "A", "B", "C", "U", "V")
TYPES = {
    "Format_Bool": "boolean",
    "Format_Bitfield": "bits",
    "Format_XBitfield": "bits",
    "Format_RadioButtons": "choice",
    "Format_AxisMask": "axes",
    "Format_Integer": "integer",
    "Format_Decimal": "real",
    "Format_String": "text",
    "Format_Password": "password",
    "Format_IPv4": "text",
    "Format_Int8": "integer",
    "Format_Int16": "integer",
}
WIDTHS = {"Format_Int8": 8, "Format_Int16": 16, "Format_Integer": 32}
UNITS = {
    "microseconds": "us",
    "milliseconds": "ms",
    "seconds": "s",
    "percent": "%",
    "step/mm": "steps/mm",
    "RPM": "rpm",
    "mm/sec^2": "mm/s2",
    "mm/sec^3": "mm/s3",
    "minutes": "min",
}
QUANTITIES = {
    "mm": "length",
    "mm/min": "velocity",
    "mm/s2": "acceleration",
    "mm/s3": "jerk",
    "steps/mm": "counts-per-length",
    "ms": "time",
    "us": "time",
    "s": "time",
    "min": "time",
    "%": "percent",
    "rpm": "rotation",
    "Hz": "frequency",
    "V": "voltage",
    "mA": "current",
    "A": "current",
    "deg": "angle",
}
NAMES = {"Setting_SpindlePWMBehaviour": "Disable spindle with zero speed (obsolete)"}
"""Settings that the source calls deprecated alone."""
SETS = {"ESET_OPTS": (5, 10), "MSET_OPTS": (8, 5)}
"""Options of settings of which there are several sets: how many,
and numbers from one to the next (settings.h)."""
PORTS = 16
CONTROL_INPUTS = 14
"""The number of the mask of control inputs, the widest one."""
NO_CODES = {0, 253}
"""What no control sends: no error, and what it keeps to itself (``Status_Unhandled``)."""


def key_of(text: str) -> str:
    return re.sub("[^a-z0-9]+", "_", text.casefold()).strip("_")[:60]


def merged(settings: list[Found]) -> Found:
    """Return one setting of all that describe a number: the widest one, the first source's name."""
    first = settings[0]
    order = ("boolean", "choice", "bits", "axes", "integer", "real", "text", "password")
    widest = max(
        settings,
        key=lambda s: (order.index(TYPES[s.form]), len(s.labels.split(",")) if "<" not in s.labels else 0),
    )
    ranges = [(number(s.least), number(s.most)) for s in settings if TYPES[s.form] == TYPES[widest.form]]
    lows = [low for low, _ in ranges if low is not None]
    highs = [high for _, high in ranges if high is not None]
    low = min(lows) if len(lows) == len(ranges) else None  # one source without a bound: none
    high = max(highs) if len(highs) == len(ranges) else None
    names = list(dict.fromkeys(s.name for s in settings if s.name)) or [first.constant]
    return Found(
        first.number,
        first.constant,
        first.group,
        NAMES.get(first.constant, names[0]),
        widest.unit or first.unit,
        widest.form,
        widest.labels,
        "" if low is None else f"{low:g}",
        "" if high is None else f"{high:.10g}",
        first.options,
        first.source,
        first.line,
        "; or ".join(
            dict.fromkeys(f"{s.source}{f', {s.condition}' if s.condition else ''}" for s in settings)
        )
        + (f" (also named {', '.join(names[1:])})" if len(names) > 1 else ""),
        first.count,
    )


def number(text: str) -> float | None:
    try:
        return float(text)
    except ValueError:
        return None


def yaml_text(text: str) -> str:
    return '"' + text.replace("\\", "\\\\").replace('"', '\\"') + '"'


def parameter(setting: Found, identifier: str, nth: int = 0) -> list[str]:
    """Return the lines of one parameter."""
    kind = TYPES[setting.form]
    name = (
        setting.name.partition("-axis ")[2] if setting.is_of_axes else setting.name.replace("?", str(nth + 1))
    )
    name = (name or setting.name)[:1].upper() + (name or setting.name)[1:]
    page = f"{re.sub('[^A-Z0-9]', '', Path(setting.source.split()[-1]).stem.upper())}{setting.line}"
    scope = "axis" if setting.is_of_axes else "global"
    step = ", step: 1" if setting.is_of_axes else ""
    out = [
        f"  - id: {identifier}",
        f"    name: {yaml_text(' '.join(name.split()))}",
        "    layouts:",
        (
            f"      - {{machines: [grblhal], scope: {scope}, numbers: {{start:"
            f' {setting.number + nth * setting.step}{step}, format: "${{n}}"}}}}'
        ),
        f"    type: {'bits' if kind == 'axes' else 'text' if kind == 'password' else kind}",
        *value_lines(setting, kind),
    ]
    if "reboot_required" in setting.options or ("_OPTS" in setting.options and "REBOOT" in setting.options):
        out.append("    effect: {level: restart}")
    if kind == "password":
        out.append("    secret: true")
    out += [
        "    optional: true",
        "    in_signature: false",
        "    needs:",
        f"      - {{what: {yaml_text('a build with ' + setting.condition)}, page: {page}}}",
        "    help:",
        (
            "      what: A setting of other builds. Number, name, unit, bounds and bits are those of the"
            " firmware's source."
        ),
        f"      find: Ask the control; its help is the answer to $SED={setting.number + nth * setting.step}.",
        "      wrong: The help of the control has it.",
        f"    page: {page}",
        "",
    ]
    return out


def value_lines(setting: Found, kind: str) -> list[str]:
    command = 'command: "${n}={v}"'
    if kind == "boolean":
        return ["    choices: yes_no", f"    storage: {{{command}}}"]
    if kind == "axes":
        return ["    bits: axes", "    first_axis: 0", f"    storage: {{bits: 8, signed: false, {command}}}"]
    if kind == "bits":
        labels = [f"Port {n}" for n in range(PORTS)] if "<" in setting.labels else setting.labels.split(",")
        bits = [
            f"      - {{bit: {n}, label: {yaml_text(label.strip())}}}"
            for n, label in enumerate(labels)
            if label.strip() not in ("", "N/A")
        ]
        rotary = ["    first_axis: 3"] if "rotary" in setting.constant.casefold() else []
        return [
            "    bits:",
            *bits,
            *rotary,
            f"    storage: {{bits: {len(labels)}, signed: false, {command}}}",
        ]
    if kind == "choice":
        known = "<" not in setting.labels and setting.labels
        labels = setting.labels.split(",") if known else ["First of those that the build has"]
        keys: list[str] = []
        for label in labels:
            key = key_of(label) or f"choice_{len(keys)}"
            keys.append(key if re.match("[a-z]", key) and key not in keys else f"choice_{len(keys)}")
        choices = [
            f"      - {{key: {key}, label: {yaml_text(label.strip())}, raw: {n}}}"
            for n, (key, label) in enumerate(zip(keys, labels, strict=True))
            if label.strip() not in ("", "N/A")
        ]
        more = [] if known else ["    more_codes: true"]
        return ["    choices:", *choices, *more, f"    storage: {{{command}}}"]
    if kind in ("text", "password"):
        return [f"    storage: {{{command}}}"]
    unit = UNITS.get(setting.unit, setting.unit)
    try:
        unit = unit_named(unit) if unit else ""
    except UnitError:
        unit = ""
    low, high = number(setting.least), number(setting.most)
    low = min(low, 0.0) if low is not None and "allow_null" in setting.options else low
    if kind == "integer" and high is None:
        high = 2.0 ** WIDTHS[setting.form] - 1
    bounds = f"[{0 if low is None else f'{low:g}'}, {'null' if high is None else f'{high:.10g}'}]"
    lines = []
    quantity = QUANTITIES.get(unit, "")
    if quantity:
        lines.append(f"    quantity: {quantity}")
    if quantity and unit not in ("mm", "mm/min", "mm/s2", "mm/s3", "steps/mm"):
        lines.append(f'    unit: "{unit}"')
    elif not quantity:
        is_known = setting.unit and "<" not in setting.unit
        lines.append(f"    bare: {yaml_text(setting.unit) if is_known else 'not printed in the manual'}")
    shown = f'unit: "{unit}", ' if quantity else ""
    decimals = len(setting.labels.partition(".")[2])
    if kind == "real":
        lines.append(f"    decimals: {decimals}")
    lines.append(f'    ranges: {{"{unit if quantity else ""}": {bounds}}}')
    signed = "true" if (low or 0) < 0 else "false"
    how = (
        f"decimals: {decimals}, single: true"
        if kind == "real"
        else f"bits: {WIDTHS[setting.form]}, signed: {signed}"
    )
    return [*lines, f"    storage: {{{shown}{how}, {command}}}"]


def main() -> None:
    parser = argparse.ArgumentParser(
        description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter
    )
    parser.add_argument("folders", nargs="+", type=Path)
    parser.add_argument(
        "--write", action="store_true", help="write the groups of what is not described by hand"
    )
    parser.add_argument("--print", action="store_true", help="print them")
    parser.add_argument(
        "--counts", action="store_true", help="count what there is, and list what is not described here"
    )
    options = parser.parse_args()
    sources, all_files = Sources(), []
    for folder in options.folders:
        repository = next(part for part in reversed(folder.parts) if part not in ("repo", ".git")).rpartition(
            "+"
        )[2]
        for name, text in files_of(folder):
            if "/boards/" not in name:  # settings of one board alone, under numbers that others use otherwise
                all_files.append((f"{repository} {name}", without_comments(text)))
    for _ in range(3):  # a base is sometimes in another file than what counts from it
        for _, text in all_files:
            read_numbers(text, sources.numbers)
    for _, text in all_files:
        read_texts(text, sources.texts)
        for constant, title in re.findall(r'\{\s*Group_\w+\s*,\s*(Group_\w+)\s*,\s*"([^"]+)"', text):
            sources.groups.setdefault(constant, title)
    for name, text in all_files:
        read_settings(name, text, sources)
    by_number: dict[int, list[Found]] = {}
    for setting in sources.settings:
        by_number.setdefault(setting.number, []).append(setting)
    if options.counts:
        print(*counted(by_number, dict(all_files)), sep="\n")
        return
    report(by_number, sources, write=options.write, show=options.print)


def counted(by_number: dict[int, list[Found]], files: dict[str, str]) -> Iterator[str]:
    """Yield how much the sources have of each kind, and what of it parameter_db does not have."""
    schema = load_schema("grblhal")
    here = schema.on("grblhal")
    texts = {name: text for name, text in files.items() if name.endswith((".h", ".c"))}
    enum = re.search(r"typedef enum \{([^}]*)\}\s*setting_id_t", "\n".join(texts.values()))
    constants = set(re.findall(r"\bSetting_\w+", enum[1])) if enum else set()
    numbers = {int(plain) for address in here.addresses if (plain := here.plain_number(address))}
    yield f"{len(by_number)} settings are described, {len(constants)} have an id in setting_id_t"
    yield from _lacking("settings", by_number.keys() - numbers)
    control = by_number.get(CONTROL_INPUTS, [])
    bits = {n for one in control for n, label in enumerate(one.labels.split(",")) if label not in ("", "N/A")}
    address = next((a for a in here.addresses if here.plain_number(a) == str(CONTROL_INPUTS)), None)
    known = {bit.bit for bit in schema.parameters[address[0]].bits or ()} if address else set()
    yield f"${CONTROL_INPUTS} has {len(bits)} bits"
    yield from _lacking(f"bits of ${CONTROL_INPUTS}", bits - known)
    for kind, prefix in (("alarms", "Alarm"), ("errors", "Status")):
        codes = {
            int(code)
            for text in texts.values()
            for code in re.findall(rf"\b{prefix}_\w+\s*=\s*([0-9]+)\s*,", text)
        } - NO_CODES
        listed = {
            m.code.rpartition(":")[2]
            for each in schema.message_lists
            if each.id == kind
            for m in each.messages
        }
        yield f"{len(codes)} {kind}"
        yield from _lacking(kind, {code for code in codes if str(code) not in listed})


def _lacking(what: str, numbers: set[int]) -> Iterator[str]:
    if numbers:
        yield f"not described here: {what} {', '.join(map(str, sorted(numbers)))}"


def report(by_number: dict[int, list[Found]], sources: Sources, *, write: bool, show: bool) -> None:
    """Print, or write, a file of parameters for each group of settings that are not described by hand."""
    schema = load_schema("grblhal")
    by_hand = described_by_hand(schema)
    files = len({s.source for s in sources.settings})
    print(f"{len(by_number)} numbers in {files} files; {len(by_hand)} described by hand")
    for n in sorted(by_hand.keys() & by_number.keys()):
        print_wider(n, schema.parameters[by_hand[n]], merged(by_number[n]))
    taken = {p.id for p in schema.parameters.values() if p.in_signature}
    count = 0
    known_groups = {g.name: g.key for g in schema.groups if any(p.in_signature for p in g.parameters)}
    for constant, settings in groups_of(by_number, by_hand, sources).items():
        title = sources.groups.get(constant, constant.removeprefix("Group_"))
        title = "Axis" if constant == "Group_Axis0" else title
        base = known_groups.get(title, key_of(title))
        key = f"{base}_builds" if title in known_groups else base
        lines = group_head(key, title, is_of_axes=constant == "Group_Axis0", is_known=title in known_groups)
        for setting in settings:
            for nth in range(setting.count):
                lines += parameter(setting, identifier(setting, nth, base, taken), nth)
                count += 1
        if write:
            (GROUPS / f"{key}.yaml").write_text("\n".join(lines).rstrip() + "\n", "utf-8")
        print(f"group {key}: {len(settings)}")
        if show:
            print("\n".join(lines))
    print(f"{count} parameters more")


def described_by_hand(schema: Schema) -> dict[int, str]:
    """Return number -> id of the parameters that parameter_db describes by hand."""
    here = schema.on("grblhal")
    found = {}
    for parameter_id, _instance in here.addresses:
        known = schema.parameters[parameter_id]
        layout = here.layout(known)
        if layout and layout.numbers and layout.numbers.start is not None and known.in_signature:
            found[layout.numbers.start] = parameter_id
    return found


def print_wider(number: int, known: Parameter, one: Found) -> None:
    """Print a mask or a choice that has more in some build than parameter_db describes."""
    labels = [label for label in one.labels.split(",") if label.strip() not in ("", "N/A")]
    count = len(known.bits or known.choices or ())
    if TYPES[one.form] in ("bits", "choice") and "<" not in one.labels and len(labels) > count:
        print(f"wider: ${number} {known.id}: {count} of {one.labels}")


def groups_of(
    by_number: dict[int, list[Found]], by_hand: dict[int, str], sources: Sources
) -> dict[str, list[Found]]:
    """Return the settings that are not described by hand by their group, each with how many there are."""
    groups: dict[str, list[Found]] = {}
    for n, settings in sorted(by_number.items()):
        if n in by_hand:
            continue
        one = merged(settings)
        base = re.sub("Base$", "", one.constant)
        several = next((option for option in SETS if option in one.options), None)
        if several:
            one.count, one.step = SETS[several]
        elif not one.is_of_axes and ("_OPTS" in one.options or "increment" in one.options):
            one.count = max(1, sum(bool(re.fullmatch(f"{base}[0-9]", c)) for c in sources.numbers))
        groups.setdefault(one.group, []).append(one)
    return groups


def group_head(key: str, title: str, *, is_of_axes: bool, is_known: bool) -> list[str]:
    """Return the head of the file of a group; ``is_known``: parameter_db has one of this name by hand."""
    return [
        "# yaml-language-server: $schema=../../schemas/group.schema.json",
        (
            "# Written by scripts/harvest_grblhal.py from the sources of the firmware and its plugins:"
            " facts of other builds."
        ),
        f"key: {key}",
        f"name: {yaml_text(title)}",
        *(["section: Of other builds"] if is_known else []),
        'chapter: "S"',
        *(
            ["states:", "  - {state: hidden, when: absent_axis, scope: axis, page: S3012}"]
            if is_of_axes
            else []
        ),
        "parameters:",
        "",
    ]


def identifier(setting: Found, nth: int, base: str, taken: set[str]) -> str:
    """Return an id that no other parameter has: by the setting's name, else with its number."""
    name = setting.name.replace("?", str(nth + 1))
    key = key_of(setting.name.partition("-axis ")[2] if setting.is_of_axes else name)
    number = setting.number + nth * setting.step
    found = f"{base}.{key}" if re.match("[a-z]", key) else f"{base}.setting_{number}"
    if found in taken:
        found += f"_{number}"
    taken.add(found)
    return found


if __name__ == "__main__":
    main()
