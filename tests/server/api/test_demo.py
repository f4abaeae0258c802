"""The demonstration is entered without a password: only with `--demo`, from this machine, with a simulated drive."""

import pytest

from db.database import open_database
from server.api.auth import COOKIE, Auth, AuthSettings
from server.api.demo import Demo
from server.api.errors import ApiError
from server.config import Config


@pytest.fixture
def demo_with(tmp_path):
    database = open_database(tmp_path / "demo.sqlite")
    auth = Auth(database, AuthSettings(argon2_time_cost=1, argon2_memory_kib=64))
    yield lambda offered: Demo(database, auth, offered)
    database.close()


@pytest.mark.parametrize("client", ["192.168.1.9", "10.0.0.1", "::ffff:192.168.1.9", "2001:db8::1", "", "localhost"])
def test_other_machines_are_refused(demo_with, client):
    with pytest.raises(ApiError) as refused:
        demo_with(True).enter(client)
    assert refused.value.status == 403


def test_without_the_demonstration_this_machine_is_refused_too(demo_with):
    with pytest.raises(ApiError):
        demo_with(False).enter("127.0.0.1")


def test_entering_twice_makes_one_account_and_one_patient(demo_with):
    demo = demo_with(True)
    first, second = demo.enter("127.0.0.1"), demo.enter("::1")
    assert (first[0].id, first[1].id) == (second[0].id, second[1].id)
    assert first[2] != second[2]
    assert first[0].password_hash is None


def test_a_service_that_is_no_demonstration_says_so(tmp_path, serving):
    with serving(tmp_path, config=Config(demo=False)) as service, service.client() as client:
        assert client.get("/api/status").json()["demo"] is False
        answer = client.post("/api/demo")
    assert answer.status_code == 403
    assert COOKIE not in answer.cookies
