"""A real Chromium for the browser tests."""

from __future__ import annotations

from collections.abc import Iterator
from pathlib import Path

import pytest
from playwright.sync_api import Browser, Page, sync_playwright

from server.cli.browser import find_browser

# Root in a container needs no-sandbox; the rest keeps Chromium from calling home.
ARGUMENTS = [
    "--no-sandbox",
    "--disable-background-networking",
    "--disable-component-update",
    "--disable-sync",
    "--no-first-run",
]
SHOTS = Path(__file__).parents[2] / "test-results"


# By module: Playwright's event loop must have ended before other tests ask for one of their own.
@pytest.fixture(scope="module")
def browser() -> Iterator[Browser]:
    """Chromium, headless; fails where there is none (`make test` sees to it before)."""
    path = find_browser()
    if path is None:
        pytest.fail("No Chromium found. `make browser` installs it or says what to type.")
    with sync_playwright() as playwright:
        chromium = playwright.chromium.launch(executable_path=path, args=ARGUMENTS)
        yield chromium
        chromium.close()


@pytest.fixture
def page(browser: Browser) -> Iterator[Page]:
    """A page at 1280×720 in a context of its own; the test fails where it threw an error."""
    context = browser.new_context(viewport={"width": 1280, "height": 720}, locale="en-GB")
    errors: list[str] = []
    context.on("weberror", lambda error: errors.append(str(error.error)))
    opened = context.new_page()
    yield opened
    context.close()
    assert not errors, errors


@pytest.fixture
def shots() -> Path:
    """Folder for screenshots, kept out of the repository."""
    SHOTS.mkdir(exist_ok=True)
    return SHOTS
