"""What a control of single values contains after a break is worked out from what it is read to contain."""

from amp_studio.transfer.break_state import state_after_break

STORED = {"P9N0": "0", "P10N0": "0", "P11N0": "5"}
WANTED = {"P9N0": "1", "P10N0": "2", "P11N0": "5"}


def test_all_old_is_old_and_all_new_is_new() -> None:
    assert state_after_break(STORED, WANTED, STORED) == ("old", ())
    assert state_after_break(STORED, WANTED, WANTED) == ("new", ())


def test_some_of_both_is_mixed_and_names_what_is_new_by_number() -> None:
    assert state_after_break(STORED, WANTED, STORED | {"P10N0": "2"}) == ("mixed", ("P10N0",))
    three = {"P9N0": "1", "P10N0": "1", "P2N0": "1", "P1N0": "1"}
    assert state_after_break(dict.fromkeys(three, "0"), three, three | {"P1N0": "0"})[1] == (
        "P2N0",
        "P9N0",
        "P10N0",
    )


def test_a_value_that_is_neither_is_not_known() -> None:
    assert state_after_break(STORED, WANTED, STORED | {"P9N0": "7"}) == ("unknown", ())
    assert state_after_break(STORED, WANTED, {"P9N0": "0"}) == ("unknown", ()), "something has gone"


def test_of_many_only_some_are_named() -> None:
    content = {f"P{n}N0": "0" for n in range(50)}
    wanted = dict.fromkeys(content, "1")
    state, new = state_after_break(content, wanted, wanted | {"P0N0": "0"})
    assert (state, len(new), new[0], new[-1]) == ("mixed", 21, "P1N0", "29 more")
