"""A joint behind the patient's own trunk is in doubt, and only such a one."""

from __future__ import annotations

import numpy as np
import pytest

from fusion.estimation import occlusion
from fusion.estimation.set_membership import SetMembership
from fusion.skeleton import INDEX

from .scene import FRAME_S, LENSES, changed, sample_at

TOP, BOTTOM = (0.0, 1.4, 2.5), (0.0, 0.9, 2.5)
FRONT, LEFT = (0.0, 1.0, 0.0), (-2.5, 1.0, 2.5)


@pytest.mark.parametrize(
    ("lens", "joint", "hidden"),
    [
        (LEFT, (0.35, 1.1, 2.5), True),  # the far arm hangs
        (LEFT, (-0.35, 1.1, 2.5), False),  # the near one
        (LEFT, (0.35, 1.1, 2.1), False),  # the far arm reaches ahead
        (LEFT, (0.3, 1.9, 2.5), False),  # or up
        (LEFT, (0.05, 1.1, 2.5), False),  # no arm is within the trunk
        (FRONT, (0.35, 1.1, 2.5), False),
        (FRONT, (0.0, 1.1, 2.8), True),  # a hand on the back
        (FRONT, (0.0, 1.1, 2.2), False),  # and before the chest
    ],
)
def test_the_trunk_hides_what_is_behind_it(
    lens: tuple[float, float, float], joint: tuple[float, float, float], hidden: bool
) -> None:
    assert occlusion.is_hidden(lens, joint, TOP, BOTTOM) == hidden


def test_a_trunk_that_is_not_known_hides_nothing() -> None:
    nowhere = (np.nan, np.nan, np.nan)
    assert not occlusion.is_hidden(LEFT, (0.35, 1.1, 2.5), nowhere, BOTTOM)
    assert not occlusion.is_hidden(LEFT, nowhere, TOP, BOTTOM)


def test_a_hidden_elbow_that_differs_is_refused_and_the_reason_is_told() -> None:
    """Though it is called tracked, and keeps its bones."""
    estimator = SetMembership()
    lens = LENSES["side"]
    spine = {INDEX["SpineShoulder"]: (0.0, 1.4, 2.5), INDEX["SpineBase"]: (0.0, 0.9, 2.5)}
    elbow, reasons = INDEX["ElbowLeft"], set()
    along = np.array([0.0, 1.15, 2.5]) - lens
    hidden = lens + along * (1 + 0.35 / np.linalg.norm(along))
    for k in range(90):
        for n, sensor in enumerate(("front", "side")):
            sample = sample_at((k + 0.5 * n) * FRAME_S, sensor)
            for joint, place in spine.items():
                sample = changed(sample, joint, place - sample.positions_in_room[joint])
            made_up = hidden + np.array([0.0, 0.2, 0.0]) if sensor == "side" else hidden
            sample = changed(sample, elbow, made_up - sample.positions_in_room[elbow])
            reasons |= {r.reason for r in estimator.update(sample) if r.joint == elbow and r.sensor == "side"}
    assert reasons == {"hidden behind the trunk"}
    assert np.linalg.norm(estimator.frame(3.0).positions_in_room[elbow] - hidden) < 0.02
