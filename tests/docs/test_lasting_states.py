"""In which states a write lasts: what each driver has is what the page of the protocols states,
and where nothing is known it is so there.
"""

import re
from pathlib import Path

from amp_studio.schema import family_ids
from amp_studio.transfer.client.drivers import open_driver, protocols_of

PAGE = Path(__file__).parents[2] / "docs" / "protocols" / "index.md"
WORDS = {None: "not known", (): "none"}


def test_the_states_in_which_a_write_lasts_are_those_of_the_drivers() -> None:
    rows = re.findall(r"^\| (`[^|]*) \| ([^|]*) \| [^|]+ \|$", PAGE.read_text(encoding="utf-8"), re.MULTILINE)
    stated = {name: states for names, states in rows for name in re.findall("`([a-z-]+)`", names)}
    found = {}
    for family in family_ids():
        for name in protocols_of(family):
            states = open_driver(f"tcp://127.0.0.1:1?protocol={name}", family).abilities.lasting_states
            found[name] = WORDS.get(states) or ", ".join(states or ())
    assert stated == found
