"""Finding: an index of each size of family, and what a question costs at each of its keystrokes."""

from collections.abc import Iterator
from itertools import cycle
from pathlib import Path

from measure import Measure, timed

from amp_studio.files import open_file
from amp_studio.find import Finder
from amp_studio.find.entries import entries_of
from amp_studio.find.index import SearchIndex
from amp_studio.schema import family_ids, load_schema

QUESTIONS = (
    "excess folowing error",
    "servo amp fe limits corected",
    "positoin feedbak counts per cylce",
    "12.7 mm",
    "1750",
)
SHORT = tuple("abcdefghijklmnopqrstuvwxyz0123456789")


def measures(full: Path, times: int) -> Iterator[Measure]:
    """Yield what an index and questions cost; the worst case is the slowest keystroke of all."""
    largest = max(family_ids(), key=lambda name: len(load_schema(name).parameters))
    schema = load_schema(largest)
    machine = schema.family.default_machine
    yield Measure(f"index of {largest}", timed(lambda: SearchIndex(entries_of(schema, machine)), times), 0.2)
    file = open_file(full).file
    finder = Finder(file.schema, file.machine, file)
    typed = [text[:n] for text in QUESTIONS for n in range(1, len(text) + 1)]
    asked = (*typed, *SHORT)[:: 1 if times > 1 else 12]
    each = [min(timed(lambda text=text: finder.find(text), 2)) for text in asked]
    yield Measure("a question, every keystroke of it", tuple(each), 0.030)
    yield Measure("  the slowest keystroke", (max(each),), 0.030)
    texts = cycle(typed)

    def after_an_edit() -> None:
        finder.forget_values()
        finder.find(next(texts))

    yield Measure("a question after an edit", timed(after_an_edit, 4 * times), 0.030)
