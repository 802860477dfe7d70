"""Emulated controls: their memory on disk, what they do with a request, and the process that serves them."""

from typing import TYPE_CHECKING

from amp_studio.front_pages import front_page

if TYPE_CHECKING:
    from .control import Control
    from .family_control import EmulatedOptions, emulate, emulators_of, protocol_of_machine, run_house
    from .line_device import DeviceSetup, serve_device
    from .memory import Memory
    from .panel import Start
    from .screen import screen_status
else:
    __getattr__ = front_page(__name__)
