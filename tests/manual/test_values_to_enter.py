"""Every value that a manual itself has somebody enter can be entered, or an erratum has the reason why not.

Taken from its procedures, examples and programs, not from the lists of ranges and defaults: for the 9/PC from
the text of each parameter, the timing example of chapter 33, and the tuning and scales of appendices A and B;
for the 57C422B from the programs of sections 4.49 and 5.2 to 5.9; for AcroMill from the typical values and
screens of its tabs; for NUM and Syntec from the text of each parameter.
"""

import pytest

from amp_studio.files import ParameterFile, new_file
from amp_studio.schema import fault, load_schema

NINEPC = """
servo.lead_screw_pitch@1             0.2 in; 0.5 in; 1 in
axis.rollover@4                      360 deg
home.dcm_scale_zero@1                -5 mm; -5 in; 0 mm
zone.limit2_min@3                    10 mm; 10 in
zone.limit2_max@3                    11 mm; 11 in
servo.sercos_cycle                   1 ms; 2 ms; 3 ms; 6 ms
servo.initial_gain@1                 0.5; 1; 2
servo.gain_break_ratio@1             0.5; 1
servo.feed_forward@1                 80 %; 100 %
servo.position_counts@1              2000; 3000; 20000; 1048576; 2097152
servo.position_gear_teeth@1          44; 1
servo.position_screw_teeth@1         40; 1
servo.analog_positive_voltage@1      6 V
servo.analog_negative_voltage@1      -6 V
servo.dcm_small_period@1             20 mm
servo.dcm_large_period@1             20.02 mm
servo.integrator_discharge@1         1
servo.max_torque_negative@1          200 %
servo.torque_offset@1                0 %; 1 %
servo.torque_filter@1                2000 Hz; 3000 Hz; 10000 Hz
accdec.velocity_step@1               50 mm/min
accdec.manual_delay@1                10
spindle.deviation_tolerance@1        20 %
spindle.gear_count@1                 1
macro.type1_g_code@9018              100
macro.type2_g_code@1                 120.1; 231; 231.6
macro.type2_program@1                1; 100; 8999
macro.m_code@9009                    100
tool.life_boundary                   20
comp.min_feed_reduction              50 %; 80 %
comp.corner_percent                  60 %
tapping.acceleration_time@1.1        0.125 s
timing.fine_foreground               9 ms; 20 ms; 36 ms; 40 ms
timing.scans_per_logic               1; 2
timing.logic_warning                 18 ms; 36 ms
servo.velocity_integral_gain@1       0
servo.velocity_proportional_gain@1   1500
spindle.voltage_at_max@1.1           10 V
spindle.max_speed@1.1                3000 rpm; 5000 rpm; 1000 rpm; 99999.9 rpm; 20000 rpm; 10000 rpm; \
50 rpm; 20 rpm
patch.dac_monitor@2                  204; 101; 201; 301; 401; 501; 601
patch.dac_monitor@3                  504
"""

SERVO_57C422B = """
R0                                   0x1414
R3                                   100; 18700; 17595
R4                                   0; 10; 1575
R5                                   0; 25; 140
R6                                   0; 8256
R1                                   0x02
R2                                   0x1D
R7                                   27
R8                                   1000
R9                                   6400 counts/s
R10                                  40
command.gear_ratio@X                 1; 0
R31                                  10 V
R32                                  -1
R33                                  -1
R34                                  4000
R36                                  4000
R65                                  0; 0x0021
R66                                  0x0200; 4; 1; 0x0100
R67                                  8
R83                                  0 ms; 1.25 ms
"""

ACROMILL = """
servo.p_gain@X                       0.001; 0.00244
servo.i_gain@X                       0; 0.001
servo.i_delay@X                      0; 1
servo.i_limit@X                      0; 1
servo.d_gain@X                       0; 0.00001; 0.000001
servo.d_time@X                       0; 0.002
servo.acc_ffwd@X                     0.0001
servo.torque_limits@X                0; 10
axes.inposition_band@X               0.001 in
axes.excess_error_band@X             0.25 in
axes.pulses_per_unit@X               10000
axes.handwheel_ratio@X               0.005
axes.encoder_multiplier@X            4; -4
control.root_epsilon                 -4; -8000
control.path_color                   10
control.sweep_epsilon                0.001; 0.01
control.compensation_epsilon         0.0001 in; 0.002 in
control.cutting_size_x               24 in; 240 in
control.dripfeed_threshold           40
control.forward_threshold            10
control.corner_arc_threshold         90
"""

NUM = """
P56N1                                60 ms
servo.sync_correction@0              250
servo.speed_anticipation@1           100 %
servo.filter_terms@1                 5; 13
measure.divi@0                       16; 32767
spindle.hole_bottom_reference@1      50 mV; 100 mV
P63N0                                500; 1000
P63N1                                100
P50N0                                2000 us; 6000 us; 20000 us
P58N0                                1000
misc.stack_size                      5121
P99N0                                4 ms; 10 ms; 14 ms
"""

SYNTEC = """
Pr61                                 250; 2500; 10000
Pr81                                 4
Pr161                                10000 BLU
Pr3203                               2000
Pr201                                3
Pr941                                1
Pr961                                0; 1; 2; 3
Pr2542                               2
Pr661                                0 mm/min
"""

MACHINES = {"9pc": ("mill", ("X", "Y", "Z", "A", "S")), "syntec": ("generic", ("X", "Y", "Z"))}
VALUES = {"9pc": NINEPC, "57c422b": SERVO_57C422B, "acromill": ACROMILL, "num": NUM, "syntec": SYNTEC}

REFUSED = {
    ("9pc", "comp.min_block_length", "0.75 in"): "e-27-example",
    ("9pc", "servo.velocity_proportional_gain@1", "66000"): "e-1801-table",
    ("9pc", "servo.velocity_proportional_gain@1", "88000"): "e-1801-table",
    ("57c422b", "command.velocity@X", "65536000 counts/s"): "e-r19-limit",
}
"""Values that a manual has somebody enter and prints a narrower range for: the erratum about it."""


def a_file(family: str) -> ParameterFile:
    """Return a new file with the axes that the values are for."""
    machine, axes = MACHINES.get(family, (None, ()))
    return new_file(family, machine, axes)


def refusal(file: ParameterFile, name: str, text: str) -> str | None:
    """Return why a value cannot be entered."""
    address = file.find(name)
    return fault(file.evaluation, address, file.read(address, text))


@pytest.mark.parametrize("family", VALUES)
def test_a_value_of_a_procedure_an_example_or_a_program_can_be_entered(family: str) -> None:
    file = a_file(family)
    reported = {}
    for line in VALUES[family].strip().splitlines():
        name, values = line.split(maxsplit=1)
        reported |= {(name, text): refusal(file, name, text) for text in values.split("; ")}
    assert {at: message for at, message in reported.items() if message} == {}


@pytest.mark.parametrize(
    ("table", "name"),
    [("7.B", "servo.velocity_proportional_gain@1"), ("7.C", "servo.velocity_integral_gain@1")],
)
def test_the_gains_of_standard_motors_can_be_entered(table: str, name: str) -> None:
    """Pages 7-55 and 7-56, the rows from 1 : 0 to 1 : 3."""
    file = a_file("9pc")
    cells = {f"{cell:g}" for row in load_schema("9pc").tables[table].rows for cell in row[1:]}
    refused = {text for text in cells if refusal(file, name, text)}
    assert {("9pc", name, text) for text in refused} == {at for at in REFUSED if at[1] == name}


@pytest.mark.parametrize(("family", "name", "text"), REFUSED)
def test_a_value_that_is_refused_all_the_same_has_an_erratum(family: str, name: str, text: str) -> None:
    file, schema = a_file(family), load_schema(family)
    assert refusal(file, name, text)
    parameter = schema.parameters[file.find(name)[0]]
    assert REFUSED[family, name, text] in parameter.errata
