"""Finding the Chromium that the browser tests drive."""

from __future__ import annotations

import os
import shutil

NAMES = ("chromium", "chromium-browser", "google-chrome", "google-chrome-stable", "chrome")
VARIABLE = "MIRRORLIMB_BROWSER"


def find_browser() -> str | None:
    """Path of a Chromium or Chrome: the one named by MIRRORLIMB_BROWSER, else the first on PATH, else None."""
    named = os.environ.get(VARIABLE)
    if named:
        return shutil.which(named)
    return next((path for name in NAMES if (path := shutil.which(name))), None)
