"""Disks that are full or write-protected: the user knows before the work is done, and none of it is lost."""

import os
import threading
from collections.abc import Callable
from functools import partial
from pathlib import Path
from typing import Any

import pytest
from pytestqt.qtbot import QtBot

from amp_studio.files import document
from amp_studio.files.lock import EditLock
from amp_studio.ui.actions.project import new
from amp_studio.ui.base.translated import set_language
from amp_studio.ui.dialogs.file_dialogs import ProjectDialog
from amp_studio.ui.dialogs.note_dialog import NoteDialog
from amp_studio.ui.main_window import MainWindow

from .conftest import User

EXCESS = ("servo.excess_error", "1")


def test_a_write_protected_file_is_reported_when_it_is_opened(
    open_window: Callable[..., MainWindow], tmp_path: Path, router: bytes, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was only refused when an hour's work was to be saved."""
    path = tmp_path / "router.amp"
    path.write_bytes(router)
    may = os.access
    monkeypatch.setattr(os, "access", lambda place, *how, **kind: place != path and may(place, *how, **kind))
    bar = open_window(path).page_in_front.bar
    assert bar.text.text() == "router.amp is write-protected: changes can be saved under another name."
    assert not bar.isHidden()


def test_unsaved_work_that_a_full_disk_cannot_keep_is_reported_once(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    """A program that was killed then lost what nobody knew to be at risk."""
    workspace, bar = window.workspace, window.page_in_front.bar

    def fail(*_: object, **__: object) -> None:
        raise OSError(28, "No space left on device")

    def keep(*, is_full: bool) -> None:
        with monkeypatch.context() as disk:
            if is_full:
                disk.setattr("amp_studio.files.document.write_atomic", fail)
            workspace._keep_unsaved()
            workspace._end_keeping()

    window.edits.commit(EXCESS, "3 mm")
    keep(is_full=True)
    assert "cannot be kept beside it (No space left on device)" in bar.text.text()
    bar.hide()
    keep(is_full=True)
    assert bar.isHidden(), "said twice"
    keep(is_full=False)
    keep(is_full=True)
    assert not bar.isHidden(), "there was room in between"
    bar.hide()


def test_a_slow_disk_keeps_no_key_waiting(window: MainWindow, monkeypatch: pytest.MonkeyPatch) -> None:
    """The journal was written by the window, which waited twice for the disk."""
    workspace, threads = window.workspace, list[int]()
    write = document.write_atomic

    def slow(*given: Any, **named: Any) -> str:
        threads.append(threading.get_ident())
        return write(*given, **named)

    monkeypatch.setattr(document, "write_atomic", slow)
    window.edits.commit(EXCESS, "3 mm")
    workspace._keep_unsaved()
    workspace._keep_unsaved()
    assert workspace._journal.isActive(), "it writes again when it has written"
    workspace._end_keeping()
    assert workspace.document.journal_path.exists()
    assert len(threads) == 1
    assert threading.get_ident() not in threads


def test_a_reload_waits_for_the_journal_that_is_being_written(
    window: MainWindow, monkeypatch: pytest.MonkeyPatch
) -> None:
    """It was written after its file had been closed, and offered as work of a program that was killed."""
    workspace, closed = window.workspace, threading.Event()
    write, release = document.write_atomic, EditLock.release

    def slow(*given: Any, **named: Any) -> str:
        closed.wait(0.3)
        return write(*given, **named)

    def close(lock: EditLock) -> None:
        release(lock)
        closed.set()

    monkeypatch.setattr(document, "write_atomic", slow)
    monkeypatch.setattr(EditLock, "release", close)
    window.edits.commit(EXCESS, "3 mm")
    workspace._keep_unsaved()
    keeping = workspace._keeping
    assert keeping is not None
    window.files.reload(window.page_in_front)
    keeping.outcome()
    assert window.workspace is not workspace
    assert not workspace.document.journal_path.exists()


def test_a_note_that_is_too_long_stays_in_its_form(window: MainWindow, qtbot: QtBot) -> None:
    """It was refused after its form had closed, and gone."""
    dialog = NoteDialog(window.workspace, EXCESS, window)
    qtbot.addWidget(dialog)
    dialog.show()
    dialog.form.set_answer("note", "a" * 100_000)
    dialog.accept()
    assert dialog.isVisible()
    assert dialog.fault.text() == "The note has 100\u202f000 characters, and 4000 are the most."
    dialog.form.set_answer("about", "machine")
    assert not dialog.ok.isEnabled(), "a note that is not in front is looked at, too"
    dialog.form.set_answer("about", "value")
    dialog.form.set_answer("note", "a" * 4000)
    assert dialog.ok.isEnabled()


@pytest.mark.parametrize("language", ["en", "de"])
def test_a_folder_that_cannot_be_made_is_a_sentence_without_the_number_of_its_error(
    language: str, window: MainWindow, user: User, accept: Callable[..., None], tmp_path: Path, monkeypatch
) -> None:
    """It was "[Errno 13] Permission denied: '/…/project'", in a German window too."""

    def refuse(folder: Path, *_: object, **__: object) -> None:
        raise PermissionError(13, "Permission denied", str(folder))

    accept(ProjectDialog, lambda dialog: dialog.form.set_answer("name", "Line 4"))
    user.chooses(tmp_path / "line")
    monkeypatch.setattr(Path, "mkdir", refuse)
    set_language(language)
    try:
        window.guarded(partial(new, window), "New Project")
    finally:
        set_language("en")
    why = {"en": "Permission denied", "de": "keine Berechtigung"}[language]
    assert user.reads() == f"{tmp_path / 'line'}: {why}"
