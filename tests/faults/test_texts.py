"""What damages texts does so the same way for the same seed; ``test_faults.py`` gives them to the readers."""

from tests.faults import texts as damaged


def test_the_same_seed_makes_the_same_texts_and_another_one_others() -> None:
    first, again, other = (list(damaged.mutants([damaged.SMALL], seed, 50)) for seed in (1, 1, 2))
    assert (first == again, first == other) == (True, False)
    assert sum(text != damaged.SMALL for text in first) > 45
