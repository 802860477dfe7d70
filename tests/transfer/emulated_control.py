"""An emulated control in a separate process: ``emulated_control.py ADDRESS FOLDER [OPTIONS]``.

OPTIONS is a JSON object: ``initial`` (text), ``signature``, ``estop``, ``autostart``, ``faults`` and
``restart_seconds``.
"""

import json
import sys
from pathlib import Path

from amp_studio.transfer.emulated.control import Control
from amp_studio.transfer.emulated.emulator import serve
from amp_studio.transfer.emulated.faults import Faults
from amp_studio.transfer.emulated.record import Identity


def patch(image: bytes, key: str, value: str) -> bytes:
    """Append a line, as a control's own editor would change a value."""
    if not value.isdigit():
        raise ValueError("patch values are plain numbers")
    return image + f"{key} {value}\n".encode()


def main(address: str, folder: str, options: str = "{}") -> int:
    message = json.loads(options)
    control = Control(
        Path(folder),
        Identity("9pc", message.get("signature", "s1"), "CNC_1", "3.05"),
        message.get("initial", "old image\n").encode(),
        estop=message.get("estop"),
        autostart=message.get("autostart"),
    )
    return serve(
        address,
        control,
        patch=patch,
        faults=Faults(**message.get("faults", {})),
        restart_seconds=message.get("restart_seconds", 0.1),
    )


if __name__ == "__main__":
    sys.exit(main(*sys.argv[1:]))
