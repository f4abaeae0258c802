"""A therapist's way from the first page through the set-up wizard to the summary, with its wrong turns."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path
from time import monotonic

import pytest
from playwright.sync_api import Page, TimeoutError, expect

pytestmark = pytest.mark.browser

SEEN_MS = 60_000
"""Generous: a busy machine must not fail a test that is about what is shown."""
NOTE = "tired today; the elbow first next time"
FITS = "() => document.documentElement.scrollHeight <= window.innerHeight"


def step(page: Page, name: str, mark: str) -> None:
    """The wizard shows that step so."""
    expect(page.get_by_test_id(f"step-{name}")).to_have_attribute("data-mark", mark, timeout=SEEN_MS)


def shown(page: Page, name: str) -> None:
    expect(page.get_by_test_id("wizard-step")).to_have_attribute("data-step", name)


def enrol(page: Page, address: str) -> None:
    """The first account, and a patient whose limits nobody has confirmed."""
    page.goto(address)
    page.get_by_test_id("account-name").fill("Dr. Lin")
    page.get_by_test_id("account-password").fill("three quiet herons")
    page.get_by_test_id("log-in").click()
    page.get_by_test_id("new-patient").click()
    page.get_by_test_id("patient-name").fill("Wang Li")
    page.get_by_test_id("healthy-right").click()
    page.get_by_test_id("save-patient").click()
    expect(page.get_by_test_id("limits")).to_be_visible()


def find_on_the_first_page(page: Page, shots: Path) -> None:
    page.get_by_test_id("nav-today").click()
    row = page.get_by_test_id("today-row")
    expect(row).to_contain_text("Nobody has confirmed the limits")
    expect(row).to_contain_text("No plan yet")
    page.get_by_test_id("search-patient").fill("zoe")
    expect(row).to_have_count(0)
    page.get_by_test_id("search-patient").fill("li")
    expect(row).to_have_count(1)
    page.screenshot(path=shots / "therapist-1-today.png")
    row.get_by_test_id("open-session").click()


def learn_that_nothing_sends(page: Page, port: int, shots: Path) -> None:
    """Said with the port to send to, and no reason to wait."""
    shown(page, "sensors")
    step(page, "sensors", "look")
    expect(page.get_by_test_id("wizard-step")).to_contain_text(str(port))
    page.screenshot(path=shots / "therapist-2-no-sensors.png")
    page.get_by_test_id("wizard-next").click()
    shown(page, "person")
    page.get_by_test_id("wizard-back").click()
    shown(page, "sensors")


def choose_among_two(page: Page, shots: Path) -> None:
    step(page, "person", "look")
    page.get_by_test_id("step-person").click()
    expect(page.get_by_test_id("person")).to_have_count(2, timeout=SEEN_MS)
    page.screenshot(path=shots / "therapist-3-two-people.png")
    page.get_by_test_id("step-arm").click()
    expect(page.get_by_test_id("missing-person")).to_be_visible()
    page.get_by_test_id("missing-person").click()
    page.get_by_test_id("person").first.get_by_role("button").click()
    step(page, "person", "done")


def answer(page: Page, shots: Path) -> None:
    """The wrong arm first, then the limits that nobody had confirmed, then a second game."""
    page.get_by_test_id("step-arm").click()
    page.get_by_test_id("confirm-side-right").click()
    step(page, "arm", "look")
    expect(page.get_by_test_id("begin-session")).to_be_disabled()
    page.get_by_test_id("confirm-side-left").click()
    page.get_by_test_id("pain-3").click()
    page.get_by_test_id("missing-limits").click()
    page.get_by_test_id("confirm-limits").click()
    step(page, "limits", "done")
    page.get_by_test_id("wizard-back").click()
    expect(page.get_by_test_id("pain-3")).to_have_attribute("aria-pressed", "true")
    page.get_by_test_id("add-exercise").click()
    expect(page.get_by_test_id("exercise")).to_have_count(2)
    page.screenshot(path=shots / "therapist-4-answers.png")
    page.get_by_test_id("begin-session").click()


def show_the_range(page: Page, shots: Path) -> None:
    shown(page, "range")
    expect(page.get_by_test_id("stop")).to_be_visible()
    expect(page.get_by_test_id("state")).to_have_attribute("data-state", re.compile("off|ready"))
    expect(page.get_by_test_id("take-range")).to_be_enabled(timeout=SEEN_MS)
    page.screenshot(path=shots / "therapist-5-range.png")
    page.get_by_test_id("take-range").click()
    step(page, "range", "done")
    shown(page, "ready")
    page.reload()
    shown(page, "range")
    step(page, "range", "done")
    page.get_by_test_id("step-ready").click()
    page.screenshot(path=shots / "therapist-6-ready.png")


def start(page: Page) -> None:
    """As soon as the healthy arm is near where the exoskeleton holds the other; the live page follows by itself."""
    ends_s = monotonic() + SEEN_MS / 1000
    while "#/live" not in page.url:
        assert monotonic() < ends_s, page.get_by_test_id("state-reason").inner_text()
        press(page, "start")
        page.wait_for_timeout(300)


def press(page: Page, name: str) -> None:
    """Press it if it can be pressed; what a moment changes takes the button with it."""
    button = page.get_by_test_id(name)
    try:
        if button.is_enabled(timeout=1000):
            button.click(timeout=2000)
    except TimeoutError:
        return


def steer_the_game(page: Page, shots: Path) -> None:
    game = page.get_by_test_id("game")
    expect(game).to_have_attribute("data-phase", re.compile("waiting|playing|paused"), timeout=SEEN_MS)
    expect(page.get_by_test_id("screens")).to_have_attribute("data-count", "0")
    page.get_by_test_id("harder").click()
    expect(page.get_by_test_id("level")).to_have_attribute("data-pinned", "true", timeout=SEEN_MS)
    page.get_by_test_id("pin").click()
    expect(page.get_by_test_id("level")).to_have_attribute("data-pinned", "false", timeout=SEEN_MS)
    for width, height in ((1280, 720), (1024, 768)):
        page.set_viewport_size({"width": width, "height": height})
        assert page.evaluate(FITS), f"the live page must be scrolled at {width} x {height}"
        expect(page.get_by_test_id("stop")).to_be_in_viewport(ratio=1)
        expect(page.get_by_test_id("end-session")).to_be_in_viewport(ratio=1)
    page.screenshot(path=shots / "therapist-7-live.png")
    page.get_by_test_id("game-next").click()
    expect(game).to_contain_text("2 of 2", timeout=SEEN_MS)
    expect(page.get_by_test_id("game-next")).to_be_disabled()


def write_it_down(page: Page, shots: Path) -> None:
    page.get_by_test_id("end-session").click()
    page.get_by_test_id("confirm-end").click()
    expect(page.get_by_test_id("played-game").first).to_be_visible(timeout=SEEN_MS)
    page.get_by_test_id("pain-1").click()
    page.get_by_test_id("session-notes").fill(NOTE)
    page.get_by_test_id("save-notes").click()
    expect(page.get_by_test_id("notes-state")).to_contain_text("kept")
    page.reload()
    expect(page.get_by_test_id("session-notes")).to_have_value(NOTE)
    expect(page.get_by_test_id("pain-1")).to_have_attribute("aria-pressed", "true")
    page.screenshot(path=shots / "therapist-8-summary.png", full_page=True)
    page.get_by_test_id("nav-today").click()
    expect(page.get_by_test_id("today-row")).to_contain_text("last session")


def test_a_therapist_is_led_from_the_first_page_to_the_summary_and_out_of_every_wrong_turn(
    start_service: Callable, crowd: Callable, page: Page, shots: Path
) -> None:
    service = start_service()
    enrol(page, service.address)
    find_on_the_first_page(page, shots)
    port = page.request.get(f"{service.address}/api/station").json()["ports"]["kinectv2-osc"]
    learn_that_nothing_sends(page, port, shots)
    with crowd(port) as people:
        step(page, "sensors", "done")
        step(page, "person", "done")
        people.visitor_comes()
        choose_among_two(page, shots)
        answer(page, shots)
        people.show_range(True)
        show_the_range(page, shots)
        people.show_range(False)
        step(page, "alignment", "done")
        start(page)
        steer_the_game(page, shots)
        page.keyboard.press("Escape")
        expect(page.get_by_test_id("state")).to_have_attribute("data-state", "stopped")
        write_it_down(page, shots)


def test_a_session_without_sensors_opens_says_what_it_waits_for_and_ends(
    start_service: Callable, page: Page, shots: Path
) -> None:
    enrol(page, start_service().address)
    page.get_by_test_id("confirm-limits").click()
    page.get_by_test_id("open-session").click()
    page.get_by_test_id("step-arm").click()
    page.get_by_test_id("confirm-side-left").click()
    page.get_by_test_id("begin-session").click()
    page.get_by_test_id("step-ready").click()
    expect(page.get_by_test_id("wizard-step")).to_contain_text("No sensor is aligned yet")
    expect(page.get_by_test_id("start")).to_be_disabled()
    page.screenshot(path=shots / "therapist-9-waiting.png")
    page.get_by_test_id("nav-today").click()
    page.get_by_test_id("go-live").click()
    page.get_by_test_id("end-session").click()
    page.get_by_test_id("confirm-end").click()
    expect(page.get_by_test_id("played")).to_contain_text("No game was played", timeout=SEEN_MS)
