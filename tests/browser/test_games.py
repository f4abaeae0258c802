"""Each game played through in a real browser by the virtual patient, with the left and with the right arm affected."""

from __future__ import annotations

from collections.abc import Callable
from contextlib import suppress
from pathlib import Path
from time import monotonic

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, TimeoutError, expect

from games.catalogue import GAMES
from server.api.game_log import played

pytestmark = pytest.mark.browser

ALIGNED_MS = 60_000
PLAYED_S = 90.0
"""Generous: a busy machine must not fail a test that is about what is shown."""
LEVEL = 0.1
Ask = Callable[..., dict]


def patient_whose_healthy_side_is(ask: Ask, page: Page, healthy_side: str) -> int:
    """A patient whose limits somebody has signed for."""
    made = ask(page, "POST", "/api/patients", {"name": f"healthy {healthy_side}", "healthy_side": healthy_side})
    limits = {key: made[key] for key in ("passive_range", "force_limits", "assist_level_most")}
    ask(page, "POST", f"/api/patients/{made['id']}/confirm-limits", limits)
    return made["id"]


def open_all_games(ask: Ask, page: Page, affected: str) -> int:
    patient = patient_whose_healthy_side_is(ask, page, "right" if affected == "left" else "left")
    exercises = [{"game": name, "minutes": 5, "level": LEVEL, "pinned": True} for name in GAMES]
    form = {"patient_id": patient, "confirmed_affected_side": affected, "pain_before": 1, "exercises": exercises}
    return ask(page, "POST", "/api/sessions", form)["id"]


def keep_moving(page: Page) -> None:
    """Start, or resume as a person would where a busy machine made the station hold."""
    for wish in ("start", "resume"):
        button = page.get_by_test_id(wish)
        if button.is_enabled():
            with suppress(TimeoutError):  # a hold that ends by itself takes its button with it
                button.click(timeout=5000)


def number(play: Page, name: str) -> int:
    return int(play.locator("#play").get_attribute(f"data-{name}") or 0)


def play_until_something_is_won(page: Page, play: Page, game: str) -> None:
    """The screen shows the points of all games so far."""
    ends_s, before = monotonic() + PLAYED_S, number(play, "score")
    while play.locator("#play").get_attribute("data-game") != game or number(play, "score") == before:
        assert monotonic() < ends_s, f"{game}: nothing was won"
        keep_moving(page)
        play.wait_for_timeout(250)


@pytest.mark.parametrize("affected", ["left", "right"])
def test_the_virtual_patient_plays_every_game_and_its_scores_replay_exactly(
    browser: Browser, start_service: Callable, ask: Ask, shots: Path, affected: str
) -> None:
    service = start_service("--demo")
    context: BrowserContext = browser.new_context(viewport={"width": 1280, "height": 720}, locale="en-GB")
    page, play = context.new_page(), context.new_page()
    page.goto(service.address)
    page.get_by_test_id("login-demo").click()
    page.get_by_test_id("log-out").wait_for()
    session = open_all_games(ask, page, affected)
    page.goto(service.address + "/#/live")
    expect(page.get_by_test_id("start")).to_be_enabled(timeout=ALIGNED_MS)
    play.goto(service.address + "/play.html")
    for game in GAMES:
        play_until_something_is_won(page, play, game)
        assert play.locator("#play").get_attribute("data-side") == affected
        play.screenshot(path=shots / f"game-{game}-{affected}.png")
        ask(page, "POST", f"/api/sessions/{session}/game", {"wish": "next" if game != list(GAMES)[-1] else "quit"})
    expect(play.locator("#play[data-face=over]")).to_be_visible(timeout=15_000)
    play.screenshot(path=shots / f"game-over-{affected}.png")
    told = ask(page, "POST", f"/api/sessions/{session}/end", {"pain_after": 1})
    again = played(service.data / "recordings" / f"session-{session:06d}.game")
    assert [one["score"] for one in told["played"]] == [outcome.score for outcome in again.outcomes]
    assert all(one["score"] > 0 for one in told["played"])
    context.close()
