"""German that a fitter trusts: one word for each act at the control,
and a decimal comma where a number is shown.
"""

import re
from dataclasses import replace
from datetime import UTC, datetime

import pytest
from PySide6.QtWidgets import QApplication

from amp_studio.report import language_of
from amp_studio.schema import Limits, Value, program_texts, unit_named, unit_text
from amp_studio.schema.units import UNITS
from amp_studio.transfer.client import HEADS
from amp_studio.ui.base.figures import range_in_words, sentence, with_measures, written
from amp_studio.ui.base.time_words import in_words, stored_in_words
from amp_studio.ui.base.translated import sentenced, tr, unit_in_words, worded
from amp_studio.ui.motion.tuning_page import TuningView
from amp_studio.ui.program.block import block_fields
from amp_studio.ui.table.value_delegate import allowed_text
from amp_studio.ui.table.word_panel import WordPanel
from amp_studio.validate.plausible.experience import TITLES


def translations() -> list[tuple[str, str]]:
    """Return every English text of the window with its German one, each form of those with a number."""
    return [
        (english, form)
        for english, own in program_texts("de", "window").items()
        for form in ([own] if isinstance(own, str) else own)
    ]


def test_loading_is_no_word_for_what_replaces_the_parameters_of_a_control() -> None:
    dangerous = re.compile(r"\b(ge|hoch|herunter)?lade(n|t)?\b|\bHolen\b|Download|Upload", re.IGNORECASE)
    assert [pair for pair in translations() if dangerous.search(re.sub("'.*?'|&", "", pair[1]))] == []


def test_checking_is_what_rules_do_and_comparing_is_done_with_a_control() -> None:
    words = dict(translations())
    assert words["Compare"] == "Vergleichen"
    assert not [s for s, d in words.items() if "erify" in s and re.search("[Pp]rüf", d.replace("&", ""))]


def test_numbers_are_shown_with_a_comma_and_typed_with_either_sign(german: None, window) -> None:
    address = ("servo.excess_error", "1")
    window.edits.commit(address, "12,7 mm")
    assert window.workspace.file.get(address) == Value(12.7, "mm")
    assert window.table.cell_text(address) == "12,7 mm"
    window.edits.commit(address, "12.8 mm")
    assert window.table.cell_text(address) == "12,8 mm"
    assert window.table.typed_value(address) == "12.8 mm", "editors and the clipboard have a point"
    assert written("10.0.0.21") == "10,0,0,21", "which is why only values go through it"
    assert [button.text() for button in window.tools.units.buttons.values()] == ["mm", "Zoll"]


def test_what_the_facts_remark_on_a_bit_is_german(german: None, window_with) -> None:
    """The boxes of the bits had ``Unnamed (figure 4.1)``, and cells ``(inferred)``."""
    window = window_with("57c422b-label-press")
    window.go_to(("setup.encoder", "X"))
    ticks = window.findChild(WordPanel).ticks
    texts = [ticks.item(n).text() for n in range(ticks.count())]
    texts += [window.table.cell_text(address) for address in window.workspace.file.machine_schema.places]
    assert [text for text in texts if re.search("Unnamed|inferred|figure", text)] == []
    assert any("Ohne Namen (Bild 4.1)" in text for text in texts)


def test_two_columns_of_a_table_have_two_names(german: None, window) -> None:
    """What came of an exchange and how it ended were both Ergebnis."""
    texts = [[worded(head) for head in HEADS], [tr("Result"), tr("How it ended")]]
    assert [each for each in texts if len(set(each)) < len(each)] == []


def test_the_example_in_a_field_has_a_comma(german: None) -> None:
    assert [field.hint for field in block_fields() if re.search(r"\d\.\d", field.hint)] == []


def test_a_value_of_an_axis_without_a_letter_has_its_place_in_german(german: None, window_with) -> None:
    """Live had ``R0 Encoder Setup, X axis``."""
    window = window_with("57c422b-label-press")
    assert window.workspace.name_of(("setup.encoder", "X")) == "R0 Encoder Setup, Achse X"


def test_why_a_family_has_no_such_axis_and_what_a_build_needs_is_german(german: None, window_with) -> None:
    """A walk through every page of a German window found these in English."""
    window = window_with("grblhal-router")
    window.enable()
    tips = {window.menus[key].toolTip() for key in ("axis.name", "axis.type")}
    assert tips == {
        "grblHAL and Grbl hat feste Namen für ihre Achsen",
        "grblHAL and Grbl hat keinen Parameter für die Art einer Achse",
    }
    window.menus["view.tuning"].trigger()
    tuning = window.findChildren(TuningView)[-1]
    backlash = next(part for part in tuning.values if part.page.key == "reversal")
    assert "Nur in Firmware mit Umkehrspielkompensation." in backlash.hint.text()


@pytest.mark.parametrize(
    ("message", "german_text"),
    [
        (
            "Excess Error 300.5 mm is outside 0 to 214.1 mm.",
            "Excess Error 300,5 mm ist außerhalb von 0 bis 214,1 mm.",
        ),
        (
            "Excess Error is 0.001 mm on X and 11 mm on Y; they agree in 59 other values. Is it meant?",
            (
                "Excess Error: 0,001 mm bei X und 11 mm bei Y; in 59 anderen Werten stimmen sie überein. Ist"
                " das so gewollt?"
            ),
        ),
        (
            "1300 Home Calibration is 25.4 mm, 25.4 times the 1 mm in the backup. Is it meant?",
            (
                "1300 Home Calibration ist 25,4 mm, war 1 mm in der Sicherung (das 25,4-Fache). Ist das so"
                " gewollt?"
            ),
        ),
        (
            "Bits of P3N0.5 and $22.0 in revision 10.0.21 are 1.5.",
            "Bits of P3N0.5 and $22.0 in revision 10.0.21 are 1,5.",
        ),
    ],
)
def test_what_the_check_shows_is_german_with_a_comma_and_an_address_is_none(
    german: None, message: str, german_text: str
) -> None:
    assert sentence(message) == german_text


def test_the_title_of_every_rule_of_the_program_itself_is_german(german: None) -> None:
    for title in (*TITLES.values(), "A value outside its range", "The builder's own rules"):
        assert worded(title) != title


def test_a_finding_and_the_allowed_range_are_german_in_the_window_and_in_the_report(
    german: None, window
) -> None:
    address = ("servo.excess_error", "1")
    window.workspace.edit("rapid", {("feedrate.rapid", "1"): Value(100.5, "mm/s")})
    texts = [window.findings.model.text_of(window.findings.model.index(n, 0)) for n in range(3)]
    assert any("100,5 mm/s bei X und 10\u202f000 mm/min bei Y; in 64 anderen" in text for text in texts), (
        texts
    )
    assert not any("100.5" in text for text in texts), "a rule has the words of its facts and the comma too"
    assert allowed_text(window.workspace, address) == "0 bis 214,1 mm"


@pytest.mark.parametrize(
    ("text", "written"),
    [
        (
            "1750 ist 10000 mm/min: üblich 5e-08 bis 3e-05 mm",
            "1750 ist 10 000 mm/min: üblich 5 × 10⁻⁸ bis 3 × 10⁻⁵ mm",
        ),
        ("12345 Home ist -20000 bis 30000,5 mm", "12345 Home ist -20 000 bis 30 000,5 mm"),
        ("P9N10000 und $10000 in 10.0.21, 20000 Werte", "P9N10000 und $10000 in 10.0.21, 20000 Werte"),
    ],
)
def test_quantities_of_a_finding_are_in_groups_and_powers_and_no_address_is(
    german: None, text: str, written: str
) -> None:
    """A finding had 10000 mm/min beside the cell with 10 000, and 5e-08 mm."""
    assert with_measures(text) == re.sub(r"(?<=\d) (?=\d{3}\b)| (?=×)|(?<=×) ", "\u202f", written)


def test_the_report_has_the_language_of_the_window_until_another_is_chosen(window) -> None:
    choice = window.report_options
    choice.contents = replace(choice.contents, sort="number")
    window.settings.keep_language("de")
    assert choice.contents.language == "de", "the order was chosen, not the language"
    choice.contents = replace(choice.contents, language="en")
    assert choice.contents.language == "en"


def test_how_an_exchange_ended_is_german() -> None:
    german = language_of("de")
    ended = german.message(
        "Download complete and read back equal. Restart the control to make it current."
        " What it contained before is kept in /tmp/mill.img."
    )
    assert ended == (
        "Übertragung fertig, und das Zurückgelesene ist gleich. Damit es gilt, die Steuerung neu starten."
        " Was sie vorher enthielt, liegt in /tmp/mill.img."
    )
    away = german.message("no connection to the control (tcp://10.0.0.1:9600: nothing listens there)")
    assert away == "keine Verbindung zur Steuerung (tcp://10.0.0.1:9600: dort antwortet nichts)"


@pytest.mark.parametrize(
    ("english", "german"),
    [
        (
            "/hall/mill.amp cannot be written: No space left on device",
            "/hall/mill.amp kann nicht geschrieben werden: auf dem Datenträger ist kein Platz mehr",
        ),
        (
            "mill.amp cannot be changed: its folder cannot be written to",
            "mill.amp kann nicht geändert werden: der Ordner ist schreibgeschützt",
        ),
    ],
)
def test_why_a_file_is_not_written_is_german(english: str, german: str) -> None:
    assert language_of("de").message(english) == german


def test_units_are_german_where_they_are_shown_and_both_are_read(german: None, window) -> None:
    own = language_of("de").units
    units = {unit: own.get(unit_text(unit), unit) for unit in UNITS if unit}
    read = {unit: unit_named(text) for unit, text in units.items() if " " not in text}
    assert read == {unit: unit for unit in read}
    assert unit_in_words("in/min") == "Zoll/min"
    for typed in ("0.5 in", "0,5 Zoll"):
        window.edits.commit(("servo.excess_error", "1"), typed)
        assert window.workspace.file.get(("servo.excess_error", "1")) == Value(0.5, "in")


def test_a_day_has_its_point(german: None) -> None:
    then, now = datetime(2026, 3, 12, 8, 30, tzinfo=UTC), datetime(2026, 11, 29, 9, tzinfo=UTC)
    assert in_words(then, now).startswith("12. Mär")


def test_the_left_panel_is_as_narrow_as_in_english_whichever_side_it_shows(german: None, open_window, path):
    window = open_window(path)
    window.resize(1366, 768)
    left = window.page.left
    for side in ("groups", "steps", "project"):
        left.show_side(side)
        window.docks.reset()
        QApplication.processEvents()
        assert left.width() == 212, side
        cut = [b.text() for b in left.segment.buttons.values() if b.width() < b.minimumSizeHint().width()]
        assert not cut, side


def test_a_line_that_is_cut_has_its_reason_in_the_same_language(german: None) -> None:
    text = "the line to the control is cut and could not be made again for 20 s (tcp://10.0.0.1:9600: {})"
    for why in ("nothing listens there", "no answer in time"):
        assert why not in sentence(text.format(why))


def test_the_time_of_a_version_is_german(german: None) -> None:
    """``Vor today 09:49`` was in the lists of versions, and ``120 in/min`` beside ``Zoll/min``."""
    assert stored_in_words("2024-03-03T10:00:00+00:00") == "3. März 2024"
    assert stored_in_words("no time") == "no time"
    assert sentenced("120 in/min", "acromill") == "120 Zoll/min"


def test_a_range_has_the_comma_and_the_groups_of_its_values(german: None) -> None:
    assert range_in_words(Limits(-999999.99, 999999.99, "mm")) == "−999\u202f999,99 bis 999\u202f999,99 mm"
