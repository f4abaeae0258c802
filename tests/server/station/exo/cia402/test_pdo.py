"""What travels in a cycle, and how full it makes the bus."""

from __future__ import annotations

import pytest
from hypothesis import given
from hypothesis import strategies as st

from server.station.exo.cia402.bus import EMERGENCY, emergency_of
from server.station.exo.cia402.faults import words
from server.station.exo.cia402.pdo import MEASURED, PDOS, SET_POINT, load


@pytest.mark.parametrize("message", PDOS)
def test_a_message_fits_a_can_frame_and_its_mapping_says_its_bytes(message: object) -> None:
    assert message.form.size <= 8
    assert message.form.size * 8 == sum(entry.bits for entry in message.entries)


def test_a_mapping_is_off_while_it_is_written_and_on_at_the_end() -> None:
    identifiers = [value for entry, value in MEASURED.settings(5) if entry.sub == 1 and entry.index == 0x1800]
    assert identifiers == [0x8000_0185, 0x185]


def test_set_points_carry_controlword_position_and_torque() -> None:
    names = [entry.name for entry in SET_POINT.entries]
    assert names == ["controlword", "target position", "max torque"]


def test_seven_joints_at_100_hz_fill_less_than_a_third_of_a_megabit() -> None:
    assert load(7, 0.01, 1_000_000) == pytest.approx(0.297, abs=0.001)


@given(st.integers(1, 0xFFFF))
def test_every_error_code_has_words_and_keeps_its_number(code: int) -> None:
    assert f"{code:04X}h" in words(code)


@given(st.binary(max_size=8))
def test_an_emergency_message_of_any_bytes_is_read(data: bytes) -> None:
    assert emergency_of(data) == EMERGENCY.unpack(data.ljust(8, b"\0"))[0]
