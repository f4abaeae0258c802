"""The station's one loop: a tick takes wishes and datagrams, moves the exoskeleton, and tells of it last."""

from __future__ import annotations

import time
from collections.abc import Callable
from math import isnan

from fusion.formats.osc import Reason
from fusion.messages import Floats, Packet, PipelineFrame
from server.channels import StationChannels, encoded
from server.config import StationConfig
from server.messages import (
    DriveState,
    Enable,
    Heartbeat,
    LiveTick,
    StateChanged,
    StationEvent,
    StationUp,
    Timing,
    Wish,
    WishAnswer,
)
from server.station import session, view
from server.station.demonstration import Demonstration
from server.station.desk import Desk
from server.station.exo import safety, softness
from server.station.exo.driver import Drive, DriveCommand, DriveReading
from server.station.exo.evidence import SafetyInputs
from server.station.exo.mapping import joint_target
from server.station.exo.safety_state import SafetyState
from server.station.exo.smoothing import Calm, calmed
from server.station.overruns import Overruns
from server.station.perception import Heard, Perception
from server.station.shoulder import ShoulderRise
from server.station.sources.source import Source
from server.station.view import Build
from server.station.warnings import Trouble, Warnings

BUILD_SHARE = 0.005
"""What one tick counts in the learnt build: a time constant of two seconds at 100 Hz."""


class Loop:
    """One tick at a time; who calls `step` owns the clock.

    Args:
        config: of the station.
        source: where datagrams come from.
        perception: what they mean.
        drive: the exoskeleton, open.
        channels: to the service.
        demonstration: in demonstration mode, who may be heard.
        clock: monotonic; read only to say how long things took.
    """

    def __init__(
        self,
        config: StationConfig,
        source: Source,
        perception: Perception,
        drive: Drive,
        channels: StationChannels,
        demonstration: Demonstration | None = None,
        clock: Callable[[], float] = time.monotonic,
    ) -> None:
        self._config, self._source, self._perception = config, source, perception
        self._drive, self._channels, self._demonstration, self._clock = drive, channels, demonstration, clock
        self._desk = Desk(config, perception, drive)
        self._device = softness.device_of(config.exoskeleton, drive.can_comply)
        self._warnings = Warnings()
        self._state = SafetyState()
        self._build = Build()
        self._calm = Calm()
        self._index = 0
        self._heartbeat_s = float("-inf")
        self._authority = ""
        self._frame = PipelineFrame(t_s=0.0, sensors=(), samples=())
        self._trunk_at_enable: Floats | None = None
        self._shoulder = ShoulderRise()
        self._ticks_missed = 0
        self._last_tick_s = 0.0
        self._overruns = Overruns()
        self._service_gone = False

    # ---------------------------------------------------------------- for who owns the clock

    def announce(self, now_s: float, real_time: bool = False) -> None:
        """Tell the service that the station listens, where, and whether it has real-time priority."""
        self._tell(StationUp(t_s=now_s, ports=self._source.ports, drive=self._drive.name, real_time=real_time))

    def count_overruns(self, slots: int, now_s: float) -> None:
        """Ticks that could not begin in time; a counted fault (SR-9)."""
        self._overruns = self._overruns.counted(slots, now_s)

    def lose_service(self) -> None:
        """The service has gone: hold in the very next tick, whatever heartbeats still wait to be read (SR-8)."""
        self._service_gone = True

    def leave(self, now_s: float) -> None:
        """Begin to end: the arm comes to rest and the recording is finished in the ticks that follow."""
        self._change(self._desk.leave(self._state, now_s), now_s)

    @property
    def may_end(self) -> bool:
        """Whether the arm is at rest and no recording is open."""
        return self._state.at_rest and self._desk.recorder is None

    def step(self, now_s: float) -> LiveTick:
        """One tick. Wishes enter here at its head and results leave at its tail."""
        began_s = self._clock()
        self._hear_people(now_s)
        packets = self._packets(now_s)
        heard = self._perception.step(packets, now_s)
        self._frame = heard.frame
        reading = self._drive.read(now_s)
        command = self._decide(reading, now_s)
        self._drive.command(command, now_s)
        given_s = self._clock()
        tick = self._tick(heard, reading, command, given_s, now_s)
        self._publish(tick, packets, heard)
        self._after(heard, now_s)
        self._last_tick_s = self._clock() - began_s
        return tick

    # ---------------------------------------------------------------- head

    def _hear_people(self, now_s: float) -> None:
        for wish in (*self._channels.stops(), *self._channels.wishes()):
            if isinstance(wish, Heartbeat):
                self._heartbeat_s, self._ticks_missed, self._authority = now_s, wish.ticks_missed, wish.authority
            else:
                self._answer(wish, now_s)

    def _answer(self, wish: Wish, now_s: float) -> None:
        after, refusal = self._desk.answer(wish, self._state, now_s)
        self._change(after, now_s)
        if isinstance(wish, Enable) and not refusal:
            self._trunk_at_enable = session.trunk_place(self._frame)
            self._shoulder = self._shoulder.enabled()
        self._tell(
            WishAnswer(
                t_s=now_s, number=wish.number, accepted=not refusal, reason=refusal, state=self._state.gate.state
            )
        )

    def _packets(self, now_s: float) -> list[Packet]:
        packets = self._source.drain()
        if self._demonstration is None:
            return packets
        if self._demonstration.remind_now(now_s):
            self._channels.pause_demonstration(self._demonstration.is_paused)
        return self._demonstration.heard(packets)

    # ---------------------------------------------------------------- middle

    def _decide(self, reading: DriveReading, now_s: float) -> DriveCommand:
        open_session = self._desk.session
        newest_s = self._frame.newest_received_s
        commanded = tuple(motion.angle_rad for motion in self._state.motions)
        seen = joint_target(self._frame.target, commanded)
        self._calm, target = calmed(self._calm, seen, 1.0 / self._config.rate_hz)
        inputs = SafetyInputs(
            reading=reading,
            target=target,
            evidence_age_s=float("inf") if isnan(newest_s) else now_s - newest_s,
            service_age_s=now_s - self._heartbeat_s,
            interrupted=self._interrupted(now_s),
            limits=open_session.limits if open_session else (),
            boxes=open_session.boxes if open_session else (),
            blockers=session.lacks(open_session, self._frame),
            authority=self._authority,
            device=self._device,
        )
        after, command = safety.step(self._state, inputs, self._config.gate, now_s)
        self._change(after, now_s)
        return command

    def _interrupted(self, now_s: float) -> str:
        if self._service_gone:
            return "The service has gone; nobody could be heard."
        if self._perception.has_failed:
            return "The body has to be found anew after an error; look whom the sensors follow."
        return self._overruns.fault(self._config.rate_hz, now_s)

    def _change(self, after: SafetyState, now_s: float) -> None:
        before, self._state = self._state.gate, after
        if before.state is not after.gate.state:
            self._tell(StateChanged(t_s=now_s, before=before.state, after=after.gate.state, reason=after.gate.reason))

    # ---------------------------------------------------------------- tail

    def _tick(
        self, heard: Heard, reading: DriveReading, command: DriveCommand, given_s: float, now_s: float
    ) -> LiveTick:
        frame, gate, facts = heard.frame, self._state.gate, self._state.facts
        self._build = self._build.learnt(frame, BUILD_SHARE)
        open_session = self._desk.session
        side = self._perception.healthy_side
        self._shoulder = self._shoulder.heard(frame, side, 1.0 / self._config.rate_hz)
        samples = {sample.sensor: sample for sample in frame.samples}
        self._index += 1
        return LiveTick(
            index=self._index,
            t_s=now_s,
            t_newest_received_s=None if isnan(frame.newest_received_s) else frame.newest_received_s,
            state=gate.state,
            reason=gate.reason or "; ".join(command.clamped),
            may_enable=gate.state is DriveState.READY and not facts.obstacles,
            blockers=facts.obstacles,
            session=open_session.name if open_session else "",
            authority=self._authority,
            healthy_side=side,
            sensors=tuple(
                view.sensor_view(quality, samples.get(quality.sensor), self._perception.decoder.dialect_of, now_s)
                for quality in frame.sensors
            ),
            people=tuple(person for seen in heard.bodies if (person := view.person_view(seen))),
            body=view.body_view(frame.fused),
            healthy=view.healthy_view(frame.healthy, frame),
            target=view.target_view(frame.target, self._build, frame.trunk),
            affected=view.affected_view(reading.angle_rad, side.other, self._build, frame.trunk),
            exo=view.exo_view(reading, command, self._state),
            limits=open_session.limits if open_session else (),
            trunk_lean_m=session.lean_m(self._trunk_at_enable, frame),
            shoulder_hitch_m=self._shoulder.hitch_m,
            timing=self._timing(heard, given_s),
            warnings=(*frame.warnings, *self._warnings.recent(now_s)),
        )

    def _timing(self, heard: Heard, given_s: float) -> Timing:
        counts = self._perception.decoder.counts()
        recorder = self._desk.recorder
        newest_s, arrivals = heard.frame.newest_received_s, [sample.t_received_s for sample in heard.samples]
        return Timing(
            datagram_to_command_s=given_s - newest_s if newest_s in arrivals else None,
            tick_s=self._last_tick_s,
            overruns=self._overruns.in_all,
            datagrams=counts.datagrams,
            datagrams_refused=counts.refused_in_all + self._source.losses.in_all,
            ticks_dropped=self._ticks_missed,
            recorder_dropped=recorder.dropped if recorder else 0,
        )

    def _publish(self, tick: LiveTick, packets: list[Packet], heard: Heard) -> None:
        message = encoded(tick)
        self._channels.publish(message)
        recorder = self._desk.recorder
        if recorder is None:
            return
        for packet in packets:
            recorder.packet(packet)
        for sample in heard.samples:
            recorder.sample(sample)
        recorder.tick(message, tick.t_s)

    def _after(self, heard: Heard, now_s: float) -> None:
        closed = self._desk.settle(self._state, now_s)
        if closed is not None:
            self._trunk_at_enable = None
            self._shoulder = self._shoulder.forgotten()
            self._tell(closed)
        floor = self._demonstration
        if floor is not None and floor.listen(heard.samples, self._desk.session is not None, now_s):
            self._perception.begin_anew()
            self._channels.pause_demonstration(floor.is_paused)
        for warned in self._warnings.step(self._troubles(), now_s):
            self._tell(warned)

    def _troubles(self) -> tuple[Trouble, ...]:
        recorder, losses = self._desk.recorder, self._source.losses
        refused = dict(self._perception.decoder.counts().refused)
        garbage = sum(refused.values()) - refused.get(Reason.REPEATED, 0)
        return (
            Trouble("overrun", self._overruns.in_all, "The control loop was late {more} times."),
            Trouble("garbage", garbage, "{more} messages from sensors could not be read."),
            Trouble("oversized", losses.oversized, "{more} datagrams were longer than a sensor's ever are."),
            Trouble("stranger", losses.strangers, "{more} datagrams came from senders that are not allowed."),
            Trouble("flood", losses.overflowed, "{more} datagrams were lost: they came faster than can be read."),
            Trouble(
                "perception", self._perception.errors, "The body had to be found anew after an error (see the log)."
            ),
            Trouble("recorder", recorder.dropped if recorder else 0, self._recorder_words()),
        )

    def _recorder_words(self) -> str:
        trouble = self._desk.recorder.trouble if self._desk.recorder else ""
        return trouble.replace("{", "(").replace("}", ")") or "{more} entries were not recorded: the disk is too slow."

    def _tell(self, event: StationEvent) -> None:
        message = encoded(event)
        self._channels.tell(message)
        if self._desk.recorder is not None:
            self._desk.recorder.event(message, event.t_s)
