"""A new mill from the first value to the last:
what a person sees who follows the guide and knows the machine.
"""

from pathlib import Path

import pytest

from amp_studio.files import new_file, open_file
from amp_studio.guide import GuideProgress, next_open, progress, step_of
from amp_studio.schema import Address
from amp_studio.validate import Finding, Validator


class User:
    """Gives the values of a machine that he knows, where the guide asks for them."""

    def __init__(self, known: Path) -> None:
        self.known = open_file(known).file
        self.file = new_file("9pc", "mill", ["X", "Y", "Z", "B", "S"])
        self.validator = Validator(self.file)
        self.findings = self.validator.run()
        self.listed: list[Finding] = []
        """The errors that are listed."""
        self.course: list[str] = []
        """The steps in the order in which they were reached."""

    def look(self) -> GuideProgress:
        """See how far it is; an error is listed only for what is reached, or for what he has set himself."""
        now, places = progress(self.validator, self.findings), step_of(self.file.schema)
        deferred = {id(finding) for finding in now.deferred}
        self.listed = [f for f in self.findings if f.severity == "error" and id(f) not in deferred]
        reached = now.current.step.number if now.current else len(now.steps)
        for finding in self.listed:
            assert any(map(self.is_own, finding.causes)) or all(
                places[name].number <= reached for name, _ in finding.causes
            )
        if now.current and now.current.step.id not in self.course:
            self.course.append(now.current.step.id)
        return now

    def is_own(self, address: Address) -> bool:
        return address in self.file.values and not self.file.is_default(address)

    def give(self, *addresses: Address) -> None:
        for address in addresses:
            self.file.set(address, self.known.get(address))
        self.findings = self.validator.update(addresses)

    def mend(self, reached: int) -> None:
        """Set what is known otherwise of the step that is reached, and of those of the listed errors."""
        places = step_of(self.file.schema)
        steps = {reached} | {places[name].number for finding in self.listed for name, _ in finding.causes}
        differing = [a for a in self.known.values if self.file.get(a) != self.known.get(a)]
        mended = [a for a in differing if places[a[0]].number in steps]
        assert mended
        self.give(*mended)


@pytest.fixture
def user(checkout: Path) -> User:
    return User(checkout / "examples" / "mill-1394" / "MILL_1394.amp")


def test_a_new_mill_is_progress_from_the_first_value_to_the_last(user: User) -> None:
    now, listed = user.look(), list[int]()
    assert user.listed == []  # hardware and loop type of five axes are as delivered until he begins
    while now.current is not None:
        listed.append(len(user.listed))
        known = [address for address in now.current.open if user.known.get(address) is not None]
        if known:
            user.give(*known)
        else:
            user.mend(now.current.step.number)
        now = user.look()
    assert now.set == now.total == 301
    assert now.deferred == ()
    assert [f.rule for f in user.findings if f.severity == "error"] == []
    assert user.course == [
        "control",
        "axis",
        "home",
        "zone",
        "position_loop",
        "velocity_loop",
        "drives",
        "jog",
        "feedrate",
        "accdec",
        "spindle",
        "format",
        "powerup",
        "macro",
        "tool",
        "cycle",
        "special",
        "miscellaneous",
        "oci",
        "tuning",
    ]
    assert max(listed) == 13  # of the velocity loop; all at once there would be more than thirty
    assert listed[-8:] == [0] * 8


def test_next_not_set_comes_to_every_open_value_once_and_leaves_nothing_behind(user: User) -> None:
    user.give(*[a for a in user.known.values if user.file.get(a) != user.known.get(a)])
    gone = [("home.g28_speed", "1"), ("jog.speed_lowest", "2"), ("axis.name", "3"), ("zone.limit2_max", "1")]
    for address in gone:
        user.file.set(address, None)
    user.findings = user.validator.run()
    walked, here = [], None
    while (here := next_open(progress(user.validator, user.findings), here)) is not None:
        walked.append(here)
        user.give(here)
    assert walked == [
        ("axis.name", "3"),
        ("home.g28_speed", "1"),
        ("zone.limit2_max", "1"),
        ("jog.speed_lowest", "2"),
    ]
    assert [f.rule for f in user.findings if f.severity == "error"] == []
