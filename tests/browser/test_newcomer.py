"""The newcomer's first minute, by real clicks against the real service and station process."""

from __future__ import annotations

import io
import re
from contextlib import suppress
from pathlib import Path
from time import monotonic

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Locator, Page, TimeoutError, expect

pytestmark = pytest.mark.browser

ALIGNED_MS = 45_000
PLAYED_S = 60
"""Generous: a busy machine must not fail a test that is about what is shown."""


def pixels(shown: Page | Locator, file: Path) -> np.ndarray:
    """A screenshot as (height, width, 3), kept as a file to be looked at."""
    picture = shown.screenshot(path=file)
    return np.asarray(Image.open(io.BytesIO(picture)).convert("RGB"), float)


def share_changed(before: np.ndarray, after: np.ndarray) -> float:
    """Share of pixels that differ visibly, of what both pictures show: words beside a view may make it shorter."""
    height, width = np.minimum(before.shape[:2], after.shape[:2])
    before, after = before[:height, :width], after[:height, :width]
    return float((np.abs(after - before).max(axis=2) > 24).mean())


def open_demonstration(page: Page, address: str, shots: Path) -> None:
    page.goto(address)
    expect(page.get_by_test_id("login-demo")).to_be_visible()
    page.screenshot(path=shots / "1-welcome.png")
    page.get_by_test_id("login-demo").click()
    page.get_by_test_id("open-session").first.click()
    page.get_by_test_id("confirm-side-left").click()
    page.get_by_test_id("pain-2").click()
    page.screenshot(path=shots / "2-open-session.png")
    page.get_by_test_id("begin-session").click()


def start_moving(page: Page) -> None:
    expect(page.get_by_test_id("sensor-row")).to_have_count(2, timeout=ALIGNED_MS)
    expect(page.get_by_test_id("start")).to_be_enabled(timeout=ALIGNED_MS)
    page.get_by_test_id("start").click()
    expect(page.get_by_test_id("state")).to_have_attribute("data-state", re.compile("engaged|hold"), timeout=10_000)


def check_the_view_moves(page: Page, shots: Path) -> None:
    view = page.get_by_test_id("view3d")
    page.frame_locator("[data-testid=view3d]").locator("canvas").first.wait_for()
    page.wait_for_timeout(1500)
    before = pixels(view, shots / "3-view-before.png")
    page.wait_for_timeout(2500)
    after = pixels(view, shots / "4-view-after.png")
    assert before.std() > 5, "the 3-D view is blank"
    assert share_changed(before, after) > 0.001, "the skeleton in the 3-D view does not move"


def resume(page: Page) -> None:
    """Press it if it can be pressed; a short hold ends by itself and takes its button with it."""
    if page.get_by_test_id("resume").is_enabled():
        with suppress(TimeoutError):
            page.get_by_test_id("resume").click(timeout=5000)


def play_until_the_score_rises(page: Page, play: Page) -> None:
    """Watch, and resume as a person would where a busy machine made the station hold."""
    ends_s = monotonic() + PLAYED_S
    while int(play.locator("[data-score]").get_attribute("data-score") or 0) == 0:
        assert monotonic() < ends_s, "nothing was collected"
        resume(page)
        play.wait_for_timeout(500)


def check_the_game_is_played(page: Page, play: Page, shots: Path) -> None:
    play.locator("[data-drawn]").wait_for(state="attached")
    play_until_the_score_rises(page, play)
    canvas = play.locator("canvas").first
    before = pixels(canvas, shots / "5-play-before.png")
    hand = play.locator("[data-hand]").get_attribute("data-hand")
    drawn = int(play.locator("[data-drawn]").get_attribute("data-drawn") or 0)
    play.wait_for_timeout(2000)
    after = pixels(canvas, shots / "6-play-after.png")
    assert before.std() > 5, "the game's canvas is blank"
    assert share_changed(before, after) > 0.001, "the game's picture stands still"
    assert play.locator("[data-hand]").get_attribute("data-hand") != hand, "the arm does not move"
    assert int(play.locator("[data-drawn]").get_attribute("data-drawn") or 0) > drawn


def hold_and_resume(page: Page) -> None:
    if page.get_by_test_id("hold").is_enabled():  # unless the station holds already
        page.get_by_test_id("hold").click()
    expect(page.get_by_test_id("state")).to_have_attribute("data-state", "hold")
    ends_s = monotonic() + PLAYED_S
    while page.get_by_test_id("state").get_attribute("data-state") != "engaged":
        assert monotonic() < ends_s, "the session could not be resumed"
        resume(page)  # refused while a busy machine keeps frames away
        page.wait_for_timeout(500)


def test_a_newcomer_watches_plays_stops_and_finds_the_figures_again(start_service, page: Page, shots: Path) -> None:
    service = start_service("--demo")
    open_demonstration(page, service.address, shots)
    start_moving(page)
    check_the_view_moves(page, shots)

    with page.context.expect_page() as popup:
        page.get_by_test_id("open-play").click()
    play = popup.value
    play.set_viewport_size({"width": 1280, "height": 720})
    check_the_game_is_played(page, play, shots)
    expect(page.get_by_test_id("score")).to_have_text(re.compile(r"[1-9]"))
    page.screenshot(path=shots / "7-live.png")
    hold_and_resume(page)

    page.keyboard.press("Escape")
    expect(page.get_by_test_id("state")).to_have_attribute("data-state", "stopped")
    page.get_by_test_id("end-session").click()
    page.get_by_test_id("pain-1").click()
    page.get_by_test_id("confirm-end").click()
    expect(page.get_by_test_id("metric-row").first).to_be_visible(timeout=20_000)
    figures = page.get_by_test_id("metric-row").all_inner_texts()
    page.screenshot(path=shots / "8-summary.png", full_page=True)
    assert pixels(page.get_by_test_id("curves"), shots / "9-curves.png").std() > 5, "the curves are blank"

    page.reload()
    expect(page.get_by_test_id("metric-row").first).to_be_visible()
    assert page.get_by_test_id("metric-row").all_inner_texts() == figures
