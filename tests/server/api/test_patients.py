"""Patients over REST, and errors in plain words."""

import pytest

from db.account import Role
from db.queries import accounts
from server.api.auth import COOKIE


def test_a_patient_is_enrolled_listed_read_and_changed(therapist, new_patient):
    made = new_patient("Zhao")
    assert made["healthy_side"] == "right"
    assert made["passive_range"]["elbow"]["max_rad"] > 2
    assert made in therapist.get("/api/patients").json()
    changed = therapist.patch(f"/api/patients/{made['id']}", json={"notes": "tires quickly"}).json()
    assert changed["notes"] == "tires quickly"
    assert therapist.get(f"/api/patients/{made['id']}").json() == changed
    assert {k: v for k, v in changed.items() if k not in ("notes", "updated_at")} == {
        k: v for k, v in made.items() if k not in ("notes", "updated_at")
    }


def test_sr10_a_patient_is_signed_for_by_name_and_any_other_limits_end_the_signature(therapist, new_patient):
    signed = new_patient("Jin")
    assert signed["limits_set_by"] == "Dr. Lin"
    assert signed["limits_set_at"]
    path = f"/api/patients/{signed['id']}"
    assert therapist.patch(path, json={"notes": "left-handed"}).json()["limits_set_by"] == "Dr. Lin"
    same = {key: signed[key] for key in ("healthy_side", "passive_range", "force_limits", "assist_level_most")}
    assert therapist.patch(path, json=same).json()["limits_set_by"] == "Dr. Lin"


@pytest.mark.parametrize(
    "change",
    [
        {"healthy_side": "left"},
        {"passive_range": {"elbow": {"min_rad": 0.0, "max_rad": 2.0}}},
        {"force_limits": {"elbow": {"torque_nm": 20.0}}},
        {"assist_level_most": 0.5},
    ],
)
def test_sr10_changed_limits_want_a_new_signature_for_what_is_stored(therapist, new_patient, change):
    signed = new_patient("Tao")
    seen = {key: signed[key] for key in ("passive_range", "force_limits", "assist_level_most")}
    path = f"/api/patients/{signed['id']}"
    changed = therapist.patch(path, json=change).json()
    assert (changed["limits_set_by"], changed["limits_set_at"]) == ("", None)
    if "healthy_side" in change:
        return
    answer = therapist.post(f"{path}/confirm-limits", json=seen)
    assert answer.status_code == 409
    assert "seen" in answer.json()["detail"]["what"]


def test_sr10_the_patients_screen_neither_enrols_nor_signs(shared, new_patient):
    patient = new_patient("Hua")
    seen = {key: patient[key] for key in ("passive_range", "force_limits", "assist_level_most")}
    path = f"/api/patients/{patient['id']}"
    with shared.client(cookies={COOKIE: screen_log_in(shared.service)}) as screen:
        answers = [
            screen.post(f"{path}/confirm-limits", json=seen),
            screen.patch(path, json={"notes": "x"}),
            screen.post("/api/patients", json={"name": "Bai", "healthy_side": "left"}),
        ]
    assert [answer.status_code for answer in answers] == [403, 403, 403]


def test_the_patients_screen_reads_nobodys_records(shared, new_patient):
    path = f"/api/patients/{new_patient('Hua')['id']}"
    records = ["/api/patients", "/api/today", path]
    records += [f"{path}/{part}" for part in ("sessions", "plan", "adherence", "scores")]
    records += [f"/api/sessions/1{part}" for part in ("", "/curves", "/events")]
    with shared.client(cookies={COOKIE: screen_log_in(shared.service)}) as screen:
        assert {record: screen.get(record).status_code for record in records} == dict.fromkeys(records, 403)
        assert screen.patch("/api/sessions/1", json={"notes": "x"}).status_code == 403


def screen_log_in(service):
    with service.database.session() as session:
        account = accounts.find_account(session, "screen") or accounts.add_account(session, "screen", None, Role.SCREEN)
    return service.auth.open_login(account)


def test_the_forms_first_limits_are_those_kept_where_none_are_given(therapist, new_patient):
    kept = new_patient("Qian")
    for name, value in therapist.get("/api/patients/cautious-limits").json().items():
        assert kept[name] == value


def test_a_patients_range_is_kept(therapist):
    narrow = {joint: {"min_rad": 0.1, "max_rad": 0.9} for joint in ("plane", "elevation", "rotation", "elbow")}
    form = {"name": "Sun", "healthy_side": "left", "passive_range": narrow}
    assert therapist.post("/api/patients", json=form).json()["passive_range"] == narrow


@pytest.mark.parametrize(
    ("form", "named"),
    [
        ({}, "name"),
        ({"name": "", "healthy_side": "left"}, "name"),
        ({"name": "   ", "healthy_side": "left"}, "name"),
        ({"name": "Wu", "healthy_side": "up"}, "healthy_side"),
        ({"name": "Wu", "healthy_side": "left", "passive_range": {"elbow": {"min_rad": 2, "max_rad": 1}}}, "elbow"),
        ({"name": "Wu", "healthy_side": "left", "passive_range": {"elbow": {"min_rad": 0, "max_rad": 99}}}, "elbow"),
        ({"name": "Wu", "healthy_side": "left", "is_admin": True}, "is_admin"),
        ({"name": "Wu", "healthy_side": "left", "limits_set_by": "me"}, "limits_set_by"),
        ({"name": "Wu", "healthy_side": "left", "force_limits": {"elbow": {"torque_nm": 0}}}, "torque_nm"),
        ({"name": "Wu", "healthy_side": "left", "force_limits": {"elbow": {"resistance_nm": 99}}}, "resistance_nm"),
        ({"name": "Wu", "healthy_side": "left", "assist_level_most": 1.1}, "assist_level_most"),
        ({"name": "Wu", "healthy_side": "left", "assistance": "strong"}, "assistance"),
    ],
)
def test_a_wrong_form_is_refused_by_the_name_of_its_field(therapist, form, named):
    answer = therapist.post("/api/patients", json=form)
    assert answer.status_code == 422
    detail = answer.json()["detail"]
    assert set(detail) == {"what", "expected", "remedy"}
    assert named in detail["what"]


def test_a_form_that_is_no_json_is_refused(therapist):
    answer = therapist.post("/api/patients", content=b"{", headers={"content-type": "application/json"})
    assert answer.status_code == 422
    assert answer.json()["detail"]["what"]


@pytest.mark.parametrize("path", ["/api/patients/999", "/api/patients/999/sessions", "/api/sessions/999"])
def test_what_does_not_exist_is_named(therapist, path):
    answer = therapist.get(path)
    assert answer.status_code == 404
    assert "999" in answer.json()["detail"]["what"]


def test_a_number_that_is_none_is_refused_in_plain_words(therapist):
    answer = therapist.get("/api/patients/first")
    assert answer.status_code == 422
    assert "patient_id" in answer.json()["detail"]["what"]


@pytest.mark.parametrize("path", ["/api", "/api/", "/api/nothing", "/api/patients/1/nothing", "/api/../api/x"])
def test_an_unknown_route_is_a_json_404(therapist, path):
    answer = therapist.get(path)
    assert answer.status_code == 404
    assert answer.json()["detail"]["what"]


def test_a_wrong_method_is_answered_in_the_same_form(therapist):
    answer = therapist.put("/api/patients", json={})
    assert answer.status_code in (404, 405)
    assert answer.json()["detail"]["what"]


def test_games_are_listed(therapist):
    assert {"name": "reach"} in therapist.get("/api/games").json()
