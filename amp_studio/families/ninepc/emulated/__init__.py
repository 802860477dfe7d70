"""The emulated 9/PC: in the house protocol of a gateway on its host PC,
and at its own screen as the manual prints it.
"""

from __future__ import annotations

from amp_studio.transfer.emulated import EmulatedOptions, run_house
from amp_studio.transfer.links import Endpoint

from .panel import NinePcPanel, axes_supported


def emulate(listen: Endpoint, options: EmulatedOptions) -> int:
    """Run an emulated 9/PC; ``--option axes=N`` is how many axes were ordered with it."""
    return run_house(listen, options, NinePcPanel(axes_supported(options.hardware)))
