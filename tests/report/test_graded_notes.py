"""Danger, warning and note of a parameter's help, as machine manuals grade them."""

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.report import Contents, help_parts, page_of
from amp_studio.report.build import build_report
from amp_studio.report.output.page import render_html
from amp_studio.report.output.text import render_text
from amp_studio.schema import Value, family_ids, load_schema


def test_a_danger_is_before_the_help_with_its_page() -> None:
    schema = load_schema("9pc")
    parts = help_parts(schema, schema.parameters["servo.position_sign"])
    assert parts[0] == ("Danger", "A wrong sign can make the axis run away. (page 7-36)")
    assert parts[1][0] == "What it does"


def test_the_page_of_a_parameter_shows_what_the_manual_warns_of() -> None:
    page = page_of(load_schema("57c422b"), "R31")
    assert "Warning\n  Always limit the voltage reference" in page
    assert "(page 4-17)" in page


def test_the_dangers_of_what_a_user_chose_are_a_chapter_with_each_statement_once(mill: ParameterFile) -> None:
    assert build_report(new_file("9pc")).dangers == (), "every value is the printed default"
    mill.set(("servo.position_sign", "1"), Value("minus"))
    mill.set(("servo.position_sign", "2"), Value("minus"))
    [sign] = [danger for danger in build_report(mill).dangers if danger.page == "7-36"]
    assert sign.says == "A wrong sign can make the axis run away."
    assert [label for _, label in sign.about] == ["Sign of Position Feedback (X, Y)"]
    text = render_text(build_report(mill)).decode()
    assert "  DANGER  A wrong sign can make the axis run away. (page 7-36)\n" in text
    assert text.count("A wrong sign can make the axis run away.") == 1


def test_an_ignored_value_is_no_danger(mill: ParameterFile) -> None:
    mill.set(("servo.position_sign", "1"), Value("minus"))
    assert "7-36" in {danger.page for danger in build_report(mill).dangers}
    mill.set(("servo.position_loop_type", "1"), Value("detached"))
    assert "7-36" not in {danger.page for danger in build_report(mill, Contents(inactive=True)).dangers}


def test_a_german_page_has_german_titles_for_the_grades(mill: ParameterFile) -> None:
    mill.set(("servo.position_sign", "1"), Value("minus"))
    page = render_html(build_report(mill, Contents(language="de"))).decode()
    assert '<h2 id="dangers">Gefahren</h2>' in page
    assert '<div class="hazard"><b>Gefahr</b>' in page
    assert '["note", "Hinweis", "Die Reihenfolge muss Inposition Band ' in page
    assert '["", "Wirkung", ' in page


@pytest.mark.parametrize("family", family_ids())
def test_every_statement_is_whole_sentences_and_not_the_help_again(family: str) -> None:
    for parameter in load_schema(family).parameters.values():
        texts = parameter.help
        for statement in (*texts.danger, *texts.warning, *texts.note):
            assert statement.says.endswith("."), parameter.id
            assert statement.says not in " ".join((texts.what, texts.find, texts.wrong)), parameter.id
