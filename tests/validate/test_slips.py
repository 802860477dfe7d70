"""Slips of one value in the sound examples: what share of them brings a new finding.
``make slips`` plants all of them.
"""

from random import Random

from slips import KINDS, campaign, examples, slips

from amp_studio.files import open_file
from amp_studio.schema import Address
from tests.campaigns import CAMPAIGN

FOUND = {
    "57c422b": 0.7,
    "9pc": 0.78,
    "acromill": 0.82,
    "grblhal": 0.75,
    "linuxcnc": 0.72,
    "num": 0.75,
    "syntec": 0.75,
}
"""Family -> the least share of a sample that is found; the whole campaign finds more."""


def test_a_sample_of_slips_in_every_family_is_found() -> None:
    done = campaign(share=1.0 if CAMPAIGN else 0.08)
    for family, least in FOUND.items():
        count = done.total(family)
        assert count.planted >= 20, family
        assert count.share >= least, f"{family}: {count}"


def test_slips_are_of_every_kind_and_change_their_value() -> None:
    kinds = set()
    for path in examples():
        file = open_file(path).file
        for slip in slips(file, Random(1)):
            kinds.add(slip.kind)
            assert slip.value != file.values[slip.address]
    assert kinds == set(KINDS)


def test_a_speed_slips_in_every_way_that_a_number_can() -> None:
    (path,) = (path for path in examples() if path.stem == "GRBL_ROUTER")
    address: Address = ("axis.max_rate", "Z")
    file = open_file(path).file
    assert str(file.values[address].value) == "2000.0"
    of_it = {s.kind: (s.value.value, s.value.unit) for s in slips(file, Random(1)) if s.address == address}
    assert of_it == {
        "x 10": (20000.0, "mm/min"),
        "/ 10": (200.0, "mm/min"),
        "x 25.4": (50800.0, "mm/min"),
        "sign": (-2000.0, "mm/min"),
        "zero": (0.0, "mm/min"),
        "x 2": (4000.0, "mm/min"),
        "neighbour": (8000.0, "mm/min"),
    }
