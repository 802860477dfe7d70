"""The public library: the examples of its page, its names, and its errors."""

import builtins
import copy
import inspect
import pickle
import re
import shutil
import subprocess
import sys
import textwrap
from collections.abc import Callable, Iterator
from fractions import Fraction
from pathlib import Path
from typing import Any

import mypy.api
import numpy as np
import pytest

import amp_studio as amp
from amp_studio import given, sim, validate
from amp_studio.files.example_files import examples
from amp_studio.transfer import client

PAGE = Path(__file__).parents[1] / "docs" / "library.md"
EXAMPLES = re.findall(r"```python\n(.*?)```", PAGE.read_text("utf-8"), re.DOTALL)


@pytest.fixture
def mill(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    """Return a copy of the example in the working folder."""
    source = next(e.path for e in examples() if e.path.stem == "MILL_1394")
    monkeypatch.chdir(tmp_path)
    return Path(shutil.copy(source, tmp_path / "mill.amp"))


@pytest.fixture
def control(tmp_path: Path) -> Iterator[str]:
    """Start an emulated control in E-stop and return its address."""
    command = [
        sys.executable,
        "-m",
        "amp_studio",
        "emulate",
        "9pc",
        "--listen",
        "tcp://127.0.0.1:0",
        "--state",
        str(tmp_path / "control"),
        "--machine",
        "mill",
    ]
    with subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True) as process:
        assert process.stdout is not None
        yield process.stdout.readline().removeprefix("listening on ").strip()
        process.communicate("quit\n", timeout=60)


FIVE: Any = 5
LIST: Any = [5]
"""What is of another type than it should be."""


def test_there_are_ten_examples_of_at_most_five_lines() -> None:
    assert len(EXAMPLES) == 10
    assert max(len(example.splitlines()) for example in EXAMPLES) <= 5


def test_the_examples_pass_a_strict_type_checker(tmp_path: Path) -> None:
    bodies = (textwrap.indent(example, "    ") for example in EXAMPLES)
    script = "import amp_studio as amp\n\nADDRESS = ''\n" + "".join(
        f"\n\ndef example_{number}() -> None:\n{body}" for number, body in enumerate(bodies)
    )
    (tmp_path / "script.py").write_text(script, "utf-8")
    options = ["--strict", "--config-file=", f"--cache-dir={tmp_path}", str(tmp_path / "script.py")]
    found, errors, code = mypy.api.run(options)
    assert (errors, code) == ("", 0), found


@pytest.mark.parametrize("example", [e for e in EXAMPLES if "ADDRESS" not in e])
def test_an_example_runs(mill: Path, example: str) -> None:
    exec(compile(example, str(PAGE), "exec"), {"amp": amp})  # what a reader types


def test_the_example_at_a_control_runs(mill: Path, control: str) -> None:
    (example,) = (e for e in EXAMPLES if "ADDRESS" in e)
    exec(compile(example, str(PAGE), "exec"), {"amp": amp, "ADDRESS": control})  # what a reader types
    machine = amp.connect(control).upload()
    assert machine.diff(mill) == ()
    machine["1300@X"] = "3 mm"
    with pytest.raises(amp.MachineError, match="keep=FOLDER"):
        amp.connect(control).download(machine)
    machine["1750@X"] = "0 mm"
    if any(finding.severity == "error" for finding in machine.check()):
        with pytest.raises(amp.MachineError, match="nothing was sent"):
            amp.connect(control).download(machine, keep=mill.parent)
    assert not amp.connect(control).verify(machine).is_same


def test_values_are_set_by_text_number_yes_and_none(mill: Path) -> None:
    machine = amp.open(mill)
    for value, text in (("5 mm", "5 mm"), (2.5, "2.5 mm"), (amp.Value(1.0, "in"), "1 in"), (None, "not set")):
        machine["1300@X"] = value
        assert str(machine["1300@X"]) == text
    machine["1300@Y"] = machine["1750@X"]
    assert machine["1300@Y"].value == machine["1750@X"].value
    machine["zone.overtravel_used@1"] = False
    assert machine["zone.overtravel_used@1"].value == "False"


NO_CONTROLS = ("", "mill", "tcp://1", "tcp://a:99999", "serial:", "COM1?baud=x", "tcp://a:1?protocol=none")


@pytest.mark.parametrize(
    ("act", "kind"),
    [
        (lambda m: m["nothing"], amp.UnknownParameterError),
        (lambda m: m.set({"1300@X": "5 mm", "1300@Y": "soon"}), amp.AssignmentError),
        (lambda m: m.set({"1203@X": 1e9}), amp.RangeError),
        (lambda m: m.diff(amp.new("num")), amp.MachineError),
        (lambda m: m.simulate("nothing"), amp.AmpStudioError),
        (lambda m: m.report("mill.doc"), amp.MachineError),
        (lambda m: m.report("mill.txt", colour="red"), amp.MachineError),
        (lambda m: m.report("mill.html", language="../de"), amp.MachineError),
        (lambda m: m.report("mill.txt", without={"nothing"}), amp.MachineError),
        (lambda m: m.report("mill.txt", programs=["none.nc"]), amp.MachineError),
        (lambda m: m.report("mill.txt", programs="none.nc"), amp.MachineError),
        (lambda m: m[5], TypeError),
        (lambda m: m.set([5]), amp.AssignmentError),
        (lambda m: m.set({5: 5}), amp.AssignmentError),
        (lambda m: m.set(None), amp.AssignmentError),
        (lambda m: m.set("1300"), amp.AssignmentError),
        (lambda m: m.set({"1300@X": b"5"}), amp.AssignmentError),
        (lambda m: m.set({"1300@X": amp.Value(LIST)}), amp.AssignmentError),
        (lambda m: m.set({"1740": amp.Value(10**5000)}), amp.AssignmentError),
        (lambda m: m.set({"1300@X": amp.Value(5.0, "rpm")}), amp.AssignmentError),
        (lambda m: m.set({"1300@X": amp.Value(5.0)}), amp.AssignmentError),
        (lambda m: m.set({"1300@X": amp.Value(5.0, FIVE)}), amp.AssignmentError),
        (lambda m: m.set({"1300@X": amp.Value(LIST, "mm")}), amp.AssignmentError),
        (lambda m: m.set({"1300@X": "5 mm"}, force=FIVE), TypeError),
        (lambda m: m.set({"1300@X": "5 mm"}, notify=FIVE), TypeError),
        (lambda m: m.fix(validator=amp.new("9pc").validator()), amp.MachineError),
        (lambda m: m.simulate("step", ""), amp.AmpStudioError),
        (lambda m: m.check_motion(""), amp.UnknownParameterError),
        (lambda m: m.check_motion("Q"), amp.UnknownParameterError),
        (lambda m: amp.connect("tcp://127.0.0.1:1").download(m, expect="5"), amp.AmpStudioError),
        (lambda _: amp.connect("tcp://127.0.0.1:1", cancel=FIVE), TypeError),
        (lambda _: amp.connect("tcp://127.0.0.1:1", progress=FIVE), TypeError),
        (lambda m: m.axis(1), TypeError),
        (lambda m: m.fix(rule=5), TypeError),
        (lambda m: m.compare("mill.amp"), TypeError),
        (lambda m: m.simulate("step", "X", like="before"), TypeError),
        (lambda m: m.simulate("step", "X", move_feedrate=b"5"), amp.AmpStudioError),
        (lambda m: m.save("a\0b"), TypeError),
        (lambda _: amp.open(FIVE), TypeError),
        (lambda _: amp.new("9pc", name=FIVE), TypeError),
        (lambda _: amp.new("9pc", axes=FIVE), amp.MachineError),
        (lambda _: amp.load_schema(FIVE), amp.GivenTypeError),
        (lambda _: amp.load_schema([]), amp.GivenTypeError),
        (lambda m: m.schema.parameter([]), amp.UnknownParameterError),
        (lambda m: m.simulate("step", "X", model_backlash=[]), amp.SimulationError),
        (lambda m: m.simulate("step", "X", model_backlash=b"1"), amp.SimulationError),
        (lambda m: m.simulate("step", "X", move_distance=10**400), amp.SimulationError),
        (lambda _: amp.import_text("none.set", "num"), amp.MachineError),
        (lambda m: m.save("there/is/none.amp"), amp.MachineError),
        (lambda m: m.export("mill.doc"), amp.AmpStudioError),
        (lambda _: amp.open("none.amp"), amp.AmpStudioError),
        (lambda _: amp.new("none"), amp.AmpStudioError),
        (lambda _: amp.new("9pc", machine="none"), amp.MachineError),
        (lambda _: amp.new("9pc").save(), amp.MachineError),
        (lambda _: amp.new("9pc", axes=[FIVE]), amp.MachineError),
        (lambda _: amp.connect("tcp://127.0.0.1:1").identify(), amp.AmpStudioError),
        *((lambda _, place=place: amp.connect(place).upload(), amp.EndpointError) for place in NO_CONTROLS),
        (lambda m: amp.connect("tcp://127.0.0.1:1").download(m, expect="00"), amp.DigestError),
        (lambda _: amp.connect("tcp://127.0.0.1:1").restore("none.img"), amp.CopyError),
        (lambda _: amp.new("9pc", axes=[""]), amp.MachineError),
        (lambda m: m.__setitem__([5], 5), amp.GivenTypeError),
        (lambda m: m.builder_rules(FIVE), amp.GivenTypeError),
    ],
)
def test_an_error_is_one_of_the_program_and_changes_nothing(
    mill: Path, act: Callable[[amp.MachineParameters], object], kind: type[Exception]
) -> None:
    machine, folder = amp.open(mill), sorted(mill.parent.iterdir())
    before = dict(machine.file.values)
    with pytest.raises(kind) as caught:
        act(machine)
    public = {getattr(amp, name) for name in amp.__all__} - {amp.AmpStudioError}
    assert isinstance(caught.value, amp.AmpStudioError)
    assert public.intersection(type(caught.value).__mro__), "an error that a script cannot name"
    assert machine.file.values == before
    assert sorted(mill.parent.iterdir()) == folder


def test_a_file_with_errors_is_not_put_back_where_nothing_proves_that_a_control_contained_it(
    mill: Path,
) -> None:
    """The command line and the window refused it, the library sent it."""
    machine = amp.open(mill)
    machine.set({"1750@X": "0 mm"})
    assert any(finding.severity == "error" for finding in machine.check())
    machine.save()
    with pytest.raises(amp.MachineError, match="nothing was sent"):
        amp.connect("tcp://127.0.0.1:1").restore(mill)


def test_a_file_that_another_program_edits_is_not_saved(mill: Path) -> None:
    machine, before = amp.open(mill), mill.read_bytes()
    machine["1300@X"] = "5 mm"
    with amp.edit(mill), pytest.raises(amp.AmpStudioError, match="open in another program"):
        machine.save()
    assert mill.read_bytes() == before


def test_numbers_of_other_libraries_become_plain_ones(mill: Path) -> None:
    """One of numpy was a value, and ended what it was compared with in an error of Python."""
    machine = amp.open(mill)
    machine.set({"1300@X": amp.Value(np.float64(5.25), "mm"), "1300@Z": np.float64(-0.0)})
    assert [type(machine[f"1300@{axis}"].value) for axis in "XZ"] == [float, float]
    machine.save()
    assert amp.open(mill)["1300@X"].value == 5.25


def test_a_save_notices_another_program_and_never_replaces_another_file(mill: Path) -> None:
    mine, other = amp.open(mill), amp.open(mill)
    other["1300@X"] = "1 mm"
    other.save()
    mine["1300@X"] = "2 mm"
    with pytest.raises(amp.AmpStudioError, match="changed"):
        mine.save()
    mine.save("mine.amp")
    with pytest.raises(amp.MachineError, match="exists already"):
        other.save("mine.amp")
    assert [amp.open(name)["1300@X"].value for name in ("mill.amp", "mine.amp")] == [1.0, 2.0]


def test_every_public_name_is_there_and_typed() -> None:
    assert all(getattr(amp, name) is not None for name in amp.__all__)
    assert (Path(amp.__file__).parent / "py.typed").is_file()


def test_every_error_and_result_that_the_library_names_is_public() -> None:
    things = [getattr(amp, name) for name in amp.__all__]
    methods = [m for c in (amp.MachineParameters, amp.ConnectedControl) for m in vars(c).values()]
    documents = " ".join(str(inspect.getdoc(each)) for each in (*things, *methods))
    named = set(re.findall(r"\b[A-Z]\w+Error\b", documents))
    assert named - {*dir(builtins)} <= {*amp.__all__}
    assert {*amp.__all__} == set(dir(amp))  # what a notebook completes


def _errors_below(kind: type[Exception]) -> set[type[Exception]]:
    return {kind}.union(*(_errors_below(each) for each in kind.__subclasses__()))


def test_every_error_comes_out_of_another_process_as_it_was(mill: Path) -> None:
    machine = amp.open(mill)
    with pytest.raises(amp.RangeError) as caught:
        machine["1203@X"] = 1e9
    again = pickle.loads(pickle.dumps(caught.value))
    assert (str(again), again.faults) == (str(caught.value), caught.value.faults)
    for kind in _errors_below(amp.AmpStudioError):
        error = kind.__new__(kind, "a sentence")
        error.args, error.at_control = ("a sentence",), "mixed"
        again = pickle.loads(pickle.dumps(error))
        assert (type(again), again.args, again.at_control) == (kind, error.args, "mixed")


@pytest.mark.parametrize("example", [e.path for e in examples()], ids=lambda p: p.stem)
def test_a_copy_of_a_machine_is_one_of_its_own(example: Path) -> None:
    machine = amp.open(example)
    for again in (copy.copy(machine), copy.deepcopy(machine), pickle.loads(pickle.dumps(machine))):
        assert (again.path, again.file.header, again.diff(machine)) == (example, machine.file.header, ())
        again.set({next(iter(again)): None})
        assert len(again) == len(machine) - 1


def test_a_machine_is_asked_as_a_mapping_of_addresses(mill: Path) -> None:
    machine = amp.open(mill)
    assert [machine[address] for address in machine] == list(machine.values())
    assert len(machine) == len(machine.values())
    assert "1300@X" in machine
    assert "home.calibration@X" in machine
    assert "nothing" not in machine
    assert 1300 not in machine


@pytest.mark.parametrize("number", [np.float64(2.5), np.float32(2.5), Fraction(5, 2)])
def test_a_number_of_numpy_is_a_number(mill: Path, number: float) -> None:
    machine = amp.open(mill)
    machine.set({"1300@X": number, "1801@X": np.int64(6001)})
    assert (machine["1300@X"].value, machine["1801@X"].value) == (2.5, 6001)


def test_what_a_notebook_shows_is_short(mill: Path) -> None:
    machine = amp.open(mill)
    assert repr(amp.connect("COM3", "num")) == "<ConnectedControl COM3: num>"
    text = repr(machine.simulate("step", axis="X", move_distance=5))
    assert "distance 5 mm" in text
    assert len(text) < 1000
    with pytest.raises(amp.MachineError, match=r"Unknown content of a report 'colour'.*changed_only"):
        machine.report("mill.txt", colour="red")


def test_the_package_runs_as_a_program() -> None:
    done = subprocess.run(
        [sys.executable, "-m", "amp_studio", "--version"], capture_output=True, text=True, check=True
    )
    assert done.stdout.split() == ["amp-studio", amp.__version__]


def test_a_checked_type_has_the_name_by_which_annotations_know_it() -> None:
    plain = {"str", "bytes", "Path", "None", "Event", *given._CALLED}
    for name in given._CHECKED - plain:
        found = [getattr(room, name, None) for room in (amp, sim, client, validate)]
        assert {kind.__name__ for kind in found if kind is not None} == {name}


def test_a_pdf_that_cannot_be_made_is_an_error_of_the_library(
    mill: Path, monkeypatch: pytest.MonkeyPatch
) -> None:
    monkeypatch.setattr(sys, "executable", "none")
    with pytest.raises(amp.MachineError, match="needs a process, which cannot be started"):
        amp.open(mill).report("mill.pdf")
