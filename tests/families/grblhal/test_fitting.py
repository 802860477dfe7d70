"""A file of one build goes to another by number,
and what has no place there is named before anything is sent.
"""

from amp_studio.families.grblhal.described import schema_of
from amp_studio.families.grblhal.fitting import fit_to
from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import Value

from .recorded import THREE_AXES, build, with_lines


def test_a_new_file_fits_a_fresh_control() -> None:
    file = new_file("grblhal", None, "XYZ")
    fitted = fit_to(file, schema_of(THREE_AXES), "XYZ")
    assert fitted.misfits == ()
    assert fitted.file.values == file.values


def test_settings_of_axes_that_the_control_does_not_have_are_named() -> None:
    fitted = fit_to(new_file("grblhal", None, "XYZA"), schema_of(THREE_AXES), "XYZ")
    names = [str(misfit) for misfit in fitted.misfits]
    assert "$103 Travel resolution = 250 steps/mm: this control does not have the setting" in names
    assert len([name for name in names if name.startswith("$1")]) == 4, (
        "steps, rate, acceleration, travel of A"
    )
    assert not any(address[1] == "A" for address in fitted.file.values)


def test_a_number_is_the_same_setting_under_another_letter() -> None:
    file = new_file("grblhal", None, "XYZA")
    file.set(("stepper.rotary_axes", ""), Value(0))
    file.set(file.find("$113"), Value(700.0, "mm/min"))
    fitted = fit_to(file, schema_of(build("XYZU")), "XYZU").file
    assert fitted.get(("axis.max_rate", "U")) == Value(700.0, "mm/min")


def test_bits_of_an_axis_that_the_control_does_not_have_are_named_and_the_rest_goes_across() -> None:
    file = new_file("grblhal", None, "XYZA")
    file.set(("homing.invert_direction", ""), Value(9))
    fitted = fit_to(file, schema_of(THREE_AXES), "XYZ")
    assert fitted.file.get(("homing.invert_direction", "")) == Value(1)
    assert fitted.lost[23] == {3: "A"}
    assert not [m for m in fitted.misfits if not m.is_lacking], "it is not refused"


def test_one_input_for_all_limit_switches_becomes_a_bit_of_each_axis() -> None:
    file = new_file("grblhal", "grbl-1.1")
    file.set(file.find("$5"), Value(True))
    assert fit_to(file, schema_of(THREE_AXES), "XYZ").file.get(("limits.invert_inputs", "")) == Value(7)


def test_a_choice_that_the_control_does_not_know_is_named() -> None:
    file = new_file("grblhal", None, "XYZ")
    file.set(("general.mode", ""), Value("lathe_mode"))
    old = schema_of(
        with_lines("[SETTING:32|1|Mode of operation||3|Normal,Laser mode|||0|0]", without="[SETTING:32|")
    )
    (misfit,) = fit_to(file, old, "XYZ").misfits
    assert (misfit.name, misfit.why) == ("$32 Mode of operation", "2 is no code of Mode of operation")


def test_a_yes_or_no_of_an_old_grbl_is_a_bit_of_a_new_one() -> None:
    file = new_file("grblhal", "grbl-1.1")
    file.set(("classic.homing", ""), Value(True))
    file.set(("classic.pulse_time", ""), Value(8, "us"))
    fitted = fit_to(file, schema_of(THREE_AXES), "XYZ")
    assert fitted.misfits == ()
    assert fitted.file.get(("homing.cycle", "")) == Value(1)
    assert fitted.file.get(("stepper.pulse_time", "")) == Value(8.0, "us")


def test_a_setting_kept_without_knowing_it_finds_its_place() -> None:
    file = new_file("grblhal", None, "XYZ")
    file.unknown |= {"$350": "120.5", "$351": "1", "note": "x"}
    schema = schema_of(with_lines("[SETTING:350|1|Arc voltage|V|6|##0.00|10|300|0|0]"))
    fitted = fit_to(file, schema, "XYZ")
    assert fitted.file.get(("general.arc_voltage", "")) == Value(120.5, "V")
    assert [str(m) for m in fitted.misfits] == ["$351 = 1: this control does not have the setting"]
    assert fitted.file.unknown == {"note": "x"}


def test_a_value_in_inches_keeps_its_unit() -> None:
    file = new_file("grblhal", None, "XYZ")
    file.set(("axis.max_travel", "X"), Value(10.0, "in"))
    assert fit_to(file, schema_of(THREE_AXES), "XYZ").file.get(("axis.max_travel", "X")) == Value(10.0, "in")


def test_a_value_that_is_out_of_range_there_is_named() -> None:
    file = new_file("grblhal", None, "XYZ")
    file.set(("homing.passes", ""), Value(20))
    old = schema_of(with_lines("[SETTING:43|11|Homing passes||5|##0|1|10|0|0]", without="[SETTING:43|"))
    (misfit,) = fit_to(file, old, "XYZ").misfits
    assert "outside 1 to 10" in misfit.why


def test_what_is_hidden_in_the_file_is_not_missed() -> None:
    file = new_file("grblhal", None, "XYZ")
    file.set(("axis.steps", "V"), Value(1.0, "steps/mm"))
    assert isinstance(fit_to(file, schema_of(THREE_AXES), "XYZ").file, ParameterFile)
    assert fit_to(file, schema_of(THREE_AXES), "XYZ").misfits == ()


def test_what_decides_a_unit_is_fitted_before_what_is_measured_in_it() -> None:
    file = new_file("grblhal", None, "XYZA")
    file.set(file.find("$376"), None)
    file.set(file.find("$133"), Value(360.0, "deg"))
    file.set(file.find("$376"), Value(1))
    assert list(file.values)[-1] == ("stepper.rotary_axes", ""), "the last one of the file"
    whole = build("XYZA").replace(
        b"[SETTING:133|46|A-axis maximum travel|mm|6|#####0.000|||0|0]",
        b"[SETTING:133|46|A-axis maximum travel|deg|5|####0|||0|0]",
    )
    fitted = fit_to(file, schema_of(whole), "XYZA").file
    assert fitted.get(fitted.find("$133")) == Value(360, "deg")
