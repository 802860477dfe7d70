"""The numbers of the real 9/PC: three of them mean two parameters, and the signature keeps watch over all."""

from collections.abc import Callable

import pytest

from amp_studio.schema import Evaluation, Schema, UnknownParameterError, Value
from amp_studio.schema.catalog import schema_of
from amp_studio.schema.load import Compiled, load_compiled
from amp_studio.schema.model import Parameter


@pytest.mark.parametrize(
    ("number", "kind", "expected"),
    [
        ("1013", "linear", "servo.velocity_gear_teeth@1"),
        ("1013", "rotary", "servo.velocity_gear_teeth@1"),
        ("1013", "spindle", "servo.spindle_motor_teeth@1"),
        ("1018", "linear", "servo.velocity_screw_teeth@1"),
        ("1018", "spindle", "servo.spindle_shaft_teeth@1"),
        ("8018", "spindle", "servo.spindle_shaft_teeth@8"),
        ("1020", "linear", "zone.overtravel_used@1"),
        ("1020", "spindle", "zone.overtravel_used@1"),
        ("3020", "linear", "zone.overtravel_used@3"),
    ],
)
@pytest.mark.parametrize("loop", [None, "digital", "analog", "sercos"])
def test_a_number_means_what_the_axis_is(
    ninepc, machine, number: str, kind: str, expected: str, loop: str | None
) -> None:
    """Pages 7-52, 7-53 against 7-82, 7-83; 1020 is printed on 6-10 and again on 7-46, where another is
    meant.
    """
    axis = expected[-1]
    values = {f"axis.type@{axis}": Value(kind)}
    if loop is not None:
        values |= {f"servo.hardware_type@{axis}": Value("sercos"), f"servo.loop_type@{axis}": Value(loop)}
    name, _, instance = expected.partition("@")
    assert (name, instance) == machine(ninepc, values).evaluation.find(number)


def test_the_parameter_whose_number_is_disputed_is_reached_by_its_id(ninepc, machine) -> None:
    here = machine(ninepc, {"axis.type@1": Value("linear")})
    assert here.evaluation.find("servo.velocity_port@1") == ("servo.velocity_port", "1")
    assert ninepc.on("mill").short(("servo.velocity_port", "1")) == "servo.velocity_port@1"
    assert ninepc.on("mill").short(("servo.velocity_gear_teeth", "1")) == "servo.velocity_gear_teeth@1"
    assert ninepc.on("mill").short(("home.calibration", "1")) == "1300"


@pytest.mark.parametrize(
    "text", ["9999", "0", "", "home.calibration@9", "home.calibration", "home.calibratio@1", "P3N0"]
)
def test_what_the_family_does_not_have_is_refused_in_one_sentence(ninepc, machine, text: str) -> None:
    with pytest.raises(UnknownParameterError) as refused:
        machine(ninepc).evaluation.find(text)
    assert str(refused.value).removeprefix("Unknown parameter ").startswith(f"'{text}'")
    assert "\n" not in str(refused.value)


def test_every_address_is_found_again_by_what_it_is_called(ninepc) -> None:
    for kind in ("mill", "lathe"):
        evaluation = Evaluation(ninepc, lambda _: None, lambda kind=kind: kind)
        for address in ninepc.on(kind).addresses:
            assert address == evaluation.find(ninepc.on(kind).short(address))


def test_the_processes_have_numbers_of_their_own(ninepc, machine) -> None:
    """Number of Limit 2,3 Groups: [20], [20020], [21020] (page 6-6)."""
    find = machine(ninepc).evaluation.find
    assert [("zone.group_count", i) for i in ("", "1", "2")] == [find(n) for n in ("20", "20020", "21020")]


# -- the signature ----------------------------------------------------------------------------------------


def changed(change: Callable[[Parameter], Parameter], name: str) -> Schema:
    """Return the 9/PC with one parameter changed."""
    compiled: Compiled = load_compiled("9pc")
    groups = tuple(
        group.model_copy(
            update={"parameters": tuple(change(p) if p.id == name else p for p in group.parameters)}
        )
        for group in compiled.groups
    )
    return schema_of(compiled.model_copy(update={"groups": groups}))


def test_the_signature_is_the_same_in_every_process_and_for_every_order_of_asking(ninepc) -> None:
    assert len(ninepc.signature) == 64
    assert ninepc.signature == schema_of(load_compiled("9pc")).signature


@pytest.mark.parametrize(
    "change",
    [
        pytest.param(
            lambda p: p.model_copy(update={"help": p.help.model_copy(update={"what": "Other words."})}),
            id="help",
        ),
        pytest.param(lambda p: p.model_copy(update={"page": "1-1"}), id="page"),
        pytest.param(lambda p: p.model_copy(update={"errata": ()}), id="errata"),
        pytest.param(lambda p: p.model_copy(update={"ranges": None}), id="ranges"),
        pytest.param(lambda p: p.model_copy(update={"states": ()}), id="states"),
        pytest.param(lambda p: p.model_copy(update={"default": None}), id="default"),
    ],
)
@pytest.mark.parametrize("name", ["home.calibration", "axis.type"])
def test_the_signature_does_not_mind_words_ranges_and_states(ninepc, change, name: str) -> None:
    assert ninepc.signature == changed(change, name).signature


def other_choice(**update: object) -> Callable[[Parameter], Parameter]:
    """Return what changes the first choice of a parameter."""
    return lambda p: p.model_copy(
        update={"choices": (p.choices[0].model_copy(update=update), *p.choices[1:])}
    )


@pytest.mark.parametrize(
    ("name", "change"),
    [
        pytest.param("home.calibration", lambda p: p.model_copy(update={"id": "home.other"}), id="id"),
        pytest.param(
            "home.calibration", lambda p: p.model_copy(update={"name": "Home Calibratio"}), id="name"
        ),
        pytest.param("home.calibration", lambda p: p.model_copy(update={"type": "integer"}), id="type"),
        pytest.param(
            "home.calibration", lambda p: p.model_copy(update={"quantity": "velocity"}), id="quantity"
        ),
        pytest.param("home.calibration", lambda p: p.model_copy(update={"unit": "in"}), id="unit"),
        pytest.param(
            "home.calibration",
            lambda p: p.model_copy(update={"numbers": p.numbers.model_copy(update={"start": 1301})}),
            id="number",
        ),
        pytest.param(
            "home.calibration",
            lambda p: p.model_copy(update={"numbers": p.numbers.model_copy(update={"step": 100})}),
            id="step",
        ),
        pytest.param(
            "home.calibration",
            lambda p: p.model_copy(update={"storage": p.storage.model_copy(update={"scale": 2.0})}),
            id="scale",
        ),
        pytest.param(
            "home.calibration",
            lambda p: p.model_copy(update={"storage": p.storage.model_copy(update={"unit": "in"})}),
            id="stored unit",
        ),
        pytest.param(
            "home.calibration",
            lambda p: p.model_copy(update={"numbers": None, "instances": ("1", "2")}),
            id="instances",
        ),
        pytest.param("axis.type", other_choice(key="line"), id="choice key"),
        pytest.param("axis.type", other_choice(label="Line"), id="choice label"),
        pytest.param("axis.type", other_choice(raw=77), id="choice code"),
        pytest.param(
            "axis.type", lambda p: p.model_copy(update={"choices": p.choices[1:]}), id="choice gone"
        ),
        pytest.param(
            "axis.type", lambda p: p.model_copy(update={"choices": p.choices[::-1]}), id="choice order"
        ),
    ],
)
def test_the_signature_changes_with_what_a_number_means(ninepc, name: str, change) -> None:
    assert ninepc.signature != changed(change, name).signature


def test_without_numbers_the_instances_still_count_for_the_signature(facts) -> None:
    text = """
      - id: axes.gain
        name: Gain
        scope: axis
        instances: {instances}
        type: real
        help: {{what: The gain.}}
        page: "1"
    """
    signatures = {
        facts.schema(text.format(instances=i)).signature
        for i in ('["1", "2"]', '["2", "1"]', '["1", "2", "3"]')
    }
    assert len(signatures) == 3


def test_the_bits_of_a_word_count_for_the_signature(facts) -> None:
    text = """
      - id: axes.mask
        name: Mask
        type: bits
        bits: [{{bit: {bit}, width: {width}, label: {label}}}]
        help: {{what: The mask.}}
        page: "1"
    """
    fields = [(0, 1, "One"), (1, 1, "One"), (0, 2, "One"), (0, 1, "Two")]
    assert len({facts.schema(text.format(bit=b, width=w, label=t)).signature for b, w, t in fields}) == 4
