"""Travel and zones: the geometry of what the manuals say, and what a handle does to the values."""

import pytest

from amp_studio.files import new_file
from amp_studio.pictures import draw
from amp_studio.schema import Value


def lines(scene, sort):
    return {line.points for line in scene.lines if line.sort == sort}


def area(scene, name):
    (found,) = [a for a in scene.areas if a.name == name]
    return (found.left, found.bottom, found.right, found.top, found.sort)


def handle(scene, *parameters):
    (found,) = [h for h in scene.handles if [d.address for d in h.drags] == list(parameters)]
    return found


def moved(handle, at):
    return {drag.address: drag.value_at(place) for drag, place in zip(handle.drags, at, strict=True)}


def notes(scene):
    return [note.text for note in scene.notes]


def test_the_mill_has_its_overtravels_and_both_zones_of_its_group(example):
    """Pages 6-7 to 6-11: X from -500 to 8, Y from -400 to 6 mm; zones 2 and 3 of group 1 bound one body
    each.
    """
    scene = draw(example("9pc"), "travel", "X Y")
    assert (scene.x.unit, scene.y.unit, scene.equal) == ("mm", "mm", True)
    assert lines(scene, "ink") == {
        ((-500.0, -400.0), (-500.0, 6.0)),
        ((8.0, -400.0), (8.0, 6.0)),
        ((-500.0, -400.0), (8.0, -400.0)),
        ((-500.0, 6.0), (8.0, 6.0)),
    }
    assert area(scene, "Limit 2") == (-498.0, -60.0, -420.0, 4.0, "forbidden")
    assert area(scene, "Limit 3") == (-350.0, -300.0, -150.0, -100.0, "either")


def test_home_marker_and_the_side_of_the_switch(example):
    """Page 5-4: home is Axis Position After Homing, Home Calibration away from the marker; the switch lies
    against the direction in which the axis leaves it.
    """
    file = example("9pc")
    file.set(("home.calibration", "1"), Value(1.5, "mm"))
    scene = draw(file, "travel", "X Y")
    assert [dot.at for dot in scene.dots if dot.kind == "home"] == [(6.0, 4.0)]
    marker, switch = (
        next(dot.at[0] for dot in scene.dots if dot.kind == kind) for kind in ("marker", "switch")
    )
    assert marker == 4.5
    assert switch > marker
    assert "left" in {dot.kind for dot in scene.dots}


def test_an_edge_moves_one_value_and_a_corner_both(example):
    scene = draw(example("9pc"), "travel", "X Y")
    right, low = ("zone.limit3_max", "1"), ("zone.limit3_min", "2")
    edge = handle(scene, right)
    assert (edge.at, edge.label, edge.value) == ((-150.0, -200.0), "1007 Limit 3 Max Value, X", "-150 mm")
    assert moved(edge, [-123.4]) == {right: Value(-123.0, "mm")}
    assert (edge.drags[0].step, edge.drags[0].low, edge.drags[0].high) == (1.0, -350.0, 999999.99)
    corner = handle(scene, right, low)
    assert corner.at == (-150.0, -300.0)
    assert moved(corner, [-200.2, -310.0]) == {right: Value(-200.0, "mm"), low: Value(-310.0, "mm")}


def test_a_file_in_inches_is_drawn_and_set_in_inches(example):
    file = example("9pc")
    file.header.units = "inch"
    scene = draw(file, "travel", "X Y")
    edge = handle(scene, ("zone.overtravel_negative", "1"))
    assert scene.x.unit == "in"
    assert edge.at[0] == pytest.approx(-19.685039)
    assert edge.value == "-19.685 in"
    assert moved(edge, [-18.013]) == {("zone.overtravel_negative", "1"): Value(-18.0, "in")}


def test_an_axis_outside_of_the_group_is_bounded_by_its_overtravels(example):
    """Page 6-4."""
    file = example("9pc")
    file.set(("zone.group", "2"), Value("none"))
    scene = draw(file, "travel", "X Y")
    assert area(scene, "Limit 3") == (-350.0, -400.0, -150.0, 6.0, "either")
    file.set(("zone.group", "2"), Value("g2"))
    both = [
        (a.left, a.bottom, a.right, a.top) for a in draw(file, "travel", "X Y").areas if a.name == "Limit 3"
    ]
    assert both == [(-350.0, -400.0, -150.0, 6.0), (-500.0, -300.0, 8.0, -100.0)]


def test_what_is_not_set_is_shown_and_not_drawn(example):
    file = example("9pc")
    file.set(("zone.overtravel_positive", "1"), None)
    file.set(("zone.overtravel_used", "2"), Value(False))
    scene = draw(file, "travel", "X Y")
    assert "1320 Positive Software Overtravel, X: not set" in notes(scene)
    assert any(
        text.startswith("2330 Negative Software Overtravel, Y: inactive, software overtravel is not used")
        for text in notes(scene)
    )
    assert lines(scene, "ink") == {((-500.0, scene.y.low), (-500.0, scene.y.high))}


def test_an_end_beyond_the_other_is_drawn_and_marked(example):
    file = example("9pc")
    file.set(("zone.limit3_min", "1"), Value(-100.0, "mm"))
    scene = draw(file, "travel", "X Y")
    assert area(scene, "Limit 3") == (-150.0, -300.0, -100.0, -100.0, "error")
    assert any(note.wrong and "Limit 3 Min Value" in note.text for note in scene.notes)


def test_num_limits_and_switch_are_internal_units_drawn_in_mm(example):
    """Pages 7-10 and 7-12: P17 and P16 count internal units of P4, here a micrometre."""
    file = example("num")
    scene = draw(file, "travel", "X Y")
    assert handle(scene, ("travel.limit_max", "0")).at == (600.0, 199.5)
    assert moved(handle(scene, ("travel.limit_max", "0")), [550.4]) == {
        ("travel.limit_max", "0"): Value(550000, "iu")
    }
    assert [dot.at[0] for dot in scene.dots if dot.kind == "switch"][:1] == [0.0]
    assert {dot.kind for dot in scene.dots} >= {
        "left",
        "down",
    }  # P15 homes both in the negative direction (7-8)


def test_syntec_delivered_limits_are_no_limits(example):
    """Page 3.2: ±999999999 BLU as delivered."""
    file = example("syntec")
    file.set(("limit.first_positive", "1"), Value(999999999, "BLU"))
    scene = draw(file, "travel", "X Y")
    assert any(text.startswith("Pr2401") and text.endswith("is no limit") for text in notes(scene))
    assert not [h for h in scene.handles if h.drags[0].address == ("limit.first_positive", "1")]


@pytest.mark.parametrize(("key", "sort"), [("inside", "forbidden"), ("outside", "outside"), (None, "dim")])
def test_syntec_second_limit_forbids_the_side_that_pr2542_shows(example, key, sort):
    """Page 3.3; without a value nothing is hatched."""
    file = example("syntec")
    for parameter, axis, count in (
        ("second_positive", "1", 25000),
        ("second_negative", "1", 10000),
        ("second_positive", "2", 30000),
        ("second_negative", "2", 15000),
    ):
        file.set((f"limit.{parameter}", axis), Value(count, "BLU"))
    file.set(("limit.second_scope", ""), Value(key) if key else None)
    assert area(draw(file, "travel", "X Y"), "2nd stroke limit") == (10.0, 15.0, 25.0, 30.0, sort)


def test_the_press_has_counts_and_one_axis(example):
    """Pages 4-10 and 4-11: registers 11 and 13 of Y; no register has the length of a count."""
    scene = draw(example("57c422b"), "travel")
    assert (scene.part, scene.x.unit) == ("Y", "counts")
    assert sorted(h.at[0] for h in scene.handles) == [-4000.0, 84000.0]


def test_soft_limits_of_the_router_are_inches(example):
    """Page 60: 0.1 and -28 in."""
    file = example("acromill")
    scene = draw(file, "travel", "X Y")
    assert min(p[0][0] for p in lines(scene, "ink")) == pytest.approx(
        -28.0 if scene.x.unit == "in" else -711.2
    )
    file.set(("axes.disable_limit", "X"), Value(True))
    assert any("Disable Limit is True" in text for text in notes(draw(file, "travel", "X Y")))


def test_grbl_counts_its_travel_from_the_switch(example):
    """$130 is the way from the switch to the other end; a bit of $23 turns the search towards minus."""
    file = example("grblhal")
    file.set(("homing.invert_direction", ""), Value(0b010))
    scene = draw(file, "travel", "X Y")
    far, near = handle(scene, ("axis.max_travel", "X")), handle(scene, ("axis.max_travel", "Y"))
    assert (far.at[0], near.at[1]) == (-790.0, 780.0)
    assert moved(far, [-600.0]) == {("axis.max_travel", "X"): Value(600.0, "mm")}
    assert "Coordinates are counted from the home switch." in notes(scene)


@pytest.mark.parametrize("family", ["9pc", "num", "syntec", "57c422b", "acromill", "grblhal"])
def test_a_new_file_has_every_picture_and_shows_what_is_missing(family):
    from amp_studio.drawing import scene_json, scene_svg
    from amp_studio.pictures import pictures_of

    file = new_file(family)
    for picture in pictures_of(file):
        for part, _ in picture.parts[:2]:
            scene = picture.scene(part)
            assert scene_svg(scene).startswith("<svg ")
            assert scene_json(scene)["picture"] == picture.name
            assert scene.handles or scene.notes


def test_the_long_travel_of_a_lathe_lies_along_x(example):
    scene = draw(example("lathe"), "travel", "X Z")
    assert (scene.part, scene.x.label, scene.y.label) == ("1+2", "Z", "X")
    assert area(scene, "Limit 2") == (-2.0, -8.0, 60.0, 125.0, "forbidden")
