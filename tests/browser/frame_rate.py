"""How many frames a second the patient's screen draws on this machine without a graphics card, and what a frame costs.

    .venv/bin/python tests/browser/frame_rate.py [GAME ...] [--seconds 8]

Each game is played by the virtual patient at 1280×720 in headless Chromium with software WebGL: first while the station
runs on the same machine, then alone, fed with what the station said. Beside it, in the same run, an empty picture of
the same size: what this machine gives at most at that moment. Medians of whole seconds; processor time is Chromium's.
"""

from __future__ import annotations

import argparse
import json
import os
import subprocess
import sys
import tempfile
from collections.abc import Iterator
from contextlib import contextmanager
from itertools import pairwise
from pathlib import Path
from statistics import median

import psutil
from playwright.sync_api import Browser, BrowserContext, Page, sync_playwright

from games.catalogue import GAMES
from server.cli.browser import find_browser

sys.path.insert(0, str(Path(__file__).parents[1]))
from browser.conftest import ARGUMENTS, built_pages
from browser.conftest import asked as ask
from browser.test_games import ALIGNED_MS, keep_moving, patient_whose_healthy_side_is
from conftest import _address_printed

SETTLES_S = 4
"""Until the page has found how much it may ask of the machine."""
HEARD = 600
"""Messages kept to be played again."""
EMPTY = """<canvas width=1280 height=720></canvas><script>
const gl = document.querySelector("canvas").getContext("webgl2");
let drawn = 0;
const draw = () => {
  requestAnimationFrame(draw);
  gl.clearColor((drawn % 60) / 60, 0.5, 0.5, 1);
  gl.clear(gl.COLOR_BUFFER_BIT);
  document.body.dataset.drawn = ++drawn;
};
draw();
</script>"""
LISTEN = f"""const Real = WebSocket;
window.heard = [];
window.WebSocket = class extends Real {{
  constructor(...given) {{
    super(...given);
    this.addEventListener("message", ({{ data }}) => window.heard.push(data) > {HEARD} && window.heard.shift());
  }}
}};"""
PLAY_AGAIN = """const messages = window.again.map((text) => JSON.parse(text));
const first = messages[0];
const lasts_s = messages.at(-1).tick.t_s - first.tick.t_s + 1 / 60;
let next = 0;
// Round after round time goes on and nothing is counted back: to the page that would be another game.
// Nor does a station come late that is not there.
const said = () => {
  const round = Math.floor(next / messages.length);
  const { tick, game, session } = messages[next++ % messages.length];
  const { hits, misses, score, total_score } = first.game;
  const later = { ...tick, index: next, t_s: tick.t_s + round * lasts_s, timing: first.tick.timing };
  return JSON.stringify({ tick: later, game: { ...game, hits, misses, score, total_score }, session });
};
window.WebSocket = class {
  static OPEN = 1;
  readyState = 1;
  constructor() {
    setTimeout(() => this.onopen?.({}));
    setInterval(() => this.onmessage?.({ data: said() }), 1000 / 60);
  }
  send() {}
  close() {}
};"""


def main() -> None:
    """Measure and print."""
    options = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    options.add_argument("game", nargs="*", default=list(GAMES))
    options.add_argument("--seconds", type=int, default=8)
    given = options.parse_args()
    with sync_playwright() as playwright:
        browser = playwright.chromium.launch(executable_path=find_browser(), args=ARGUMENTS)
        heard = {}
        with service() as address:
            for game in given.game:
                heard[game] = beside_the_station(browser, address, game, given.seconds)
        for game in given.game:
            empty(browser, given.seconds)
            alone(browser, game, heard[game], given.seconds)
        browser.close()


@contextmanager
def service() -> Iterator[str]:
    """A demonstration of its own, at this address."""
    with tempfile.TemporaryDirectory() as folder:
        config = Path(folder) / "mirrorlimb.toml"
        config.write_text("port = 0\n[station.sensors.ports]\n'kinectv2-osc' = 0\nosceleton2 = 0\nmirrorlimb = 0\n")
        command = [Path(sys.executable).with_name("mirrorlimb"), "serve", "--demo", "--config", config]
        process = subprocess.Popen(
            [*command, "--data", Path(folder) / "data"], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True
        )
        try:
            yield _address_printed(process)
        finally:
            process.terminate()
            process.wait(timeout=30)


def beside_the_station(browser: Browser, address: str, game: str, seconds: int) -> list[str]:
    """Measure while the station runs; returns what it said meanwhile."""
    context = new_context(browser)
    context.add_init_script(LISTEN)
    page, play = context.new_page(), context.new_page()
    page.goto(address)
    page.get_by_test_id("login-demo").click()
    page.get_by_test_id("log-out").wait_for()
    session = begin(page, game)
    page.goto(f"{address}/#/live")
    page.get_by_test_id("start").wait_for(timeout=ALIGNED_MS)
    play.goto(f"{address}/play.html")
    while play.locator("#play").get_attribute("data-face") != "playing":
        keep_moving(page)
        if play.locator("#play").get_attribute("data-face") == "waiting":
            ask(page, "POST", f"/api/sessions/{session}/game", {"wish": "start"})
        play.wait_for_timeout(250)
    page.goto(f"{address}/#/")  # the live page's 3-D view would be drawn by the same processor
    measure(play, f"{game}, station running", "#play", seconds)
    heard = play.evaluate("window.heard")
    ask(page, "POST", f"/api/sessions/{session}/end", {"pain_after": 1})
    context.close()
    return heard


def begin(page: Page, game: str) -> int:
    patient = patient_whose_healthy_side_is(ask, page, "right")
    exercises = [{"game": game, "minutes": 10, "level": 0.3, "pinned": True}]
    form = {"patient_id": patient, "confirmed_affected_side": "left", "exercises": exercises}
    return ask(page, "POST", "/api/sessions", form)["id"]


def alone(browser: Browser, game: str, heard: list[str], seconds: int) -> None:
    """Measure with nothing but the page, fed with what the station said."""
    context = new_context(browser)
    context.add_init_script(f"window.again = {json.dumps(heard)};\n{PLAY_AGAIN}")
    play = context.new_page()
    with built_pages() as address:
        play.goto(f"{address}/play.html")
        measure(play, f"{game}, alone", "#play", seconds)
        context.close()


def empty(browser: Browser, seconds: int) -> None:
    """Measure a picture in which nothing is drawn."""
    context = new_context(browser)
    page = context.new_page()
    page.set_content(EMPTY)
    measure(page, "an empty picture", "body", seconds)
    context.close()


def new_context(browser: Browser) -> BrowserContext:
    return browser.new_context(viewport={"width": 1280, "height": 720}, locale="en-GB")


def measure(page: Page, what: str, counter: str, seconds: int) -> None:
    """Print frames a second and what one costs."""
    page.wait_for_timeout(SETTLES_S * 1000)
    reading = f"() => [performance.now(), +document.querySelector('{counter}').dataset.drawn]"
    spent_s, moments = processor_s(), [page.evaluate(reading)]
    for _ in range(seconds):
        page.wait_for_timeout(1000)
        moments.append(page.evaluate(reading))
    rates = [1000 * (b[1] - a[1]) / (b[0] - a[0]) for a, b in pairwise(moments)]
    frames = max(moments[-1][1] - moments[0][1], 1)
    pixels = page.locator(counter).get_attribute("data-pixels") or "1"
    print(
        f"{what:28s} {median(rates):5.1f} frames/s (least {min(rates):4.1f}), "
        f"{1000 * (processor_s() - spent_s) / frames:5.1f} ms of processor time a frame, "
        f"{pixels} of the pixels each way, load {os.getloadavg()[0]:.1f} on {os.cpu_count()} cores",
        flush=True,
    )


def processor_s() -> float:
    """Processor time of every process of the browser so far."""
    spent_s = 0.0
    for process in psutil.Process().children(recursive=True):
        try:
            if "chrom" in process.name():
                times = process.cpu_times()
                spent_s += times.user + times.system
        except psutil.NoSuchProcess:
            continue
    return spent_s


if __name__ == "__main__":
    main()
