"""Modules are imported beside Qt without a look at their text."""

from __future__ import annotations

import sys
from types import ModuleType

_READS = "_mod_uses_pyside"


def leave_sources_unread() -> None:
    """Answer for PySide6 which modules use it.

    It reads the source of every module after its import, to see whether it names PySide6: only such a one may
    have other spellings of Qt (``from __feature__ import snake_case``), which this program does not use. At a
    start these were 390 files, kept in memory too. A release that does it in another way goes on reading.
    """
    import PySide6.QtCore  # noqa: F401  # it brings the module

    feature = sys.modules.get("shibokensupport.feature")
    if feature is not None and hasattr(feature, _READS):
        vars(feature)[_READS] = _is_of_window


def _is_of_window(module: ModuleType) -> bool:
    return module.__name__.startswith("amp_studio.ui")
