"""Plans over REST, what was done of them, today's list, and scores that people enter."""

from datetime import date, timedelta

import pytest

from db.exercise import Exercise, PlayedExercise
from db.queries import sessions
from db.therapy_session import SessionStatus, TherapySession
from server.api import adherence

REACH = {"game": "reach", "minutes": 6.0, "level": None, "pinned": False}


def plan_form(**more):
    monday = adherence.monday_of(adherence.today())
    form = {"exercises": [REACH], "sessions_per_week": 7, "weeks": 4, "starts_on": str(monday), "note": "slowly"}
    return form | more


def put_plan(client, patient, **more):
    return client.put(f"/api/patients/{patient['id']}/plan", json=plan_form(**more))


def row_of(client, patient):
    (row,) = [row for row in client.get("/api/today").json() if row["id"] == patient["id"]]
    return row


@pytest.fixture
def trained(shared):
    """Stores a session that was played for some minutes, begun some days ago."""

    def store(patient, minutes, days_ago=0, status=SessionStatus.ENDED):
        started = adherence.beginning_of(adherence.today() - timedelta(days=days_ago)) + timedelta(hours=1)
        played = PlayedExercise(game="reach", played_s=60 * minutes, score=90, hits=6, misses=2, level=0.4)
        with shared.service.database.session() as session:
            row = TherapySession(
                patient_id=patient["id"],
                therapist_id=1,
                affected_side="left",
                exercises=(Exercise(game="reach", minutes=6.0, level=0.3),),
                played=(played,) if minutes else (),
                seed=1,
                started_at=started,
                status=status,
                measured=True,
            )
            return sessions.add_session(session, row).id

    return store


def test_a_plan_is_made_read_and_replaced(therapist, new_patient):
    patient = new_patient("Yu")
    path = f"/api/patients/{patient['id']}/plan"
    missing = therapist.get(path)
    assert missing.status_code == 404
    assert missing.json()["detail"]["what"] == "Yu has no plan yet"
    made = put_plan(therapist, patient).json()
    assert {key: made[key] for key in plan_form()} == plan_form()
    assert made["updated_by"] == "Dr. Lin"
    put_plan(therapist, patient, sessions_per_week=2, exercises=[REACH | {"level": 0.5, "pinned": True}])
    replaced = therapist.get(path).json()
    assert (replaced["sessions_per_week"], replaced["exercises"][0]["pinned"]) == (2, True)


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"exercises": []}, "exercises"),
        ({"exercises": [REACH | {"game": "chess"}]}, "chess"),
        ({"exercises": [REACH | {"minutes": 0}]}, "minutes"),
        ({"exercises": [REACH | {"level": 1.5}]}, "level"),
        ({"sessions_per_week": 0}, "sessions_per_week"),
        ({"weeks": 0}, "weeks"),
        ({"starts_on": "soon"}, "starts_on"),
        ({"starts_on": "9999-12-01"}, "more than a year from now"),
    ],
)
def test_a_plan_that_cannot_be_is_refused_by_name(therapist, new_patient, change, named):
    answer = put_plan(therapist, new_patient("Lu"), **change)
    assert answer.status_code == 422
    assert named in answer.json()["detail"]["what"]


def test_a_patient_is_due_until_today_is_done(therapist, new_patient, trained):
    patient = new_patient("Due")
    assert row_of(therapist, patient)["plan"] is None
    assert not row_of(therapist, patient)["due"]
    put_plan(therapist, patient).raise_for_status()
    row = row_of(therapist, patient)
    assert (row["due"], row["done_this_week"], row["planned_this_week"]) == (True, 0, 7)
    assert row["plan"]["minutes"] == 6.0
    assert (row["plan"]["week"], row["last_session"], row["limits_signed"]) == (1, None, True)
    trained(patient, minutes=0)
    unplayed = trained(patient, minutes=0.9)
    assert row_of(therapist, patient)["due"]
    assert row_of(therapist, patient)["last_session"]["id"] == unplayed
    trained(patient, minutes=5)
    row = row_of(therapist, patient)
    assert (row["due"], row["done_this_week"], row["last_session"]["minutes"]) == (False, 1, 5.0)


def test_a_week_of_more_sessions_than_days_is_due_twice_a_day(therapist, new_patient, trained):
    patient = new_patient("Twice")
    put_plan(therapist, patient, sessions_per_week=14).raise_for_status()
    due = [row_of(therapist, patient)["due"]]
    for _ in range(2):
        trained(patient, minutes=5)
        due.append(row_of(therapist, patient)["due"])
    assert due == [True, True, False]


def test_those_who_are_due_come_first(therapist, new_patient):
    put_plan(therapist, new_patient("Zz due")).raise_for_status()
    new_patient("Aa not due")
    due = [row["due"] for row in therapist.get("/api/today").json()]
    assert due == sorted(due, reverse=True)


def test_a_plan_that_has_not_begun_or_is_over_asks_for_nothing(therapist, new_patient):
    patient = new_patient("Later")
    for days in (7, -70):
        monday = adherence.monday_of(adherence.today()) + timedelta(days=days)
        put_plan(therapist, patient, starts_on=str(monday)).raise_for_status()
        row = row_of(therapist, patient)
        assert (row["due"], row["planned_this_week"]) == (False, 0)


def test_adherence_counts_what_was_played_per_day_and_week(therapist, new_patient, trained):
    patient = new_patient("Steady")
    monday = adherence.monday_of(adherence.today()) - timedelta(days=7)
    put_plan(therapist, patient, starts_on=str(monday), sessions_per_week=3).raise_for_status()
    for minutes, days_ago in ((5, 7), (3, 7), (4, 0), (0, 0), (9, 40)):
        trained(patient, minutes, days_ago)
    trained(patient, 2, status=SessionStatus.OPEN)
    found = therapist.get(f"/api/patients/{patient['id']}/adherence?weeks=2").json()
    assert found["weeks"] == [
        {"monday": str(monday), "done": 2, "planned": 3},
        {"monday": str(monday + timedelta(days=7)), "done": 1, "planned": 3},
    ]
    assert len(found["days"]) == 14
    done = {day["on"]: (day["sessions"], day["minutes"], day["repetitions"]) for day in found["days"]}
    assert done[str(adherence.today() - timedelta(days=7))] == (2, 8.0, 16)
    assert done[str(adherence.today())] == (1, 4.0, 8)
    assert sum(sessions for sessions, *_ in done.values()) == 3


def test_without_a_plan_nothing_was_planned(therapist, new_patient):
    found = therapist.get(f"/api/patients/{new_patient('Free')['id']}/adherence").json()
    assert [week["planned"] for week in found["weeks"]] == [0] * 12


def test_a_score_is_entered_listed_by_day_and_taken_back(therapist, new_patient):
    patient = new_patient("Gu")
    path = f"/api/patients/{patient['id']}/scores"
    form = {"kind": "arat", "side": "left", "value": 31, "on": "2026-03-02", "rater": "Dr. He"}
    later = therapist.post(path, json=form).json()
    earlier = therapist.post(path, json=form | {"on": "2026-02-02", "value": 20}).json()
    assert therapist.get(path).json() == [earlier, later]
    assert (later["entered_by"], later["rater"]) == ("Dr. Lin", "Dr. He")
    elsewhere = f"/api/patients/{new_patient('He')['id']}/scores/{later['id']}"
    assert therapist.delete(elsewhere).status_code == 404
    assert therapist.delete(f"{path}/{later['id']}").status_code == 204
    assert therapist.get(path).json() == [earlier]


@pytest.mark.parametrize(
    ("change", "named"),
    [
        ({"value": 58}, "57"),
        ({"kind": "barthel"}, "kind"),
        ({"rater": " "}, "rater"),
        ({"on": str(date.today() + timedelta(days=2))}, "still to come"),
    ],
)
def test_a_score_that_cannot_be_is_refused(therapist, new_patient, change, named):
    form = {"kind": "arat", "side": "left", "value": 31, "on": "2026-03-02", "rater": "Dr. He"} | change
    answer = therapist.post(f"/api/patients/{new_patient('Mo')['id']}/scores", json=form)
    assert answer.status_code == 422
    assert named in answer.json()["detail"]["what"]
