"""What rosbridge says is read, and whatever else comes is not taken for it."""

from __future__ import annotations

import json

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.station.exo.rosbridge import wire

ANYTHING = st.recursive(
    st.none() | st.booleans() | st.floats() | st.integers() | st.text(max_size=8),
    lambda inner: st.lists(inner, max_size=4) | st.dictionaries(st.text(max_size=6), inner, max_size=4),
    max_leaves=12,
)


def _read(message: str | bytes) -> wire.JointState | None:
    heard = wire.heard(message)
    return None if heard is None else wire.joint_state(heard.msg)


def test_a_state_as_rosbridge_writes_it_is_read() -> None:
    message = {
        "op": "publish",
        "topic": "/joint_states",
        "msg": {
            "header": {"stamp": {"sec": 12, "nanosec": 500_000_000}, "frame_id": "base"},
            "name": ["a", "b"],
            "position": [0.5, None],
            "velocity": [],
            "effort": [1, 2.5],
        },
    }
    state = _read(json.dumps(message))
    assert state.header.stamp.seconds == 12.5
    assert state.position == (0.5, None)
    assert state.effort == (1.0, 2.5)


@given(st.binary(max_size=200) | st.text(max_size=200))
def test_sr2_garbage_is_nothing(message) -> None:
    assert _read(message) is None


@given(ANYTHING, ANYTHING)
def test_sr2_json_of_any_shape_is_read_or_is_nothing(message, positions) -> None:
    _read(json.dumps({"op": "publish", "topic": "/joint_states", "msg": message}))
    state = {"name": ["a"], "position": positions}
    read = _read(json.dumps({"op": "publish", "topic": "/joint_states", "msg": state}))
    assert read is None or all(value is None or isinstance(value, float) for value in read.position)


@pytest.mark.parametrize("message", ["[" * 60_000, '{"op":' * 9_000, '{"op": "status", "msg": ' + "[" * 50_000])
def test_sr2_deep_nests_are_nothing(message) -> None:
    assert _read(message) is None


@given(st.floats(0, 1e6))
def test_times_come_back_to_the_nanosecond(seconds) -> None:
    assert wire.time_of(seconds).seconds == pytest.approx(seconds, abs=1e-9 + seconds * 1e-15)
    assert 0 <= wire.time_of(seconds).nanosec < 1_000_000_000
