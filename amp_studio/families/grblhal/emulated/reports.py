"""What the firmware reports: protocol.c and report.c of the grblHAL core, Grbl 1.1 likewise."""

from __future__ import annotations

from collections.abc import Callable, Iterator, Mapping
from dataclasses import dataclass

from amp_studio.schema import load_schema

from .stored_settings import FAMILY, StoredSettings


@dataclass(frozen=True)
class FirmwareReports:
    """The reports of a control as it is now."""

    settings: StoredSettings
    axes: str
    offsets: Mapping[str, str]
    startup: Mapping[int, str]
    build: str
    unit: int
    """20 for inches, 21 for mm, as the word G20 or G21 last had it."""

    def by_name(self) -> dict[str, Callable[[], Iterator[str]]]:
        """Return name after the ``$`` -> what makes its lines."""
        common = {
            "I": self._identity,
            "$": self._values,
            "#": self._coordinates,
            "G": self._modes,
            "N": self._lines,
        }
        if self.settings.is_classic:
            return common
        return {
            **common,
            "+": self._values,
            "EG": self._groups,
            "ES": self._descriptions,
            "ESH": self._helps,
            "EA": self._alarms,
            "EE": self._errors,
        }

    def _identity(self) -> Iterator[str]:
        """Yield the answer to $I."""
        if self.settings.is_classic:
            yield from (f"[VER:1.1h.20190830:{self.build}]", "[OPT:V,15,128]")
            return
        yield f"[VER:1.1f.20260817:{self.build}]"
        yield f"[OPT:VNM{'H' if self.settings.all[22].value else ''},100,1024,{len(self.axes)},0]"
        yield f"[AXS:{len(self.axes)}:{self.axes}]"
        yield from (
            "[NEWOPT:ENUMS,RT+]",
            "[FIRMWARE:grblHAL]",
            "[NVS STORAGE:*EEPROM]",
            "[FREE MEMORY:64K]",
            "[DRIVER:Emulated]",
            "[DRIVER VERSION:1]",
        )

    def _values(self) -> Iterator[str]:
        for setting in self.settings.available():
            yield f"${setting.number}={setting.show()}"

    def _coordinates(self) -> Iterator[str]:
        inches = self.settings.all[13].value
        for name, text in self.offsets.items():
            figures = ",".join(f"{float(part) / 25.4:.4f}" for part in text.split(",")) if inches else text
            yield f"[{name}:{figures}]"
        zeros = ",".join(["0.0000" if inches else "0.000"] * len(self.axes))
        yield from (f"[TLO:{'0.000' if self.settings.is_classic else zeros}]", f"[PRB:{zeros}:0]")

    def _modes(self) -> Iterator[str]:
        yield f"[GC:G0 G54 G17 G{self.unit} G90 G94 M5 M9 T0 F0 S0]"

    def _lines(self) -> Iterator[str]:
        for number, line in self.startup.items():
            yield f"$N{number}={line}"

    def _groups(self) -> Iterator[str]:
        yield "[SETTINGGROUP:0|0|Root]"
        for number, group in enumerate(load_schema(FAMILY).groups, 1):
            yield f"[SETTINGGROUP:{42 if group.name == 'Axis' else number}|0|{group.name}]"
        for number, axis in enumerate(self.axes):
            yield f"[SETTINGGROUP:{43 + number}|42|{axis}-axis]"

    def _descriptions(self) -> Iterator[str]:
        for setting in self.settings.available():
            yield setting.describe(len(self.axes))

    def _helps(self) -> Iterator[str]:
        for setting in self.settings.available():
            yield f"{setting.number}\t{setting.name}\t{setting.unit}\t\t\t{setting.help}\t\t\t0\t0"

    def _alarms(self) -> Iterator[str]:
        yield from (
            "[ALARMCODE:1||A limit switch was reached.]",
            "[ALARMCODE:2||A move would have left the travel.]",
        )

    def _errors(self) -> Iterator[str]:
        for number, text in (
            (3, "Not a command."),
            (8, "Not at rest."),
            (9, "Locked."),
            (52, "Out of range."),
        ):
            yield f"[ERRORCODE:{number}||{text}]"
