"""What every picture has in common: handles that change nothing where they lie, labels, notes, errors."""

import json
from functools import cache
from itertools import pairwise

import pytest
from hypothesis import given, settings
from hypothesis import strategies as st

from amp_studio.drawing import scene_json, scene_svg
from amp_studio.files import open_file
from amp_studio.pictures import draw, pictures_of
from amp_studio.schema import Value
from tests.campaigns import examples

from .conftest import EXAMPLES
from .test_other_pictures import handle, moved, notes


@pytest.mark.parametrize(
    ("name", "units"),
    [
        ("9pc", "metric"),
        ("9pc", "inch"),
        ("lathe", "metric"),
        ("num", "metric"),
        ("syntec", "metric"),
        ("57c422b", "metric"),
        ("acromill", "metric"),
        ("acromill", "inch"),
        ("grblhal", "metric"),
    ],
)
def test_each_handle_dropped_where_it_lies_changes_nothing_that_matters(example, name, units):
    """What a person reads at a handle is what its place means: at most one step apart."""
    file = example(name)
    file.header.units = units
    for picture in pictures_of(file):
        for part, _ in picture.parts:
            scene = picture.scene(part)
            for each in scene.handles:
                for drag in each.drags:
                    value = drag.value_at(each.at[0 if drag.along == "x" else 1])
                    own = file.get(drag.address)
                    if isinstance(own.value, str):
                        assert value == own
                    else:
                        assert abs(
                            file.evaluation.canonical(drag.address) - _canonical(value)
                        ) <= 1.01 * _canonical(Value(drag.step, drag.unit))


def _canonical(value):
    from amp_studio.schema import canonical

    return canonical(value.value, value.unit)


def test_a_picture_as_svg_and_json_has_labels_and_notes(example):
    file = example("9pc")
    file.set(("zone.limit3_max", "1"), None)
    scene = draw(file, "travel", "X Y")
    assert "1007 Limit 3 Max Value, X: not set" in scene_svg(scene)
    told = scene_json(scene)
    assert {
        "text": "1007 Limit 3 Max Value, X: not set",
        "wrong": False,
        "id": "zone.limit3_max",
        "instance": "1",
    } in told["notes"]
    (edge,) = [
        h
        for h in told["handles"]
        if len(h["moves"]) == 1
        and h["moves"][0]["id"] == "zone.overtravel_positive"
        and h["moves"][0]["instance"] == "1"
    ]
    assert edge["moves"][0]["range"] == [-500.0, 2540000.0]
    assert edge["moves"][0]["unit"] == "mm"
    assert all(a <= b for a, b in pairwise([0.0, edge["moves"][0]["step"]]))


@pytest.mark.parametrize(
    ("name", "part"), [("nothing", ""), ("travel", "Q"), ("travel", "X X"), ("travel", "X Y Z")]
)
def test_an_unknown_picture_or_part_is_an_error(example, name, part):
    with pytest.raises(KeyError):
        draw(example("9pc"), name, part)


def test_the_axis_calibration_of_a_9pc_is_a_curve_in_its_own_unit(example):
    """Page 36-7: deviations over the positions, of which the first has none,
    and none is above 2 % of the way.
    """
    file = example("9pc")
    address = ("calibration.table", "1")
    file.set(address, Value("deviation - mm -100:0 0:0.004 100:0.0065"))
    scene = draw(file, "calibration", "X")
    assert scene.lines[-1].points == ((-100.0, 0.0), (0.0, 0.004), (100.0, 0.0065))
    assert moved(scene.handles[1], 0.005) == Value("deviation - mm -100:0 0:0.005 100:0.0065")
    assert scene.with_point((50.0, 0.006)) == (
        address,
        Value("deviation - mm -100:0 0:0.004 50:0.006 100:0.0065"),
    )
    assert scene.handles[2].without == (address, Value("deviation - mm -100:0 0:0.004"))
    with pytest.raises(ValueError, match="deviation 0"):
        moved(scene.handles[0], 0.001)
    with pytest.raises(ValueError, match="2 %"):
        moved(scene.handles[1], 2.5)


def test_a_table_begins_with_a_point_that_is_put_in(example):
    file = example("9pc")
    scene = draw(file, "calibration", "X")
    assert notes(scene) == ["Axis Calibration, X: not set"]
    assert scene.with_point((-100.0, 0.3)) == (("calibration.table", "1"), Value("deviation - mm -100:0"))


def test_the_limit_speed_of_a_num_range_lies_on_its_line(example):
    """Page 8-16: 0 is the highest speed of the range."""
    file = example("num")
    limit = next(i for i in file.machine_schema.instances(file.schema.parameters["spindle.limit_speed"]))
    assert not [h for h in draw(file, "gears", "1").handles if h.drags[0].address[0] == "spindle.limit_speed"]
    file.set(("spindle.limit_speed", limit), Value(80, "rpm"))
    assert handle(draw(file, "gears", "1"), ("spindle.limit_speed", limit)).at == (80.0, 8.0)


EXTREMES = (0.0, -1.0, 1e-9, 1e300, -1.7e308, 5e-324)


@given(data=st.data())
@settings(max_examples=examples(40))
def test_no_value_however_odd_keeps_a_picture_from_being_drawn(checkout, data):
    file = _opened(checkout, data.draw(st.sampled_from(sorted(EXAMPLES)))).copy()
    for parameter in data.draw(
        st.lists(st.sampled_from(file.schema.pictures.params), min_size=1, max_size=5)
    ):
        definition = file.schema.parameters[parameter]
        for instance in file.machine_schema.instances(definition)[:2]:
            address = (parameter, instance)
            if definition.type in ("real", "integer"):
                number = data.draw(st.sampled_from(EXTREMES))
                whole = definition.type == "integer"
                unit = file.evaluation.unit(address, file.header.units)
                file.set(address, Value(int(max(min(number, 1e15), -1e15)) if whole else number, unit))
            else:
                file.set(address, None)
    for picture in pictures_of(file):
        scene = picture.scene()
        assert "nan" not in scene_svg(scene)
        assert json.dumps(scene_json(scene), allow_nan=False)
        assert scene.handles or scene.notes or scene.curves


@cache
def _opened(checkout, name):
    return open_file(checkout / "examples" / EXAMPLES[name]).file


def test_the_ramp_that_moves_have_is_the_marked_one(example):
    """Page 10-3 chooses between linear and exponential, bit 5 of P7N1 (9-6) between straight and sin²."""
    lathe, num = example("lathe"), example("num")

    def marked(file):
        return [text.text for text in draw(file, "ramps", "X").texts if text.sort == "now"]

    assert marked(lathe) == ["Linear"]
    lathe.set(("accdec.positioning_mode", ""), Value("exponential"))
    assert marked(lathe) == ["Exponential"]
    num.set(("misc.functions_more", ""), Value(0b100000))
    assert marked(num) == ["Sin²"]
    num.set(("misc.functions_more", ""), None)
    assert marked(num) == []
    assert any(
        "not set, so the ramp of moves is not marked" in text for text in notes(draw(num, "ramps", "X"))
    )
