"""What a motion states is German in German: assumptions, doubts, reasons, prices, alarms and refusals."""

import re
from collections.abc import Iterator

import pytest

from amp_studio.families.ninepc.law_events import CODED
from amp_studio.files import ParameterFile, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.report.language import language_of
from amp_studio.schema import Value
from amp_studio.sim import SimulationError, check_motion, listing, simulate, simulated_axes
from tests.campaigns import CAMPAIGN
from tests.families.ninepc.test_law_sync import PAIR
from tests.report.test_german import FUNCTION_WORDS

EXAMPLES = {path.parent.name: path for path in sorted(examples_folder().glob("*/*.amp"))}
QUICK = {"57c422b-label-press", "lathe-ls176", "num-1060-mill", "acromill-router"}
"""Examples whose first axis ``make test`` moves once; a campaign runs all scenarios of all, of three axes."""
QUOTED = r"„[^“]*“|'[^']*'"


def stated(file: ParameterFile) -> Iterator[str]:
    """Yield every sentence of the motions of a file."""
    for axis in list(simulated_axes(file))[: 3 if CAMPAIGN else 1]:
        for scenario in listing(file).scenarios:
            if scenario.name == "sweep" or not (scenario.name == "step" or CAMPAIGN):
                continue
            try:
                trace = simulate(file, scenario.name, axis)
            except SimulationError as error:
                yield str(error)
                continue
            yield from (trace.model, *trace.assumptions, *trace.doubts)
            yield from (text for each in trace.recommendations for text in (each.why, each.price))
            yield from (alarm.message for alarm in trace.alarms)
    if CAMPAIGN:
        yield from (check.why for check in check_motion(file))


def english_in(sentences: list[str], file: ParameterFile) -> list[str]:
    """Return the German sentences in which English words remain beside the names of parameters."""
    names = sorted((p.name for p in file.schema.parameters.values()), key=len, reverse=True)
    known = re.compile("|".join((*map(re.escape, names), QUOTED)))
    return [text for text in sentences if FUNCTION_WORDS.search(known.sub("", text))]


def test_the_home_of_a_coded_scale_is_stated_with_the_names_that_the_parameters_have() -> None:
    file = open_file(EXAMPLES["lathe-ls176"]).file
    assert english_in([language_of("de", "9pc").sentence(text) for text in CODED[:2]], file) == []


@pytest.mark.parametrize("example", EXAMPLES if CAMPAIGN else sorted(QUICK))
def test_no_sentence_of_a_motion_has_english_words(example: str) -> None:
    file = open_file(EXAMPLES[example]).file
    words = language_of("de", file.schema.family.family)
    german = {text: words.sentence(text) for text in stated(file) if text}
    assert len(german) > 3
    assert english_in([*german.values()], file) == []
    assert [text for text, de in german.items() if re.search(r"[a-z] [a-z]{3,} ", text) and text == de] == []


PUT_TOGETHER = {
    "The velocity loop has too little margin with a load of 2.5 times the inertia of the motor: Ms 2.87,"
    " 22.7 deg phase margin and 6.36 dB gain margin; all gains together Ms 1.24, 89.1 deg phase margin on the"
    " assumed machine (page 7-54, aim normal).": (
        "Der Drehzahlregler hat mit einer Last vom 2,5-Fachen der Motorträgheit zu wenig Reserve: Ms 2,87,"
        " Phasenreserve 22,7°, Amplitudenreserve 6,36 dB; alle Verstärkungen zusammen: Ms 1,24, Phasenreserve"
        " 89,1°, an der angenommenen Maschine (Seite 7-54, Ziel normal)."
    ),
    "Every count of the feedback moves the output 1.1 times as much. It raises a gain on a machine that is"
    " partly assumed: your choice.": (
        "Jedes Inkrement der Rückmeldung bewegt den Ausgang 1,1-mal so stark. Es erhöht eine Verstärkung an"
        " einer zum Teil angenommenen Maschine: zu entscheiden."
    ),
    "ASSUMED: the second axis of the circle is like axis X.": (
        "ANGENOMMEN: die zweite Achse des Kreises ist wie die Achse X."
    ),
}


@pytest.mark.parametrize("english", PUT_TOGETHER, ids=range(len(PUT_TOGETHER)))
def test_a_sentence_is_put_together_of_its_parts(english: str) -> None:
    assert language_of("de", "9pc").sentence(english) == PUT_TOGETHER[english]


@pytest.mark.parametrize("example", sorted({*QUICK, "mill-1394", "syntec-mill"} - {"lathe-ls176"}))
def test_the_steps_of_tests_at_the_machine_are_german(example: str) -> None:
    from amp_studio.dossier import machine_tests_of

    file = open_file(EXAMPLES[example]).file
    words = language_of("de", file.schema.family.family)
    tests = list(machine_tests_of(file, next(iter(simulated_axes(file)))))
    texts = {text for test in tests for step in test.steps for text in step}
    texts |= {test.title.partition(": ")[2] for test in tests}
    assert len(texts) > 4
    assert [text for text in sorted(texts) if words.sentence(text) == text] == []


def test_a_refused_circle_names_both_axes_in_german() -> None:
    from amp_studio.dossier import machine_tests_of

    file = open_file(EXAMPLES["num-1060-mill"]).file
    words = language_of("de", file.schema.family.family)
    refusals = {test.refusal for axis in simulated_axes(file) for test in machine_tests_of(file, axis)} - {""}
    assert any("G17 to G19" in text for text in refusals)
    assert [
        text for text in refusals if words.sentence(text) == text or " and " in words.sentence(text)
    ] == []


@pytest.mark.parametrize(
    ("example", "scenario", "settings"),
    [
        ("num-1060-mill", "handwheel", {"move.rate": 90.0, "move.turns": 900.0}),
        ("syntec-mill", "handwheel", {"move.rate": 50.0}),
        ("num-1060-mill", "clamp", {"move.crm": "none"}),
        ("num-1060-mill", "tap", {"move.pitch": 1.0, "move.speed": 400.0, "move.feed_stop": 1.0}),
        ("lathe-ls176", "synchronize", {"move.speed": 4000.0, "move.then": 1000.0}),
    ],
)
def test_wheels_clamps_and_pairs_are_stated_in_german(
    example: str, scenario: str, settings: dict[str, float | str]
) -> None:
    file = open_file(EXAMPLES[example]).file
    for address, value in (PAIR if scenario == "synchronize" else {}).items():
        file.set(address, Value(0.9) if address == ("spindle.gain", "2.1") else value)
    words = language_of("de", file.schema.family.family)
    trace = simulate(file, scenario, None, settings, advise=False)
    english = [*trace.assumptions, *(alarm.message for alarm in trace.alarms)]
    assert english_in([words.sentence(text) for text in english], file) == []
    assert [text for text in english if text == words.sentence(text)] == []
    described = next(each for each in listing(file).scenarios if each.name == scenario)
    german = [words.sentence(text) for text in (described.title, *described.settings.values())]
    assert english_in(german, file) == []
