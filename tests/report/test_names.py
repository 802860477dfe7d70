"""A name of the room is loaded only when it is asked for."""

import subprocess
import sys


def test_a_finding_is_put_into_words_without_the_room_that_sets_pages() -> None:
    script = (
        "import sys; from amp_studio.report import finding_text; print('amp_studio.report.output.pdf' in"
        " sys.modules)"
    )
    done = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True)
    assert done.stdout == "False\n"
