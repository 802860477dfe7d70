"""The diagram of loops: blocks in the order of the signals, values that lead to their parameters, and steady
signals that are those of the scenarios.
"""

import pytest

import amp_studio as amp
from amp_studio.pictures import draw, pictures_of
from amp_studio.pictures.loop import LEFT
from amp_studio.schema import LoopBlock, LoopRoles

from .conftest import EXAMPLES


def texts(scene):
    return {text.text: text.value for text in scene.texts}


def test_a_9pc_has_10_mm_behind_at_10_m_a_minute_and_gain_1(example):
    """Page 7-25: following error = feedrate / (1000 x gain)."""
    found = texts(draw(example("9pc"), "loop", "X"))
    assert found["following error"] == "10 mm"
    assert found["command velocity"] == "10000 mm/min"
    assert texts(draw(example("9pc"), "loop", "X@10"))["following error"] == "1 mm"


def test_the_signals_are_those_of_the_speed_that_is_chosen(example):
    """A quarter of the rapid feedrate is a quarter of its error; more than rapid is no speed."""
    assert texts(draw(example("9pc"), "loop", "X@25 %"))["command velocity"] == "2500 mm/min"
    assert texts(draw(example("9pc"), "loop", "@25"))["following error"] == "2.5 mm"
    for share in ("0", "101", "fast"):
        with pytest.raises(KeyError, match="share of the rapid feedrate"):
            draw(example("9pc"), "loop", f"X@{share}")


def test_the_signals_are_those_of_a_move(checkout):
    """One engine: a step at the same speed has the same following error."""
    machine = amp.open(checkout / "examples" / EXAMPLES["num"])
    moved = machine.simulate("step", axis="X")
    displayed = texts(draw(machine.file, "loop", "X"))["following error"]
    assert float(displayed.split()[0]) == pytest.approx(moved.result["steady_following_error"][0], rel=2e-3)


@pytest.mark.parametrize("name", ["9pc", "num", "syntec", "57c422b", "acromill"])
def test_each_value_leads_to_its_parameter_and_blocks_follow_each_other(example, name):
    file = example(name)
    scene = draw(file, "loop")
    named = {text.address for text in scene.texts if text.address}
    assert named == set(scene.drawn_from)
    boxes = [text.text for text in scene.texts if text.anchor == "middle"]
    assert [block.name for block in file.schema.pictures.loop.blocks if block.place == "chain"] == [
        box
        for box in boxes
        if any(block.name == box and block.place == "chain" for block in file.schema.pictures.loop.blocks)
    ]
    assert all(len(line.points) < 5 or line.points[0][0] == LEFT for line in scene.lines)


def test_a_value_out_of_range_is_red_and_one_that_is_not_set_is_named(example):
    file = example("9pc")
    file.set(("servo.initial_gain", "1"), None)
    scene = draw(file, "loop", "X")
    assert texts(scene)["1710"] == "not set"
    assert any(note.text.startswith("No signals") for note in scene.notes)


def test_a_machine_in_inches_has_its_signals_in_inches(example):
    file = example("9pc")
    file.header.units = "inch"
    assert texts(draw(file, "loop", "X"))["following error"].endswith(" in")


def test_a_family_without_a_printed_loop_has_no_diagram(example):
    assert "loop" not in {picture.name for picture in pictures_of(example("grblhal"))}


def test_facts_of_a_diagram_have_one_command_and_blocks_that_there_are():
    command = LoopBlock(name="Command", place="command")
    with pytest.raises(ValueError, match="one command"):
        LoopRoles(page="1", note="", blocks=(command,))
    chain = LoopBlock(name="Gain")
    with pytest.raises(ValueError, match="not in the chain"):
        LoopRoles(page="1", note="", blocks=(command, chain, LoopBlock(name="F", place="back", into="no")))
