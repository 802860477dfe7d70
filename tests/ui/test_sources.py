"""The window starts without a look at its sources: PySide6 would read that of each module."""

import subprocess
import sys

_STARTED = """
import linecache, sys
import amp_studio.ui
import amp_studio.ui.main_window, amp_studio.sim
print([name for name in linecache.cache if "amp_studio" in name])
"""


def test_no_source_is_read_to_import_a_module_beside_qt() -> None:
    made = subprocess.run([sys.executable, "-c", _STARTED], capture_output=True, text=True, check=True)
    assert made.stdout == "[]\n"
