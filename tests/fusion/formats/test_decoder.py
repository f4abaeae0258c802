"""All dialects through the one decoder: what is sent arrives, whatever the network does to it."""

from collections.abc import Iterable

import numpy as np
import pytest
from hypothesis import given, settings
from hypothesis import strategies as st
from hypothesis.extra.numpy import arrays
from numpy.testing import assert_allclose, assert_array_equal

from fusion.errors import InputError
from fusion.formats.assembly import MAX_BODIES, SILENCE_S
from fusion.formats.decoder import MAX_SENDERS, MAX_UNKNOWN, Decoder
from fusion.formats.dialect import Dialect
from fusion.formats.kinectv2_osc import KinectV2Osc
from fusion.formats.mirrorlimb_osc import MirrorlimbOsc
from fusion.formats.osc import Reason, write, write_bundle
from fusion.formats.osceleton2 import NAMES, Osceleton2
from fusion.formats.registry import DIALECTS, dialect_named, dialect_of_address
from fusion.messages import Packet, SkeletonSample
from fusion.skeleton import INDEX, JOINT_COUNT

STREAM = "10.0.0.5"
PERIOD_S = 1 / 30
SAYABLE = {dialect.name: np.arange(JOINT_COUNT) for dialect in DIALECTS} | {
    "osceleton2": np.array(list(NAMES.values()))
}


@st.composite
def samples(draw: st.DrawFn) -> SkeletonSample:
    """A body whose lost joints are NaN and whose positions fit float32."""
    state = draw(arrays(np.uint8, JOINT_COUNT, elements=st.integers(0, 2)))
    positions = draw(arrays(np.float64, (JOINT_COUNT, 3), elements=st.floats(-10, 10, width=32)))
    positions[state == 0] = np.nan
    return SkeletonSample("k", str(draw(st.integers(0, 2**31 - 1))), 3.25, 3.25, positions, state)


def body_at(x_m: float, body: str = "4", t_s: float = 0.0) -> SkeletonSample:
    """A tracked body with every coordinate the same."""
    return SkeletonSample("k", body, t_s, t_s, np.full((JOINT_COUNT, 3), x_m), np.full(JOINT_COUNT, 2, np.uint8))


def feed(decoder: Decoder, payloads: Iterable[bytes], t_s: float = 0.0, stream: str = STREAM) -> list[SkeletonSample]:
    """Datagrams that arrive 50 µs after one another."""
    return [
        sample
        for number, payload in enumerate(payloads)
        for sample in decoder.feed(Packet(stream, t_s + number * 50e-6, payload))
    ]


def refusals(decoder: Decoder) -> dict[Reason, int]:
    return dict(decoder.counts().refused)


@pytest.mark.parametrize("dialect", DIALECTS, ids=lambda dialect: dialect.name)
@settings(max_examples=30)
@given(sent=samples())
def test_decode_undoes_encode(dialect: Dialect, sent: SkeletonSample) -> None:
    decoder = Decoder()
    (came,) = feed(decoder, dialect.encode(sent, 0), t_s=sent.t_s)
    says = SAYABLE[dialect.name]
    assert_array_equal(came.state[says], sent.state[says])
    assert_allclose(came.positions_in_sensor[says], sent.positions_in_sensor[says], rtol=1e-6, atol=1e-7)
    assert came.body == sent.body
    assert came.t_s == pytest.approx(sent.t_s)
    assert came.sensor.startswith(STREAM)
    assert decoder.dialect_of(came.sensor) == dialect.name
    assert not decoder.flush(100.0)
    assert not refusals(decoder)


def test_osceleton2_is_in_millimetres_with_y_negated() -> None:
    payload = write("/osceleton2/joint", "siiffffd", "l_wrist", 0, 3, 100.0, 250.0, 2000.0, 0.5, 1.7e12)
    (sample,) = [*feed(decoder := Decoder(), [payload]), *decoder.flush(1.0)]
    assert_allclose(sample.positions_in_sensor[INDEX["WristLeft"]], [0.1, -0.25, 2.0])
    assert sample.state[INDEX["WristLeft"]] == 1
    assert (sample.body, sample.t_s) == ("3", 1.7e9)


def test_neck_torso_and_waist_are_the_spine() -> None:
    assert [NAMES[name] for name in ("neck", "torso", "waist")] == [
        INDEX[name] for name in ("SpineShoulder", "SpineMid", "SpineBase")
    ]


def test_a_kinect_tracking_id_keeps_its_64_bits() -> None:
    (sample,) = feed(Decoder(), KinectV2Osc().encode(body_at(1, body=str(2**64 - 1)), 0))
    assert sample.body == str(2**64 - 1)


def test_numbered_joints_are_not_kinectv2s() -> None:
    assert dialect_of_address("/bodies/0/joints/12") is None
    assert dialect_of_address("/bodies/0/joints/Head") is dialect_named("kinectv2-osc")


def test_an_unknown_dialect_is_answered_with_the_known_ones() -> None:
    with pytest.raises(InputError, match="kinectv2-osc, osceleton2, mirrorlimb"):
        dialect_named("kinect")


# ---------------------------------------------------------------- where frames close


@pytest.mark.parametrize("dialect", [KinectV2Osc(), Osceleton2()], ids=lambda dialect: dialect.name)
def test_a_frame_closes_on_its_second_hand(dialect: Dialect) -> None:
    *most, last = dialect.encode(body_at(1.0), 0)
    decoder = Decoder()
    assert not feed(decoder, most)
    assert len(feed(decoder, [last], t_s=0.003)) == 1


@pytest.mark.parametrize("dialect", [KinectV2Osc(), Osceleton2()], ids=lambda dialect: dialect.name)
def test_without_hands_a_frame_closes_after_12_ms_of_silence(dialect: Dialect) -> None:
    decoder = Decoder()
    assert not feed(decoder, dialect.encode(body_at(1.0), 0)[:-2])
    assert not decoder.flush(0.9 * SILENCE_S)
    assert len(decoder.flush(2 * SILENCE_S)) == 1


def test_without_hands_a_frame_closes_on_a_repeated_joint() -> None:
    first, second = (KinectV2Osc().encode(body_at(x), 0)[:-2] for x in (1.0, 2.0))
    (sample,) = feed(Decoder(), first + second[:3])
    assert_array_equal(sample.positions_in_sensor, 1.0)


def test_without_hands_an_osceleton2_frame_closes_on_a_changed_time() -> None:
    first, second = (Osceleton2().encode(body_at(x, t_s=x), 0)[:-2] for x in (1.0, 2.0))
    (sample,) = feed(Decoder(), first[:5] + second[7:9])
    assert (sample.state > 0).sum() == 5


def test_an_overtaken_osceleton2_hand_does_not_close_the_next_frame() -> None:
    first, second = (Osceleton2().encode(body_at(x, t_s=x), 0) for x in (1.0, 2.0))
    came = feed(Decoder(), first[:-2] + second[:10] + first[-2:] + second[10:])
    assert [int((sample.state > 0).sum()) for sample in came] == [20, 20]


def test_a_frame_closes_at_the_end_of_its_bundle() -> None:
    bundle = write_bundle([write_bundle(KinectV2Osc().encode(body_at(1.0), 0)[:20])])
    (sample,) = feed(Decoder(), [bundle])
    assert (sample.state > 0).sum() == 20


def test_bodies_may_come_interleaved_and_joints_in_any_order() -> None:
    rng = np.random.default_rng(1)
    bodies = [KinectV2Osc().encode(body_at(float(number), body=str(number)), 0) for number in range(3)]
    joints = [payload for payloads in bodies for payload in payloads[:-2]]
    hands = [payload for payloads in bodies for payload in payloads[-2:]]
    came = feed(Decoder(), [joints[i] for i in rng.permutation(len(joints))] + hands)
    assert [sample.body for sample in came] == ["0", "1", "2"]
    for number, sample in enumerate(came):
        assert_array_equal(sample.positions_in_sensor, float(number))


@pytest.mark.parametrize("dialect", DIALECTS, ids=lambda dialect: dialect.name)
def test_sensors_are_told_apart_by_their_sender(dialect: Dialect) -> None:
    decoder = Decoder()
    pairs = zip(dialect.encode(body_at(1.0), 0), dialect.encode(body_at(2.0), 0), strict=True)
    came = [
        s for a, b in pairs for s in (*feed(decoder, [a], stream="10.0.0.1"), *feed(decoder, [b], stream="10.0.0.2"))
    ]
    assert [sample.sensor.split("/")[0] for sample in came] == ["10.0.0.1", "10.0.0.2"]
    assert [np.nanmax(sample.positions_in_sensor) for sample in came] == [1.0, 2.0]


@pytest.mark.parametrize("dialect", DIALECTS, ids=lambda dialect: dialect.name)
@settings(max_examples=60)
@given(data=st.data())
def test_lost_doubled_and_overtaken_datagrams_never_mix_two_instants(dialect: Dialect, data: st.DataObject) -> None:
    decoder, came = Decoder(), []
    for frame in range(3):
        sent = dialect.encode(body_at(float(frame), t_s=frame * PERIOD_S), frame)
        fates = data.draw(st.lists(st.sampled_from([0, 1, 1, 1, 2]), min_size=len(sent), max_size=len(sent)))
        arriving = [payload for payload, times in zip(sent, fates, strict=True) for _ in range(times)]
        came += feed(decoder, data.draw(st.permutations(arriving)), t_s=frame * PERIOD_S)
    came += decoder.flush(1.0)
    for sample in came:
        assert len(np.unique(sample.positions_in_sensor[sample.state > 0])) <= 1


@pytest.mark.parametrize("dialect", DIALECTS, ids=lambda dialect: dialect.name)
def test_doubled_datagrams_give_one_sample_per_frame(dialect: Dialect) -> None:
    decoder = Decoder()
    came = [
        sample
        for frame in range(5)
        for sample in feed(
            decoder,
            [p for payload in dialect.encode(body_at(1.0, t_s=frame * PERIOD_S), frame) for p in (payload, payload)],
            t_s=frame * PERIOD_S,
        )
    ]
    assert len([*came, *decoder.flush(1.0)]) == 5


def test_a_sender_that_starts_anew_is_heard_again() -> None:
    decoder = Decoder()
    payloads = [MirrorlimbOsc().encode(body_at(1.0), sequence)[0] for sequence in (90_000, 90_001, 90_000, 0, 1)]
    assert [len(feed(decoder, [payload])) for payload in payloads] == [1, 1, 0, 1, 1]
    assert refusals(decoder) == {Reason.REPEATED: 1}


# ---------------------------------------------------------------- bad input


def _kinect(address: str, *arguments: object, tags: str = "fffs") -> bytes:
    return write(address, tags, *arguments)  # type: ignore[arg-type]  # wrong types are the point


HEAD = "/bodies/1/joints/Head"
NAN = float("nan")


@pytest.mark.parametrize(
    ("payload", "reason"),
    [
        (_kinect(HEAD, NAN, 0.0, 1.0, "Tracked"), Reason.NOT_FINITE),
        (_kinect(HEAD, 0.0, float("-inf"), 1.0, "Inferred"), Reason.NOT_FINITE),
        (_kinect(HEAD, 0.0, 0.0, 2500.0, "Tracked"), Reason.TOO_FAR),
        (_kinect(HEAD, 0.0, 0.0, 1.0, "Seen"), Reason.UNKNOWN_STATE),
        (_kinect("/bodies/1/joints/Tail", 0.0, 0.0, 1.0, "Tracked"), Reason.UNKNOWN_JOINT),
        (_kinect("/bodies/me/joints/Head", 0.0, 0.0, 1.0, "Tracked"), Reason.UNKNOWN_BODY),
        (_kinect(f"/bodies/{2**64}/joints/Head", 0.0, 0.0, 1.0, "Tracked"), Reason.UNKNOWN_BODY),
        (_kinect(HEAD, 0.0, 0.0, 1.0, 2, tags="fffi"), Reason.WRONG_ARGUMENTS),
        (_kinect("/bodies/1/hands/Third", "Open", "High", tags="ss"), Reason.UNKNOWN_JOINT),
        (write("/osceleton2/joint", "siiffffd", "tail", 0, 1, 0.0, 0.0, 1.0, 1.0, 0.0), Reason.UNKNOWN_JOINT),
        (write("/osceleton2/joint", "siiffffd", "head", 0, 1, 0.0, 0.0, 1.0, NAN, 0.0), Reason.UNKNOWN_STATE),
        (write("/osceleton2/joint", "siiffffd", "head", 0, 1, 0.0, 0.0, 1.0, 1.0, NAN), Reason.NOT_FINITE),
        (write("/osceleton2/hand", "iii", 0, 1, 0), Reason.WRONG_ARGUMENTS),
        (write("/mirrorlimb/1/skeleton", "s", "k"), Reason.WRONG_ARGUMENTS),
        (write("/mirrorlimb/2/skeleton", "s", "k"), Reason.UNKNOWN_ADDRESS),
        (b"GET / HTTP/1.1\r\n\r\n", Reason.NOT_OSC),
    ],
)
def test_what_cannot_be_is_refused_and_counted(payload: bytes, reason: Reason) -> None:
    decoder = Decoder()
    assert not feed(decoder, [payload])
    assert not decoder.flush(1.0)
    assert refusals(decoder) == {reason: 1}


@pytest.mark.parametrize(
    ("change", "reason"),
    [
        ({"sensor": ""}, Reason.BAD_NAME),
        ({"body": "\n"}, Reason.BAD_NAME),
        ({"sensor": "x" * 65}, Reason.BAD_NAME),
        ({"skeleton": "blazepose"}, Reason.UNKNOWN_SKELETON),
        ({"states": "2" * 24}, Reason.UNKNOWN_STATE),
        ({"states": "3" * 25}, Reason.UNKNOWN_STATE),
        ({"t": NAN}, Reason.NOT_FINITE),
        ({"x": NAN}, Reason.NOT_FINITE),
        ({"x": 51.0}, Reason.TOO_FAR),
    ],
)
def test_what_cannot_be_in_our_own_dialect_is_refused(change: dict[str, object], reason: Reason) -> None:
    fields = {
        "sensor": "k",
        "n": 0,
        "t": 0.0,
        "body": "1",
        "skeleton": "kinect-v2",
        "states": "2" * 25,
        "x": 1.0,
    } | change
    *head, x = fields.values()
    decoder = Decoder()
    feed(decoder, [_kinect("/mirrorlimb/1/skeleton", *head, x, *[1.0] * 74, tags="sidsss" + "f" * 75)])
    assert refusals(decoder) == {reason: 1}


def test_a_bad_message_in_a_bundle_spoils_only_itself() -> None:
    good = KinectV2Osc().encode(body_at(1.0), 0)
    bad = _kinect("/bodies/4/joints/Tail", 0.0, 0.0, 1.0, "Tracked")
    (sample,) = feed(decoder := Decoder(), [write_bundle([bad, *good])])
    assert sample.state.all()
    assert refusals(decoder) == {Reason.UNKNOWN_JOINT: 1}


def test_positions_of_lost_joints_may_be_anything() -> None:
    decoder = Decoder()
    feed(decoder, [_kinect(HEAD, NAN, NAN, NAN, "NotTracked")])
    (sample,) = decoder.flush(1.0)
    assert not sample.state.any()
    assert np.isnan(sample.positions_in_sensor).all()


@settings(max_examples=300)
@given(data=st.data())
def test_a_flipped_byte_never_raises(data: st.DataObject) -> None:
    payload = bytearray(data.draw(st.sampled_from([p for d in DIALECTS for p in d.encode(body_at(1.0), 0)])))
    for _ in range(data.draw(st.integers(1, 4))):
        payload[data.draw(st.integers(0, len(payload) - 1))] = data.draw(st.integers(0, 255))
    decoder = Decoder()
    for sample in [*feed(decoder, [bytes(payload)]), *decoder.flush(1.0)]:
        assert np.isfinite(sample.positions_in_sensor[sample.state > 0]).all()
        assert np.isfinite(sample.t_s)


# ---------------------------------------------------------------- floods


def test_unknown_addresses_are_listed_once_and_not_for_ever() -> None:
    decoder = Decoder()
    feed(decoder, [write(f"/other/{number % 100}\n", "i", 1) for number in range(1000)])
    counts = decoder.counts()
    assert counts.unknown_addresses[:2] == ("/other/0?", "/other/1?")
    assert len(counts.unknown_addresses) == MAX_UNKNOWN
    assert counts.refused_in_all == counts.datagrams == 1000


def test_a_flood_of_bodies_is_refused() -> None:
    decoder = Decoder()
    feed(decoder, [_kinect(f"/bodies/{n}/joints/Head", 0.0, 0.0, 1.0, "Tracked") for n in range(100)])
    assert refusals(decoder) == {Reason.TOO_MANY_BODIES: 100 - MAX_BODIES}


def test_a_flood_of_senders_is_refused_until_others_fall_silent() -> None:
    decoder = Decoder()
    frame = MirrorlimbOsc().encode(body_at(1.0), 0)
    came = [sample for number in range(100) for sample in feed(decoder, frame, stream=f"10.0.1.{number}")]
    assert len(came) == MAX_SENDERS
    assert refusals(decoder) == {Reason.TOO_MANY_SENDERS: 100 - MAX_SENDERS}
    assert len(feed(decoder, frame, t_s=60.0, stream="10.0.2.1")) == 1


def test_a_flood_of_sensor_names_is_refused() -> None:
    decoder = Decoder()
    for number in range(100):
        sample = body_at(1.0)
        named = SkeletonSample(f"k{number}", sample.body, 0.0, 0.0, sample.positions_in_sensor, sample.state)
        feed(decoder, MirrorlimbOsc().encode(named, 0))
    assert refusals(decoder)[Reason.TOO_MANY_SENDERS] == 84
