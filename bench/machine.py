"""The file that is measured: eight fitted axes, every parameter set, no error and no warning.

Its values are those of the mill of ``examples/``: each axis takes them from the axis of its type there.
"""

from pathlib import Path

from amp_studio.files import ParameterFile, fitted_axes, new_file, open_file
from amp_studio.files.example_files import examples_folder
from amp_studio.files.parameter_file import fill_defaults
from amp_studio.files.storage import save_file
from amp_studio.schema import Address, Value
from amp_studio.validate import Validator

AXES = ("X", "Y", "Z", "A", "B", "C", "S", "S")
MODELS = {"linear": "1", "rotary": "4", "spindle": "5"}
"""Axis type -> the axis of the mill that has it."""

# Two 1394 drives: X, Y, Z, A and the first spindle on rack 1; B, C and the second spindle on rack 2.
RACKS = "11112212"
OUTPUTS = ("mod1", "mod2", "mod3", "mod4", "mod1", "mod2", "tb2", "tb2")
PORTS = ("j1", "j2", "j3", "j4", "j1", "j2", "j9", "j9")


def example_path() -> Path:
    """Return the mill of the examples."""
    return examples_folder() / "mill-1394" / "MILL_1394.amp"


def full_file() -> ParameterFile:
    """Return the file; raises AssertionError when it is not as this module describes it."""
    mill, file = open_file(example_path()).file, new_file("9pc", "mill", AXES, name="FULL")
    for address in file.addresses():
        if address[0] in ("axis.type", "axis.name"):
            continue
        own = file.values.get(("axis.type", address[1]))
        model = MODELS[str(own.value)] if own and file.evaluation.scope(address) == "axis" else address[1]
        file.set(address, mill.values.get((address[0], model)) or file.get(address))
    for n, axis in enumerate(fitted_axes(file)):
        file.set(("servo.output_port", axis), Value(OUTPUTS[n]))
        file.set(("servo.position_port", axis), Value(PORTS[n]))
        file.set(("servo.velocity_port", axis), Value(PORTS[n] if n < 6 else "none"))
        file.set(("servo.amplifier_rack", axis), Value(int(RACKS[n])))
    for axis, letter in zip("123", "ijk", strict=True):
        file.set(("axis.integrand_name", axis), Value(letter))
    for axis in "456":
        file.set(("axis.integrand_name", axis), Value("none"))
    file.set(("servo.spindle_type", "8"), Value("s2"))
    fill_defaults(file)
    for address in file.addresses():
        if file.get(address) is None and file.schema.parameters[address[0]].type != "text":
            file.set(address, _any_value(file, address))
    assert fitted_axes(file) == tuple("12345678")
    texts = [
        a for a in file.addresses() if file.schema.parameters[a[0]].type == "text" and a not in file.values
    ]
    assert len(file.values) + len(texts) == len(file.addresses())
    assert all(f.severity == "advice" for f in Validator(file).run())
    return file


def _any_value(file: ParameterFile, address: Address) -> Value:
    """Return some value for a parameter that is inactive on this machine."""
    parameter = file.schema.parameters[address[0]]
    if parameter.choices:
        key = parameter.choices[0].key
        return Value(key == "yes" if parameter.type == "boolean" else key)
    unit = file.evaluation.unit(address, "metric")
    return Value(1 if parameter.type == "integer" else 1.0, unit)


def write_full_file(folder: Path) -> Path:
    """Save the file in a folder and return its path."""
    path = folder / "FULL.amp"
    save_file(full_file(), path)
    return path
