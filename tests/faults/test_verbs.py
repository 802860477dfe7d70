"""What an upload leaves behind when a call of the system fails, one run a call."""

import errno
import os
import subprocess
import sys
from pathlib import Path

import pytest

from tests.campaigns import some

from .verbs import compiler, library

SIZE = 2_300
"""Bytes of the image."""
UPLOADS = """
import os, sys
from pathlib import Path
from amp_studio import cli
from amp_studio import control
control.fetch_image = lambda *_, **__: b"what a control contains" * 100
root = Path(sys.argv[1])
for at in range(1, 100):
    folder, log = root / str(at), root / f"{at}.log"
    folder.mkdir()
    os.environ.update(FAULT_AT=str(at), FAULT_LOG=str(log), FAULT_FOLDER=str(folder))
    code = cli.run(["upload", "--from", "tcp://127.0.0.1:1", "-o", str(folder / "x.img")])
    os.environ["FAULT_FOLDER"] = "none"
    if not log.exists():
        break
    log.write_text(f"{code} {log.read_text()}")
"""
"""Uploads, of which the first has its first call fail, the second its second, until there is no further
call."""


@pytest.mark.skipif(
    compiler() is None, reason="the failing calls are made with a C compiler, and there is none"
)
@pytest.mark.parametrize("for_ever", some([False, True], 2), ids=some(["once", "from then on"], 2))
def test_a_failed_upload_of_an_image_leaves_no_empty_file(for_ever: bool, tmp_path: Path) -> None:
    env = {"LD_PRELOAD": library(), "FAULT_AT": "0", "FAULT_FOLDER": "none", "FAULT_ERRNO": str(errno.EIO)}
    env |= {"FAULT_FOREVER": "1"} if for_ever else {}
    subprocess.run(
        [sys.executable, "-c", UPLOADS, str(tmp_path)], env=os.environ | env, check=True, capture_output=True
    )
    ended = {int(log.stem): log.read_text().split(maxsplit=1) for log in tmp_path.glob("*.log")}
    assert len(ended) > 10
    for at, (code, calls) in ended.items():
        left = {path.name: path.stat().st_size for path in (tmp_path / str(at)).iterdir()}
        assert left.get("x.img", SIZE) == SIZE, f"call {at}, {calls}"
        assert "x.img" not in left or "x.img.sha256" in left, f"call {at}, {calls}"
        assert ("x.img" in left) == (code != "2"), f"exit {code}, call {at}, {calls}"
        assert for_ever or code == "0" or not left, f"call {at}, {calls}"
    assert {code for code, _ in ended.values()} == {"0", "2"}
