"""Double-sided two-way ranging: six time stamps of two free-running clocks become one distance."""

from __future__ import annotations

from dataclasses import dataclass
from typing import Final

from fusion.errors import InputError

LIGHT_M_S: Final = 299_792_458.0


@dataclass(frozen=True, slots=True)
class TwoWayStamps:
    """One exchange poll → answer → final; each side stamps by its own clock, seconds."""

    poll_sent_s: float  # initiator
    poll_received_s: float  # responder
    answer_sent_s: float  # responder
    answer_received_s: float  # initiator
    final_sent_s: float  # initiator
    final_received_s: float  # responder


def range_from_stamps(stamps: TwoWayStamps) -> float:
    """The distance in metres [Shi].

    ToF = (Tround1·Tround2 − Treply1·Treply2) / (Tround1 + Tround2 + Treply1 + Treply2)

    Only differences by one clock enter, so offsets cancel; clocks that run apart by e shift the time of flight by about
    e · ToF alone (1 ppm at 5 m: 5 µm), whatever the replies last.

    Raises:
        InputError: the stamps do not go forward.
    """
    round_1 = stamps.answer_received_s - stamps.poll_sent_s
    reply_1 = stamps.answer_sent_s - stamps.poll_received_s
    round_2 = stamps.final_received_s - stamps.answer_sent_s
    reply_2 = stamps.final_sent_s - stamps.answer_received_s
    if min(round_1, round_2, reply_1, reply_2) <= 0:
        raise InputError("a ranging exchange's stamps do not go forward", "every interval above 0", "check the clocks")
    flight_s = (round_1 * round_2 - reply_1 * reply_2) / (round_1 + round_2 + reply_1 + reply_2)
    return LIGHT_M_S * flight_s
