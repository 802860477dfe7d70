"""The copy of a Grbl control is text in the control's own words, and each content has exactly one."""

import pytest

from amp_studio.families.grblhal.content import GrblContent, read_content, write_content
from amp_studio.transfer.image import ImageError

CONTENT = GrblContent(
    identity=("[VER:1.1f.20260817:my mill]", "[AXS:4:XYZA]", "[FIRMWARE:grblHAL]", "[DRIVER:Simulator]"),
    settings={130: "200.000", 0: "5.0"},
    offsets={"G28": "1.000,2.000,3.000,0.000", "G54": "0.000,0.000,0.000,0.000"},
    startup={0: "", 1: "G21"},
    enumerations={"$ES": ("[SETTING:0|35|Step pulse time|microseconds|6|#0.0|2.0||0|0]",)},
)
TEXT = """grblHAL settings 1
> $I
[VER:1.1f.20260817:my mill]
[AXS:4:XYZA]
[FIRMWARE:grblHAL]
[DRIVER:Simulator]
> $$
$0=5.0
$130=200.000
> $#
[G54:0.000,0.000,0.000,0.000]
[G28:1.000,2.000,3.000,0.000]
> $N
$N0=
$N1=G21
> $ES
[SETTING:0|35|Step pulse time|microseconds|6|#0.0|2.0||0|0]
end 17
"""


def test_a_content_is_written_in_order_and_read_back() -> None:
    assert write_content(CONTENT).decode() == TEXT
    assert read_content(TEXT.encode()) == CONTENT
    assert (CONTENT.version, CONTENT.identity_word("DRIVER"), CONTENT.axes) == (
        "1.1f.20260817",
        "Simulator",
        ("X", "Y", "Z", "A"),
    )


def test_a_grbl_that_shows_nothing_of_its_axes_has_as_many_as_its_offsets() -> None:
    grbl = GrblContent(("[VER:1.1h.20190830:]",), {0: "10"}, {"G54": "0.000,0.000,0.000"}, {0: ""})
    assert (grbl.axes, grbl.describes_itself) == (("X", "Y", "Z"), False)
    assert read_content(write_content(grbl)) == grbl


@pytest.mark.parametrize(
    ("old", "new", "text"),
    [
        ("grblHAL settings 1", "grblHAL settings 2", "this is not a copy of Grbl settings"),
        ("end 17\n", "", "cut off"),
        ("end 17", "end 18", "cut off"),
        ("> $#\n", "> $Q\n", "line 10 of the copy of the settings begins no section"),
        ("> $N\n", "> $$\n", "line 13 of the copy of the settings begins no section"),
        ("$0=5.0\n$130=200.000", "$130=200.000\n$0=5.0", "not in the order"),
        ("$130=", "$0=", "has something twice"),
        ("$130=200.000", "130=200.000", "'130=200.000', which is not a setting"),
        ("$N1=", "$M1=", "'$M1=G21', which is not a start-up line"),
        ("[G28:", "[TLO:", "which is not an offset"),
        ("$0=5.0", "$0=5\x1b", "line 8 of the copy of the settings contains a control character"),
        ("$0=5.0", "$00=5.0", "which is not a setting"),
    ],
)
def test_a_damaged_copy_is_refused_with_what_is_wrong(old: str, new: str, text: str) -> None:
    assert old in TEXT
    with pytest.raises(ImageError) as caught:
        read_content(TEXT.replace(old, new, 1).encode())
    assert text in str(caught.value)


def test_a_copy_without_a_section_is_none() -> None:
    with pytest.raises(ImageError, match=r"has no section \$#"):
        read_content(b"grblHAL settings 1\n> $I\n> $$\nend 3\n")
