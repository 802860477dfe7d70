"""The window: what is sent when, and what counts as lost."""

from hypothesis import given
from hypothesis import strategies as st

from amp_studio.transfer.house.retry_timer import RetryPolicy, RetryTimer
from amp_studio.transfer.house.streaming import window_limit
from amp_studio.transfer.house.window import Window
from tests.work import calls_of


def fill(window: Window, first: int, now: float = 0.0) -> list[int]:
    """Send all that may be sent, under numbers from ``first`` on; return the offsets."""
    offsets = []
    while (piece := window.next_piece()) is not None:
        window.sent(first + len(offsets), *piece, now)
        offsets.append(piece[0])
    return offsets


def test_the_window_fills_and_moves() -> None:
    window = Window(0, 100, 10, 4)
    assert fill(window, 1) == [0, 10, 20, 30]
    window.arrived(1)
    assert fill(window, 5) == [40]


def test_an_answer_to_a_later_sending_says_which_are_lost() -> None:
    window = Window(0, 100, 10, 4)
    fill(window, 1)
    window.arrived(3)
    assert fill(window, 5) == [0, 10, 40], "the lost ones first, what has arrived never again"


def test_a_piece_that_was_not_kept_is_sent_again() -> None:
    window = Window(0, 40, 10, 4)
    fill(window, 1)
    window.refused(2)
    window.reached(10)
    assert fill(window, 5) == [10]


def test_what_the_control_has_reached_needs_no_answer_of_its_own() -> None:
    window = Window(0, 35, 10, 4)
    fill(window, 1)
    window.reached(34)
    assert not window.is_done, "the last byte of the last piece is still missing"
    window.reached(35)
    assert window.is_done
    assert window.bytes_flying == 0


def test_after_a_timeout_everything_under_way_is_sent_again() -> None:
    window = Window(5, 40, 10, 3)
    assert fill(window, 1) == [5, 15, 25]
    window.lose_all()
    assert fill(window, 9) == [5, 15, 25]


@given(
    st.integers(0, 50),
    st.integers(0, 200),
    st.integers(1, 20),
    st.integers(1, 8),
    st.randoms(use_true_random=False),
)
def test_every_piece_arrives_over_any_line(
    start: int, size: int, chunk: int, limit: int, chance: object
) -> None:
    """Half of the sendings and a third of the answers are lost; the window still ends with every byte."""
    window = Window(start, size, chunk, limit)
    got, number, turns = set(range(start)), 0, 0
    while not window.is_done:
        turns += 1
        assert turns < 10_000
        arrived = []
        while (piece := window.next_piece()) is not None:
            number += 1
            window.sent(number, *piece, 0.0)
            assert len(window._flying) <= limit
            if chance.random() < 0.5:
                got |= set(range(piece[0], sum(piece)))
                arrived.append(number)
        answered = [n for n in arrived if chance.random() < 0.7]
        for n in answered:
            window.arrived(n)
        if not answered:
            window.lose_all()
    assert got >= set(range(size))


def test_the_timeout_follows_the_line() -> None:
    pace = RetryTimer(RetryPolicy(first=0.7, least=0.1, most=5.0))
    assert pace.timeout == 0.7
    for _ in range(50):
        pace.answered(0.2)
    assert 0.2 <= pace.timeout < 0.21
    pace.missed()
    pace.missed()
    assert 0.8 <= pace.timeout < 0.84
    pace.answered(0.2)
    assert pace.timeout < 0.21
    for _ in range(50):
        pace.answered(0.001)
    assert pace.timeout == 0.1, "never shorter than the shortest"
    for _ in range(9):
        pace.missed()
    assert pace.timeout == 5.0, "never longer than the longest"


def test_a_slow_line_has_little_under_way() -> None:
    assert window_limit(512, 16, None) == 16
    assert window_limit(512, 16, 11_520) == 7
    assert window_limit(512, 16, 960) == 2
    assert window_limit(512, 1, 960) == 1, "never more than the control offers"


def test_an_answer_costs_the_same_however_many_pieces_are_under_way() -> None:
    """A control may offer 65,536 pieces of one byte: each answer looks at what it is about,
    not at all of them.
    """

    pieces, number = 4_000, 0
    window = Window(0, pieces, 1, pieces)
    while (piece := window.next_piece()) is not None:
        window.sent(number, *piece, 0.0)
        number += 1
    assert window.bytes_flying == pieces

    def answered() -> None:
        for at in range(pieces):
            window.arrived(at)
            window.reached(at + 1)

    assert calls_of(answered) < 20 * pieces
    assert (window.is_done, window.bytes_flying) == (True, 0)


def test_a_gap_that_reaches_far_takes_every_piece_before_it_from_those_under_way() -> None:
    window = Window(0, 100, 10, 8)
    for number in range(8):
        window.sent(number, *window.next_piece(), 0.0)
    window.reached(55)
    assert [number for number in range(8) if window.flying(number)] == [5, 6, 7]
    assert window.bytes_flying == 30
    window.lose_all()
    assert (window.bytes_flying, window.oldest) == (0, None)
    assert [window.next_piece() for _ in range(3)] == [(50, 10), (60, 10), (70, 10)]
