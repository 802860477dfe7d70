"""Texts in the language of the window.

The words are in ``translations/amp_studio_LANGUAGE.ts``, which Qt Linguist edits and ``make translations`` keeps up to date.
The file is read as it is: nothing has to be compiled, and one word has one translation wherever it is written.
"""

from __future__ import annotations

from pathlib import Path
from typing import Final
from xml.etree import ElementTree as ET

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

FOLDER = Path(__file__).parent / "translations"
LANGUAGES: Final = {"en": "English", "de": "Deutsch"}
"""Code -> name in the language itself."""


def tr(text: str, disambiguation: str = "", n: int = -1) -> str:
    """Return a text in the language of the window; ``%n`` is ``n`` in its proper form."""
    return QCoreApplication.translate("", text, disambiguation, n)


class Translated:
    """Gives a class that is no QObject the ``tr`` of one."""

    def tr(self, text: str, disambiguation: str = "", n: int = -1) -> str:
        """Return a text in the language of the window; ``%n`` is ``n`` in its proper form."""
        return tr(text, disambiguation, n)


class FileTranslator(QTranslator):
    """Translates by one file of Qt's format, whatever the context."""

    def __init__(self, path: Path) -> None:
        super().__init__()
        self.words: dict[str, str] = {}
        self.plurals: dict[str, tuple[str, ...]] = {}
        for message in ET.parse(path).iter("message"):  # noqa: S314  # a file of the program itself
            source, translation = message.findtext("source") or "", message.find("translation")
            if translation is None or translation.get("type") is not None:
                continue
            if message.get("numerus") == "yes":
                self.plurals[source] = tuple(form.text or "" for form in translation.findall("numerusform"))
            elif translation.text:
                self.words[source] = translation.text

    def isEmpty(self) -> bool:
        """Return whether it has no words."""
        return not self.words

    def translate(
        self, context: str | None, source_text: str, disambiguation: str | None = None, n: int = -1
    ) -> str | None:
        """Return the translation; None where there is none."""
        if n >= 0 and source_text in self.plurals:
            forms = self.plurals[source_text]
            return forms[0 if n == 1 else -1]
        return self.words.get(source_text)


_installed: list[QTranslator] = []


def language_in_use(choice: str) -> str:
    """Return the code of the language of a choice; that of the system where it is not one of them."""
    if choice in LANGUAGES:
        return choice
    system = QLocale.system().name()[:2]
    return system if system in LANGUAGES else "en"


def speak(choice: str) -> str:
    """Give the program a language (``system`` or a code), before its first window; returns the code."""
    application = QCoreApplication.instance()
    code = language_in_use(choice)
    if application is None:
        return code
    for translator in _installed:
        application.removeTranslator(translator)
    _installed.clear()
    if code == "en":
        return code
    own_of_qt = QTranslator()
    if own_of_qt.load(f"qtbase_{code}", QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)):
        _installed.append(own_of_qt)
    _installed.append(FileTranslator(FOLDER / f"amp_studio_{code}.ts"))
    for translator in _installed:
        application.installTranslator(translator)
    return code
