"""What is measured, and how a patient's figures went, over REST."""

from datetime import UTC, datetime, timedelta

import pytest

from db.clinical_score import GREATEST
from db.exercise import Exercise
from db.queries import sessions
from db.therapy_session import Metric, SessionStatus, TherapySession
from fusion.metrics.catalogue import MEASURES


@pytest.fixture
def measured(shared):
    """Stores a session with figures, begun on some day of March."""

    def store(patient, day, *metrics, status=SessionStatus.ENDED, **more):
        with shared.service.database.session() as session:
            row = TherapySession(
                patient_id=patient["id"],
                therapist_id=1,
                affected_side="left",
                exercises=(Exercise(game="reach", minutes=6.0),),
                seed=1,
                started_at=datetime(2026, 3, 1, tzinfo=UTC) + timedelta(days=day),
                status=status,
                measured=True,
                **more,
            )
            stored = sessions.add_session(session, row)
            sessions.replace_metrics(session, stored.id, [Metric(**one, session_id=stored.id) for one in metrics])
            return stored.id

    return store


def own_range(value, sem=0.05, **more):
    return {"name": "own_range", "joint": "elbow", "side": "left", "unit": "rad", "value": value, "sem": sem} | more


def lines_of(client, patient):
    said = client.get(f"/api/patients/{patient['id']}/progress").json()
    return {(line["name"], line["joint"], line["side"]): line for line in said["lines"]}


def test_a_figure_is_told_over_the_sessions_with_what_is_more_than_chance(therapist, new_patient, measured):
    patient = new_patient("Song")
    later = measured(patient, 8, own_range(1.5))
    first = measured(patient, 1, own_range(1.1))
    line = lines_of(therapist, patient)["own_range", "elbow", "left"]
    assert [point["session_id"] for point in line["points"]] == [first, later]
    assert line["difference"] == pytest.approx(0.4)
    assert line["mdc"] == pytest.approx(1.96 * 2**0.5 * 0.05)
    assert (line["verdict"], line["better"], line["trust"]) == ("better", "more", "good")


def test_what_the_drive_did_is_not_judged(therapist, new_patient, measured):
    patient = new_patient("Peng")
    for day, value in ((1, 0.5), (3, 1.5)):
        measured(patient, day, own_range(value, name="range_of_movement", caveat="caveat.passive_drive"))
    line = lines_of(therapist, patient)["range_of_movement", "elbow", "left"]
    assert line["verdict"] == "unknown"
    assert line["points"][0]["caveat"] == "caveat.passive_drive"


def test_the_healthy_arm_gets_neither_better_nor_worse_and_the_cameras_error_counts(therapist, new_patient, measured):
    patient = new_patient("Shen")
    for day, value in ((1, 0.5), (3, 1.5)):
        sides = [own_range(value, name="range_of_movement", side=side) for side in ("left", "right")]
        measured(patient, day, *sides)
    lines = lines_of(therapist, patient)
    affected, healthy = (lines["range_of_movement", "elbow", side] for side in ("left", "right"))
    assert (affected["verdict"], healthy["verdict"]) == ("better", "changed")
    assert healthy["mdc"] > affected["mdc"] == pytest.approx(1.96 * 2**0.5 * 0.05)


def test_pain_is_a_line_of_its_own(therapist, new_patient, measured):
    patient = new_patient("Deng")
    measured(patient, 1, pain_before=5, pain_after=4)
    measured(patient, 2, pain_before=2)
    lines = lines_of(therapist, patient)
    assert [point["value"] for point in lines["pain_before", "", ""]["points"]] == [5, 2]
    assert len(lines["pain_after", "", ""]["points"]) == 1


def test_states_sensors_unknown_figures_and_open_sessions_are_left_out(therapist, new_patient, measured):
    patient = new_patient("Cao")
    figures = ("time_engaged", "sensor_residual", "what_an_older_version_measured")
    measured(patient, 1, *({"name": name, "value": 1.0} for name in figures))
    measured(patient, 2, own_range(1.0), status=SessionStatus.OPEN)
    said = therapist.get(f"/api/patients/{patient['id']}/progress").json()
    assert said == {"sessions": 1, "lines": []}


def test_a_patient_without_a_session_has_no_lines_and_a_stranger_no_answer(therapist, stranger, new_patient):
    patient = new_patient("Yuan")
    assert therapist.get(f"/api/patients/{patient['id']}/progress").json() == {"sessions": 0, "lines": []}
    assert therapist.get("/api/patients/9999/progress").status_code == 404
    assert stranger.get("/api/metrics").status_code == 401


def test_the_catalogue_says_of_each_measure_how_far_it_can_be_trusted(therapist):
    said = {measure["name"]: measure for measure in therapist.get("/api/metrics").json()}
    assert list(said) == list(MEASURES)
    assert said["peak_speed"]["trust"] == "poor"
    assert said["pain_before"]["mcid"]["value"] == pytest.approx(2.17)
    scales = {scale["kind"]: scale for scale in therapist.get("/api/scales").json()}
    assert {kind: scale["highest"] for kind, scale in scales.items()} == GREATEST
    assert scales["box-and-block"]["mdc"]["value"] == 5.5
