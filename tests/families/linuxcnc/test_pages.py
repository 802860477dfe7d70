"""A page of LinuxCNC's codes is a file of its source and a line of it, and the head of the facts names the
file."""

import re
from pathlib import Path

PROGRAM = Path(__file__).parents[3] / "parameter_db" / "linuxcnc" / "program.yaml"


def test_each_file_that_a_page_cites_is_named_at_the_head_of_the_codes() -> None:
    text = PROGRAM.read_text(encoding="utf-8")
    head = text[: text.index("\npage:")]
    cited = set(re.findall(r'page: "([A-Z]+)\d+"', text))
    assert cited
    assert cited <= set(re.findall(r"\b([A-Z]{1,2}) [\w/]+\.cc", head))
