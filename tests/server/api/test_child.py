"""A watched process is started again when it dies, and ends when it is told to."""

import asyncio
import os
import signal

from server.api import child as child_module
from server.api.child import Child

SLEEPS = "import time; print('here', flush=True); time.sleep(60)"
STUBBORN = (
    "import signal, time; signal.signal(signal.SIGTERM, signal.SIG_IGN); print('here', flush=True); time.sleep(60)"
)
DIES = "import sys; print('first line', flush=True); sys.exit('it hurts')"


def child(tmp_path, program, deaths):
    return Child("the child", ("-c", program), tmp_path / "logs" / "child.log", deaths.append)


async def until(condition):
    async with asyncio.timeout(20):
        while not condition():
            await asyncio.sleep(0.01)


def has_spoken(tmp_path):
    return "here" in (tmp_path / "logs" / "child.log").read_text()


async def test_a_child_that_dies_is_started_again_and_its_last_words_are_heard(tmp_path, monkeypatch):
    monkeypatch.setattr(child_module, "FIRST_PAUSE_S", 0.01)
    deaths = []
    dying = child(tmp_path, DIES, deaths)
    await dying.start()
    await until(lambda: dying.restarts >= 2)
    await dying.close()
    assert set(deaths) == {"it hurts"}


async def test_a_child_that_is_killed_is_started_again_under_another_number(tmp_path, monkeypatch):
    monkeypatch.setattr(child_module, "FIRST_PAUSE_S", 0.01)
    deaths = []
    living = child(tmp_path, SLEEPS, deaths)
    await living.start()
    first = living.pid
    os.kill(first, signal.SIGKILL)
    await until(lambda: living.pid not in (None, first))
    await living.close()
    assert living.pid is None
    assert len(deaths) == 1


async def test_a_child_that_is_told_to_end_is_not_started_again(tmp_path):
    deaths = []
    living = child(tmp_path, SLEEPS, deaths)
    await living.start()
    await until(lambda: has_spoken(tmp_path))
    await living.close()
    assert (living.pid, living.restarts, deaths) == (None, 0, [])


async def test_a_child_that_will_not_end_is_killed(tmp_path):
    stubborn = child(tmp_path, STUBBORN, [])
    await stubborn.start()
    await until(lambda: has_spoken(tmp_path))
    await stubborn.close(grace_s=0.1)
    assert stubborn.pid is None
