"""What a sensor's word about a joint is worth: whether it is used, how surely, and how far it may be off."""

from __future__ import annotations

from typing import Final, NamedTuple

from fusion.compiled import Record, Records, kernel
from fusion.estimation import trust
from fusion.estimation.error_box import half_width_in_room
from fusion.estimation.gated_filter import carried_on
from fusion.estimation.measurement import Heard
from fusion.estimation.motion_set import SPEED_MAX
from fusion.estimation.vectors import Vector, distance, plus, widened
from fusion.messages import Floats

BELIEVED_STD_M: Final = 0.035
DOUBTED_STD_M: Final = 0.2
"""Off by half a metre at worst is 0.2 to 0.3 m as a rule; nothing changes in between."""
AGREEING_STD_M: Final = 0.07
AGREES_WITHIN_M: Final = 0.08
"""A doubted measurement this near to what a believed sensor leads to expect is used beside it."""
BELIEVED_HALF_WIDTH_M: Final[Vector] = (0.2, 0.2, 0.15)
"""Range, across, up: the error interval of a tracked joint [Du2016 Table 1]."""
DOUBTED_HALF_WIDTH_M: Final[Vector] = (0.6, 0.6, 0.6)
"""An inferred or wandering joint is off by half a metre at worst; and a fifth more."""


class Evidence(NamedTuple):
    """One sensor's word about one joint, ready to be used."""

    position: Vector  # m in room, as measured
    unbiased: Vector  # m, less what this sensor always says differently from the others
    believed: bool
    unchecked: bool  # believed where nobody was lately: the gate has nothing to judge by
    shared: bool  # believed, and so was another sensor lately
    outvoted: bool  # in doubt, disagreeing, and another sensor is sure: not used
    variance: float  # m²
    half_width: Vector  # m along the room's axes


@kernel
def weigh(
    heard: Heard,
    lens: Vector,
    rotation_sensor_to_room: Floats,
    joint: Record,
    words: Records,
    own: int,
    t_s: float,
    late_s: float,
) -> Evidence:
    """Weigh what a sensor at `lens` says of a joint against its own past, the other sensors and the predicted joint.

    `words` (K,) is what is remembered of the joint, sensor by sensor; `own` is this sensor. The point is moved by what
    the learnt bias leaves, the set is cut by what was measured.
    """
    word = words[own]
    believed = trust.judge(word, t_s, heard.tracked, heard.wandering)
    position = carried_on(joint, heard.position, late_s)
    unbiased = plus(position, word.offset_m, -1.0)
    surely = trust.another_is_sure(words, own, t_s)
    agrees = surely and distance(unbiased, joint.position) < AGREES_WITHIN_M
    std_m = BELIEVED_STD_M if believed else AGREEING_STD_M if agrees else DOUBTED_STD_M
    box_m = BELIEVED_HALF_WIDTH_M if believed else DOUBTED_HALF_WIDTH_M
    from_lens = plus(heard.position, lens, -1.0)
    half_width = half_width_in_room(from_lens, rotation_sensor_to_room, box_m)
    return Evidence(
        position=position,
        unbiased=unbiased,
        believed=believed,
        unchecked=believed and not surely and not trust.is_sure(word, t_s),
        shared=believed and surely,
        outvoted=surely and not believed and not agrees,
        variance=std_m**2,
        half_width=widened(half_width, SPEED_MAX * late_s),
    )
