"""SR-11: one authority at a time; two pages, and one of them is pulled."""

import time

import httpx
import pytest
from websockets.exceptions import InvalidStatus

from db.account import Role
from db.queries import accounts
from server.api.auth import COOKIE


def until(condition):
    """Wait for something that happens elsewhere."""
    for _ in range(400):
        if found := condition():
            return found
        time.sleep(0.025)
    return pytest.fail("it did not happen")


def state(page):
    return until(lambda: page.messages)[-1]["tick"]["state"]


@pytest.fixture
def colleague(shared):
    """Somebody else who may treat, at another browser."""
    with logged_in_as(shared, "Dr. Qian", Role.THERAPIST) as client:
        yield client


@pytest.fixture
def screen(shared):
    """The patient's screen."""
    with logged_in_as(shared, "screen", Role.SCREEN) as client:
        yield client


def logged_in_as(service, name, role):
    auth = service.service.auth
    with service.service.database.session() as session:
        account = accounts.find_account(session, name) or accounts.add_account(session, name, None, role)
    client = httpx.Client(base_url=service.url, timeout=20, trust_env=False)
    client.cookies.set(COOKIE, auth.open_login(account))
    return client


@pytest.fixture
def in_charge(shared, therapist, new_patient, look):
    """The page that opened a session, with the arm engaged."""
    page = look(therapist, "first")
    form = {"patient_id": new_patient()["id"], "confirmed_affected_side": "left"}
    page.session = page.post("/api/sessions", **form).raise_for_status().json()
    page.path = f"/api/sessions/{page.session['id']}"
    page.post(f"{page.path}/control", action="start").raise_for_status()
    yield page
    if therapist.get("/api/sessions/current").json():
        page.post(f"{page.path}/authority", confirmed=True).raise_for_status()
        page.post(f"{page.path}/end").raise_for_status()


def holder(client):
    return client.get("/api/sessions/current/authority").json()


def test_sr11_whoever_opens_a_session_is_in_charge_and_everybody_sees_it(in_charge, colleague, look):
    assert holder(colleague) == {"account": "Dr. Lin", "client": "first", "connected": True}
    other = look(colleague, "second")
    shown = until(lambda: other.messages and other.messages[-1]["session"])
    assert shown["authority"] == holder(colleague)
    until(lambda: other.messages[-1]["tick"]["authority"] == "Dr. Lin")


@pytest.mark.parametrize("browser", ["colleague", "therapist"])
def test_sr11_another_page_may_hold_and_stop_and_call_pain_and_nothing_else(in_charge, browser, look, request):
    """Also another page of the same person."""
    other = look(request.getfixturevalue(browser), "second")
    path = in_charge.path
    asked = {
        "control": [{"action": action} for action in ("start", "resume", "reset")],
        "assistance": [{"mode": "free", "level": 0.1}],
        "follow": [{"sensor": "left", "body": "3"}],
        "measured-range": [{}],
        "end": [{}],
    }
    for route, forms in asked.items():
        for form in forms:
            answer = other.post(f"{path}/{route}", **form)
            assert answer.status_code == 409
            assert "in charge" in answer.json()["detail"]["what"]
    states = [other.post(f"{path}/control", action=action).json()["state"] for action in ("hold", "pain", "stop")]
    assert states == ["hold", "hold", "stopped"]


def test_sr11_a_pulled_connection_is_a_hold_though_its_socket_stays_open(in_charge, colleague, look):
    other = look(colleague, "second")
    until(lambda: state(other) == "engaged")
    in_charge.pull()
    until(lambda: state(other) == "hold")
    assert other.messages[-1]["tick"]["authority"] == ""
    assert holder(colleague) == {"account": "Dr. Lin", "client": "first", "connected": False}


def test_sr11_a_page_that_is_left_is_a_hold_and_has_its_place_back_when_it_returns(therapist, in_charge, look):
    watcher = look(therapist, "second")
    until(lambda: state(watcher) == "engaged")
    in_charge.close()
    until(lambda: state(watcher) == "hold")
    assert in_charge.post(f"{in_charge.path}/control", action="resume").status_code == 409
    back = look(therapist, "first")
    until(lambda: holder(therapist)["connected"])
    time.sleep(0.3)
    assert state(watcher) == "hold", "nothing resumes by itself"
    assert back.post(f"{in_charge.path}/control", action="resume").json()["state"] == "engaged"


def test_sr11_taking_over_wants_a_confirmation_holds_the_arm_and_is_noted(in_charge, colleague, look):
    other = look(colleague, "second")
    refused = other.post(f"{in_charge.path}/authority", confirmed=False)
    assert refused.status_code == 409
    assert "Dr. Lin" in refused.json()["detail"]["what"]
    taken = other.post(f"{in_charge.path}/authority", confirmed=True).json()
    assert taken == {"account": "Dr. Qian", "client": "second", "connected": True}
    until(lambda: state(other) == "hold")
    assert in_charge.post(f"{in_charge.path}/control", action="resume").status_code == 409
    assert other.post(f"{in_charge.path}/control", action="resume").json()["state"] == "engaged"
    assert in_charge.post(f"{in_charge.path}/control", action="stop").json()["state"] == "stopped"
    events = until(
        lambda: [event for event in colleague.get(f"{in_charge.path}/events").json() if event["kind"] == "taken over"]
    )
    assert events[0]["text"] == "Dr. Qian took over from Dr. Lin"


def test_sr11_a_lost_page_can_be_followed_by_another_without_a_confirmation(in_charge, colleague, look):
    in_charge.close()
    other = look(colleague, "second")
    assert other.post(f"{in_charge.path}/authority").json()["account"] == "Dr. Qian"


def test_sr11_the_same_page_open_twice_is_one_page_the_newest(therapist, in_charge, look):
    newest = look(therapist, "first")
    until(lambda: in_charge.closed_with == 4409)
    until(lambda: newest.messages)
    assert holder(therapist)["connected"]


def test_sr11_the_patients_screen_never_comes_into_charge(in_charge, screen, look, new_patient):
    page = look(screen, "patient")
    assert page.post(f"{in_charge.path}/authority", confirmed=True).status_code == 403
    form = {"patient_id": in_charge.session["patient_id"], "confirmed_affected_side": "left"}
    assert page.post("/api/sessions", **form).status_code == 403
    assert page.post(f"{in_charge.path}/control", action="pain").json()["state"] == "hold"
    ended = in_charge.post(f"{in_charge.path}/end").json()
    assert [metric["value"] for metric in ended["metrics"] if metric["name"] == "pain_calls"] == [1]


def test_sr11_it_is_noted_when_nobody_is_in_charge(therapist, in_charge):
    in_charge.close()

    def noted():
        events = therapist.get(f"{in_charge.path}/events").json()
        return [event["data"]["after"] for event in events if event["kind"] == "authority"]

    assert until(lambda: len(noted()) == 2 and noted()) == ["Dr. Lin", ""]


@pytest.mark.parametrize("name", ["a b", "x" * 65, "<script>"])
def test_a_page_cannot_have_any_name(therapist, name):
    answer = therapist.post("/api/sessions/1/control", json={"action": "stop"}, headers={"Mirrorlimb-Client": name})
    assert answer.status_code == 422
    assert "Mirrorlimb-Client" in answer.json()["detail"]["what"]


@pytest.mark.parametrize("route", ["sessions", "authority"])
def test_sr11_a_page_without_a_name_comes_into_charge_of_nothing(colleague, in_charge, route):
    form = {"patient_id": in_charge.session["patient_id"], "confirmed_affected_side": "left"}
    asked = {"sessions": ("/api/sessions", form), "authority": (f"{in_charge.path}/authority", {"confirmed": True})}
    path, body = asked[route]
    answer = colleague.post(path, json=body)
    assert answer.status_code == 422
    assert "Mirrorlimb-Client" in answer.json()["detail"]["expected"]
    stopped = colleague.post(f"{in_charge.path}/control", json={"action": "stop"})
    assert stopped.json()["state"] == "stopped", "a stop is never refused for that"


def test_a_stream_of_a_page_with_an_impossible_name_is_refused(therapist, look):
    with pytest.raises(InvalidStatus) as refused:
        look(therapist, "a%20b")
    assert refused.value.response.status_code == 422
