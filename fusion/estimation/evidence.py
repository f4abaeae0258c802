"""What a sensor's word about a joint is worth: whether it is used, how surely, and how far it may be off."""

from __future__ import annotations

from typing import Final, NamedTuple

from fusion.compiled import Record, Records, kernel
from fusion.estimation import bias, tremor, trust
from fusion.estimation.error_box import half_width_in_room
from fusion.estimation.gated_filter import carried_on
from fusion.estimation.measurement import Heard
from fusion.estimation.motion_set import SPEED_MAX
from fusion.estimation.trust import OUTVOTES_S, SURE_FOR_S
from fusion.estimation.vectors import Vector, distance, plus, widened
from fusion.messages import Floats

AGREES_WITHIN_M: Final = 0.08
"""A doubted measurement this near to what a believed sensor leads to expect is no outlier."""
BELIEVED_HALF_WIDTH_M: Final[Vector] = (0.2, 0.2, 0.15)
"""Range, across, up: the error interval of a tracked joint [Du2016 Table 1]."""
DOUBTED_HALF_WIDTH_M: Final[Vector] = (0.6, 0.6, 0.6)
"""An inferred or wandering joint is off by half a metre at worst; and a fifth more."""


class Evidence(NamedTuple):
    """One sensor's word about one joint, ready to be used."""

    position: Vector  # m in room, as measured and carried on to now with the velocity believed
    measured: Vector  # m in room, as measured: a velocity that is only believed cuts no set
    apart_m: float  # from the point predicted
    believed: bool
    unchecked: bool  # believed where nobody was lately: the gate has nothing to judge by
    shared: bool  # believed, and so was another sensor lately
    outvoted: bool  # in doubt, disagreeing, and another sensor is sure: the point is not moved by it
    variance: float  # m², of its white noise
    half_width: Vector  # m along the room's axes, around `measured`


@kernel
def weigh(
    heard: Heard,
    lens: Vector,
    rotation_sensor_to_room: Floats,
    joint: Record,
    words: Records,
    bias_m2: Floats,
    own: int,
    t_s: float,
    late_s: float,
) -> Evidence:
    """Weigh what a sensor at `lens` says of a joint against its own past, the other sensors and the predicted joint.

    `words` (K,) is what is remembered of the joint, sensor by sensor, `bias_m2` (K, K) how their biases vary together;
    `own` is this sensor.
    """
    word = words[own]
    believed = trust.judge(word, t_s, heard)
    tremor.learn(word, heard.position, t_s - word.heard_s, heard.tracked)
    bias.age(words, bias_m2, own, heard.from_spine, heard.spine_seen, t_s)
    bias.reopen(words, bias_m2, own, believed)
    position = carried_on(joint, heard.position, late_s)
    apart_m = distance(position, joint.position)
    others_s = t_s - trust.others_believed_s(words, own)
    box_m = BELIEVED_HALF_WIDTH_M if believed else DOUBTED_HALF_WIDTH_M
    half_width = half_width_in_room(plus(heard.position, lens, -1.0), rotation_sensor_to_room, box_m)
    return Evidence(
        position=position,
        measured=heard.position,
        apart_m=apart_m,
        believed=believed,
        unchecked=believed and min(others_s, t_s - word.believed_s) > SURE_FOR_S,
        shared=believed and others_s <= SURE_FOR_S,
        outvoted=not believed and others_s <= OUTVOTES_S and apart_m > AGREES_WITHIN_M,
        variance=tremor.variance(word, believed),
        half_width=widened(half_width, SPEED_MAX * late_s),
    )
