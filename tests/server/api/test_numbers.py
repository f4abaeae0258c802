"""Numbers that no row can have are refused in plain words, wherever one is given."""

import pytest

from server.api.app import describe_app
from server.api.openapi import openapi_document

HUGE = 99_999_999_999_999_999_999
ASKED = [
    (method, path)
    for path, methods in openapi_document(describe_app())["paths"].items()
    for method in methods
    if "_id}" in path or "{number}" in path
]


def refused(answer):
    assert answer.status_code == 422
    said = answer.json()["detail"]
    assert "than or equal to" in said["what"] + said["expected"]
    assert said["remedy"]


@pytest.mark.parametrize("number", [HUGE, -HUGE, 2**63])
def test_a_number_that_the_database_cannot_hold_is_refused_in_an_address(therapist, number):
    assert len(ASKED) > 20
    for method, path in ASKED:
        address = path.format(patient_id=number, session_id=number, number=number)
        refused(therapist.request(method, address, json={}))


def test_a_score_whose_number_the_database_cannot_hold_is_refused_for_a_patient_who_is_there(therapist, new_patient):
    refused(therapist.delete(f"/api/patients/{new_patient('Bao')['id']}/scores/{HUGE}"))


@pytest.mark.parametrize(
    ("method", "path", "form"),
    [
        ("PUT", "/api/replay", {"session_id": HUGE}),
        ("POST", "/api/sessions", {"patient_id": HUGE, "confirmed_affected_side": "left"}),
    ],
)
def test_a_number_that_the_database_cannot_hold_is_refused_in_a_form(therapist, method, path, form):
    refused(therapist.request(method, path, json=form))


def test_a_number_that_nothing_has_is_not_found(therapist):
    assert therapist.get(f"/api/patients/{2**53 - 1}").status_code == 404
    assert therapist.get("/api/sessions/0").status_code == 404
