"""A recording's other streams become samples, and what cannot be used is named with the reason."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from fusion.joined.feed import samples_of
from fusion.messages import PositionSample, SegmentSample
from fusion.recording.recording import Recording
from fusion.skeleton import Side
from fusion.virtual_patient.tag import in_anchors
from fusion.virtual_patient.worn import sites_on


def test_every_site_and_the_tag_of_a_recording_speak(everything: Recording) -> None:
    found = samples_of(everything)
    assert [name for name, _ in found.used] == [*sites_on(Side.RIGHT), "waist"]
    assert found.unusable == {}
    for name, samples in found.used:
        kind = PositionSample if name == "waist" else SegmentSample
        assert all(isinstance(sample, kind) for sample in samples)
        assert samples[-1].t_s - samples[0].t_s > 19.0


def test_a_site_without_a_bone_a_second_tag_and_flat_anchors_are_named(everything: Recording) -> None:
    sock = replace(everything.imu_streams[0], site="left-sock")
    flat = everything.range_streams[0]
    level = replace(flat, anchor_positions=flat.anchor_positions * (1.0, 1.0, 0.0), tags=("belt", "hat"))
    found = samples_of(replace(everything, imu_streams=(sock,), range_streams=(level,)))
    assert found.used == ()
    assert set(found.unusable) == {"left-sock", "belt", "hat"}
    assert "site" in found.unusable["left-sock"]
    assert "plane" in found.unusable["belt"]
    assert "second tag" in found.unusable["hat"]


def test_a_gap_makes_a_stream_unusable_and_says_where(everything: Recording) -> None:
    whole = everything.imu_streams[0]
    keep = (whole.t_s < 5.0) | (whole.t_s > 6.0)
    holed = replace(whole, t_s=whole.t_s[keep], gyro_rad_s=whole.gyro_rad_s[keep], accel_m_s2=whole.accel_m_s2[keep])
    found = samples_of(replace(everything, imu_streams=(holed,), range_streams=()))
    assert "gap" in found.unusable["upper-back"]


def test_another_clock_is_no_clock(everything: Recording) -> None:
    late = replace(everything.imu_streams[0], t_s=everything.imu_streams[0].t_s + 1e6)
    found = samples_of(replace(everything, imu_streams=(late,), range_streams=()))
    assert "clock" in found.unusable["upper-back"]


def test_the_anchors_frame_has_z_up() -> None:
    up = in_anchors(np.array([[0.0, 1.0, 0.0]])) - in_anchors(np.zeros((1, 3)))
    np.testing.assert_allclose(up, [[0.0, 0.0, 1.0]], atol=1e-12)
