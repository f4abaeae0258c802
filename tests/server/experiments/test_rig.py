"""What the experiments on real processes are judged by: the drive's log, and wires that do what they say."""

from __future__ import annotations

import math
from pathlib import Path

import msgspec

from server.experiments.rig import wires
from server.experiments.rig.drive_log import DriveLog, Note, still_after_s, told_after_s
from server.experiments.rig.measures import percentiles
from server.experiments.rig.station_process import NS_PER_S, SteppedClock
from server.station.exo.driver import ZERO, DriveMode


def _note(t_s: float, speed_rad_s: float = 0.0, reason: str = "", angle_rad: float = 0.0) -> Note:
    return Note(t_s, t_s, True, DriveMode.FOLLOW, reason, (angle_rad, *ZERO[1:]), (speed_rad_s, *ZERO[1:]))


def test_told_is_the_first_command_after_the_fault_that_gives_the_reason() -> None:
    notes = [_note(1.0, reason="held before"), _note(2.0), _note(2.1, reason="other"), _note(2.2, reason="silent")]
    assert told_after_s(notes, 1.5, "silent") == 2.2 - 1.5
    assert told_after_s(notes, 1.5) == 2.1 - 1.5
    assert told_after_s(notes, 2.5) is None


def test_still_is_the_last_movement_and_none_while_it_goes_on() -> None:
    slowing = [_note(1.0, 0.5), _note(1.1, 0.2, angle_rad=0.05), _note(1.2, angle_rad=0.07), _note(1.3, angle_rad=0.07)]
    assert math.isclose(still_after_s(slowing, 0.9) or 0.0, 0.2)
    assert still_after_s([*slowing, _note(1.4, 0.3)], 0.9) is None
    assert still_after_s([], 0.9) is None


def test_a_line_that_is_half_written_waits_for_its_end(tmp_path: Path) -> None:
    path = tmp_path / "log"
    first, second = (msgspec.json.encode(_note(t_s)) + b"\n" for t_s in (1.0, 2.0))
    log = DriveLog(path)
    assert log.notes() == []
    path.write_bytes(first + second[:10])
    assert [note.t_s for note in log.notes()] == [1.0]
    path.write_bytes(first + second)
    assert [note.t_s for note in log.since(0.0)] == [1.0, 2.0]


def test_wires_lose_double_bend_and_mix_as_they_say() -> None:
    sent = [bytes([k]) * 40 for k in range(2 * wires.REORDERED_AMONG)]
    arrived = {
        name: [datagram for each in sent for datagram in wire(each)]
        for name, wire in {
            "cut": wires.cut,
            "doubled": wires.doubled,
            "half": wires.half_dropped(1),
            "mixed": wires.reordered(1),
            "bent": wires.corrupted(1),
        }.items()
    }
    assert arrived["cut"] == []
    assert len(arrived["doubled"]) == 2 * len(sent)
    assert 0.25 < len(arrived["half"]) / len(sent) < 0.75
    assert sorted(arrived["mixed"]) == sent
    assert arrived["mixed"] != sent
    assert 0.25 < sum(a != b for a, b in zip(sent, arrived["bent"], strict=True)) / len(sent) < 0.75


def test_a_stepped_clock_shows_the_step_from_then_on_and_to_both_sides(tmp_path: Path) -> None:
    ours, theirs = SteppedClock(tmp_path / "clock"), SteppedClock(tmp_path / "clock")
    ours.step(3600.0)
    assert theirs.shown_ns(0) == 0
    far = 2**62
    assert theirs.shown_ns(far) == far + 3600 * NS_PER_S


def test_percentiles_of_nothing_are_no_numbers() -> None:
    assert math.isnan(percentiles([]).p99_ms)
    assert percentiles([0.001, 0.003]).max_ms == 3.0
