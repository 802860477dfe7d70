"""Texts in the language of the window, for classes that are no QObject."""

from __future__ import annotations

from PySide6.QtCore import QCoreApplication


class Translated:
    """Gives a class the ``tr`` of a QObject; its own name is the context, as lupdate writes it."""

    def tr(self, text: str, disambiguation: str = "", n: int = -1) -> str:
        """Return a text in the language of the window; ``%n`` is ``n`` in its proper form."""
        return QCoreApplication.translate(type(self).__name__, text, disambiguation, n)
