"""Typing errors: which words a mistyped one may be."""

from collections.abc import Callable

import pytest
from hypothesis import given
from hypothesis import strategies as st

from amp_studio.find.words import Vocabulary, asked_words, distance, words_of


@pytest.mark.parametrize(
    ("a", "b", "slips"),
    [
        ("error", "error", 0),
        ("eror", "error", 1),
        ("errror", "error", 1),
        ("errer", "error", 1),
        ("gian", "gain", 1),  # neighbours exchanged are one slip
        ("corected", "corrected", 1),
        ("folowign", "following", 2),
        ("abc", "xyz", 3),  # more than the two that were allowed
    ],
)
def test_slips_are_counted(a: str, b: str, slips: int) -> None:
    assert distance(a, b, 2) == slips
    assert distance(b, a, 2) == slips


LETTERS = "abcde"


def _slip(word: str, kind: int, at: int) -> str:
    at = at % len(word)
    slips: list[Callable[[], str]] = [
        lambda: word[:at] + word[at + 1 :],
        lambda: word[:at] + "x" + word[at:],
        lambda: word[:at] + "x" + word[at + 1 :],
        lambda: word[:at] + word[at + 1 : at + 2] + word[at] + word[at + 2 :],
    ]
    return slips[kind]()


@given(st.text(LETTERS, min_size=4, max_size=12), st.integers(0, 3), st.integers(0, 11))
def test_one_slip_of_the_hand_is_never_more_than_one(word: str, kind: int, at: int) -> None:
    assert distance(word, _slip(word, kind, at), 2) <= 1


def test_a_word_is_found_begun_or_mistyped_and_a_number_only_begun() -> None:
    known = Vocabulary(["following", "feedrate", "feed", "1300", "1301", "error"])
    assert set(known.like("feed")) == {"feed", "feedrate"}
    assert set(known.like("folowing")) == {"following"}
    assert set(known.like("130")) == {"1300", "1301"}
    assert known.like("1303") == {}
    assert known.like("xyz") == {}
    assert known.like("feed")["feed"] > known.like("feed")["feedrate"] > known.like("fedrate")["feedrate"]


def test_the_nearest_word_is_offered_and_none_for_noise() -> None:
    known = Vocabulary(["sampling", "period", "spindle"])
    assert known.nearest("smapligg") == "sampling"
    assert known.nearest("qqqqqqqq") == ""


def test_small_words_count_only_where_nothing_else_is_asked() -> None:
    assert asked_words("why is the excess error") == ["excess", "error"]
    assert asked_words("how to") == ["how", "to"]
    assert words_of("MOT-022: 203.2 mm/min, P21N3") == ["mot", "022", "203.2", "mm", "min", "p21n3"]
