"""What a row of ``rule_cases/`` cannot say: findings of no rule, and the words of a message."""

from rule_machines import TrialMachine, sound, trial_machine

from amp_studio.schema import Value
from amp_studio.validate import Validator


def mill() -> TrialMachine:
    """Return the Syntec mill."""
    return trial_machine("syntec", "generic")


def test_what_a_file_is_complete_without_is_not_asked_for() -> None:
    file = sound("acromill", "router")
    file.set(("offset.r_geometric", "1"), None)
    assert Validator(file).run() == ()
    file.set(("speeds.rapid", ""), None)
    (advice,) = Validator(file).run()
    assert (advice.rule, advice.addresses) == ("schema.unset", (("speeds.rapid", ""),))


def test_an_axis_without_a_port_is_not_looked_at() -> None:
    """Syntec, section 1.1: an axis is activated by its port; 0 is taken for none."""
    with mill().recorded():
        mill().set({("resolution.encoder", "5"): Value(0)})
        assert mill().findings == ()
        mill().set({("axis.port", "5"): Value(5)})
        assert mill().of("syntec.resolution.encoder-zero") != []


def test_jog_far_above_the_limit_is_the_fatal_alarm() -> None:
    """Syntec, sections 1.5.3 and 1.5.4: twice the error is MOT-019, four times MOT-023."""
    for speed, alarm in ((96000, "MOT-019"), (96001, "MOT-023")):
        with mill().recorded():
            mill().set({("jog.feedrate", "1"): Value(speed, "mm/min")})
            assert alarm in mill().of("syntec.servo.jog-behind")[0].message


def test_the_dda_limit_is_reported_with_its_time() -> None:
    """Syntec, section 1.4.2: 1966usec and 62.472 m/min."""
    with mill().recorded():
        mill().set({("feed.rapid", "3"): Value(70000, "mm/min")})
        (finding,) = mill().of("syntec.dda.rapid")
    assert "of 1966 µs" in finding.message
    assert "The limit is 62472 mm/min." in finding.message
    assert [setting.value for setting in finding.fix] == [Value(62472, "mm/min")]
