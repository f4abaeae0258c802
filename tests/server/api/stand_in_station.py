"""A station made of paper: the real channels, an arm that does as it is told, and a way to make it die.

Its patient's name decides how it misbehaves: "dies" ends the process when the session starts, "mute" never answers.
"""

import os
import signal
import sys
import time
from math import cos, sin
from pathlib import Path

from fusion.recording.log import LogAbout, LogWriter
from fusion.skeleton import JOINT_COUNT, JOINTS, Side
from server.channels import StationChannels, encoded
from server.config import read_start
from server.messages import (
    ArmView,
    Assistance,
    BodyView,
    CloseSession,
    DriveState,
    Enable,
    ExoView,
    FollowBody,
    Heartbeat,
    Hold,
    LiveTick,
    OpenSession,
    Pain,
    Reset,
    Resume,
    SensorView,
    SessionClosed,
    SetAssistance,
    StateChanged,
    StationUp,
    Stop,
    Timing,
    WishAnswer,
)

PERIOD_S = 0.02
ALLOWED = {
    Enable: (DriveState.READY, DriveState.ENGAGED),
    Hold: (DriveState.ENGAGED, DriveState.HOLD),
    Resume: (DriveState.HOLD, DriveState.ENGAGED),
    Reset: (DriveState.STOPPED, DriveState.READY),
}


def arm(angle, side):
    x = 0.2 if side is Side.RIGHT else -0.2
    hand = (x, -0.5 + 0.3 * angle, -0.3 - 0.1 * angle)
    points = ((x, 0.0, 0.0), (x, -0.3, 0.0), (x, -0.4, -0.25), hand)
    return ArmView(
        plane_rad=angle,
        elevation_rad=angle / 2,
        rotation_rad=0.1,
        elbow_rad=0.5 + angle / 4,
        valid=True,
        points_in_trunk=points,
        points_in_room=tuple(
            joint_at(f"{part}{side.suffix}", angle) for part in ("Shoulder", "Elbow", "Wrist", "Hand")
        ),
    )


HEIGHTS_M = {"SpineBase": 0.0, "SpineMid": 0.25, "SpineShoulder": 0.5, "Neck": 0.57, "Head": 0.72}
# Outward, up, towards the sensor, of a limb's joints; the sensor sees the person's right on its own left.
LIMBS_M = {
    "Shoulder": (0.18, 0.48, 0.0),
    "Elbow": (0.35, 0.3, 0.05),
    "Wrist": (0.35, 0.3, 0.3),
    "Hand": (0.35, 0.32, 0.38),
    "HandTip": (0.35, 0.33, 0.45),
    "Thumb": (0.31, 0.35, 0.4),
    "Hip": (0.1, -0.05, 0.0),
    "Knee": (0.12, -0.45, 0.05),
    "Ankle": (0.12, -0.85, 0.0),
    "Foot": (0.13, -0.9, 0.12),
}


def body(angle):
    """Somebody who stands 2 m before the sensor and moves both forearms."""
    return tuple(joint_at(name, angle) for name in JOINTS)


def joint_at(name, angle):
    if name in HEIGHTS_M:
        return (0.0, HEIGHTS_M[name], 2.0)
    part, sign = (name[:-4], 1.0) if name.endswith("Left") else (name[:-5], -1.0)
    outward, up, ahead = LIMBS_M[part]
    lift = 0.3 * (angle - 0.5) if part in ("Wrist", "Hand", "HandTip", "Thumb") else 0.0
    return (sign * outward, up + lift, 2.0 - ahead)


def tick(index, t_s, state, session, healthy_side, authority="", assistance=Assistance.PASSIVE, level=1.0):
    angle = 0.5 + 0.4 * sin(2 * t_s)
    joints = body(angle)
    sensor = SensorView(
        sensor="left",
        dialect="mirrorlimb",
        is_reference=True,
        frames_per_s=30.0,
        latency_s=0.004,
        joints_tracked=25,
        clock_offset_s=0.0,
        residual_m=None,
        aligned=True,
        age_s=0.01,
        refused_joints=0,
        warnings=(),
        position_in_room=(0.0, 0.0, 0.0),
        joints_in_room=joints,
    )
    exo = ExoView(
        angle_rad=(angle, angle / 2, 0.1, 0.5),
        velocity_rad_s=(0.8 * cos(2 * t_s), 0.4 * cos(2 * t_s), 0.0, 0.0),
        torque_nm=(0.0,) * 4,
        command_rad=(angle, angle / 2, 0.1, 0.5),
        command_velocity_rad_s=(0.0,) * 4,
        clamped=(),
        speed_factor=1.0,
        blend=1.0,
        fault="",
        interaction_nm=(0.5, 0.0, 0.0, 1.0),
        share=(1.0,) * 4,
        assistance=assistance,
        level=level,
    )
    return LiveTick(
        index=index,
        t_s=t_s,
        t_newest_received_s=t_s - 0.005,
        state=state,
        reason="",
        may_enable=state is DriveState.READY,
        blockers=(),
        session=session,
        authority=authority,
        healthy_side=healthy_side,
        sensors=(sensor,),
        body=BodyView(
            joints_in_room=joints,
            bound_m=(0.1,) * JOINT_COUNT,
            shape_m2=((0.01, 0.0, 0.0, 0.01, 0.0, 0.01),) * JOINT_COUNT,
            state=(2,) * JOINT_COUNT,
        ),
        healthy=arm(angle, healthy_side),
        target=arm(angle, healthy_side.other),
        affected=arm(angle, healthy_side.other),
        exo=exo,
        limits=(),
        trunk_lean_m=0.01,
        timing=Timing(
            datagram_to_command_s=0.006,
            tick_s=0.001,
            overruns=0,
            datagrams=1,
            datagrams_refused=0,
            ticks_dropped=0,
            recorder_dropped=0,
        ),
        warnings=(),
    )


class Station:
    def __init__(self, start):
        self.channels = StationChannels(Path(start.channels))
        self.state, self.session, self.healthy_side, self.log = DriveState.OFF, None, Side.RIGHT, None
        self.authority, self.assistance, self.level = "", Assistance.PASSIVE, 1.0
        self.greet()

    def greet(self):
        """Until somebody listens."""
        dropped = -1
        while dropped != self.channels.events_dropped:
            dropped = self.channels.events_dropped
            self.channels.tell(encoded(StationUp(t_s=time.monotonic(), ports={"any": 12345}, drive="simulated")))
            time.sleep(0.01)

    def answer(self, wish, accepted=True, reason=""):
        answer = WishAnswer(
            t_s=time.monotonic(), number=wish.number, accepted=accepted, reason=reason, state=self.state
        )
        self.channels.tell(encoded(answer))

    def go(self, state, reason):
        if state is not self.state:
            changed = StateChanged(t_s=time.monotonic(), before=self.state, after=state, reason=reason)
            self.state = state
            self.channels.tell(encoded(changed))

    def take(self, wish):
        if isinstance(wish, Heartbeat):
            self.authority = wish.authority
            if not self.authority and self.state is DriveState.ENGAGED:
                self.go(DriveState.HOLD, "nobody who is in charge is connected")
        elif self.session and self.session.patient == "mute":
            return
        else:
            self.obey(wish)

    def obey(self, wish):
        if isinstance(wish, OpenSession):
            self.open(wish)
        elif isinstance(wish, CloseSession):
            self.close(wish)
        elif isinstance(wish, Stop):
            self.go(DriveState.STOPPED, wish.reason)
            self.answer(wish)
        elif isinstance(wish, Pain):
            self.go(DriveState.HOLD, wish.reason)
            self.answer(wish)
        elif isinstance(wish, FollowBody):
            self.answer(wish)
        elif isinstance(wish, SetAssistance):
            self.assistance, self.level = wish.mode, wish.level
            self.answer(wish)
        else:
            self.move(wish)

    def open(self, wish):
        if wish.patient == "refused":
            self.answer(wish, False, "the drive is being serviced")
            return
        self.session, self.healthy_side = wish, wish.healthy_side
        self.assistance, self.level = wish.assistance, wish.level
        self.log = LogWriter(Path(wish.recording), LogAbout(name=wish.session))
        self.go(DriveState.READY, "a session is open")
        self.answer(wish)

    def close(self, wish):
        if self.session is None:
            self.answer(wish, False, "no session is open")
            return
        closed, self.session = self.session, None
        self.log.close()
        self.log = None
        self.go(DriveState.OFF, "the session is over")
        self.answer(wish)
        over = SessionClosed(t_s=time.monotonic(), session=closed.session, recording=closed.recording)
        self.channels.tell(encoded(over))

    def move(self, wish):
        if self.session.patient == "dies":
            self.log.flush()
            sys.stderr.write("the drive caught fire\n")
            sys.stderr.flush()
            os._exit(3)
        needed, after = ALLOWED[type(wish)]
        if isinstance(wish, Enable | Resume) and not self.authority:
            self.answer(wish, False, "nobody who is in charge is connected")
        elif self.state is needed:
            self.go(after, "somebody wished it")
            self.answer(wish)
        else:
            self.answer(wish, False, f"that is not possible while {self.state}")

    def step(self, index):
        for wish in (*self.channels.stops(), *self.channels.wishes()):
            self.take(wish)
        session = self.session.session if self.session else ""
        made = tick(
            index, time.monotonic(), self.state, session, self.healthy_side, self.authority, self.assistance, self.level
        )
        if self.log:
            self.log.tick(encoded(made), made.t_s)
        self.channels.publish(encoded(made))


def main():
    start = read_start(Path(sys.argv[sys.argv.index("--config") + 1]))
    station = Station(start)
    ended = []
    signal.signal(signal.SIGTERM, lambda *_: ended.append(True))
    index = 0
    while not ended:
        station.step(index)
        index += 1
        time.sleep(PERIOD_S)
    station.channels.close()


if __name__ == "__main__":
    main()
