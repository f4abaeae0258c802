"""The database opens, grows to this program's form, and says plainly when it cannot."""

import sqlite3
import threading
from datetime import UTC, datetime, timedelta, timezone

import pytest
from alembic.autogenerate import compare_metadata
from alembic.migration import MigrationContext
from sqlalchemy import inspect

from db.account import Account, Role
from db.clinical_score import ClinicalScoreForm
from db.database import open_database
from db.errors import CannotOpenError, NotStoredError, TooNewError
from db.exercise import Exercise, PlayedExercise
from db.limits import JointRange, PatientLimits
from db.migrate import downgrade, upgrade
from db.patient import PatientCreate, PatientUpdate
from db.queries import accounts, patients, sessions
from db.sqlite import create_sqlite_engine
from db.tables import METADATA
from db.therapy_session import AllLimits, Event, LimitsSnapshot, Metric, SessionStatus, TherapySession

REACH = (Exercise(game="reach", minutes=6.0, level=0.3),)


@pytest.fixture
def path(tmp_path):
    return tmp_path / "mirrorlimb.sqlite"


@pytest.fixture
def database(path):
    opened = open_database(path)
    yield opened
    opened.close()


def enrol(session, name="Wang"):
    therapist = accounts.find_account(session, "lin") or accounts.add_account(session, "lin", "hash")
    return patients.add_patient(session, PatientCreate(name=name, healthy_side="right"), therapist.id)


def begin(session, patient, **more):
    return sessions.add_session(
        session,
        TherapySession(patient_id=patient.id, therapist_id=1, affected_side="left", exercises=REACH, seed=7, **more),
    )


def test_migrations_and_models_agree(path):
    upgrade(str(path))
    engine = create_sqlite_engine(str(path))
    with engine.connect() as connection:
        context = MigrationContext.configure(connection, opts={"compare_type": True})
        assert compare_metadata(context, METADATA) == []
    engine.dispose()


def test_down_to_nothing_and_up_again(path):
    upgrade(str(path))
    downgrade(str(path), "base")
    engine = create_sqlite_engine(str(path))
    assert set(inspect(engine).get_table_names()) <= {"alembic_version"}
    engine.dispose()
    upgrade(str(path))
    open_database(path).close()


def test_rows_from_before_get_cautious_limits_that_nobody_has_signed_for(path):
    upgrade(str(path), "0001")
    with sqlite3.connect(path) as raw:
        raw.execute("INSERT INTO account (name, created_at) VALUES ('lin', '2026-01-01')")
        raw.execute(
            "INSERT INTO patient (name, healthy_side, notes, passive_range, created_by_id, created_at, updated_at) "
            "VALUES ('Wang', 'right', '', '{}', 1, '2026-01-01', '2026-01-01')"
        )
        raw.execute(
            "INSERT INTO therapy_session (patient_id, therapist_id, affected_side, game, seed, level, started_at, "
            "status, limits, version, recording, measured) "
            "VALUES (1, 1, 'left', 'reach', 7, 0.3, '2026-01-01', 'ended', '{\"joints\": []}', '0.1.0', '', 1)"
        )
    raw.close()
    database = open_database(path)
    with database.session() as session:
        (patient,) = patients.list_patients(session)
        assert patient.limits == PatientLimits()
        assert (patient.assistance, patient.limits_set_by, patient.limits_set_at) == ("passive", "", None)
        assert accounts.find_account(session, "lin").role is Role.ADMIN
        (old,) = sessions.history_of(session, patient.id)
        assert (old.assistance, old.assist_level, old.limits.set_by) == ("passive", 1.0, "")
    database.close()


OLD_SESSION = """
INSERT INTO therapy_session (patient_id, therapist_id, affected_side, game, seed, level, started_at, status, limits,
                             version, recording, measured, assistance, assist_level)
VALUES (1, 1, 'left', 'reach', 7, 0.3, '2026-01-01', 'ended', '{"joints": []}', '0.1.0', '', 1, 'passive', 1.0)
"""
COUNTED = '{"hits": %d, "misses": 4, "score": 200, "level": 0.45}'


def test_sessions_from_before_keep_their_game_its_level_and_what_was_counted(path):
    upgrade(str(path), "0002")
    with sqlite3.connect(path) as raw:
        raw.execute("INSERT INTO account (name, created_at, role) VALUES ('lin', '2026-01-01', 'admin')")
        raw.execute(
            "INSERT INTO patient (name, healthy_side, notes, passive_range, force_limits, assistance, "
            "assist_level_most, limits_set_by, created_by_id, created_at, updated_at) "
            "VALUES ('Wang', 'right', '', '{}', '{}', 'passive', 1.0, '', 1, '2026-01-01', '2026-01-01')"
        )
        for _ in range(2):
            raw.execute(OLD_SESSION)
        for hits in (15, 16):
            raw.execute(
                "INSERT INTO event (session_id, t, kind, text, data) VALUES (2, '2026-01-01', 'score', 'hit', ?)",
                (COUNTED % hits,),
            )
        raw.execute(
            "INSERT INTO metric (session_id, name, joint, side, value, unit, label, caveat) "
            "VALUES (2, 'time_engaged', '', '', 312.5, 's', '', '')"
        )
    raw.close()
    database = open_database(path)
    with database.session() as session:
        counted, uncounted = sessions.history_of(session, 1)
        assert counted.exercises == uncounted.exercises == REACH
        assert counted.played == (
            PlayedExercise(game="reach", played_s=312.5, score=200, hits=16, misses=4, level=0.45),
        )
        assert (uncounted.played, counted.notes, counted.workspace) == ((), "", None)
    database.close()
    downgrade(str(path), "0002")
    with sqlite3.connect(path) as raw:
        assert raw.execute("SELECT game, level FROM therapy_session").fetchall() == [("reach", 0.3)] * 2
    raw.close()


def test_the_level_last_reached_in_each_game_is_found(database):
    with database.session() as session:
        patient = enrol(session)
        for game, level in (("reach", 0.2), ("reach", 0.5), ("trace", 0.1)):
            played = PlayedExercise(game=game, played_s=60.0, score=1, hits=1, misses=0, level=level)
            begin(session, patient, played=(played,))
        begin(session, patient)
        begin(session, enrol(session, "Li"), played=(played.model_copy(update={"level": 0.9}),))
        assert sessions.levels_reached(session, patient.id) == {"reach": 0.5, "trace": 0.1}


@pytest.mark.parametrize(("kind", "greatest"), [("fugl-meyer-ue", 66), ("arat", 57), ("box-and-block", 150)])
def test_a_score_beyond_its_scale_is_refused(kind, greatest):
    form = {"kind": kind, "side": "left", "on": "2026-03-01", "rater": "Lin"}
    assert ClinicalScoreForm.model_validate({**form, "value": greatest}).value == greatest
    for value in (greatest + 1, -1):
        with pytest.raises(ValueError, match=r"scale|greater"):
            ClinicalScoreForm.model_validate({**form, "value": value})


def test_what_was_stored_is_there_after_opening_again(path):
    first = open_database(path)
    with first.session() as session:
        enrol(session)
    first.close()
    second = open_database(path)
    with second.session() as session:
        assert [patient.name for patient in patients.list_patients(session)] == ["Wang"]
    second.close()


def test_a_file_that_is_no_database_is_refused_with_a_remedy_and_left_alone(path):
    path.write_bytes(b"these are somebody's notes, not a database" * 100)
    before = path.read_bytes()
    with pytest.raises(CannotOpenError) as caught:
        open_database(path)
    assert str(path) in caught.value.what
    assert caught.value.remedy
    assert path.read_bytes() == before


def test_a_missing_folder_is_refused(tmp_path):
    with pytest.raises(CannotOpenError):
        open_database(tmp_path / "nowhere" / "x.sqlite")


def test_a_folder_in_the_files_place_is_refused(path):
    path.mkdir()
    with pytest.raises(CannotOpenError):
        open_database(path)


def test_a_newer_programs_database_is_refused_and_left_alone(path):
    open_database(path).close()
    with sqlite3.connect(path) as raw:
        raw.execute("UPDATE alembic_version SET version_num = '9999'")
    raw.close()
    with pytest.raises(TooNewError, match="9999"):
        open_database(path)


def test_times_come_back_with_their_zone_in_utc(database):
    beijing = timezone(timedelta(hours=8))
    started = datetime(2026, 3, 1, 9, 30, tzinfo=beijing)
    with database.session() as session:
        number = begin(session, enrol(session), started_at=started).id
    with database.session() as session:
        read = sessions.find_session(session, number)
        assert read.started_at == started
        assert read.started_at.tzinfo == UTC


def test_a_time_without_zone_is_refused(database):
    with pytest.raises(Exception, match="zone"), database.session() as session:
        begin(session, enrol(session), started_at=datetime(2026, 3, 1))


def test_a_block_that_fails_stores_nothing(database):
    def twice():
        with database.session() as session:
            enrol(session)
            session.add(Account(name="lin"))

    with pytest.raises(NotStoredError):
        twice()
    with database.session() as session:
        assert patients.list_patients(session) == []


def test_a_row_that_points_nowhere_is_refused(database):
    with pytest.raises(NotStoredError), database.session() as session:
        sessions.add_event(session, Event(session_id=99, kind="state"))


def test_a_database_that_another_holds_is_reported_and_works_afterwards(path):
    database = open_database(path)
    other = sqlite3.connect(path, isolation_level=None, check_same_thread=False)
    other.execute("BEGIN IMMEDIATE")
    with database.engine.connect() as connection:
        connection.rollback()
    raw = database.engine.raw_connection()
    raw.cursor().execute("PRAGMA busy_timeout = 20")
    raw.close()
    with pytest.raises(NotStoredError, match="locked"), database.session() as session:
        enrol(session)
    other.execute("ROLLBACK")
    other.close()
    with database.session() as session:
        enrol(session)
    database.close()


def test_writers_in_several_threads_all_succeed(database):
    with database.session() as session:
        enrol(session)

    def add(name):
        for i in range(5):
            with database.session() as session:
                patients.list_patients(session)
                enrol(session, f"{name}{i}")

    threads = [threading.Thread(target=add, args=(name,)) for name in "abcd"]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    with database.session() as session:
        assert len(patients.list_patients(session)) == 21


def test_a_change_touches_only_what_it_names(database):
    with database.session() as session:
        patient = enrol(session)
        changed = patients.change_patient(session, patient, PatientUpdate(notes="tires quickly"))
        assert (changed.name, changed.healthy_side, changed.notes) == ("Wang", "right", "tires quickly")


def test_a_range_in_the_wrong_order_is_refused():
    with pytest.raises(ValueError, match="smaller"):
        JointRange(min_rad=1.0, max_rad=0.5)


def test_limits_and_metrics_come_back_as_they_were(database):
    limits = AllLimits(
        joints=(LimitsSnapshot(joint="elbow", min_rad=0, max_rad=2, velocity_rad_s=1, acceleration_rad_s2=5),)
    )
    with database.session() as session:
        patient = enrol(session)
        number = begin(session, patient, limits=limits).id
        for value in (1.0, 2.0):
            sessions.replace_metrics(session, number, [Metric(session_id=number, name="sparc", value=value)])
    with database.session() as session:
        (detail,) = sessions.history_of(session, patient.id)
        assert detail.limits == limits
        assert [metric.value for metric in detail.metrics] == [2.0]
        assert (detail.patient_name, detail.therapist_name) == ("Wang", "lin")


def test_sessions_left_open_or_unmeasured_are_found(database):
    with database.session() as session:
        patient = enrol(session)
        crashed = begin(session, patient)
        unmeasured = begin(session, patient, status=SessionStatus.ENDED)
        begin(session, patient, status=SessionStatus.ENDED, measured=True)
        assert [found.id for found in sessions.sessions_left_open(session)] == [crashed.id, unmeasured.id]


def test_old_logins_are_forgotten(database):
    from db.account import LoginSession

    now = datetime.now(UTC)
    with database.session() as session:
        account = accounts.add_account(session, "lin", None)
        for token, used, expires in (("old", -3600, 60), ("over", 0, -1), ("good", 0, 60)):
            accounts.add_login(
                session,
                LoginSession(
                    token_hash=token,
                    account_id=account.id,
                    last_used_at=now + timedelta(seconds=used),
                    expires_at=now + timedelta(seconds=expires),
                ),
            )
        accounts.remove_old_logins(session, now - timedelta(seconds=1800), now)
        kept = [token for token in ("old", "over", "good") if accounts.find_login(session, token)]
    assert kept == ["good"]
