"""Nobody gets past the door without a log-in, and a log-in does not last for ever (SR-14)."""

import contextlib
import sqlite3
import threading
from datetime import timedelta
from pathlib import Path

import pytest
from fastapi.routing import iter_route_contexts
from sqlmodel import select
from websockets.exceptions import ConnectionClosed, InvalidStatus
from websockets.sync.client import connect

from db.account import LoginSession
from db.database import open_database
from db.queries import accounts
from fusion.errors import RefusedError
from server.api import socket_gate
from server.api.app import create_app
from server.api.auth import COOKIE, Auth, AuthSettings
from server.api.errors import ApiError
from server.api.throttle import Throttle
from server.config import Config

NAME, PASSWORD = "Dr. Lin", "three quiet herons"
OPEN_TO_ALL = {"/api/status", "/api/setup", "/api/login", "/api/demo", "/api/openapi.json"}
"""Everything else asks who is there."""
NOBODYS = {"/api", "/api/{path:path}", "/{path:path}"}
"""What no route took: a plain 404, and the pages, which are the same for everybody."""


def all_routes():
    """Every route of the application, also those that somebody adds tomorrow."""
    app = create_app(Config(), Path("nowhere"), built=Path("nowhere"))
    return [route for route in iter_route_contexts(app.routes) if route.path not in OPEN_TO_ALL | NOBODYS]


HTTP = [(method, route.path) for route in all_routes() for method in sorted(route.methods or ())]
SOCKETS = [route.path for route in all_routes() if not route.methods]


def filled(path):
    for name in ("patient_id", "session_id"):
        path = path.replace(f"{{{name}}}", "1")
    return path.replace("{path:path}", "")


def test_there_are_routes_and_sockets_to_test():
    assert len(HTTP) >= 15
    assert len(SOCKETS) >= 2


@pytest.mark.parametrize("token", [None, "", "made-up", "a" * 5000])
@pytest.mark.parametrize(("method", "path"), HTTP)
def test_every_route_refuses_strangers(stranger, method, path, token):
    if token is not None:
        stranger.cookies.set(COOKIE, token)
    answer = stranger.request(method, filled(path))
    assert answer.status_code == 401
    assert answer.json()["detail"]["remedy"] == "log in"


@pytest.mark.parametrize("path", SOCKETS)
@pytest.mark.parametrize("headers", [{}, {"Cookie": f"{COOKIE}=made-up"}])
def test_every_socket_refuses_strangers(shared, path, headers):
    with pytest.raises(InvalidStatus) as refused:
        connect(shared.ws_url + filled(path), additional_headers=headers)
    assert refused.value.response.status_code == 401


@pytest.mark.parametrize("path", SOCKETS)
@pytest.mark.parametrize("origin", ["http://evil.example", "null", "http://127.0.0.1:1"])
def test_every_socket_refuses_other_sites_even_with_the_cookie(shared, therapist, path, origin):
    cookie = f"{COOKIE}={therapist.cookies[COOKIE]}"
    with pytest.raises(InvalidStatus) as refused:
        connect(shared.ws_url + filled(path), additional_headers={"Cookie": cookie}, origin=origin)
    assert refused.value.response.status_code == 403


@pytest.mark.parametrize("path", SOCKETS)
def test_every_socket_lets_its_own_pages_in(shared, therapist, path):
    cookie = f"{COOKIE}={therapist.cookies[COOKIE]}"
    connect(shared.ws_url + filled(path), additional_headers={"Cookie": cookie}, origin=shared.url).close()


@pytest.mark.parametrize(("method", "path"), [route for route in HTTP if route[0] not in ("GET", "HEAD")])
@pytest.mark.parametrize("header", [{"Origin": "http://evil.example"}, {"Sec-Fetch-Site": "cross-site"}])
def test_every_change_refuses_other_sites_even_with_the_cookie(therapist, method, path, header):
    assert therapist.request(method, filled(path), headers=header).status_code == 403


@pytest.mark.parametrize("path", ["/api/login", "/api/setup", "/api/demo"])
def test_nobody_is_logged_in_in_somebodys_name(stranger, path):
    answer = stranger.post(path, headers={"Origin": "http://evil.example"}, json={"name": NAME, "password": PASSWORD})
    assert answer.status_code == 403
    assert "set-cookie" not in answer.headers


@pytest.mark.parametrize("host", ["evil.example", "evil.example:8000", "127.0.0.1.evil.example", "[", ""])
def test_a_name_pointed_at_this_machine_is_refused(stranger, host):
    assert stranger.get("/api/status", headers={"Host": host}).status_code in (400, 403)


def test_the_cookie_is_out_of_reach_of_scripts_and_other_sites(stranger):
    cookie = stranger.post("/api/login", json={"name": NAME, "password": PASSWORD}).headers["set-cookie"].lower()
    assert "httponly" in cookie
    assert "samesite=strict" in cookie
    assert len(cookie.split("=")[1].split(";")[0]) * 6 >= 128


def test_only_the_tokens_hash_and_the_passwords_argon2_are_stored(shared, therapist):
    with sqlite3.connect(shared.data / "mirrorlimb.sqlite") as raw:
        dump = "\n".join(raw.iterdump())
    raw.close()
    assert "$argon2id$" in dump
    assert PASSWORD not in dump
    assert therapist.cookies[COOKIE] not in dump


def test_each_log_in_has_a_token_of_its_own_and_ends_the_one_before(shared, stranger):
    form = {"name": NAME, "password": PASSWORD}
    stranger.post("/api/login", json=form)
    first = stranger.cookies[COOKIE]
    stranger.post("/api/login", json=form)
    assert stranger.cookies[COOKIE] != first
    assert shared.service.auth.account_or_none(first) is None
    assert stranger.get("/api/me").json()["name"] == NAME


def test_after_logging_out_the_token_is_worthless(shared, stranger):
    stranger.post("/api/login", json={"name": NAME, "password": PASSWORD})
    token = stranger.cookies[COOKIE]
    assert stranger.post("/api/logout").status_code == 204
    assert COOKIE not in stranger.cookies
    stranger.cookies.set(COOKIE, token)
    assert stranger.get("/api/me").status_code == 401


def test_a_socket_closes_soon_after_its_log_in_ended(shared, therapist, monkeypatch):
    monkeypatch.setattr(socket_gate, "CHECKED_EVERY_S", 0.05)
    token = therapist.cookies[COOKIE]
    with connect(f"{shared.ws_url}/api/stream", additional_headers={"Cookie": f"{COOKIE}={token}"}) as socket:
        socket.recv(timeout=10)
        therapist.post("/api/logout").raise_for_status()
        with pytest.raises(ConnectionClosed) as closed:
            socket.recv(timeout=10)
    assert closed.value.rcvd.code == socket_gate.LOGGED_OUT


def test_a_second_first_account_is_refused(stranger):
    answer = stranger.post("/api/setup", json={"name": "somebody else", "password": "a long password"})
    assert answer.status_code == 409


def test_a_short_first_password_is_refused(stranger):
    answer = stranger.post("/api/setup", json={"name": "somebody else", "password": "short"})
    assert answer.status_code == 422
    assert "password" in answer.json()["detail"]["what"]


# ---------------------------------------------------------------- time


@pytest.fixture
def database(tmp_path):
    opened = open_database(tmp_path / "accounts.sqlite")
    yield opened
    opened.close()


def auth_with(database, **settings):
    return Auth(database, AuthSettings(argon2_time_cost=1, argon2_memory_kib=64, **settings))


def let_pass(database, seconds):
    """Time goes by: what was written a moment ago becomes as old as that."""
    with database.session() as session:
        for login in session.exec(select(LoginSession)):
            login.last_used_at -= timedelta(seconds=seconds)
            login.expires_at -= timedelta(seconds=seconds)


def test_a_log_in_that_is_not_used_runs_out(database):
    auth = auth_with(database, idle_s=1800.0)
    _, token = auth.set_up(NAME, PASSWORD, "here")
    let_pass(database, 1790)
    assert auth.account_or_none(token, is_use=False) is not None
    let_pass(database, 20)
    assert auth.account_or_none(token) is None


def test_use_prolongs_a_log_in_but_looking_does_not(database):
    auth = auth_with(database, idle_s=1800.0)
    _, used = auth.set_up(NAME, PASSWORD, "here")
    looked_at = auth.open_login(auth.log_in(NAME, PASSWORD, "here")[0])
    for _ in range(2):
        let_pass(database, 1000)
        auth.account_or_none(used)
        auth.account_or_none(looked_at, is_use=False)
    assert auth.account_or_none(used) is not None
    assert auth.account_or_none(looked_at) is None


def test_use_does_not_prolong_a_log_in_for_ever(database):
    auth = auth_with(database, idle_s=1800.0, absolute_s=3600.0)
    _, token = auth.set_up(NAME, PASSWORD, "here")
    for _ in range(3):
        let_pass(database, 1000)
        assert auth.account_or_none(token) is not None
    let_pass(database, 1000)
    assert auth.account_or_none(token) is None


def test_of_many_first_accounts_at_once_one_is_made(database):
    auth, made = auth_with(database), []

    def try_it(name):
        with contextlib.suppress(RefusedError):
            made.append(auth.set_up(name, PASSWORD, name))

    threads = [threading.Thread(target=try_it, args=(f"somebody {i}",)) for i in range(8)]
    for thread in threads:
        thread.start()
    for thread in threads:
        thread.join()
    assert len(made) == 1


def test_an_account_without_password_cannot_be_logged_in_to(database):
    auth = auth_with(database)
    with database.session() as session:
        accounts.add_account(session, "demo", None)
    for password in ("", "None", "demo", auth._nobodys_hash):
        with pytest.raises(ApiError) as refused:
            auth.log_in("demo", password, "here")
        assert refused.value.status == 401


# ---------------------------------------------------------------- guessing


def test_guessing_a_password_is_slowed_down_and_others_are_not(database):
    auth = auth_with(database)
    auth.set_up(NAME, PASSWORD, "here")
    statuses = []
    for _ in range(8):
        with pytest.raises(ApiError) as refused:
            auth.log_in(NAME, "guess", "attacker")
        statuses.append(refused.value.status)
    assert statuses == [401] * 5 + [429] * 3
    assert auth.log_in(NAME, PASSWORD, "here")


def test_the_right_password_is_not_taken_while_waiting(database):
    auth = auth_with(database)
    auth.set_up(NAME, PASSWORD, "here")
    for _ in range(5):
        with pytest.raises(ApiError):
            auth.log_in(NAME, "guess", "attacker")
    with pytest.raises(ApiError) as refused:
        auth.log_in(NAME, PASSWORD, "attacker")
    assert refused.value.status == 429
    assert "wait" in refused.value.remedy


def test_each_further_failure_doubles_the_wait_up_to_a_limit():
    throttle, waits = Throttle(free=2, longest_s=10), []
    for _ in range(8):
        throttle.failed("somebody", 0.0)
        waits.append(throttle.wait_s("somebody", 0.0))
    assert waits == [0, 1, 2, 4, 8, 10, 10, 10]
    throttle.succeeded("somebody")
    assert throttle.wait_s("somebody", 0.0) == 0


def test_the_throttle_forgets_the_oldest_names():
    throttle = Throttle(free=1, remembered=10)
    for i in range(1000):
        throttle.failed(str(i), 0.0)
    assert throttle.wait_s("0", 0.0) == 0
    assert throttle.wait_s("999", 0.0) > 0
