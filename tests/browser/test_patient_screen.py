"""Every face of the patient's screen: large enough to be read, nothing upon anything else, and what happens next."""

from __future__ import annotations

from dataclasses import replace
from datetime import UTC, datetime
from pathlib import Path
from typing import Any

import msgspec
import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Page, WebSocketRoute, expect

from fusion.skeleton import Side
from games.game import ChoiceView, GameView, Phase, ThingView, Wish
from server.api.live import LiveMessage, SessionPhase, SessionView
from server.messages import EXO_JOINTS, ArmView, DriveState, ExoView, LiveTick, Timing

pytestmark = pytest.mark.browser

STILL = (0.0,) * len(EXO_JOINTS)
MIDDLE, LEFT, RIGHT, LOW = (-0.42, -0.05, -0.48), (-0.5, -0.34, -0.42), (-0.04, 0.13, -0.37), (-0.18, -0.41, -0.46)
ARM = ArmView(
    plane_rad=0.5,
    elevation_rad=0.5,
    rotation_rad=0.0,
    elbow_rad=0.5,
    valid=True,
    points_in_trunk=((-0.2, 0.0, 0.0), (-0.3, -0.2, -0.2), (-0.3, -0.2, -0.4), (-0.3, -0.2, -0.48)),
    points_in_room=None,
)
TICK = LiveTick(
    index=1,
    t_s=1.0,
    t_newest_received_s=None,
    state=DriveState.ENGAGED,
    reason="",
    may_enable=False,
    blockers=(),
    session="1",
    healthy_side=Side.RIGHT,
    sensors=(),
    body=None,
    healthy=ARM,
    target=ARM,
    affected=ARM,
    exo=ExoView(
        angle_rad=STILL,
        velocity_rad_s=STILL,
        torque_nm=STILL,
        command_rad=STILL,
        command_velocity_rad_s=STILL,
        clamped=(),
        speed_factor=1.0,
        blend=0.0,
        fault="",
    ),
    limits=(),
    trunk_lean_m=0.0,
    timing=Timing(
        datagram_to_command_s=None,
        tick_s=0.0,
        overruns=0,
        datagrams=0,
        datagrams_refused=0,
        ticks_dropped=0,
        recorder_dropped=0,
    ),
    warnings=(),
)
GAME = GameView(
    game="reach",
    phase=Phase.PLAYING,
    score=1240,
    streak=12,
    round=1,
    rounds=3,
    things=(ThingView(1, "fruit", MIDDLE, 0.07, 0.4),),
    hand=MIDDLE,
    time_left_s=45.0,
    hits=80,
    misses=3,
    level=0.4,
    aim=MIDDLE,
    exercise=2,
    exercises=3,
    next_game="catch",
    total_score=2480,
)
SESSION = SessionView(
    id=1,
    patient="A",
    exercises=(),
    affected_side=Side.LEFT,
    started=datetime(2026, 1, 5, tzinfo=UTC),
    elapsed_s=100.0,
    phase=SessionPhase.RUNNING,
    assist_level_most=1.0,
    authority=None,
    patient_screens=1,
    screen_lost=False,
)


def offered(**spots: tuple[float, float, float]) -> tuple[ChoiceView, ...]:
    return tuple(ChoiceView(Wish(name), place, 0.08, 0.3) for name, place in spots.items())


def message(game: GameView | None = GAME, opened: SessionView | None = SESSION, **tick: Any) -> LiveMessage:
    return LiveMessage(tick=msgspec.structs.replace(TICK, **tick), game=game, session=opened)


SEEN_BADLY = "No sensor sees the patient now."
RESTING = replace(GAME, phase=Phase.REST, choices=offered(go_on=MIDDLE))
NOBODY = message(None, None, session="")
SAYS = {
    "welcome": NOBODY,
    "playing": message(replace(GAME, choices=offered(pause=LOW))),
    "waiting": message(replace(GAME, phase=Phase.WAITING, choices=offered(start=MIDDLE))),
    "break": message(replace(GAME, phase=Phase.PAUSED, choices=offered(go_on=MIDDLE, quit=LEFT, next=RIGHT))),
    "rest": message(RESTING),
    "between": message(replace(GAME, phase=Phase.BETWEEN, choices=offered(go_on=MIDDLE, quit=LEFT))),
    "over": message(replace(GAME, phase=Phase.OVER)),
    "paused": message(state=DriveState.HOLD, reason=SEEN_BADLY),
    "eased": message(
        state=DriveState.HOLD, reason="A pressed pain", exo=msgspec.structs.replace(TICK.exo, compliant=True)
    ),
    "ready": message(None, state=DriveState.READY),
    "stopped": message(state=DriveState.STOPPED),
    "fault": message(state=DriveState.FAULT),
    "noscene": message(replace(GAME, game="a game of next year")),
    "ended": NOBODY,
}
UNREADABLE = """(least_px) => {
  const wrong = [];
  const texts = document.createTreeWalker(document.getElementById("play"), NodeFilter.SHOW_TEXT);
  while (texts.nextNode()) {
    const { parentElement: of, data } = texts.currentNode;
    if (!data.trim() || !of.checkVisibility() || of.closest(".spoken, .popup")) continue;
    const range = document.createRange();
    range.selectNodeContents(texts.currentNode);
    const { left, right, top, bottom } = range.getBoundingClientRect();
    const px = parseFloat(getComputedStyle(of).fontSize);
    if (px < least_px) wrong.push(`"${data}" has ${px} px`);
    if (left < 0 || top < 0 || right > innerWidth || bottom > innerHeight) wrong.push(`"${data}" is cut off`);
  }
  return wrong;
}"""
UPON_ONE_ANOTHER = """() => {
  const parts = [...document.querySelectorAll(".panel, .pain, #controls, .note, .choice, .figures")];
  const seen = parts.filter((part) => part.checkVisibility()).map((part) => [part, part.getBoundingClientRect()]);
  const meets = (a, b) => a.left < b.right && b.left < a.right && a.top < b.bottom && b.top < a.bottom;
  return seen.flatMap(([one, a], i) =>
    seen.slice(i + 1).flatMap(([other, b]) => (meets(a, b) ? [`${one.className} on ${other.className}`] : [])));
}"""


class Stream:
    """What the page is told over the stream, until it is told something else."""

    def __init__(self, page: Page) -> None:
        self.says = NOBODY
        self.answers = True
        self._sockets: list[WebSocketRoute] = []
        page.route_web_socket("**/api/stream*", self._opened)

    def breaks(self) -> None:
        """The connection is lost, and cannot be had again."""
        self.answers = False
        for socket in self._sockets:
            socket.close()

    def _opened(self, socket: WebSocketRoute) -> None:
        if not self.answers:
            socket.close()
            return
        self._sockets.append(socket)
        socket.on_message(lambda _: self._say(socket))
        self._say(socket)

    def _say(self, socket: WebSocketRoute) -> None:
        if self.answers:
            socket.send(msgspec.json.encode(self.says).decode())


@pytest.fixture
def stream(page: Page, pages: str) -> Stream:
    """The patient's screen with a stream of our own."""
    told = Stream(page)
    page.goto(f"{pages}/play.html")
    return told


def show(page: Page, stream: Stream, face: str) -> None:
    stream.says = SAYS.get(face, stream.says)
    expect(page.locator(f"#play[data-face='{face}']")).to_be_attached(timeout=20_000)
    page.wait_for_timeout(150)  # a frame or two, so that words stand where they belong


@pytest.mark.parametrize("language", ["en", "zh"])
def test_every_face_is_legible_and_nothing_covers_anything(
    page: Page, stream: Stream, shots: Path, language: str
) -> None:
    wrong = []
    if language == "zh":
        page.get_by_test_id("language").click()
    for face in SAYS:
        show(page, stream, face)
        page.screenshot(path=shots / f"play-{face}-{language}.png")
        found = page.evaluate(UNREADABLE, 28) + page.evaluate(UPON_ONE_ANOTHER)
        found += [f"{one['id']}: {one['help']}" for one in Axe().run(page).response["violations"]]
        wrong += [f"{face}: {one}" for one in found]
    assert not wrong, "\n".join(wrong)


def test_at_200_percent_every_face_keeps_its_place(page: Page, stream: Stream, shots: Path) -> None:
    wrong = []
    page.set_viewport_size({"width": 640, "height": 360})
    for face in SAYS:
        show(page, stream, face)
        page.screenshot(path=shots / f"play-{face}-small.png")
        wrong += [f"{face}: {one}" for one in page.evaluate(UNREADABLE, 14) + page.evaluate(UPON_ONE_ANOTHER)]
    assert not wrong, "\n".join(wrong)


def test_a_connection_lost_in_a_game_says_that_the_game_waits_and_it_goes_on(page: Page, stream: Stream) -> None:
    show(page, stream, "playing")
    stream.breaks()
    expect(page.locator("#play[data-face=lost]")).to_be_attached(timeout=20_000)
    expect(page.get_by_test_id("overlay")).to_contain_text("the game waits and your points are kept")
    stream.answers = True
    show(page, stream, "playing")
    expect(page.get_by_test_id("score")).to_have_text("2480")


def test_a_session_closed_half_way_leaves_the_patient_with_what_was_won(page: Page, stream: Stream) -> None:
    show(page, stream, "playing")
    stream.says = NOBODY
    expect(page.locator("#play[data-face=ended]")).to_be_attached(timeout=20_000)
    expect(page.get_by_test_id("total")).to_contain_text("2480")


def test_posture_is_answered_by_a_picture_and_a_kind_word(page: Page, stream: Stream, shots: Path) -> None:
    for posture in ("lean", "hitch"):
        stream.says = message(replace(GAME, posture=posture))
        note = page.locator(f"[data-testid=note][data-kind={posture}]")
        expect(note).to_be_visible(timeout=20_000)
        expect(note.locator("svg")).to_be_visible()
        page.screenshot(path=shots / f"play-{posture}.png")
        assert not page.evaluate(UPON_ONE_ANOTHER)
        stream.says = message()
        expect(note).to_be_hidden(timeout=20_000)


def test_a_second_screen_says_so_and_leaves_the_sound_to_the_first(page: Page, stream: Stream) -> None:
    stream.says = message(opened=msgspec.structs.replace(SESSION, patient_screens=2))
    page.reload()
    expect(page.get_by_test_id("note")).to_contain_text("A second screen", timeout=20_000)
    page.locator("#picture").click()
    expect(page.get_by_test_id("sound")).to_have_attribute("aria-label", "Sound: off")


def test_without_a_camera_the_patient_is_told_who_sees_to_it(page: Page, stream: Stream) -> None:
    show(page, stream, "ready")
    expect(page.get_by_test_id("overlay")).to_contain_text("No camera is connected yet")
