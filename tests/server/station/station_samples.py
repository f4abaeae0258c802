"""Values that the station's tests share."""

from __future__ import annotations

from fusion.skeleton import Side
from server.messages import EXO_JOINTS, ArmView, DriveState, ExoView, JointLimits, LiveTick, Timing

POINTS = ((0.0, 0.0, 0.0),) * 4
ARM = ArmView(
    plane_rad=0.5,
    elevation_rad=0.3,
    rotation_rad=0.0,
    elbow_rad=0.5,
    valid=True,
    points_in_trunk=POINTS,
    points_in_room=None,
)
STILL = (0.0,) * len(EXO_JOINTS)
EXO = ExoView(
    angle_rad=STILL,
    velocity_rad_s=STILL,
    torque_nm=STILL,
    command_rad=STILL,
    command_velocity_rad_s=STILL,
    clamped=(),
    speed_factor=1.0,
    blend=0.0,
    fault="",
)
TIMING = Timing(
    datagram_to_command_s=None,
    tick_s=0.0,
    overruns=0,
    datagrams=0,
    datagrams_refused=0,
    ticks_dropped=0,
    recorder_dropped=0,
)


def live_tick(index: int = 0) -> LiveTick:
    """A tick in which nothing happens."""
    return LiveTick(
        index=index,
        t_s=index / 100,
        t_newest_received_s=None,
        state=DriveState.OFF,
        reason="",
        may_enable=False,
        blockers=(),
        session="",
        healthy_side=Side.LEFT,
        sensors=(),
        body=None,
        healthy=None,
        target=None,
        affected=ARM,
        exo=EXO,
        limits=(),
        trunk_lean_m=0.0,
        timing=TIMING,
        warnings=(),
    )


def patient_limits(velocity_rad_s: float = 1.5, acceleration_rad_s2: float = 6.0) -> tuple[JointLimits, ...]:
    """A patient's limits, inside the device's."""
    ranges = ((-0.4, 1.9), (0.0, 1.9), (-1.2, 1.2), (0.0, 2.3))
    return tuple(
        JointLimits(
            joint=joint,
            min_rad=low,
            max_rad=high,
            velocity_rad_s=velocity_rad_s,
            acceleration_rad_s2=acceleration_rad_s2,
        )
        for joint, (low, high) in zip(EXO_JOINTS, ranges, strict=True)
    )
