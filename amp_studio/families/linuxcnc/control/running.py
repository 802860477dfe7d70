"""A LinuxCNC that runs on this computer: with which configuration, which values it uses, and what its joints
do. ``halcmd show`` changes nothing.
"""

from __future__ import annotations

import subprocess
from collections.abc import Iterator
from math import isclose
from pathlib import Path

from amp_studio.families.linuxcnc.figures import read_figure
from amp_studio.families.linuxcnc.formats.ini import FAMILY, unit_in
from amp_studio.families.linuxcnc.kinematics import joint_letters
from amp_studio.files import ParameterFile
from amp_studio.schema import Address, InvalidValueError, Value
from amp_studio.transfer import AxisStatus, ControlStatus, TransferError

PROCESSES = Path("/proc")
TASK = b"milltask"
"""The program that reads the configuration; the start script gives it ``-ini`` and the path (LN948)."""
SECONDS = 3.0
_DIGITS = 1e-6
"""halcmd prints seven digits."""
_STATES = {
    "homed": "homed",
    "homing": "homing",
    "f-errored": "following error",
    "amp-fault-in": "amplifier fault",
    "pos-hard-limit": "on its positive limit switch",
    "neg-hard-limit": "on its negative limit switch",
    "error": "error",
}
"""Pins of a joint -> what they mean where they are true (C, the pins of joints)."""


def is_running(path: Path) -> bool:
    """Return whether a LinuxCNC runs with this configuration on this computer, as far as it shows that."""
    # The start script runs one that includes files by this copy of it (LN345).
    expanded = path.with_name(f"{path.name}.expanded")
    return any(found.resolve() in (path, expanded) for found in _configurations())


def _configurations() -> Iterator[Path]:
    """Yield the configurations of the programs that run."""
    for folder in PROCESSES.glob("[0-9]*"):
        try:
            words = (folder / "cmdline").read_bytes().split(b"\0")
        except OSError:
            continue  # it has ended
        if words[0].rpartition(b"/")[2] == TASK and b"-ini" in words[:-1]:
            yield Path(words[words.index(b"-ini") + 1].decode(errors="surrogateescape"))


def pins(kind: str) -> dict[str, str]:
    """Return the pins of one kind (``ini``, ``joint``) with what they are; raises TransferError."""
    try:
        asked = subprocess.run(
            ["halcmd", "-s", "show", "pin", f"{kind}.*"],
            capture_output=True,
            text=True,
            timeout=SECONDS,
            check=True,
        )
    except (OSError, subprocess.SubprocessError) as error:
        raise TransferError(
            f"the running LinuxCNC does not show its values ({error}): halcmd has to work for this user", ""
        ) from error
    return pins_of(asked.stdout)


def pins_of(text: str) -> dict[str, str]:
    """Return the pins of a listing with what they are."""
    rows = (row.split() for row in text.splitlines())
    return {row[4]: row[3] for row in rows if len(row) >= 5}


def values_in_use(file: ParameterFile) -> dict[Address, Value]:
    """Return what the running program uses of the values that a file sets, as far as pins show it.

    A value that is listed as the file has it is the file's own; one with fewer digits would seem to differ.
    Raises TransferError.
    """
    return values_of(file, pins("ini"))


def values_of(file: ParameterFile, listed: dict[str, str]) -> dict[Address, Value]:
    """Return ``values_in_use`` by pins that were listed; raises TransferError."""
    used = dict[Address, Value]()
    for parameter, pattern, _ in file.schema.tables["pins"].rows:
        for address, value in file.values.items():
            text = listed.get(str(pattern).format(i=address[1].lower())) if address[0] == parameter else None
            if text is not None and file.evaluation.state(address).is_active:
                used[address] = _in_use(file, address, value, text)
    return used


def _in_use(file: ParameterFile, address: Address, value: Value, text: str) -> Value:
    try:
        found = read_figure(file.schema.parameters[address[0]], text, unit_in(file, address))
    except InvalidValueError as error:
        raise TransferError(f"the running LinuxCNC shows {text[:20]} for a value: {error}", "") from None
    if isinstance(found.value, (int, float)) and isinstance(value.value, (int, float)):
        return value if isclose(found.value, value.value, rel_tol=_DIGITS) else found
    return value if found.value == value.value else found


def status_of(file: ParameterFile, runs: bool, protocol: str) -> ControlStatus:
    """Return what the program states of its joints; raises TransferError."""
    if not runs:
        return ControlStatus(FAMILY, protocol, file.header.name, "does not run with this configuration")
    return status_from(file, pins("motion") | pins("joint"), protocol)


def status_from(file: ParameterFile, listed: dict[str, str], protocol: str) -> ControlStatus:
    """Return ``status_of`` by pins that were listed; raises TransferError."""
    joints = [n for n in range(16) if listed.get(f"joint.{n}.active") == "TRUE"]
    kinematics = file.get(("kins.kinematics", ""))
    letters = joint_letters(str(kinematics.value) if kinematics else None, len(joints))
    axes = tuple(_joint(n, letters[n] if n < len(letters) else f"joint {n}", listed, file) for n in joints)
    state = "on" if listed.get("motion.motion-enabled") == "TRUE" else "off"
    values = {"velocity": _number(listed.get("motion.current-vel", ""))}
    return ControlStatus(FAMILY, protocol, file.header.name, state, axes, values=values)


def _joint(n: int, name: str, listed: dict[str, str], file: ParameterFile) -> AxisStatus:
    """Return the reading of a joint from the pins that are listed."""

    def figure(pin: str) -> float:
        return _number(listed.get(f"joint.{n}.{pin}", ""))

    states = tuple(text for pin, text in _STATES.items() if listed.get(f"joint.{n}.{pin}") == "TRUE")
    unit = unit_in(file, ("joint.home", str(n)))
    return AxisStatus(
        name, figure("pos-fb"), figure("f-error"), figure("vel-cmd"), unit, states, tuple(_STATES.values())
    )


def _number(text: str) -> float:
    try:
        return float(text)
    except ValueError:
        raise TransferError(f"the running LinuxCNC shows '{text[:20]}' for a number", "") from None
