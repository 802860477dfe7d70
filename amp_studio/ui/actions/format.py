"""Import and export: the text formats that controls and their tools read and send."""

from __future__ import annotations

from dataclasses import replace
from pathlib import Path
from typing import TYPE_CHECKING

from PySide6.QtWidgets import QFileDialog

from amp_studio.files import Document, ParameterFile, check_output, keep, out_of_range, write_atomic
from amp_studio.schema import family_ids, load_schema
from amp_studio.ui.base.ask_path import ask_to_open
from amp_studio.ui.base.questions import ask, choose
from amp_studio.ui.base.task import in_background
from amp_studio.ui.base.translated import Translated
from amp_studio.ui.merge.comparisons import AskPath, WriteNew
from amp_studio.ui.window.studio_window import StudioWindow

if TYPE_CHECKING:
    from amp_studio.formats import Account, FormatError

_SHOWN = 8
"""Number of errors of an import that a question lists."""
_LONGEST = 400
"""Characters of a list in a question."""


class TextFormats(Translated):
    """Imports a text file as a parameter file, and exports the open file as text."""

    def __init__(self, window: StudioWindow, ask_path: AskPath, write_new: WriteNew) -> None:
        self.window, self._ask_path, self._write_new = window, ask_path, write_new
        self._account: Account
        """What became of the text that was read last."""
        self._notes: list[str] = []
        """Notes about the text that was read last."""
        self._machine, self._listing = "", 0
        """The machine type, and which of several listings, that a person chose for it."""

    def read(self) -> None:
        """Ask for a text file and a name, and show the imported parameter file."""
        from amp_studio.formats import all_formats  # not needed at program start

        endings = " ".join(f"*{ending}" for f in all_formats() for ending in f.endings)
        kinds = self.tr("Text formats ({endings});;All files (*)").format(endings=endings)
        if path := ask_to_open(self.window, self.tr("Import"), "", kinds):
            self.read_from(path)

    def read_from(self, source: Path) -> None:
        """Ask for a name, and show the parameter file that a text file means."""
        if not self._decided(source):
            return
        file = self._understood(source)
        if file is None or not self._takes_what_is_out_of_range(file):
            return
        named = " ".join(self._notes)
        if not self._is_accepted(
            self.tr("Import"), file, self._account, source.name, self.tr("&Import"), named
        ):
            return
        path = self._ask_path(self.tr("Import as"), source)
        if path is not None:
            file.header.name = path.stem
            self._write_new(path, lambda: Document.create(file, path))
            if self._notes:
                self.window.show_status("; ".join(self._notes))

    def _decided(self, path: Path) -> bool:
        """Ask what a text leaves open: which of several listings, the machine type. Returns whether to go
        on.
        """
        from amp_studio.formats import offer_of

        self._machine, self._listing = "", 0
        offer = in_background(self.window, self.tr("Importing"), lambda: offer_of(path))
        if offer is None:
            return True
        if len(offer.listings) > 1:
            places = [f"{n}: {place}" for n, place in enumerate(offer.listings, 1)]
            # The last one is offered: in a log it is the newest.
            chosen = self._item(self.tr("Listing:"), places, len(places) - 1)
            if chosen is None:
                return False
            self._listing = chosen + 1
        machines = [(m.key, m.name) for m in load_schema(offer.family).family.machines]
        names = [name for _, name in machines]
        chosen = self._item(
            self.tr("Machine type:"), names, [key for key, _ in machines].index(offer.machine)
        )
        if chosen is None:
            return False
        self._machine = machines[chosen][0]
        return True

    def _item(self, asked: str, names: list[str], present: int = 0) -> int | None:
        return choose(self.window, self.tr("Import"), asked, names, self.tr("Import"), present)

    def _understood(self, path: Path) -> ParameterFile | None:
        """Return the imported file; asks for the family, and whether to keep lines that are not
        recognised.
        """
        from amp_studio.formats import FamilyNotGivenError, FormatError

        try:
            # First without keeping anything: most texts are understood whole, and nothing is asked.
            file = self._import(path, None, False)
        except FamilyNotGivenError:
            family = self._family()
            if family is None:
                return None
        except FormatError as error:
            return self._kept(path, None, error)
        else:
            return file
        try:
            return self._import(path, family, False)
        except FormatError as error:
            return self._kept(path, family, error)

    def _family(self) -> str | None:
        families = family_ids()
        chosen = self._item(self.tr("Control family:"), [load_schema(each).family.name for each in families])
        return None if chosen is None else families[chosen]

    def _kept(self, path: Path, family: str | None, error: FormatError) -> ParameterFile | None:
        """Return the imported file with unrecognised lines kept, if the user agrees;
        raises when that is not possible.
        """
        from amp_studio.formats import FormatError

        try:
            file = self._import(path, family, True)
        except FormatError:
            # The first error: it is about the text as it is, not about what was kept of it.
            raise error from None
        listed = "\n".join(list(file.unknown)[:_SHOWN])
        question = self.tr(
            "{error}.\n\nKeep the lines that are not recognised, so that an export writes them"
            " back?\n{listed}"
        ).format(error=error, listed=listed)
        wanted = ask(
            self.window, self.tr("Import"), question, self.tr("&Keep Them"), self.tr("Cancel"), default=1
        )
        if wanted != self.tr("&Keep Them"):
            return None
        self._account = replace(self._account, kept=(), unknown=())  # the user knows of them now
        return file

    def _import(self, path: Path, family: str | None, keep: bool) -> ParameterFile:
        from amp_studio.formats import import_file

        self._notes.clear()
        accounts: list[Account] = []
        read = lambda: import_file(  # noqa: E731  # one call to hand over
            path,
            family,
            keep_unknown=keep,
            machine=self._machine,
            listing=self._listing,
            notify=self._notes.append,
            take_account=accounts.append,
        )
        file = in_background(self.window, self.tr("Importing"), read)
        self._account = accounts[0]
        return file

    def _takes_what_is_out_of_range(self, file: ParameterFile) -> bool:
        faults = out_of_range(file)
        if not faults:
            return True
        more = self.tr("\nand {what} more").format(what=len(faults) - _SHOWN) if len(faults) > _SHOWN else ""
        listed = "\n".join(problem for _, problem in faults[:_SHOWN])
        count = (
            self.tr("One value is")
            if len(faults) == 1
            else self.tr("{count} values are").format(count=len(faults))
        )
        question = self.tr(
            "{count} not allowed:\n{listed}{more}\n\nImport them and mark them as forced?"
        ).format(count=count, listed=listed, more=more)
        if ask(
            self.window,
            self.tr("Import"),
            question,
            self.tr("&Import and Mark"),
            self.tr("Cancel"),
            default=1,
        ) != self.tr("&Import and Mark"):
            return False
        keep(file, [address for address, _ in faults], "an import")
        return True

    def write(self) -> None:
        """Ask for a name and export the open file; the file extension sets the format."""
        from amp_studio.formats import export_of, formats_of

        workspace = self.window.workspace_in_front
        offered = formats_of(workspace.file.schema.family.family)
        filters = {
            f"{f.title[:1].upper()}{f.title[1:]} ({' '.join(f'*{ending}' for ending in f.endings)})": f
            for f in offered
        }
        near = workspace.path.with_suffix(offered[0].ending)
        text, chosen = QFileDialog.getSaveFileName(
            self.window, self.tr("Export"), str(near), ";;".join(filters)
        )
        if not text:
            return
        found = filters.get(chosen)
        path = Path(text)
        # An ending that was typed has precedence over the kind that was chosen.
        path = path if path.suffix or found is None else path.with_suffix(found.ending)
        check_output(path, workspace.path)
        # A copy: it is written in a thread, and the file may be edited meanwhile.
        file, key = workspace.file.copy(), found.key if found else None
        secrets = workspace.secrets
        export = in_background(
            self.window, self.tr("Exporting"), lambda: export_of(file, path, key, secrets=secrets)
        )
        if not self._is_accepted(self.tr("Export"), file, export.account, path.name, self.tr("&Export")):
            return
        notes: list[str] = []
        write_atomic(path, export.content, notify=notes.append)
        number = self.tr("{written} of {total} values").format(
            written=export.account.written, total=len(file.values)
        )
        self.window.show_status("; ".join([f"{path} written ({number})", *notes]))

    def _is_accepted(
        self, title: str, file: ParameterFile, account: Account, name: str, yes: str, named: str = ""
    ) -> bool:
        """Return whether the user accepts the account; asked only where a value does not go across as it
        is.
        """
        from amp_studio.formats import account_lines

        lines = list(account_lines(file, account, named))
        if not lines:
            return True
        lost = len(account.not_representable) + len(account.rounded)
        head = self.tr("{name}: {written} of {total} values go across as they are.").format(
            name=name, written=account.written, total=account.written + lost
        )
        short_lines = [line if len(line) <= _LONGEST else f"{line[:_LONGEST]} …" for line in lines]
        return ask(self.window, title, "\n\n".join([head, *short_lines]), yes, self.tr("Cancel")) == yes
