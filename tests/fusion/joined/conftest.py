"""A virtual patient with cameras, inertial sensors and a tag, lived through once for all tests here."""

from __future__ import annotations

import pytest

from fusion.recording.recording import Recording
from fusion.virtual_patient.sensor import TABLE1_CENTRED
from fusion.virtual_patient.tag import TagErrors
from fusion.virtual_patient.trial import virtual_recording
from fusion.virtual_patient.worn import ON_SKIN


@pytest.fixture(scope="session")
def everything() -> Recording:
    """20 s of reaching, clocks of all sensors equal."""
    return virtual_recording(
        3, 20.0, noise=TABLE1_CENTRED, clock_offset_s=0.0, stroll_m=0.1, worn=ON_SKIN, tag=TagErrors()
    )
