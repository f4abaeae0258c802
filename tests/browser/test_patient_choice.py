"""Two people before two sensors: the therapist sees both and says who the patient is."""

from __future__ import annotations

import re
from collections.abc import Callable
from pathlib import Path

import pytest
from playwright.sync_api import Page, expect

pytestmark = pytest.mark.browser

SEEN_MS = 45_000


def test_the_therapist_says_who_of_two_people_is_the_patient(
    start_service: Callable, crowd: Callable, page: Page, shots: Path
) -> None:
    service = start_service("--demo")
    page.goto(service.address)
    page.get_by_test_id("login-demo").click()
    expect(page.get_by_test_id("open-session").first).to_be_visible()
    ports = page.request.get(f"{service.address}/api/station").json()["ports"]
    with crowd(ports["kinectv2-osc"]) as people:
        page.get_by_test_id("open-session").first.click()
        page.get_by_test_id("confirm-side-left").click()
        page.get_by_test_id("begin-session").click()
        page.get_by_test_id("nav-live").click()
        people.visitor_comes()
        question = page.get_by_test_id("who")
        expect(question.get_by_test_id("person")).to_have_count(2, timeout=SEEN_MS)
        expect(page.locator("[data-testid=sensor-row][data-aligned=true]")).to_have_count(2, timeout=SEEN_MS)
        page.wait_for_timeout(1500)
        page.screenshot(path=shots / "who-1-question.png")
        page.set_viewport_size({"width": 1024, "height": 768})
        page.get_by_role("button", name="中文").click()
        expect(question).to_contain_text("另一个人")
        page.screenshot(path=shots / "who-2-chinese.png")
        page.get_by_role("button", name="English").click()
        followed, other = question.get_by_test_id("person").all()
        expect(followed).to_contain_text("Followed as the patient")
        expect(other).to_contain_text("Another person")
        body = (other.get_attribute("data-bodies") or "").split()[0]
        other.get_by_role("button").focus()
        page.keyboard.press("Enter")
        expect(question).to_be_hidden()
        page.get_by_test_id("ask-who").click()
        chosen = question.get_by_test_id("person").first
        expect(chosen).to_have_attribute("data-bodies", re.compile(body), timeout=SEEN_MS)
        expect(chosen).to_contain_text("Patient confirmed")
        page.wait_for_timeout(1000)
        page.screenshot(path=shots / "who-3-confirmed.png")
        page.get_by_test_id("who-close").click()
        expect(question).to_be_hidden()
        page.screenshot(path=shots / "who-4-closed.png")
