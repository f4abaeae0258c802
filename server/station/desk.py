"""Where wishes are answered: the session is opened and closed here, and its recording with it."""

from __future__ import annotations

from pathlib import Path

from fusion.errors import MachineError
from fusion.recording.log import LogAbout
from server.config import StationConfig
from server.messages import (
    CloseSession,
    DriveState,
    FollowBody,
    Hold,
    OpenSession,
    Pain,
    Reset,
    SessionClosed,
    Stop,
    Wish,
)
from server.station.exo import patient_range, safety
from server.station.exo.driver import Drive
from server.station.exo.safety_state import SafetyState
from server.station.perception import Perception
from server.station.recorder import Recorder
from server.station.session import Session, opened


class Desk:
    """Holds the open session and its recorder.

    Args:
        config: of the station.
        perception: told whose arm is healthy, and whom to follow.
        drive: fitted to each patient.
    """

    def __init__(self, config: StationConfig, perception: Perception, drive: Drive) -> None:
        self._config, self._perception, self._drive = config, perception, drive
        self.session: Session | None = None
        self.recorder: Recorder | None = None
        self._last_stop = 0

    def answer(self, wish: Wish, state: SafetyState, now_s: float) -> tuple[SafetyState, str]:
        """Apply a wish.

        Returns:
            The gate's state afterwards, and why the wish was refused ("" = granted).
        """
        if wish.number < self._last_stop:
            return state, "A stop, or pain, came after this wish."
        if isinstance(wish, OpenSession):
            return self._open(wish, state, now_s)
        if isinstance(wish, FollowBody):
            return self._follow(wish, state, now_s), ""
        if isinstance(wish, Stop | Pain):
            self._last_stop = wish.number
        if isinstance(wish, Reset) and state.gate.state in (DriveState.STOPPED, DriveState.FAULT):
            # The gate refuses until the drive's fault is gone, so a drive that needs this is asked for twice.
            self._drive.reset()
        return safety.wish(state, wish, now_s)

    def leave(self, state: SafetyState, now_s: float) -> SafetyState:
        """Close the session, if one is open, because the station ends."""
        return safety.wish(state, CloseSession(number=0), now_s)[0]

    def settle(self, state: SafetyState, now_s: float) -> SessionClosed | None:
        """After a close: let go when the arm is at rest and the recording is finished. Call it once per tick."""
        if self.session is None or state.gate.session_open or not state.at_rest:
            return None
        if self.recorder is not None:
            self.recorder.finish()
            if not self.recorder.finished:
                return None
        closed = SessionClosed(t_s=now_s, session=self.session.name, recording=self.session.recording)
        self.session, self.recorder = None, None
        return closed

    def _follow(self, wish: FollowBody, state: SafetyState, now_s: float) -> SafetyState:
        """Another body's arm is another target: that is no short loss, so a person resumes."""
        if not self._perception.follow(wish.sensor, wish.body):
            return state
        return safety.wish(state, Hold(number=wish.number, reason="Another body is followed now."), now_s)[0]

    def _open(self, wish: OpenSession, state: SafetyState, now_s: float) -> tuple[SafetyState, str]:
        after, refusal = safety.wish(state, wish, now_s)
        refusal = refusal or self._unusable(wish)
        if refusal:
            return state, refusal
        try:
            self.recorder = self._recorder(wish)
        except MachineError as error:
            return state, str(error)
        self.session = opened(wish, self._config.device, self._config.gate)
        self._perception.treat(wish.healthy_side)
        if self.session.limits:
            self._drive.fit(self.session.limits)
            after = safety.put_in(after, self._drive.read(now_s), now_s)
        return after, ""

    def _unusable(self, wish: OpenSession) -> str:
        if self.session is not None:
            return "The last session is still being closed; try again in a moment."
        return patient_range.refused(wish.limits, self._config.device) if wish.limits else ""

    def _recorder(self, wish: OpenSession) -> Recorder | None:
        if not wish.recording:
            return None
        about = LogAbout(
            name=wish.session,
            about="A mirror-therapy session recorded live",
            healthy_side=wish.healthy_side,
            origin="mirrorlimb station",
            primary=self._config.reference or "",
        )
        return Recorder(Path(wish.recording), about)
