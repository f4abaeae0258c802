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
LONGEST_STEP_M = 0.15
"""From one frame to the next; the sensors' own noise is a tenth of that."""
PAUSE_S = 1.0


@pytest.fixture(scope="module")
def told(recordings):
    """The body after every frame, and the numbers that aligned sensors took for the patient's."""
    recording = read_recording(recordings / TWO)
    streams = recording.skeleton_streams
    reference = next(stream.sensor for stream in streams if stream.primary)
    found = align_streams(streams, reference).alignments

    def run(live):
        pipeline = Pipeline(PipelineSettings(Side.RIGHT, "kalman", reference, None if live else found))
        due = [(s.t_s - found[s.sensor].clock_offset_s, s) for stream in streams for s in stream.samples]
        frames, patients = [], set()
        for t_s, sample in sorted(due, key=lambda one: one[0]):
            pipeline.take(sample)
            frame = pipeline.step(t_s)
            if frame.fused is not None:
                frames.append((frame.fused.t_s, *trunk_centre(frame.fused.positions_in_room, frame.fused.state)))
            placed = {quality.sensor for quality in frame.sensors if quality.aligned}
            judged = [seen for seen in pipeline.bodies(t_s) if seen.sensor in placed]
            patients |= {(seen.sensor, seen.body) for seen in judged if seen.verdict is Verdict.PATIENT}
        return np.array(frames), patients

    return run


@pytest.mark.recordings
@pytest.mark.parametrize("live", [False, True], ids=["aligned", "live"])
def test_the_followed_person_never_changes(told, live):
    frames, patients = told(live)
    assert len(frames) > 500
    assert len(patients) == 2  # one number in each sensor: the recording's numbers stay with their wearers
    together = np.diff(frames[:, 0]) < PAUSE_S
    steps = np.linalg.norm(np.diff(frames[:, 1:], axis=0), axis=1)[together]
    assert np.nanmax(steps) < LONGEST_STEP_M
