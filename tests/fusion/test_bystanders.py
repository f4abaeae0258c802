"""Whoever walks past, stands beside or reaches over: the patient is followed, in every sensor."""

from __future__ import annotations

from dataclasses import replace

import numpy as np
import pytest

from fusion.align.bodies import Verdict
from fusion.pipeline import Pipeline, PipelineSettings
from fusion.skeleton import INDEX, Side
from fusion.virtual_patient.bystander import Bystander, Visit
from fusion.virtual_patient.patient import VirtualPatient
from fusion.virtual_patient.trial import exercises, sensors_for

DT_S = 1 / 60
ALIGNED_S = 4.0
LENGTH_S = 11.0
TRUNK = [INDEX[name] for name in ("SpineBase", "SpineMid", "SpineShoulder")]


class Room:
    """A patient who exercises, and a visitor from the fourth second on, before two sensors; the visitor is number 9."""

    def __init__(self, visit, seed=2):
        self.patient, self.visitor = VirtualPatient(Side.RIGHT, seed), Bystander(visit, seed + 1)
        self.sensors, self.others = sensors_for(Side.RIGHT, seed), sensors_for(Side.RIGHT, seed + 50)
        self.pipeline = Pipeline(PipelineSettings(Side.RIGHT, "kalman"))
        self.number, self.others_number = ["1", "1"], ["9", "9"]
        self.seen = [True, True]
        self.goals = exercises(seed)
        self.until_s, self.goal = 0.0, None

    def run(self, to_s):
        """Distance (m) of the fused trunk from the true one at every step."""
        off = []
        while self.patient.t_s < to_s:
            positions, visitor = self.patient.step(DT_S, self._wanted()), self.visitor.step(DT_S)
            for k, sensor in enumerate(self.sensors):
                self._take(sensor.see(positions, self.patient.t_s) if self.seen[k] else None, self.number[k])
                other = self.others[k].see(visitor, self.patient.t_s)
                self._take(other if self.patient.t_s > ALIGNED_S else None, self.others_number[k])
            frame = self.pipeline.step(self.patient.t_s)
            if frame.fused is not None:
                true = self.sensors[0].pose.to_sensor(positions)
                off.append(np.linalg.norm(np.nanmean((frame.fused.positions_in_room - true)[TRUNK], axis=0)))
        return np.array(off)

    def _wanted(self):
        if self.patient.t_s >= self.until_s:
            stay_s, self.goal = next(self.goals)
            self.until_s += stay_s
        return self.goal

    def _take(self, sample, body):
        if sample is not None:
            self.pipeline.take(replace(sample, body=body))


def is_followed(room):
    told = room.pipeline.bodies(room.patient.t_s)
    return {seen.verdict is Verdict.PATIENT for seen in told if seen.body == "9"} == {False}


def refused(room, sensor):
    """Samples of somebody else."""
    return sum(count for reason, count in room.pipeline.refusals()[sensor].items() if "another person" in reason)


@pytest.mark.parametrize("visit", Visit)
def test_the_patient_is_followed_whatever_a_visitor_does(visit):
    room = Room(visit)
    room.run(ALIGNED_S)
    assert room.run(LENGTH_S).max() < 0.06
    assert is_followed(room)


def test_a_patient_whom_a_sensor_loses_behind_a_visitor_is_taken_up_again_under_a_new_number():
    room = Room(Visit.REACHES)
    room.run(ALIGNED_S + 2.0)
    room.seen[0] = False
    assert room.run(ALIGNED_S + 4.0).max() < 0.06
    room.seen[0], room.number[0] = True, "12"
    assert room.run(LENGTH_S).max() < 0.06
    assert refused(room, "virtual-1") > 100
    assert is_followed(room)


def test_a_patient_whom_both_sensors_lose_is_never_taken_for_the_visitor():
    room = Room(Visit.REACHES)
    room.run(ALIGNED_S + 2.0)
    room.seen = [False, False]
    room.run(ALIGNED_S + 5.0)
    assert is_followed(room)
    room.seen, room.number = [True, True], ["12", "13"]
    room.run(ALIGNED_S + 6.0)
    assert room.run(LENGTH_S + 2.0).max() < 0.06
    assert is_followed(room)


def test_a_number_that_goes_over_to_the_visitor_is_let_go():
    """They stand side by side, and a sensor mistakes one for the other."""
    room = Room(Visit.STANDS)
    room.run(ALIGNED_S + 2.0)
    room.number[0], room.others_number[0] = "9", "1"
    assert room.run(LENGTH_S).max() < 0.1
    followed = {seen.body for seen in room.pipeline.bodies(room.patient.t_s) if seen.verdict is Verdict.PATIENT}
    assert followed == {"9", "1"}  # the first sensor's new number, and the second one's old one


def test_a_click_confirms_the_patient_without_a_new_beginning():
    room = Room(Visit.STANDS)
    room.run(ALIGNED_S + 2.0)
    assert room.pipeline.follow("virtual-1", "1") is False
    assert room.run(ALIGNED_S + 3.0).max() < 0.06
    assert [seen.body for seen in room.pipeline.bodies(room.patient.t_s) if seen.confirmed] == ["1"]
