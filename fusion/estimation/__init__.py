"""Estimators: a base and one sibling file per method.

A new method is a new file beside `kalman` and one line in `METHODS`.
"""

from __future__ import annotations

from collections.abc import Callable
from typing import Final

from fusion.estimation.adaptive import Adaptive
from fusion.estimation.average import Average
from fusion.estimation.esmf import Esmf
from fusion.estimation.estimator import Estimator
from fusion.estimation.kalman import Kalman
from fusion.estimation.set_membership import SetMembership

METHODS: Final[dict[str, Callable[[], Estimator]]] = {
    method.name: method for method in (SetMembership, Kalman, Esmf, Adaptive, Average)
}
"""Every method by the name that `--method` takes; the first is the default."""
