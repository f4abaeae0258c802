"""A drive that was not where the gate believed it is told the command and a gap, which closes slowly.

The gate lets a set-point begin anew where a joint is measured: when a waiting arm has been moved, or a yielding one is
held. The gap must not be added to that, or the joint is sent beyond where it stands; moved there it is measured, the
set-point begins anew, and it runs away.
"""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.messages import Floats

STEP_RAD: Final = 0.045
"""A command that moves further in one tick begins anew: no joint is so quick, and what the gate leaps is more."""


def gap_rad(before_rad: Floats, gap_before_rad: Floats, wanted_rad: Floats, measured_rad: Floats) -> Floats:
    """What is to be added to a command now, (n,) rad.

    Args:
        before_rad: (n,) the command before.
        gap_before_rad: (n,) what was added to it.
        wanted_rad: (n,) the command.
        measured_rad: (n,) where the joints are.
    """
    step = wanted_rad - before_rad
    as_told = gap_before_rad - step  # the joint is told what it was told before
    is_nearer = np.abs(wanted_rad + as_told - measured_rad) < np.abs(wanted_rad + gap_before_rad - measured_rad)
    begins_anew = (gap_before_rad != 0.0) & (np.abs(step) > STEP_RAD) & is_nearer
    gap: Floats = np.where(begins_anew, as_told, gap_before_rad)
    return gap
