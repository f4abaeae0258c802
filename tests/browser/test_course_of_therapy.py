"""A course of therapy in a real browser: planned, played, watched again, scored, looked at, and put on paper."""

from __future__ import annotations

import io
import re
from datetime import date, timedelta
from pathlib import Path
from time import monotonic

import numpy as np
import pytest
from PIL import Image
from playwright.sync_api import Locator, Page, expect

pytestmark = pytest.mark.browser

PLAYED_S = 4
WAITED_MS = 45_000
"""Generous: a busy machine must not fail a test that is about what is shown."""
DRAWN_MS = 3000
"""Longer than the page waits before it asks the service again, and than a busy machine draws."""
PAGE_OF_PDF = re.compile(rb"/Type\s*/Page\b")
A4_POINTS = (595, 842)
ZOOMED = {"width": 640, "height": 360}
"""What 1280 × 720 leaves at 200 %."""

# The page that asks is the dashboard, whose stream is open: it is in charge of what it opens.
ASK = """async ([method, path, body]) => {
  const headers = { "Content-Type": "application/json",
                    "Mirrorlimb-Client": sessionStorage.getItem("mirrorlimb.client.dashboard") };
  const answer = await fetch(path, { method, headers, ...(body && { body: JSON.stringify(body) }) });
  return [answer.status, await answer.json().catch(() => null)];
}"""


def ask(page: Page, method: str, path: str, body: dict | None = None) -> dict:
    status, answer = page.evaluate(ASK, [method, path, body])
    assert status < 300, answer
    return answer


def until(page: Page, condition) -> None:
    ends_s = monotonic() + WAITED_MS / 1000
    while not condition():
        assert monotonic() < ends_s, "it did not happen"
        page.wait_for_timeout(200)


def pixels(shown: Locator, file: Path) -> np.ndarray:
    """A screenshot as (height, width, 3), kept as a file to be looked at."""
    return np.asarray(Image.open(io.BytesIO(shown.screenshot(path=file))).convert("RGB"), float)


def tab_to(page: Page, test_id: str) -> None:
    """By the Tab key alone."""
    for _ in range(120):
        page.keyboard.press("Tab")
        if page.evaluate("document.activeElement?.dataset?.testid") == test_id:
            return
    pytest.fail(f"{test_id} cannot be reached by the keyboard")


@pytest.fixture
def dashboard(start_service, page: Page) -> Page:
    """Logged in at the demonstration."""
    page.goto(start_service("--demo").address)
    page.get_by_test_id("login-demo").click()
    page.get_by_test_id("tab-plan").wait_for()
    return page


def patient_of(page: Page) -> int:
    return int(re.search(r"patients/(\d+)", page.url)[1])


def start_moving(page: Page, session: int) -> None:
    """A person presses Start, and Resume where a busy machine made the station hold."""

    def state() -> str:
        return ask(page, "GET", "/api/station")["state"]

    def begin() -> bool:
        action = {"ready": "start", "hold": "resume"}.get(state())
        if action:  # refused while the sensors are not aligned
            page.evaluate(ASK, ["POST", f"/api/sessions/{session}/control", {"action": action}])
        return state() == "engaged"

    until(page, begin)


def play_a_session(page: Page, patient: int) -> int:
    form = {"patient_id": patient, "confirmed_affected_side": "left", "pain_before": 4}
    session = ask(page, "POST", "/api/sessions", form)["id"]
    start_moving(page, session)
    page.wait_for_timeout(PLAYED_S * 1000)
    ask(page, "POST", f"/api/sessions/{session}/control", {"action": "pain"})
    page.wait_for_timeout(800)
    ask(page, "POST", f"/api/sessions/{session}/end", {"pain_after": 2})
    return session


def test_a_plan_is_made_by_the_keyboard_alone_and_opens_the_next_session(dashboard: Page, shots: Path) -> None:
    patient = patient_of(dashboard)
    dashboard.get_by_test_id("tab-plan").focus()
    dashboard.keyboard.press("Enter")
    dashboard.get_by_test_id("plan-exercise").wait_for()
    tab_to(dashboard, "plan-minutes")
    dashboard.keyboard.press("Control+a")
    dashboard.keyboard.type("4.5")
    tab_to(dashboard, "add-trace")
    dashboard.keyboard.press("Enter")
    tab_to(dashboard, "plan-per-week")
    dashboard.keyboard.press("Control+a")
    dashboard.keyboard.type("99")
    expect(dashboard.get_by_text("A number from 1 to 14.")).to_be_visible()
    expect(dashboard.get_by_test_id("save-plan")).to_be_disabled()
    dashboard.keyboard.press("Control+a")
    dashboard.keyboard.type("5")
    tab_to(dashboard, "save-plan")
    dashboard.keyboard.press("Enter")
    expect(dashboard.get_by_test_id("plan-saved")).to_be_visible()

    dashboard.reload()
    expect(dashboard.get_by_test_id("plan-exercise")).to_have_count(2)
    expect(dashboard.get_by_test_id("plan-sum")).to_contain_text("20 sessions of 9.5 minutes")
    dashboard.screenshot(path=shots / "plan.png", full_page=True)
    form = {"patient_id": patient, "confirmed_affected_side": "left"}
    opened = ask(dashboard, "POST", "/api/sessions", form)
    assert [(one["game"], one["minutes"]) for one in opened["exercises"]] == [("reach", 4.5), ("trace", 5)]


def test_scores_are_checked_listed_and_deleted_after_a_question(dashboard: Page) -> None:
    dashboard.get_by_test_id("tab-scores").click()
    dashboard.get_by_test_id("score-value").fill("67")
    expect(dashboard.get_by_text("Fugl-Meyer UE is a whole number from 0 to 66.")).to_be_visible()
    expect(dashboard.get_by_test_id("save-score")).to_be_disabled()
    dashboard.get_by_test_id("score-value").fill("41")
    dashboard.get_by_test_id("score-on").fill((date.today() + timedelta(days=2)).isoformat())
    expect(dashboard.get_by_test_id("save-score")).to_be_disabled()
    dashboard.get_by_test_id("score-on").fill(date.today().isoformat())
    dashboard.get_by_test_id("score-rater").fill("Dr. Qian")
    dashboard.get_by_test_id("save-score").click()
    row = dashboard.get_by_test_id("score-row")
    expect(row).to_contain_text("41 / 66")
    expect(row).to_contain_text("Dr. Qian")

    dashboard.get_by_test_id("remove-score").click()
    expect(dashboard.get_by_test_id("keep-score")).to_be_focused()
    dashboard.get_by_test_id("keep-score").click()
    expect(row).to_have_count(1)
    dashboard.get_by_test_id("remove-score").click()
    dashboard.get_by_test_id("confirm-remove-score").click()
    expect(row).to_have_count(0)


def check_progress(page: Page, shots: Path) -> None:
    page.get_by_test_id("tab-progress").click()
    expect(page.get_by_test_id("verdict").first).to_be_visible()
    expect(page.get_by_test_id("trust")).to_contain_text("Trust:")
    expect(page.get_by_test_id("joint-ranges")).to_have_count(4)
    assert page.get_by_test_id("progress-row").count() > 20
    page.get_by_test_id("choose-figure").select_option("range_of_movement/elbow")
    expect(page.get_by_test_id("progress-figure")).to_have_attribute("data-family", "range_of_movement/elbow")
    expect(page.get_by_test_id("verdict")).to_have_count(2)
    page.screenshot(path=shots / "progress.png", full_page=True)


def seconds(page: Page) -> float:
    return float(page.get_by_test_id("replay-position").get_attribute("data-seconds"))


def scrub(page: Page, to_s: float) -> None:
    """As a finger does."""
    move = "(slider, to) => { slider.value = to; slider.dispatchEvent(new Event('input', { bubbles: true })); }"
    page.get_by_test_id("replay-scrub").evaluate(move, to_s)
    until(page, lambda: seconds(page) == pytest.approx(to_s, abs=0.2))


def check_replay(page: Page, session: int, shots: Path) -> None:
    page.goto(f"{page.url.split('#')[0]}#/sessions/{session}/replay")
    page.frame_locator("[data-testid=replay-view]").locator("canvas").first.wait_for()
    expect(page.get_by_test_id("replay-play")).to_have_attribute("data-playing", "true")
    page.get_by_text("Events (").click()
    page.locator("[data-testid=replay-event][data-kind=pain]").click()
    page.get_by_test_id("replay-play").click()
    expect(page.get_by_test_id("replay-play")).to_have_attribute("data-playing", "false")
    stands_s = seconds(page)
    page.wait_for_timeout(DRAWN_MS)
    assert seconds(page) == pytest.approx(stands_s, abs=0.2), "a paused replay goes on"

    before = pixels(page.get_by_test_id("replay-view"), shots / "replay-pain.png")
    scrub(page, stands_s - PLAYED_S / 2)
    page.wait_for_timeout(DRAWN_MS)
    after = pixels(page.get_by_test_id("replay-view"), shots / "replay-earlier.png")
    assert before.std() > 5, "the replay is blank"
    assert (np.abs(after - before).max(axis=2) > 24).mean() > 0.0005, "the picture does not follow the time line"
    page.screenshot(path=shots / "replay.png", full_page=True)


def check_report(page: Page, route: str, shots: Path) -> None:
    for language, disclaimer in (("en", "not a medical device"), ("zh", "不是医疗器械")):
        page.get_by_test_id(f"language-{language}").click()
        page.goto(f"{page.url.split('#')[0]}#/{route}")
        expect(page.get_by_test_id("report")).to_contain_text(disclaimer)
        page.wait_for_load_state("networkidle")
        pdf = page.pdf(path=shots / f"report-{route.replace('/', '-')}-{language}.pdf", prefer_css_page_size=True)
        assert len(PAGE_OF_PDF.findall(pdf)) == 1, "the report does not fit on one page"
        box = re.search(rb"/MediaBox\s*\[\s*0 0 ([\d.]+) ([\d.]+)", pdf)
        assert [float(edge) for edge in box.groups()] == pytest.approx(A4_POINTS, abs=1)
    page.get_by_test_id("language-en").click()


def check_zoom(page: Page, routes: list[str]) -> None:
    page.set_viewport_size(ZOOMED)
    for route in routes:
        page.goto(f"{page.url.split('#')[0]}#/{route}")
        page.wait_for_load_state("networkidle")
        assert page.evaluate("document.documentElement.scrollWidth") <= ZOOMED["width"], route


def test_a_course_is_played_watched_again_looked_at_and_printed(dashboard: Page, shots: Path) -> None:
    patient = patient_of(dashboard)
    sessions = [play_a_session(dashboard, patient) for _ in range(2)]
    score = {"kind": "arat", "side": "left", "value": 31, "on": date.today().isoformat(), "rater": "Dr. Lin"}
    ask(dashboard, "POST", f"/api/patients/{patient}/scores", score)
    dashboard.reload()
    expect(dashboard.get_by_test_id("session-row")).to_have_count(2)

    check_progress(dashboard, shots)
    expect(dashboard.get_by_test_id("progress-scores")).to_contain_text("ARAT")
    check_replay(dashboard, sessions[0], shots)
    check_report(dashboard, f"sessions/{sessions[1]}/report", shots)
    check_report(dashboard, f"patients/{patient}/report", shots)
    check_zoom(dashboard, [f"patients/{patient}/{name}" for name in ("plan", "progress", "scores", "report")])


def test_a_replay_gives_way_to_a_session(dashboard: Page) -> None:
    patient = patient_of(dashboard)
    session = play_a_session(dashboard, patient)
    dashboard.goto(f"{dashboard.url.split('#')[0]}#/sessions/{session}/replay")
    dashboard.get_by_test_id("replay-play").wait_for()
    ask(dashboard, "POST", "/api/sessions", {"patient_id": patient, "confirmed_affected_side": "left"})
    expect(dashboard.get_by_test_id("replay-gone")).to_be_visible()
    dashboard.get_by_test_id("replay-gone").get_by_role("button").click()
    expect(dashboard.get_by_test_id("problem")).to_contain_text("needed for the arm")
