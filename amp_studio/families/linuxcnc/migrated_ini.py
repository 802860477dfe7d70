"""The INI file of a migration: its lines, and the remark above each with what it was taken from."""

from __future__ import annotations

from dataclasses import dataclass, field

from amp_studio.meaning import AxisMeaning


@dataclass
class MigratedIni:
    """The lines of a configuration: section -> key, value and a remark above."""

    sections: dict[str, list[tuple[str, str, str]]] = field(default_factory=dict)

    def put(self, section: str, key: str, value: str, remark: str = "") -> None:
        self.sections.setdefault(section, []).append((key, value, remark))

    def text(self, name: str) -> str:
        """Return the whole, with number and grade above each key."""
        lines = [
            (
                f"# {name}, migrated. Above each key: the parameter of the old control and how well it was"
                " taken over."
            )
        ]
        for section, rows in self.sections.items():
            lines += ["", f"[{section}]"]
            for key, value, remark in rows:
                lines += [f"# {remark}"] * bool(remark) + [f"{key} = {value}"]
        return "\n".join((*lines, ""))


def taken_from(axis: AxisMeaning, concept: str, outcome: str) -> str:
    """Return the remark above a key: the parameters of the old control and how well they were taken over."""
    figure = axis.figures.get(concept)
    named = ", ".join(f"{s.param} {s.raw}" for s in figure.sources) if figure else ""
    return f"{named}: {outcome}" if named else ""
