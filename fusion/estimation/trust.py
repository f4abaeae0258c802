"""Which of a sensor's joints are believed: tracked without a flicker, with bones as long as they always are."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.compiled import Record, Records, kernel

STEADY_S: Final = 0.25
"""A joint is believed after this long without doubt: one that wanders flickers between inferred and tracked. One
that was not tracked at all and comes back tracked is believed at once."""
SURE_FOR_S: Final = 0.25
"""What was believed this lately outweighs doubtful word that is newer; 0.2 to 0.5 s serve. With less, a sensor whose
samples come late lets the doubtful ones of a faster sensor in and out by turns."""

FIELDS: Final = [
    ("doubted_s", "f8"),  # when the joint was last in doubt; -inf never
    ("believed_s", "f8"),  # when the joint was last believed and fitted; -inf never
]
"""What is remembered of each joint of each sensor."""


@kernel
def judge(word: Record, t_s: float, tracked: bool, wandering: bool) -> bool:
    """Whether a joint that a sensor gives is believed; `word` is what is remembered of that sensor and joint."""
    if wandering or not tracked:
        word.doubted_s = t_s
    return tracked and t_s - word.doubted_s > STEADY_S


@kernel
def is_sure(word: Record, t_s: float) -> bool:
    """Whether a sensor was believed lately enough to outweigh doubtful word."""
    return bool(t_s - word.believed_s <= SURE_FOR_S)


@kernel
def another_is_sure(words: Records, own: int, t_s: float) -> bool:
    """`is_sure` any sensor but `own`; `words` (K,) are those of one joint."""
    sure = False
    for k in range(len(words)):
        sure |= k != own and is_sure(words[k], t_s)
    return sure


@kernel
def last_believed_s(words: Records) -> float:
    """When any of the sensors was last believed in this joint; -inf never."""
    last_s = -np.inf
    for k in range(len(words)):
        last_s = max(last_s, words[k].believed_s)
    return last_s
