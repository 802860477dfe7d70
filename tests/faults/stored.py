"""Damaged files that the program keeps for itself: a control's memory, copies, backups, the cache, settings,
locks, facts.

What is refused is refused with the one documented error, and no file has changed by it.
"""

import hashlib
import logging
import random
import shutil
from collections.abc import Callable, Iterator
from pathlib import Path
from unittest import mock

from amp_studio.cli.checks.cache import CheckCache
from amp_studio.cli.checks.formats import CheckResult
from amp_studio.cli.parsing import parse
from amp_studio.cli.verbs.checks.validate import VERB
from amp_studio.files import ParameterFileError, new_file, recover_backup
from amp_studio.files.atomic import SaveError
from amp_studio.files.lock import EditLock, InUseError
from amp_studio.files.reading import read_content
from amp_studio.files.storage import save_file
from amp_studio.schema import DatabaseError
from amp_studio.schema.compiled_cache import read_cached, write_cached
from amp_studio.schema.load import compile_family
from amp_studio.schema.model.compiled_json import record_text, text_record
from amp_studio.transfer.client.kept import CopyError, digest_path, keep_image, open_copy
from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.record import Identity, StateError, to_json, written
from amp_studio.transfer.house.broken_transfers import BrokenTransfers
from amp_studio.transfer.house.message import Commit, Committed, OpenDownload
from amp_studio.transfer.image import encode_image
from amp_studio.validate.rule_file import suppress

from .texts import REPOSITORY, RULES, SMALL, mutants, violations
from .wire import damaged

FACTS = REPOSITORY / "tests" / "families" / "steps" / "facts"


def contents(folder: Path) -> dict[str, bytes]:
    """Return the content of a folder."""
    return {str(path.relative_to(folder)): path.read_bytes() for path in folder.rglob("*") if path.is_file()}


def _one_damaged(
    folder: Path, seed: int, count: int, look: Callable[[], None], allowed: tuple[type[Exception], ...]
) -> list[str]:
    """Damage one file of a folder at a time and look; what is refused has changed nothing."""
    whole, chance = contents(folder), random.Random(seed)
    texts = {name: content.decode("utf-8") for name, content in whole.items()}

    def cases() -> Iterator[tuple[str, str]]:
        for _ in range(count):
            name = chance.choice(sorted(texts))
            yield name, next(mutants([texts[name]] * 3 + list(texts.values()), chance.getrandbits(32), 1))

    def looked(case: tuple[str, str]) -> None:
        _lay_out(folder, whole)
        (folder / case[0]).write_bytes(case[1].encode("utf-8", "surrogatepass"))
        before = contents(folder)
        try:
            look()
        except allowed:
            assert contents(folder) == before, "a refusal has changed files"
            raise

    return violations(cases(), looked, allowed)


def _lay_out(folder: Path, whole: dict[str, bytes]) -> None:
    for name, held in contents(folder).items():
        if name not in whole:
            (folder / name).unlink()
        elif held != whole[name]:
            (folder / name).write_bytes(whole[name])
    for name, content in whole.items():
        if not (folder / name).exists():
            (folder / name).write_bytes(content)


def fuzz_memories(folder: Path, seed: int, count: int) -> list[str]:
    """Start an emulated control on a damaged memory: in the middle of a download,
    and between a commit and its end.
    """
    identity, image = Identity("9pc", "s1"), b"a new image\n"
    found = []
    for number, (name, staged) in enumerate({"download": 5, "commit": len(image)}.items()):
        memory = folder / name
        _begin(memory, identity, image, staged)

        def look(memory: Path = memory) -> None:
            control = Control(memory, identity, b"born with")
            try:
                assert control.staged_size <= len(image)
                assert control.image == (memory / "active.img").read_bytes()
            finally:
                control.close()

        found += _one_damaged(memory, seed + number, max(1, count // 2), look, (StateError,))
    return found


def _begin(memory: Path, identity: Identity, image: bytes, staged: int) -> None:
    """Leave a memory as it is in the middle of a download, or just after the one moment of a commit."""
    control = Control(memory, identity, b"born with")
    transfer, sha256 = b"t" * 16, hashlib.sha256(image).digest()
    control.open_download(OpenDownload(transfer, len(image), sha256, control.sha256, "s1"))
    control.stage(transfer, image[:staged])
    if staged == len(image):
        control.commit(Commit(transfer, sha256))
    control.close()
    answer = Committed(transfer, sha256, 1, restarting=True)
    (memory / "commit.json").write_bytes(to_json({"to": sha256.hex(), "answer": written(answer)}))


def fuzz_copies(folder: Path, seed: int, count: int) -> list[str]:
    """Open damaged copies of a control's content: the image, its digest and the parameter file beside it."""
    file = new_file("57c422b", "module")
    for address in list(file.values)[12:]:
        del file.values[address]
    file.evaluation.forget()
    kept = keep_image(encode_image(file), folder, "mill")
    readable = kept.with_suffix(".amp")

    def look() -> None:
        copy = open_copy(kept)
        assert copy.image == kept.read_bytes()
        assert copy.is_checked
        assert digest_path(kept).read_bytes()[:64].lower() == hashlib.sha256(copy.image).hexdigest().encode()
        copy = open_copy(readable)
        assert not copy.is_kept or copy.image == kept.read_bytes()

    return _one_damaged(folder, seed, count, look, (CopyError, ParameterFileError))


def fuzz_backups(folder: Path, seed: int, count: int) -> list[str]:
    """Put a damaged backup back: one that cannot be read is not put in place of the file."""
    path, backup = folder / "x.amp", folder / "x.amp.bak"
    save_file(new_file("57c422b", name="X"), path)
    backup.write_text(SMALL, encoding="utf-8")

    def look() -> None:
        path_before, before = path.read_bytes(), backup.read_bytes()
        recover_backup(path)
        assert (path.read_bytes(), backup.read_bytes()) == (before, path_before)
        read_content(path, before)

    return _one_damaged(folder, seed, count, look, (ParameterFileError,))


def fuzz_caches(folder: Path, seed: int, count: int) -> list[str]:
    """Read a damaged cache: it gives what was kept there or nothing;
    what is below a right digest are records or refused.
    """
    path = folder / "steps-x.json"
    write_cached(path, record_text(compile_family(FACTS)).encode(), "steps")
    whole = path.read_bytes().decode("utf-8")
    kept = whole.partition("\n")[2].encode()

    def look(text: str) -> None:
        content = text.encode("utf-8", "surrogatepass")
        path.write_bytes(content)
        assert read_cached(path) in (None, kept)
        below = content.partition(b"\n")[2]
        path.write_bytes(hashlib.sha256(below).hexdigest().encode() + b"\n" + below)
        found = read_cached(path)
        assert found == below
        text_record(found)

    logging.disable(logging.WARNING)
    try:
        return violations(mutants([whole], seed, count), look, (ValueError,))
    finally:
        logging.disable(logging.NOTSET)


def fuzz_check_caches(folder: Path, seed: int, count: int) -> list[str]:
    """Read damaged results of earlier checks: they are as they were kept, or there are none."""
    chance, path = random.Random(seed), folder / "x.amp"
    path.write_text(SMALL, encoding="utf-8")
    with mock.patch("amp_studio.cli.checks.cache.cache_folder", return_value=folder / "cache"):
        cache = CheckCache(parse("validate", VERB, [str(path)]))
    (key,) = cache.keys([path])
    assert key is not None
    kept = CheckResult(path, 2, "1300: out of range\n" * 40, ("a note",))
    cache.write({key: kept}, [key])
    whole = cache._path.read_bytes()

    def look(content: bytes) -> None:
        cache._path.write_bytes(content)
        assert cache.read([key], [path]) in ({}, {path: kept})

    contents = (damaged(damaged(whole, chance), chance) for _ in range(count))
    return violations(contents, look, ())


def fuzz_locks(folder: Path, seed: int, count: int) -> list[str]:
    """Meet a lock whose holder left a damaged note: it is refused in one line."""
    path = folder / "x.amp"
    path.write_bytes(b"")
    with EditLock(path):
        holder = next(each for each in folder.iterdir() if each.name.endswith(".holder"))

        def look(text: str) -> None:
            holder.write_bytes(text.encode("utf-8", "surrogatepass"))
            EditLock(path).take()

        return violations(mutants(["me on here, process 12, since now"], seed, count), look, (InUseError,))


def fuzz_begun_downloads(folder: Path, seed: int, count: int) -> list[str]:
    """Look for a begun download whose note is damaged: an id of 16 bytes, or none."""
    broken = BrokenTransfers(folder)
    broken.keep(b"x", bytes(16))
    (path,) = folder.iterdir()

    def look(text: str) -> None:
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        found = broken.find(b"x")
        assert found is None or len(found) == 16

    return violations(mutants(["0123456789abcdef" * 2], seed, count), look, ())


def fuzz_facts(folder: Path, seed: int, count: int) -> list[str]:
    """Compile a family of which one fact file is damaged."""
    work = folder / "facts"
    shutil.copytree(FACTS, work)

    def look() -> None:
        compile_family(work)

    return _one_damaged(work, seed, count, look, (DatabaseError,))


def fuzz_suppressions(folder: Path, seed: int, count: int) -> list[str]:
    """Suppress a finding in a damaged file of rules: it is added, or refused and no byte has changed."""
    path = folder / "rules.yaml"
    path.write_text(RULES, encoding="utf-8")

    def look() -> None:
        suppress(path, "schema.range", ["1300"], reason="looked: at it", by="me # here")

    return _one_damaged(folder, seed, count, look, (ValueError, SaveError))


SETTINGS = """\
[General]
control=tcp://127.0.0.1:7090
geometry=@ByteArray(\\x1\\xd9\\xd0\\xcb\\0\\x3\\0\\0\\0\\0\\0\\0\\0\\0\\0\\0)
layout="@ByteArray(\\0\\0\\0\\xff\\0\\0\\0\\0\\xfd\\0\\0\\0\\0)"
recent=/tmp/a.amp, /tmp/b.amp, @Invalid()
controls="{\\"address\\": \\"tcp://127.0.0.1:9600\\", \\"when\\": \\"2026-03-12T08:30:00\\", \
\\"verb\\": \\"download\\"}"
other=@Variant(\\0\\0\\0\\x7f\\0\\0\\0\\x8QString)
"""


def fuzz_settings(folder: Path, seed: int, count: int) -> list[str]:
    """Start with damaged settings."""
    from PySide6.QtCore import QSettings, Qt, qInstallMessageHandler
    from PySide6.QtWidgets import QApplication, QDockWidget, QMainWindow

    from amp_studio.ui.window.settings import UserSettings, is_there, is_usable

    application = QApplication.instance() or QApplication([])
    window = QMainWindow()
    window.addDockWidget(Qt.DockWidgetArea.LeftDockWidgetArea, QDockWidget("Panel", window))

    def look(text: str) -> None:
        path.write_bytes(text.encode("utf-8", "surrogatepass"))
        place = path if is_usable(path) else path / "none"
        stored = QSettings(str(place), QSettings.Format.IniFormat)
        with mock.patch("amp_studio.ui.window.settings.stored_in", return_value=stored):
            settings = UserSettings()
        assert isinstance(settings.control(), str)
        for recent in settings.recent():
            is_there(recent)
        for control in settings.controls():
            assert control.moment is None or control.moment.year > 0
        settings.place(window)
        if (kept := settings.arrangement()) is not None:
            window.restoreState(kept)
        settings.bring_back(window.findChildren(QDockWidget))
        settings.session()
        assert window.width() >= 1

    path = folder / "settings.conf"
    before = qInstallMessageHandler(lambda *_: None)  # what Qt prints about each entry that it cannot read
    found = violations(mutants([SETTINGS], seed, count), look, ())
    qInstallMessageHandler(before)
    window.deleteLater()
    application.processEvents()
    return found
