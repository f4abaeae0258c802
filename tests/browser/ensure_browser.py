"""Make sure that a browser for the tests is there: find it, install it if that is allowed, else say what to type."""

from __future__ import annotations

import os
import shutil
import subprocess
import sys

from server.cli.browser import VARIABLE, find_browser

ADVICE = (
    "The browser tests need Chromium or Chrome, and none was found. Type one of these, then run `make test` again:\n"
    "  sudo apt-get install chromium            (Debian, Ubuntu)\n"
    "  sudo dnf install chromium                (Fedora)\n"
    "  brew install --cask google-chrome        (macOS)\n"
    f"or set {VARIABLE} to the browser's path."
)


def main() -> int:
    """Return 0 when a browser is there in the end."""
    if find_browser() is None and _may_install():
        print("No browser found; installing Chromium with apt-get ...", flush=True)
        _install()
    path = find_browser()
    print(f"browser for the tests: {path}" if path else ADVICE, file=sys.stdout if path else sys.stderr)
    return 0 if path else 2


def _may_install() -> bool:
    return VARIABLE not in os.environ and shutil.which("apt-get") is not None and os.geteuid() == 0


def _install() -> None:
    quiet = {"stdin": subprocess.DEVNULL, "stdout": subprocess.DEVNULL, "check": False}
    subprocess.run(["apt-get", "update", "-qq"], **quiet)
    environment = os.environ | {"DEBIAN_FRONTEND": "noninteractive"}
    subprocess.run(["apt-get", "install", "-y", "-qq", "chromium", "fonts-noto-cjk"], env=environment, **quiet)


if __name__ == "__main__":
    sys.exit(main())
