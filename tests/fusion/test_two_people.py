"""Of two real people before two real sensors, one is followed throughout."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.align.bodies import Verdict, trunk_centre
from fusion.align.whole import align_streams
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.recording.reader import read_recording
from fusion.skeleton import Side

TWO = "dual-kinect-study22-two-people-45deg"
OTHERS = (Verdict.BESIDE, Verdict.BONES)
APART_M = 0.3
"""The two stand 0.8 m apart and never touch."""


@pytest.fixture(scope="module")
def told(recordings):
    """How far the other one was from the fused body, and the numbers that aligned sensors took for the patient's."""
    recording = read_recording(recordings / TWO)
    streams = recording.skeleton_streams
    reference = next(stream.sensor for stream in streams if stream.primary)
    found = align_streams(streams, reference).alignments

    def run(live):
        pipeline = Pipeline(PipelineSettings(Side.RIGHT, "kalman", reference, None if live else found))
        due = [(s.t_s - found[s.sensor].clock_offset_s, s) for stream in streams for s in stream.samples]
        apart_m, patients = [], set()
        for t_s, sample in sorted(due, key=lambda one: one[0]):
            pipeline.take(sample)
            frame = pipeline.step(t_s)
            placed = {quality.sensor for quality in frame.sensors if quality.aligned}
            for seen in pipeline.bodies(t_s):
                if seen.verdict is Verdict.PATIENT and seen.sensor in placed:
                    patients.add((seen.sensor, seen.body))
                elif seen.verdict in OTHERS and seen.sensor == reference and frame.fused is not None:
                    trunk = trunk_centre(frame.fused.positions_in_room, frame.fused.state)
                    apart_m.append(np.linalg.norm(trunk - seen.centre_in_sensor))
        return np.array(apart_m), patients

    return run


@pytest.mark.recordings
@pytest.mark.parametrize("live", [False, True], ids=["aligned", "live"])
def test_the_followed_person_never_changes_and_is_never_where_the_other_is(told, live):
    apart_m, patients = told(live)
    assert len(patients) == 2  # one number in each sensor: the recording's numbers stay with their wearers
    assert len(apart_m) > 500
    assert apart_m.min() > APART_M
