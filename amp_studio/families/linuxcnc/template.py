"""The HAL file that a migrated machine begins with: each loop is closed in the computer, and nothing
moves.
"""

from __future__ import annotations

from collections.abc import Sequence

_HEAD = """\
# A template. Nothing of the old wiring is in it: each loop is closed in the computer, and no output of a
# card is set. Homing waits for a switch and a marker until they are connected to joint.N.home-sw-in and
# joint.N.index-enable.
loadrt [KINS]KINEMATICS
loadrt [EMCMOT]EMCMOT servo_period_nsec=[EMCMOT]SERVO_PERIOD num_joints=[KINS]JOINTS
"""
_TAIL = """\
net estop-loop iocontrol.0.user-enable-out => iocontrol.0.emc-enable-in
net tool-prep iocontrol.0.tool-prepare => iocontrol.0.tool-prepared
net tool-change iocontrol.0.tool-change => iocontrol.0.tool-changed
"""
_JOINT = """\
setp pid.{n}.Pgain {gain}
setp pid.{n}.FF1 {forward}
net enable.{n} joint.{n}.amp-enable-out => pid.{n}.enable
net command.{n} joint.{n}.motor-pos-cmd => pid.{n}.command
net speed.{n} pid.{n}.output => table.{n}.in
net feedback.{n} table.{n}.out => joint.{n}.motor-pos-fb pid.{n}.feedback
"""


def hal_template(has_gain: Sequence[bool]) -> str:
    """Return the template for so many joints; one without a gain in the configuration gets that of the
    loop in the computer, with the whole speed fed forward: else it lags at full speed, and trips.
    """
    names = range(len(has_gain))
    loops = [(f"[JOINT_{n}]P", f"[JOINT_{n}]FF1") if has else ("50", "1") for n, has in enumerate(has_gain)]
    loads = [
        f"loadrt pid names={','.join(f'pid.{n}' for n in names)}",
        f"loadrt integ names={','.join(f'table.{n}' for n in names)}",
        "addf motion-command-handler servo-thread",
        "addf motion-controller servo-thread",
        *(f"addf pid.{n}.do-pid-calcs servo-thread\naddf table.{n} servo-thread" for n in names),
    ]
    return "\n".join(
        (
            _HEAD + "\n".join(loads),
            "",
            *(_JOINT.format(n=n, gain=gain, forward=ff1) for n, (gain, ff1) in enumerate(loops)),
            _TAIL,
        )
    )
