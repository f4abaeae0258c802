"""Where games place what they ask for: inside the limits, as far as was shown, and a little further after success."""

from math import degrees, radians

import msgspec
import pytest
from hypothesis import given
from hypothesis import strategies as st

from db.exercise import PlayedExercise
from db.limits import JointRange, PassiveRange, PatientLimits
from db.workspace import SessionWorkspace
from server.api.limits import session_limits
from server.api.workspace import (
    LEAST_SPAN_RAD,
    PUSHED_RAD,
    ends,
    first_workspace,
    inside,
    shown_workspace,
    succeeded,
)
from server.api.workspace_meter import ENOUGH_S, WorkspaceMeter
from server.config import StationConfig
from server.messages import EXO_JOINTS, DriveState

ALLOWED = inside(session_limits(PatientLimits(), StationConfig().device), 0.1)
LIMITS = SessionWorkspace(source="limits", used=ALLOWED)


def played(hits, misses):
    return (PlayedExercise(game="reach", played_s=60.0, score=0, hits=hits, misses=misses, level=0.3),)


def some(low_deg, high_deg):
    joint = JointRange(min_rad=radians(low_deg), max_rad=radians(high_deg))
    return PassiveRange(**dict.fromkeys(EXO_JOINTS, joint))


@pytest.mark.parametrize(
    ("hits", "misses", "well"), [(15, 5, True), (14, 6, True), (13, 7, False), (19, 0, False), (0, 0, False)]
)
def test_a_session_has_succeeded_with_enough_attempts_of_which_most_did(hits, misses, well):
    assert succeeded(played(hits, misses)) is well


@given(st.floats(-180, 179), st.floats(0.5, 180), st.booleans())
def test_no_workspace_leaves_what_is_allowed_or_is_empty(low_deg, span_deg, pushed):
    shown = some(low_deg, min(low_deg + span_deg, 180))
    used = shown_workspace(shown, LIMITS.model_copy(update={"pushed": pushed}), ALLOWED).used
    for joint in EXO_JOINTS:
        (low, high), (least, greatest) = ends(used, joint), ends(ALLOWED, joint)
        assert least <= low < high <= greatest


def test_what_was_shown_is_used_and_pushed_outwards_by_three_degrees_after_success():
    shown = some(20, 60)
    plain = shown_workspace(shown, LIMITS, ALLOWED)
    assert ends(plain.used, "elbow") == ends(shown, "elbow")
    pushed = shown_workspace(shown, first_workspace(None, played(18, 4), ALLOWED), ALLOWED)
    assert pushed.pushed
    low, high = ends(pushed.used, "elbow")
    assert (low, high) == pytest.approx((radians(17), radians(63)))


def test_without_a_new_measurement_the_last_workspace_holds_and_grows_only_after_success():
    last = shown_workspace(some(20, 60), LIMITS, ALLOWED)
    same = first_workspace(last, played(10, 10), ALLOWED)
    assert (same.source, same.used) == ("last", last.used)
    wider = first_workspace(last, played(18, 2), ALLOWED)
    assert ends(wider.used, "elbow")[1] == pytest.approx(ends(last.used, "elbow")[1] + PUSHED_RAD)


def test_a_single_pose_becomes_a_small_range_about_it():
    low, high = ends(shown_workspace(some(40, 40.5), LIMITS, ALLOWED).used, "elbow")
    assert high - low == pytest.approx(LEAST_SPAN_RAD)


@pytest.mark.parametrize(("low_deg", "span_deg"), [(-60.0, 40.0), (130.0, 40.0), (-170.0, 20.0), (160.0, 20.0)])
@pytest.mark.parametrize("beyond_deg", [-0.2, 0.0, 0.2])
def test_a_range_at_the_edge_of_what_is_allowed_is_still_one_to_play_in(low_deg, span_deg, beyond_deg):
    """Of what is shown, nothing or a fraction of a degree is allowed."""
    allowed = some(-20 + beyond_deg, 130 + beyond_deg)
    low, high = ends(shown_workspace(some(low_deg, low_deg + span_deg), LIMITS, allowed).used, "elbow")
    assert high - low == pytest.approx(LEAST_SPAN_RAD)
    assert degrees(low) == pytest.approx(-20 + beyond_deg) or degrees(high) == pytest.approx(130 + beyond_deg)


def test_where_less_is_allowed_than_a_game_needs_all_of_it_is_used():
    allowed = some(30, 36)
    assert shown_workspace(some(34, 80), LIMITS, allowed).used == allowed


def test_where_nobody_has_measured_the_games_have_the_limits():
    assert first_workspace(None, (), ALLOWED) == first_workspace(LIMITS, (), ALLOWED) == LIMITS


@pytest.fixture
def tick(paper_tick):
    """Makes ticks whose mirrored arm has every joint at one angle."""

    def made(t_s, angle_deg, state=DriveState.READY, elevation_deg=None, **more):
        angles = {f"{joint}_rad": radians(angle_deg) for joint in EXO_JOINTS}
        if elevation_deg is not None:
            angles["elevation_rad"] = radians(elevation_deg)
        target = msgspec.structs.replace(paper_tick.target, **angles, **more)
        return msgspec.structs.replace(paper_tick, t_s=t_s, state=state, target=target)

    return made


def shown_by(ticks):
    meter = WorkspaceMeter()
    for one in ticks:
        meter.take(one)
    return meter.read()


def test_the_meter_reads_the_robust_ends_of_what_was_shown_to_a_degree(tick):
    sweep = [tick(k / 50, 20 + 80 * (k % 100) / 100) for k in range(600)]
    outliers = [tick(12 + k / 50, angle) for k, angle in enumerate((-150, 170, 179))]
    read = shown_by([*sweep, *outliers])
    assert (read.enough, read.missing) == (True, [])
    for joint in EXO_JOINTS:
        low, high = (degrees(end) for end in ends(read.shown, joint))
        assert (low, high) == (pytest.approx(21.6, abs=2.0), pytest.approx(98.4, abs=2.0))


def test_what_is_missing_is_named(tick):
    still = [tick(k / 50, 40) for k in range(600)]
    read = shown_by(still)
    assert (read.missing, read.enough) == (list(EXO_JOINTS), False)
    assert read.seen_s > ENOUGH_S
    assert shown_by([]).shown is None


@pytest.mark.parametrize("more", [{"state": DriveState.ENGAGED}, {"valid": False}])
def test_an_arm_that_the_drive_moves_or_that_is_not_seen_shows_nothing(more, tick):
    assert shown_by(tick(k / 50, k % 90, **more) for k in range(300)).seen_s == 0.0


def test_plane_and_rotation_of_a_hanging_arm_are_not_counted(tick):
    assert shown_by(tick(k / 50, k % 90, elevation_deg=5) for k in range(300)).shown is None
