"""The exoskeleton on screens: who is in charge, what it does, and that everybody can stop it."""

from __future__ import annotations

import re
from collections.abc import Callable, Iterator
from time import monotonic

import pytest
from playwright.sync_api import Browser, BrowserContext, Page, TimeoutError, expect

pytestmark = pytest.mark.browser

WITHIN_MS = 45_000
"""Generous: a busy machine must not fail a test that is about what is shown."""
ANGLE = re.compile(r"−?\d+°")


@pytest.fixture
def open_page(browser: Browser) -> Iterator[Callable[[str], Page]]:
    """Pages of browsers of their own, with a touch screen and the 3-D view put away."""
    contexts: list[BrowserContext] = []

    def opened(address: str) -> Page:
        context = browser.new_context(viewport={"width": 1280, "height": 720}, locale="en-GB", has_touch=True)
        context.add_init_script("localStorage.setItem('mirrorlimb.view3d', 'away')")
        contexts.append(context)
        page = context.new_page()
        page.goto(address)
        page.get_by_test_id("login-demo").click()
        return page

    yield opened
    for context in contexts:
        context.close()


def shows(page: Page, state: str) -> None:
    expect(page.get_by_test_id("state")).to_have_attribute("data-state", state, timeout=WITHIN_MS)


def press(page: Page, wish: str) -> None:
    """Press it if it can be pressed; a hold that ends by itself takes its button with it."""
    button = page.get_by_test_id(wish)
    if button.is_enabled():
        try:
            button.click(timeout=5000)
        except TimeoutError:
            return


def get_moving(page: Page) -> None:
    """Start, or resume as a person would where a busy machine made the station hold."""
    ends_s = monotonic() + WITHIN_MS / 1000
    while page.get_by_test_id("state").get_attribute("data-state") != "engaged":
        assert monotonic() < ends_s, page.get_by_test_id("state-reason").inner_text()
        for wish in ("start", "resume"):
            press(page, wish)
        page.wait_for_timeout(200)


def open_session(page: Page) -> None:
    page.get_by_test_id("open-session").first.click()
    page.get_by_test_id("confirm-side-left").click()
    page.get_by_test_id("begin-session").click()
    expect(page.get_by_test_id("authority")).to_have_attribute("data-charge", "mine")


def check_the_panel(page: Page) -> None:
    rows = page.get_by_test_id("exo-row")
    expect(rows).to_have_count(4)
    for row in rows.all():
        for angle in ("exo-measured", "exo-commanded"):
            expect(row.get_by_test_id(angle)).to_have_text(ANGLE)
        expect(row.get_by_test_id("exo-torque")).to_contain_text(re.compile(r"\d.*≤w\+15"))
        expect(row.get_by_test_id("exo-effort")).to_contain_text("/6")


def change_the_help(page: Page) -> None:
    page.get_by_test_id("help-assisted").click()
    expect(page.get_by_test_id("help")).to_have_attribute("data-mode", "assisted")
    slider = page.get_by_test_id("help-level")
    slider.focus()
    page.keyboard.press("ArrowLeft")
    expect(slider).to_have_attribute("aria-valuetext", "90 %")


def check_reset_is_not_start(page: Page) -> None:
    expect(page.get_by_test_id("start")).to_be_disabled()
    page.get_by_test_id("reset").click()
    shows(page, "ready")
    expect(page.get_by_test_id("reset")).to_be_disabled()
    page.wait_for_timeout(500)
    shows(page, "ready")


def stop_by(page: Page, act: Callable[[], None]) -> None:
    get_moving(page)
    act()
    expect(page.get_by_test_id("stop")).to_contain_text("Stopped")
    shows(page, "stopped")
    check_reset_is_not_start(page)


def check_who_only_looks(colleague: Page) -> None:
    colleague.get_by_test_id("go-live").click()
    expect(colleague.get_by_test_id("authority")).to_have_attribute("data-charge", "other")
    shows(colleague, "ready")
    expect(colleague.get_by_test_id("start")).to_be_disabled()
    expect(colleague.get_by_test_id("help-free")).to_be_disabled()
    expect(colleague.get_by_test_id("stop")).to_be_enabled()


def stop_from_another_page(therapist: Page, colleague: Page) -> None:
    get_moving(therapist)
    colleague.goto(colleague.url.split("#")[0] + "#/")
    colleague.get_by_test_id("stop-bar").get_by_test_id("stop").tap()
    shows(therapist, "stopped")
    therapist.get_by_test_id("reset").click()
    shows(therapist, "ready")


def pull(therapist: Page, colleague: Page) -> None:
    colleague.get_by_test_id("nav-live").click()
    get_moving(therapist)
    shows(colleague, "engaged")
    therapist.context.close()
    shows(colleague, "hold")
    expect(colleague.get_by_test_id("authority")).to_have_attribute("data-charge", "gone")
    expect(colleague.get_by_test_id("resume")).to_be_disabled()
    colleague.get_by_test_id("take-over").click()
    expect(colleague.get_by_test_id("authority")).to_have_attribute("data-charge", "mine")


def stop_for_pain(therapist: Page) -> None:
    with therapist.context.expect_page() as popup:
        therapist.get_by_test_id("open-play").click()
    screen = popup.value
    screen.set_viewport_size({"width": 640, "height": 400})  # drawn without a graphics card
    expect(screen.get_by_test_id("pain")).to_be_visible()
    get_moving(therapist)
    screen.keyboard.press("Space")
    expect(screen.get_by_test_id("pain")).to_contain_text("Stopped")
    expect(screen.locator("[data-face=eased]").first).to_be_attached()
    expect(therapist.get_by_test_id("state")).to_have_text("Held softly")


def test_sr11_one_page_moves_the_arm_and_every_page_and_the_patient_can_stop_it(
    start_service, open_page, shots
) -> None:
    service = start_service("--demo")
    therapist = open_page(service.address)
    open_session(therapist)
    get_moving(therapist)
    check_the_panel(therapist)
    change_the_help(therapist)
    therapist.screenshot(path=shots / "exo-1-assisted.png")
    stop_by(therapist, lambda: therapist.keyboard.press("Escape"))
    stop_by(therapist, therapist.get_by_test_id("stop").tap)
    colleague = open_page(service.address)
    check_who_only_looks(colleague)
    stop_from_another_page(therapist, colleague)
    pull(therapist, colleague)
    stop_for_pain(colleague)
    colleague.screenshot(path=shots / "exo-2-eased.png")


def test_sr10_no_session_opens_before_a_person_has_confirmed_the_limits(start_service, open_page, shots) -> None:
    page = open_page(start_service("--demo").address)
    page.get_by_test_id("open-session").wait_for()
    page.goto(page.url.split("#")[0] + "#/patients/new")
    page.get_by_test_id("patient-name").fill("Li")
    page.get_by_test_id("healthy-right").click()
    page.get_by_test_id("elbow-resistance").fill("4.5")
    page.get_by_test_id("save-patient").click()
    expect(page.get_by_test_id("limits")).to_have_attribute("data-signed", "false")
    page.get_by_test_id("open-session").click()
    page.get_by_test_id("confirm-side-left").click()
    expect(page.get_by_test_id("missing")).to_contain_text("Nobody has confirmed the limits")
    expect(page.get_by_test_id("begin-session")).to_be_disabled()
    page.screenshot(path=shots / "exo-3-missing.png")
    page.get_by_test_id("missing-limits").click()
    page.get_by_test_id("confirm-limits").click()
    expect(page.get_by_test_id("limits-signed")).to_contain_text("Confirmed by demo")
    expect(page.get_by_test_id("limits")).to_contain_text("4.5")
    page.screenshot(path=shots / "exo-4-signed.png")
    expect(page.get_by_test_id("begin-session")).to_be_enabled()
