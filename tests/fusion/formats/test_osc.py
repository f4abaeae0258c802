"""OSC bytes: held against python-osc in both directions, and against garbage."""

import struct

import pytest
from hypothesis import example, given, settings
from hypothesis import strategies as st
from pythonosc.osc_message import OscMessage
from pythonosc.osc_message_builder import OscMessageBuilder

from fusion.formats.osc import MAX_BYTES, MAX_DEPTH, BadDatagram, Message, Reason, read, write, write_bundle

TEXT = st.text(st.characters(exclude_characters="\0", exclude_categories=["Cs"]), max_size=9)
VALUES = {
    "i": st.integers(-(2**31), 2**31 - 1),
    "h": st.integers(-(2**63), 2**63 - 1),
    "f": st.floats(width=32, allow_nan=False),
    "d": st.floats(allow_nan=False),
    "s": TEXT,
    "b": st.binary(min_size=1, max_size=9),
}
ARGUMENTS = st.lists(st.sampled_from("ihfdsb").flatmap(lambda tag: st.tuples(st.just(tag), VALUES[tag])), max_size=8)


@given(arguments=ARGUMENTS, name=TEXT)
def test_what_is_written_is_read_back_and_python_osc_agrees(arguments: list, name: str) -> None:
    tags, values = "".join(tag for tag, _ in arguments), tuple(value for _, value in arguments)
    payload = write(f"/{name}", tags, *values)
    assert read(payload) == (Message(f"/{name}", tags, values),)
    theirs = OscMessage(payload)
    assert (theirs.address, tuple(theirs.params)) == (f"/{name}", values)


@given(arguments=ARGUMENTS)
def test_what_python_osc_writes_is_read(arguments: list) -> None:
    builder = OscMessageBuilder("/a")
    for tag, value in arguments:
        builder.add_arg(value, tag)
    assert read(builder.build().dgram)[0].arguments == tuple(value for _, value in arguments)


def test_nested_bundles_are_opened_in_order() -> None:
    one, two, three = (write("/m", "i", number) for number in (1, 2, 3))
    payload = write_bundle([one, write_bundle([two, write_bundle([])]), three])
    assert [message.arguments for message in read(payload)] == [(1,), (2,), (3,)]


BUNDLE_HEAD = b"#bundle\0" + b"\0" * 8


@settings(max_examples=400)
@given(payload=st.binary(max_size=120) | st.binary(max_size=80).map(lambda tail: BUNDLE_HEAD + tail))
@example(payload=BUNDLE_HEAD + struct.pack(">i", -4) * 4)  # python-osc reads this one for ever
@example(payload=b"/a\0\0,f\0\0\x3f")
@example(payload=b"/a\0\0,[i\0")
def test_garbage_is_refused_and_nothing_else_is_raised(payload: bytes) -> None:
    try:
        messages = read(payload)
    except BadDatagram:
        return
    assert all(isinstance(message, Message) for message in messages)


WHOLE = write("/bodies/1/joints/Head", "fffs", 1.0, 2.0, 3.0, "Tracked")


@pytest.mark.parametrize("length", range(len(WHOLE)))
def test_a_message_cut_off_anywhere_is_refused(length: int) -> None:
    with pytest.raises(BadDatagram):
        read(WHOLE[:length])


@pytest.mark.parametrize("length", range(1, 5))
def test_a_bundle_cut_off_is_refused(length: int) -> None:
    with pytest.raises(BadDatagram):
        read(write_bundle([WHOLE])[:-length])


def _nested(depth: int) -> bytes:
    payload = WHOLE
    for _ in range(depth):
        payload = write_bundle([payload])
    return payload


@pytest.mark.parametrize(
    ("payload", "reason"),
    [
        (b"\0" * (MAX_BYTES + 1), Reason.OVERSIZED),
        (b"", Reason.NOT_OSC),
        (b"/a\0\0i\0\0\0", Reason.NOT_OSC),
        (WHOLE + b"\0\0\0\0", Reason.TRAILING),
        (b"/\xff\0\0,\0\0\0", Reason.BAD_TEXT),
        (b"/a\0\0,T\0\0", Reason.UNKNOWN_TAG),
        (_nested(MAX_DEPTH + 1), Reason.TOO_DEEP),
    ],
)
def test_the_reason_is_named(payload: bytes, reason: Reason) -> None:
    with pytest.raises(BadDatagram) as caught:
        read(payload)
    assert caught.value.reason is reason


def test_bundles_may_nest_as_deep_as_stated() -> None:
    assert len(read(_nested(MAX_DEPTH))) == 1
