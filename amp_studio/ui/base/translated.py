"""Texts in the language of the window.

Code has the English text; ``amp_studio/languages`` has it under an id, with its words in the other languages
under the same id.
``make translations`` takes up new texts and lists what has no translation.
What is made below the window has its words there too.
"""

from __future__ import annotations

import re
from functools import lru_cache
from pathlib import Path
from typing import Final

from PySide6.QtCore import QCoreApplication, QLibraryInfo, QLocale, QTranslator

from amp_studio.drawing import grouped
from amp_studio.languages import language_codes, name_of_language
from amp_studio.report import Language, language_of
from amp_studio.report import counted as english_count
from amp_studio.schema import ControlMessage, Schema, isolated_path, program_texts, unit_text
from amp_studio.validate import Finding, family_of_rule

LANGUAGES: Final = {code: name_of_language(code) for code in language_codes()}
"""Code -> name in the language itself."""
_OF_SYSTEM = re.compile(r"\[Errno \d+\] (.+?): '(.+)'")

_SIGN = re.compile(r"(?<![\w.$@)\]-])-(?=\d)")
_LARGE = re.compile(
    r"(?<![\w.$@:/\\#'-])(?<!parameter )(?<!port )(?<!alarm )(?<!error )(?<!code )(?<!build )(?<!number )"
    r"[1-9]\d{4,}(?![\w:/'-]|[.,]\d++[A-Za-z_:]| [A-Z][a-z])"
)
"""A number in a sentence, and no address: neither of a parameter (``20020 Number of ...``) nor of a network,
no part of a path, no number of a thing.
"""


def tr(text: str, disambiguation: str = "", n: int = -1) -> str:
    """Return a text in the language of the window; ``%n`` is ``n`` in its proper form."""
    return QCoreApplication.translate("", text, disambiguation, n)


def worded(text: str, family: str = "") -> str:
    """Return a text that was made below the window (the title of a picture, a severity,
    ``page 7-20``) in its language; with a family also one of its facts (a step, a rule, a reason, a danger).

    The words are those of reports in that language. Names and help have none and stay as they are.
    """
    return text if _spoken == "en" else _worded(_spoken, text, family)


def sentenced(text: str, *families: str) -> str:
    """Return as ``worded``, with its numbers and their units as the language writes them too."""
    return _with_groups(text if _spoken == "en" else _sentenced(_spoken, text, *families))


@lru_cache(maxsize=4096)
def _sentenced(code: str, text: str, *families: str) -> str:
    return language_of(code, *families).sentence(text)


@lru_cache(maxsize=4096)
def _worded(code: str, text: str, family: str) -> str:
    return language_of(code, family).title(text)


def help_language() -> str:
    """Return in which language help and printed tables are, where it is not that of the window."""
    return "" if _spoken == "en" else worded("in English")


def scenario_in_words(name: str) -> str:
    """Return the name of a scenario of the simulator in the language of the window."""
    return language_of(_spoken).scenario(name)


def control_message(message: ControlMessage, family: str) -> str:
    """Return a message of the control by its code and its text there; where the manual prints none, what the
    program calls it is in the language of the window.
    """
    return " ".join(filter(None, (message.code, message.text or worded(message.title, family))))


def label_in_words(label: str) -> str:
    """Return a label of the control, with what the facts remark on it in the language of the window."""
    return language_of(_spoken).label(label)


def unit_in_words(unit: str) -> str:
    """Return a unit as it is shown in the language of the window: ``in`` is ``Zoll`` in a German one."""
    return unit_text(unit) if _spoken == "en" else _unit(_spoken, unit_text(unit))


@lru_cache(maxsize=512)
def _unit(code: str, printed: str) -> str:
    return language_of(code).unit(printed)


def facts_in_words(schema: Schema) -> Language:
    """Return the language of the window with the facts of a family."""
    return language_of(_spoken, schema.family.family)


def worded_finding(finding: Finding) -> str:
    """Return the message of a finding in the language of the window."""
    if _spoken == "en":
        return _with_groups(finding.message)
    return _with_groups(language_of(_spoken, family_of_rule(finding.rule)).finding(finding))


def message_in_words(text: str) -> str:
    """Return what the program states of a value in the language of the window."""
    text = without_number(text)
    return _with_groups(text if _spoken == "en" else _message(_spoken, text))


def _with_groups(text: str) -> str:
    """Return a sentence with its numbers as they are in cells: with a minus, large ones in groups."""
    if text.isdecimal():  # the number of a parameter
        return text
    return _LARGE.sub(lambda found: grouped(found[0]), _SIGN.sub("−", text))


def without_number(text: str) -> str:
    """Return the text of an error of the system as a sentence: its path, then its reason."""
    return _OF_SYSTEM.sub(lambda found: f"{found[2]}: {message_in_words(found[1])}", text)


@lru_cache(maxsize=4096)
def _message(code: str, text: str) -> str:
    return language_of(code).message(text)


def counted(number: int, noun: str, none: str = "0") -> str:
    """Return ``1 error``, ``2 files`` in the language of the window; ``none`` replaces the number 0."""
    if _spoken == "en":
        return english_count(number, noun, none)
    language = language_of(_spoken)
    text = language.counted(number, noun)
    return text if number or none == "0" else f"{language.title(none)} {text.partition(' ')[2]}"


def written_to(path: Path) -> str:
    """Return that a file was written, in the language of the window."""
    return tr("{path} written").format(path=isolated_path(path))


class Translated:
    """Gives a class that is no QObject the ``tr`` of one."""

    def tr(self, text: str, disambiguation: str = "", n: int = -1) -> str:
        """Return a text in the language of the window; ``%n`` is ``n`` in its proper form."""
        return tr(text, disambiguation, n)


class CatalogueTranslator(QTranslator):
    """Translates by the texts of one language, whatever the context."""

    def __init__(self, code: str) -> None:
        super().__init__()
        self.words: dict[str, str] = {}
        self.plurals: dict[str, list[str]] = {}
        for english, own in program_texts(code, "window").items():
            if isinstance(own, list):
                self.plurals[english] = own
            elif code != "en":  # the texts are English: only the forms of numbers are missing
                self.words[english] = own

    def isEmpty(self) -> bool:
        """Return whether it has no words and no forms."""
        return not (self.words or self.plurals)

    def translate(
        self, context: str | None, source_text: str, disambiguation: str | None = None, n: int = -1
    ) -> str | None:
        """Return the translation; None where there is none."""
        if n >= 0 and source_text in self.plurals:
            forms = self.plurals[source_text]
            return forms[0 if n == 1 else -1]
        return self.words.get(source_text)


_installed: list[QTranslator] = []
_spoken = "en"


def language_of_window() -> str:
    """Return the code of the language that the window has."""
    return _spoken


def language_in_use(choice: str) -> str:
    """Return the code of the language of a choice; that of the system where it is not one of them."""
    if choice in LANGUAGES:
        return choice
    system = QLocale.system().name()[:2]
    return system if system in LANGUAGES else "en"


def set_language(choice: str) -> str:
    """Give the program a language (``system`` or a code), before its first window; returns the code."""
    application = QCoreApplication.instance()
    code = language_in_use(choice)
    if application is None:
        return code
    for translator in _installed:
        application.removeTranslator(translator)
    _installed.clear()
    global _spoken  # noqa: PLW0603  # the program has one language, as its translators have
    _spoken = code
    own_of_qt = QTranslator()
    folder = QLibraryInfo.path(QLibraryInfo.LibraryPath.TranslationsPath)
    if code != "en" and own_of_qt.load(f"qtbase_{code}", folder):
        _installed.append(own_of_qt)
    _installed.append(CatalogueTranslator(code))
    for translator in _installed:
        application.installTranslator(translator)
    return code
