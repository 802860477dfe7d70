"""The emulated Grbl control as ``amp-studio emulate grblhal`` runs it."""

from __future__ import annotations

from amp_studio.transfer.emulated import EmulatedOptions, serve_device
from amp_studio.transfer.links import Endpoint

from .firmware import Firmware


def emulate_grbl(listen: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated control with grblHAL, or with Grbl 1.1 as its machine type asks for,
    until it is asked to quit.
    """
    return serve_device(listen, options, Firmware)
