"""Every page for everybody: WCAG 2.2 AA as far as a machine can check it, 200 % zoom, keys alone, a small download."""

from __future__ import annotations

import gzip
from collections.abc import Callable, Iterator
from contextlib import suppress
from dataclasses import dataclass
from pathlib import Path
from time import monotonic

import pytest
from axe_playwright_python.sync_playwright import Axe
from playwright.sync_api import Browser, BrowserContext, Page, TimeoutError, expect

pytestmark = pytest.mark.browser

RULES = {"runOnly": ["wcag2a", "wcag2aa", "wcag21a", "wcag21aa", "wcag22aa", "best-practice"]}
NOT_OURS = {"exclude": [["iframe"]]}
"""The 3-D view inside its frame is viser's page."""
DESK, ZOOMED = {"width": 1280, "height": 720}, {"width": 640, "height": 360}
"""At 200 % a screen of 1280 × 720 has room for half as much."""
STATIC = Path(__file__).parents[2] / "server" / "api" / "static"
MOST_BYTES = 300_000
"""Gzipped, of the dashboard's first load."""
LANGUAGES = ("en", "zh")
SETTLES_MS = 300
ALIGNED_MS = 60_000
PLAYED_S = 60.0
"""Generous: a busy machine must not fail a test that is about what is shown."""

TOO_WIDE = "() => document.documentElement.scrollWidth - document.documentElement.clientWidth"
FOCUSED = """() => {
  const element = document.activeElement;
  if (!element || element === document.body) return null;
  const style = getComputedStyle(element);
  const shown = style.outlineStyle !== "none" || style.boxShadow !== "none";
  return { name: element.outerHTML.slice(0, 120), shown };
}"""


@dataclass(frozen=True)
class Clinic:
    """A running demonstration with one finished session of its patient."""

    address: str
    context: BrowserContext
    page: Page
    patient: int
    session: int


def finished_session(ask: Callable[..., dict], page: Page, patient: int) -> int:
    """A session that lasted a moment."""
    form = {"patient_id": patient, "confirmed_affected_side": "left", "pain_before": 2}
    session = ask(page, "POST", "/api/sessions", form)["id"]
    page.wait_for_timeout(2000)
    ask(page, "POST", f"/api/sessions/{session}/end", {"pain_after": 1})
    return session


@pytest.fixture
def clinic(browser: Browser, start_service: Callable, ask: Callable[..., dict]) -> Iterator[Clinic]:
    """Logged in at the demonstration, with something on every page."""
    service = start_service("--demo")
    context = browser.new_context(viewport=DESK, locale="en-GB", reduced_motion="reduce")
    page = context.new_page()
    page.goto(service.address)
    page.get_by_test_id("login-demo").click()
    expect(page.get_by_test_id("open-session").first).to_be_visible()
    patient = ask(page, "GET", "/api/patients")[0]["id"]
    yield Clinic(service.address, context, page, patient, finished_session(ask, page, patient))
    context.close()


def violations(page: Page) -> list[str]:
    """What axe finds wrong, each with the elements concerned."""
    found = Axe().run(page, context=NOT_OURS, options=RULES).response["violations"]
    return [
        f"{one['id']} ({one['impact']}): {one['help']}: {[node['target'] for node in one['nodes']][:6]}"
        for one in found
    ]


def routes(clinic: Clinic) -> dict[str, str]:
    """Every page of the dashboard that is there without an open session."""
    patient, session = f"#/patients/{clinic.patient}", f"#/sessions/{clinic.session}"
    return {
        "today": "#/",
        "enrol": "#/patients/new",
        "patient": patient,
        "change": f"{patient}/change",
        "set-up": f"{patient}/session",
        "plan": f"{patient}/plan",
        "progress": f"{patient}/progress",
        "scores": f"{patient}/scores",
        "course-report": f"{patient}/report",
        "live": "#/live",
        "summary": session,
        "replay": f"{session}/replay",
        "report": f"{session}/report",
    }


def show(page: Page, address: str) -> None:
    page.goto(address)
    page.locator("main h1").first.wait_for()
    before = ""
    while (now := page.locator("main").inner_text()) != before:  # what is fetched comes piece by piece
        before = now
        page.wait_for_timeout(SETTLES_MS)


def wrong_at(page: Page, name: str, shots: Path) -> list[str]:
    """What is wrong with the page as it stands, on a desk and enlarged to 200 %."""
    wrong = []
    for size in (DESK, ZOOMED):
        page.set_viewport_size(size)
        page.wait_for_timeout(SETTLES_MS)
        where = f"{name}-{size['width']}"
        page.screenshot(path=shots / f"axe-{where}.png", full_page=True)
        wide_px = page.evaluate(TOO_WIDE)
        wrong += [f"{where}: {one}" for one in violations(page)]
        wrong += [f"{where}: scrolls sideways by {wide_px} px"] if wide_px > 0 else []
    page.set_viewport_size(DESK)
    return wrong


def test_no_page_of_the_dashboard_breaks_wcag_22_aa_at_any_zoom_in_any_language(clinic: Clinic, shots: Path) -> None:
    wrong = []
    for language in LANGUAGES:
        clinic.page.get_by_test_id(f"language-{language}").click()
        for name, route in routes(clinic).items():
            show(clinic.page, clinic.address + "/" + route)
            wrong += wrong_at(clinic.page, f"{name}-{language}", shots)
    assert not wrong, "\n".join(wrong)


def press_if_it_can_be(page: Page, wish: str) -> None:
    button = page.get_by_test_id(wish)
    if button.is_enabled():
        with suppress(TimeoutError):  # a hold that ends by itself takes its button with it
            button.click(timeout=5000)


def play_until_something_is_won(page: Page, play: Page) -> None:
    ends_s = monotonic() + PLAYED_S
    while int(play.locator("#play").get_attribute("data-score") or 0) == 0:
        assert monotonic() < ends_s, "nothing was won"
        press_if_it_can_be(page, "start")
        press_if_it_can_be(page, "resume")
        play.wait_for_timeout(300)


def test_an_open_sessions_pages_and_those_of_what_was_played_break_no_rule(
    clinic: Clinic, shots: Path, ask: Callable[..., dict]
) -> None:
    page, play, at = clinic.page, clinic.context.new_page(), f"{clinic.address}/#"
    form = {"patient_id": clinic.patient, "confirmed_affected_side": "left", "pain_before": 3}
    session = ask(page, "POST", "/api/sessions", form)["id"]
    show(page, f"{at}/patients/{clinic.patient}/session")
    wrong = wrong_at(page, "set-up-open", shots)
    page.goto(f"{at}/live")
    expect(page.get_by_test_id("start")).to_be_enabled(timeout=ALIGNED_MS)
    wrong += wrong_at(page, "live-ready", shots)
    play.goto(f"{clinic.address}/play.html")
    wrong += [f"patient's screen, ready: {one}" for one in violations(play)]
    play_until_something_is_won(page, play)
    wrong += [f"patient's screen, playing: {one}" for one in violations(play)]
    wrong += wrong_at(page, "live-moving", shots)
    ask(page, "POST", f"/api/sessions/{session}/end", {"pain_after": 2})
    for name in ("", "/report", "/replay"):
        show(page, f"{at}/sessions/{session}{name}")
        wrong += wrong_at(page, f"played{name.replace('/', '-')}", shots)
    for name in ("progress", "report"):
        show(page, f"{at}/patients/{clinic.patient}/{name}")
        wrong += wrong_at(page, f"course-{name}", shots)
    assert not wrong, "\n".join(wrong)


def test_the_log_in_page_and_the_patients_screen_break_no_rule(clinic: Clinic, shots: Path) -> None:
    play = clinic.context.new_page()
    play.goto(clinic.address + "/play.html")
    play.locator("#play[data-face=welcome]").wait_for()
    wrong = [f"patient's screen: {one}" for one in violations(play)]
    clinic.page.get_by_test_id("log-out").click()
    clinic.page.get_by_test_id("login-demo").wait_for()
    wrong += [f"log in: {one}" for one in violations(clinic.page)]
    assert not wrong, "\n".join(wrong)


def test_every_control_is_reached_by_tab_and_shows_that_it_is(clinic: Clinic) -> None:
    wrong = []
    for name, route in routes(clinic).items():
        show(clinic.page, clinic.address + "/" + route)
        controls = clinic.page.locator("main :is(a[href], button, input, select, textarea):visible:enabled").count()
        seen = set()
        for _ in range(controls + 30):
            clinic.page.keyboard.press("Tab")
            focused = clinic.page.evaluate(FOCUSED)
            if focused is None or focused["name"].startswith("<iframe"):
                continue
            seen.add(focused["name"])
            wrong += [] if focused["shown"] else [f"{name}: no sign of the focus on {focused['name']}"]
        wrong += [] if seen else [f"{name}: nothing can be reached by Tab"]
    assert not wrong, "\n".join(sorted(set(wrong)))


def test_the_dashboard_is_a_small_download(clinic: Clinic) -> None:
    fetched: dict[str, int] = {}

    def count(response: object) -> None:
        if response.url.split("?")[0].endswith((".js", ".css", ".html", "/")):
            fetched[response.url] = len(gzip.compress(response.body()))

    fresh = clinic.context.new_page()
    fresh.on("response", count)
    fresh.goto(clinic.address)
    fresh.get_by_test_id("nav-today").wait_for()
    fresh.wait_for_load_state("networkidle")
    assert 0 < sum(fetched.values()) <= MOST_BYTES, fetched
    assert not any("three" in address for address in fetched), fetched
