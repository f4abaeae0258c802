"""How old is what the patient sees? Measures a running demonstration with a real browser open.

    .venv/bin/python examples/measure_latency.py [SECONDS]

Starts `mirrorlimb serve --demo` on free ports, opens the dashboard (with its 3-D view) and the patient's screen in
Chromium, and prints how long after a datagram's arrival the drive got its command, and how long after it the browser
had drawn the picture made of it. The picture's age is taken when its acknowledgement arrives, so the way back counts.
Needs the development tools (`make setup`) and a Chromium (`make browser`).
"""

from __future__ import annotations

import subprocess
import sys
import tempfile
from pathlib import Path

from playwright.sync_api import Page, sync_playwright

from server.cli.browser import find_browser

CONFIG = "port = 0\n[station.sensors.ports]\n'kinectv2-osc' = 0\nosceleton2 = 0\nmirrorlimb = 0\n"
FLAGS = ["--no-sandbox", "--disable-background-networking", "--no-first-run"]


def main(seconds: float) -> None:
    """Run the demonstration for some seconds and print the figures."""
    with tempfile.TemporaryDirectory() as folder, sync_playwright() as playwright:
        service, address = start(Path(folder))
        try:
            browser = playwright.chromium.launch(executable_path=find_browser(), args=FLAGS)
            page = browser.new_context(viewport={"width": 1280, "height": 720}).new_page()
            play_for(page, address, seconds)
            show(page.request.get(f"{address}/api/station").json()["latency"])
            browser.close()
        finally:
            service.terminate()
            service.wait(timeout=20)


def start(folder: Path) -> tuple[subprocess.Popen[str], str]:
    """Start the demonstration in a folder of its own; return its process and address."""
    config = folder / "mirrorlimb.toml"
    config.write_text(CONFIG, "utf-8")
    command = [Path(sys.executable).with_name("mirrorlimb"), "serve", "--demo", "--config", config, "--data", folder]
    service = subprocess.Popen(command, stdout=subprocess.PIPE, text=True)  # noqa: S603 (our own command)
    if service.stdout is None:
        raise RuntimeError("the service has no output to read its address from")
    return service, service.stdout.readline().strip()


def play_for(page: Page, address: str, seconds: float) -> None:
    """Open both screens, start the arm and watch."""
    page.goto(address)
    page.get_by_test_id("login-demo").click()
    page.get_by_test_id("open-session").first.click()
    page.get_by_test_id("confirm-side-left").click()
    page.get_by_test_id("begin-session").click()
    page.locator("[data-testid=start]:enabled").click(timeout=60_000)
    with page.context.expect_page():
        page.get_by_test_id("open-play").click()
    for _ in range(int(seconds)):
        page.wait_for_timeout(1000)
        if page.get_by_test_id("resume").is_enabled():
            page.get_by_test_id("resume").click()


def show(latency: dict[str, dict[str, float]]) -> None:
    """Print one line per figure."""
    for name, figure in latency.items():
        p50_ms, p99_ms = 1000 * figure["p50_s"], 1000 * figure["p99_s"]
        print(f"{name.replace('_', ' ')}: p50 {p50_ms:.1f} ms, p99 {p99_ms:.1f} ms over {figure['samples']} samples")


if __name__ == "__main__":
    main(float(sys.argv[1]) if len(sys.argv) > 1 else 60)
