"""Which of a sensor's joints are believed: tracked without a flicker, in view, with bones as long as ever."""

from __future__ import annotations

from typing import Final

import numpy as np

from fusion.compiled import Record, Records, kernel
from fusion.estimation.measurement import Heard

STEADY_S: Final = 0.15
"""A joint is believed after this long without doubt: one that wanders flickers between inferred and tracked. One
that was not tracked at all and comes back tracked is believed at once. 0.1 to 0.25 s serve."""
SURE_FOR_S: Final = 0.25
"""What was believed this lately is what a new word is held against; 0.1 to 0.4 s serve."""
OUTVOTES_S: Final = 0.1
"""What was believed this lately outweighs doubtful word that differs: three frames."""

FIELDS: Final = [
    ("doubted_s", "f8"),  # when the joint was last in doubt; -inf never
    ("believed_s", "f8"),  # when the joint was last believed and fitted; -inf never
]
"""What is remembered of each joint of each sensor."""


@kernel
def strange(word: Record) -> None:
    """Nothing was heard of this sensor yet."""
    word.doubted_s = word.believed_s = -np.inf


@kernel
def judge(word: Record, t_s: float, heard: Heard) -> bool:
    """Whether a joint that a sensor gives is believed; `word` is what is remembered of that sensor and joint."""
    if heard.wandering or heard.hidden or not heard.tracked:
        word.doubted_s = t_s
    return heard.tracked and t_s - word.doubted_s > STEADY_S


@kernel
def others_believed_s(words: Records, own: int) -> float:
    """When any sensor but `own` was last believed in a joint; -inf never. `words` (K,) are those of the joint."""
    last_s = -np.inf
    for k in range(len(words)):
        if k != own:
            last_s = max(last_s, words[k].believed_s)
    return last_s


@kernel
def believed_lately(words: Records, t_s: float) -> int:
    """How many sensors were believed in a joint lately enough to count."""
    count = 0
    for k in range(len(words)):
        count += t_s - words[k].believed_s <= SURE_FOR_S
    return count


@kernel
def last_believed_s(words: Records) -> float:
    """When any of the sensors was last believed in a joint; -inf never."""
    return others_believed_s(words, -1)
