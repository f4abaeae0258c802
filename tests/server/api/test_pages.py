"""The built pages are served; where they are missing, it says what to type."""

import pytest
from fastapi import FastAPI
from httpx import ASGITransport, AsyncClient

from server.api.errors import add_error_handlers
from server.api.guard import Guard, is_own_host
from server.api.pages import add_pages


def app_with(built):
    app = FastAPI()
    add_error_handlers(app)
    add_pages(app, built)
    app.add_middleware(Guard, host="127.0.0.1")
    return app


def client_of(app):
    return AsyncClient(transport=ASGITransport(app), base_url="http://127.0.0.1")


@pytest.fixture
def built(tmp_path):
    (tmp_path / "assets").mkdir()
    (tmp_path / "index.html").write_text("<title>dashboard</title>")
    (tmp_path / "play.html").write_text("<title>game</title>")
    (tmp_path / "assets" / "main-abc123.js").write_text("1")
    return tmp_path


@pytest.mark.parametrize(
    ("path", "text"),
    [("/", "dashboard"), ("/play.html", "game"), ("/patients/3", "dashboard"), ("/x/y/z", "dashboard")],
)
async def test_pages_are_served(built, path, text):
    async with client_of(app_with(built)) as client:
        answer = await client.get(path)
    assert answer.status_code == 200
    assert text in answer.text
    assert answer.headers["cache-control"] == "no-cache"


async def test_assets_are_kept_by_the_browser_and_pages_are_not(built):
    async with client_of(app_with(built)) as client:
        assert "immutable" in (await client.get("/assets/main-abc123.js")).headers["cache-control"]
        assert (await client.get("/assets/missing.js")).status_code == 404


@pytest.mark.parametrize("path", ["/../secret.txt", "/%2e%2e/secret.txt", "/assets/..%2f..%2fsecret.txt"])
async def test_nothing_outside_is_served(built, path):
    (built.parent / "secret.txt").write_text("keep this")
    async with client_of(app_with(built)) as client:
        assert "keep this" not in (await client.get(path)).text


async def test_pages_that_were_never_built_say_what_to_type(tmp_path):
    async with client_of(app_with(tmp_path / "nothing")) as client:
        answer = await client.get("/")
    assert answer.status_code == 503
    assert "make setup" in answer.text


async def test_an_unknown_api_path_is_json_even_with_pages(built):
    async with client_of(app_with(built)) as client:
        answer = await client.get("/api/nothing")
    assert (answer.status_code, answer.headers["content-type"]) == (404, "application/json")


async def test_every_answer_tells_the_browser_what_is_allowed(built):
    async with client_of(app_with(built)) as client:
        for path in ("/", "/api/nothing", "/assets/main-abc123.js"):
            headers = (await client.get(path)).headers
            assert "frame-ancestors 'self'" in headers["content-security-policy"]
            assert headers["x-content-type-options"] == "nosniff"


async def test_a_mistake_of_the_program_shows_nothing_of_its_inside(built):
    app = app_with(built)

    @app.get("/broken")
    def broken():
        raise RuntimeError("the secret path is /root")

    app.router.routes.insert(0, app.router.routes.pop())
    transport = ASGITransport(app, raise_app_exceptions=False)
    async with AsyncClient(transport=transport, base_url="http://127.0.0.1") as client:
        answer = await client.get("/broken")
    assert answer.status_code == 500
    assert "secret" not in answer.text
    assert answer.json()["detail"]["remedy"]


@pytest.mark.parametrize(
    "host", ["localhost", "localhost:8000", "127.0.0.1:1", "[::1]:8000", "192.168.1.7", "clinic.example"]
)
def test_own_names(host):
    assert is_own_host(host, "clinic.example")


@pytest.mark.parametrize("host", ["", "evil.example", "localhost.evil.example", "1.2.3.4.evil.example", "[::1"])
def test_foreign_names(host):
    assert not is_own_host(host, "clinic.example")
