"""From recorded ticks to figures, also from recordings that older versions made."""

import msgspec
import pytest

from fusion.skeleton import Side
from server.api.measure import Counts, session_record
from server.api.recorded import RecordedTick

EXO = {"angle_rad": [0.1] * 4, "velocity_rad_s": [0.2] * 4, "torque_nm": [3.0] * 4}
TOLD = {"interaction_nm": [0.5] * 4, "share": [0.3] * 4, "assistance": "assisted", "level": 0.6}


def recorded(exo, **more):
    tick = {"t_s": 1.0, "state": "engaged", "healthy": None, "exo": exo, "trunk_lean_m": 0.0, "sensors": []} | more
    return msgspec.msgpack.decode(msgspec.msgpack.encode(tick), type=RecordedTick)


def test_a_recording_from_before_efforts_were_told_has_none():
    assert session_record([recorded(EXO)], Side.RIGHT, Counts()).drive is None


def test_a_recording_of_now_tells_effort_help_and_mode():
    record = session_record([recorded(EXO | TOLD)], Side.RIGHT, Counts(hits=1, misses=2, pain_calls=3))
    assert (record.hits, record.misses, record.pain_calls) == (1, 2, 3)
    assert record.drive.interaction_nm.tolist() == [[0.5] * 4]
    assert record.drive.share.tolist() == [[0.3] * 4]
    assert record.drive.torque_nm.tolist() == [[3.0] * 4]
    assert (record.drive.assistance.tolist(), record.drive.level.tolist()) == (["assisted"], [0.6])


def test_a_recording_from_before_the_shoulder_was_told_has_no_hitch():
    assert session_record([recorded(EXO)], Side.RIGHT, Counts()).shoulder_hitch_m is None
    told = session_record([recorded(EXO, shoulder_hitch_m=0.03)], Side.RIGHT, Counts())
    assert told.shoulder_hitch_m.tolist() == [0.03]


def test_a_tick_with_another_way_of_helping_is_refused():
    with pytest.raises(msgspec.ValidationError):
        recorded(EXO | TOLD | {"assistance": "strong"})
