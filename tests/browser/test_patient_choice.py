"""Two people before two sensors: the therapist sees both and says who the patient is."""

from __future__ import annotations

import re
import socket
from collections.abc import Iterator
from contextlib import ExitStack, contextmanager
from dataclasses import replace
from pathlib import Path
from threading import Event, Thread

import pytest
from playwright.sync_api import Page, expect

from fusion.formats.registry import dialect_named
from fusion.skeleton import Side
from fusion.virtual_patient.bystander import Bystander, Visit
from fusion.virtual_patient.patient import VirtualPatient
from fusion.virtual_patient.trial import sensors_for

pytestmark = pytest.mark.browser

SEEN_MS = 45_000
STEP_S = 1 / 60
ADDRESSES = ("127.0.0.41", "127.0.0.42")
PATIENT, VISITOR = "72057594037930000", "72057594037939999"
"""As long as a Kinect's own numbers."""


@contextmanager
def two_people(port: int) -> Iterator[None]:
    """Two virtual sensors that send real OSC of a patient and somebody who stands beside, until the end."""
    ended = Event()
    with ExitStack() as stack:
        sockets = [stack.enter_context(socket.socket(socket.AF_INET, socket.SOCK_DGRAM)) for _ in ADDRESSES]
        for opened, address in zip(sockets, ADDRESSES, strict=True):
            opened.bind((address, 0))
            opened.connect(("127.0.0.1", port))
        sending = Thread(target=_send, args=(sockets, ended))
        sending.start()
        try:
            yield
        finally:
            ended.set()
            sending.join()


def _send(sockets: list[socket.socket], ended: Event) -> None:
    dialect = dialect_named("kinectv2-osc")
    patient, visitor = VirtualPatient(Side.RIGHT, 3), Bystander(Visit.STANDS, 4)
    shown = [(PATIENT, sensors_for(Side.RIGHT, 3)), (VISITOR, sensors_for(Side.RIGHT, 30))]
    while not ended.wait(STEP_S):
        bodies = patient.step(STEP_S), visitor.step(STEP_S)
        for (number, sensors), positions in zip(shown, bodies, strict=True):
            for opened, sensor in zip(sockets, sensors, strict=True):
                sample = sensor.see(positions, patient.t_s)
                for datagram in dialect.encode(replace(sample, body=number), 0) if sample else ():
                    opened.send(datagram)


def test_the_therapist_says_who_of_two_people_is_the_patient(start_service, page: Page, shots: Path) -> None:
    service = start_service("--demo")
    page.goto(service.address)
    page.get_by_test_id("login-demo").click()
    expect(page.get_by_test_id("open-session").first).to_be_visible()
    ports = page.request.get(f"{service.address}/api/station").json()["ports"]
    with two_people(ports["kinectv2-osc"]):
        page.get_by_test_id("open-session").first.click()
        page.get_by_test_id("confirm-side-left").click()
        page.get_by_test_id("begin-session").click()
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
