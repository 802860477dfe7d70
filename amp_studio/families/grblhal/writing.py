"""Writing what differs: one line at a time, in an order that the firmware takes,
until the control shows all of it.

Settings move each other (settings.c): $22=0 clears $20 and $40, bit 7 of $22 is the opposite of bit 0 of
$676, bit 9 of $22 brings the rates of each axis and takes $24 and $25 away; $20 and $40 need $22, and $0,
$100 and $110 allow each other. So $22 is first, what is refused is tried again after the others,
and what was moved is written again.
"""

from __future__ import annotations

from collections.abc import Iterator, Mapping

from amp_studio.transfer import Progress, Receipt, SentValues

from .content import GrblContent
from .description import DescribedSetting
from .kind import HOMING
from .line import GrblLine, GrblRefusalError
from .numbers import decimals_of, is_shown_as, read_number, shown_number
from .offsets import left_notes, offset_command, offsets_to_put_back, startup_commands
from .reading import read_settings
from .refusals import MAY_WAIT

ROUNDS = 4
"""How often what was moved is written again; dependences of the firmware are two deep."""


class Writing:
    """One download on its way: ``settings`` are those that differ,
    ``sent`` what the control has answered ``ok`` to.
    """

    def __init__(
        self,
        target: GrblContent,
        present: GrblContent,
        known: Mapping[int, DescribedSetting],
        sent: SentValues,
    ) -> None:
        self.target, self.present, self._known = target, present, known
        self.names = {number: setting.name for number, setting in known.items()}
        self.settings = {n: text for n, text in target.settings.items() if present.settings.get(n) != text}
        self.others = dict.fromkeys(offsets_to_put_back(target, present), "")
        self.others |= startup_commands(target, present)
        self.sent = sent
        sent.total = len(self.settings) + len(self.others)

    def run(self, line: GrblLine, progress: Progress) -> None:
        """Send it all; raises GrblRefusalError for what the control refuses in the end,
        and as ``GrblLine.ask``.
        """
        # All are compared again after each round, those that did not differ too: one that was written
        # may have moved them.
        left = dict(self.settings)
        for _ in range(ROUNDS):
            if not left:
                break
            self._round(line, left, progress)
            reported = read_settings(line, self.present)
            left = {
                n: text for n, text in self.target.settings.items() if not self._is_stored(n, text, reported)
            }
        if self.others:
            self._write_others(line, progress)

    def receipt(self) -> Receipt:
        """Return what a person has to know of a download that was taken."""
        waiting = _restart_notes(self.settings, self._known)
        coarse = _coarse_notes(self.settings, self.present.settings, self.names)
        return Receipt(
            restart_needed=bool(waiting), notes=(*coarse, *waiting, *left_notes(self.target, self.present))
        )

    def _is_stored(self, number: int, text: str, reported: Mapping[int, str]) -> bool:
        return is_shown_as(text, reported.get(number, ""))

    def _round(self, line: GrblLine, left: Mapping[int, str], progress: Progress) -> None:
        """Write settings; what is refused is tried again as long as another one was taken meanwhile."""
        # $22 first: it brings and takes away settings, and clears $20 and $40, which come after it.
        waiting = dict(sorted(left.items(), key=lambda entry: (entry[0] != HOMING, entry[0])))
        refusal: GrblRefusalError | None = None
        while waiting:
            taken = 0
            for number, text in list(waiting.items()):
                try:
                    self._write(line, f"${number}", f"${number}={text}")
                except GrblRefusalError as error:
                    if error.code not in MAY_WAIT:
                        raise
                    refusal = error
                    continue
                del waiting[number]
                taken += 1
                progress("download", min(len(self.sent.names), self.sent.total), self.sent.total)
            # Nothing that is left allows another: this refusal is the last word of the control.
            if waiting and not taken:
                assert refusal is not None
                raise refusal

    def _write_others(self, line: GrblLine, progress: Progress) -> None:
        """Put back offsets and start-up lines, and the unit of the program as it was."""
        # Whatever a line before it was refused for, the firmware refuses G-code until a command is taken
        # (protocol.c): this one is.
        in_inches = " G20 " in f"{' '.join(line.ask('$G'))} "
        for name, command in self.others.items():
            self._write(line, name, command or offset_command(self.target, name, in_inches=in_inches))
            progress("download", min(len(self.sent.names), self.sent.total), self.sent.total)
        # A start-up line is executed, and the next program must find the unit it expects.
        line.ask("G20" if in_inches else "G21", writes=True)

    def _write(self, line: GrblLine, name: str, command: str) -> None:
        """Send one setting, recorded before and after; raises GrblRefusalError."""
        # Between two settings is the only point at which a download may stop.
        line.check_cancel()
        self.sent.begin(name)
        try:
            line.ask(command, writes=True)
        except GrblRefusalError:
            self.sent.refuse(name)
            raise
        self.sent.confirm(name)


def _coarse_notes(
    settings: Mapping[int, str], reported: Mapping[int, str], names: Mapping[int, str]
) -> Iterator[str]:
    """Yield a sentence for each setting that the control shows coarser than it keeps it."""
    for number, text in settings.items():
        decimals = decimals_of(reported.get(number, ""))
        if decimals is None:
            continue
        shows = shown_number(read_number(text), decimals)
        if float(shows) != float(text):
            name = f" {names[number]}" if number in names else ""
            yield (
                f"${number}{name} is shown as {shows}: what was sent, {text}, is finer than the control"
                " shows, and active."
            )


def _restart_notes(settings: Mapping[int, str], known: Mapping[int, DescribedSetting]) -> list[str]:
    """Return a sentence about the settings that become active only when the control is switched on again."""
    waiting = [f"${n} {known[n].name}" for n in settings if n in known and known[n].needs_restart]
    if not waiting:
        return []
    return [
        (
            f"{', '.join(waiting)} become{'s' if len(waiting) == 1 else ''} active when the control is"
            " switched off and on."
        )
    ]
