"""What only the check of AcroMill has: the letters of the axes, and the pages of its tabs."""

from dataclasses import replace

from families import ACROMILL

from amp_studio.files import new_file
from amp_studio.schema import load_schema, show_value


def test_the_letters_of_the_axes_are_delivered_in_their_order() -> None:
    """X,Y... is the default, and X,Y,Z,A,B,C,U,V are typical (page 60)."""
    file, schema = new_file("acromill"), load_schema("acromill")
    name = schema.parameter("axes.name")
    content = [file.default((name.id, axis)) for axis in schema.on("mill").instances(name)]
    assert [one and show_value(name, one) for one in content] == list("XYZABCUV")


def test_no_page_can_be_altered_unseen() -> None:
    for at, section in enumerate(ACROMILL.book.sections):
        other = replace(section, page="1")
        assert any(ACROMILL.new_with_section(check, at, other) for check in ("names", "runs")), (
            section.heading
        )
