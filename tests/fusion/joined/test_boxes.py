"""Laws of the cuts: they keep every body that obeys the rules, more rules never widen, their order does not matter."""

from __future__ import annotations

import numpy as np
from hypothesis import given
from hypothesis import strategies as st

from fusion.joined.boxes import Boxes, Distance, Offset, Place, Rule, anywhere, contracted
from fusion.skeleton import BONE_INDICES, JOINT_COUNT

SEEDS = st.integers(0, 2**32 - 1)
A, B = 4, 5


def a_body(rng: np.random.Generator) -> np.ndarray:
    """(25, 3) m, bones of human lengths in any direction."""
    positions = np.zeros((JOINT_COUNT, 3))
    for parent, child in BONE_INDICES:
        step = rng.normal(size=3)
        positions[child] = positions[parent] + rng.uniform(0.05, 0.45) * step / np.linalg.norm(step)
    return positions


def in_ball(rng: np.random.Generator, radius_m: float) -> np.ndarray:
    step = rng.normal(size=3)
    return rng.uniform(0, radius_m) * step / np.linalg.norm(step)


def boxes_around(rng: np.random.Generator, body: np.ndarray) -> Boxes:
    """Boxes that hold the body, a few of them endless."""
    below, above = rng.uniform(0, 0.4, (2, JOINT_COUNT, 3))
    below[rng.uniform(size=JOINT_COUNT) < 0.3] = np.inf
    return Boxes(body - below, body + above)


def true_rules(rng: np.random.Generator, body: np.ndarray) -> list[Rule]:
    """Rules of every kind that the body obeys."""
    rules: list[Rule] = [Place(0, body[0] + in_ball(rng, 0.2), 0.2)]
    for parent, child in BONE_INDICES.tolist():
        vector = body[child] - body[parent]
        length, slack = float(np.linalg.norm(vector)), rng.uniform(0, 0.1)
        rules.append(Distance(parent, child, max(length - slack, 0.0), length + slack))
        if rng.uniform() < 0.5:
            rules.append(Offset(parent, child, vector + in_ball(rng, slack), slack))
    return rules


def holds(boxes: Boxes, body: np.ndarray) -> np.ndarray:
    return (boxes.low - 1e-9 <= body) & (body <= boxes.high + 1e-9)


@given(seed=SEEDS)
def test_a_body_that_obeys_every_rule_stays_in_its_boxes(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = a_body(rng)
    found, unused = contracted(boxes_around(rng, body), true_rules(rng, body), sweeps=3)
    assert holds(found, body).all()
    assert unused == ()


@given(seed=SEEDS)
def test_the_posterior_holds_every_sampled_pair_of_joints_that_is_in_both_prior_and_rule(seed: int) -> None:
    rng = np.random.default_rng(seed)
    middle, half = rng.normal(0, 0.2, (2, 3)), rng.uniform(0.05, 0.4, (2, 3))
    prior = anywhere()
    prior.low[[A, B]], prior.high[[A, B]] = middle - half, middle + half
    first, second = rng.uniform(middle - half, middle + half, (4000, 2, 3)).transpose(1, 0, 2)
    least = rng.uniform(0, 0.4)
    rules = {
        Place(A, middle[0] + in_ball(rng, 0.3), 0.25): lambda p: (
            np.linalg.norm(first - p.position, axis=1) <= p.tolerance_m
        ),
        Distance(A, B, least, least + rng.uniform(0.02, 0.2)): lambda d: (
            np.abs(np.linalg.norm(second - first, axis=1) - (d.least_m + d.most_m) / 2) <= (d.most_m - d.least_m) / 2
        ),
        Offset(A, B, middle[1] - middle[0] + in_ball(rng, 0.3), 0.15): lambda o: (
            np.linalg.norm(second - first - o.offset, axis=1) <= o.tolerance_m
        ),
    }
    for rule, obeyed in rules.items():
        posterior, _ = contracted(prior, [rule])
        for joint, points in ((A, first), (B, second)):
            kept = points[obeyed(rule)]
            assert ((posterior.low[joint] - 1e-9 <= kept) & (kept <= posterior.high[joint] + 1e-9)).all()


@given(seed=SEEDS)
def test_another_rule_never_widens_a_box(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = a_body(rng)
    prior, rules = boxes_around(rng, body), true_rules(rng, body)
    fewer = [rule for rule in rules if rng.uniform() < 0.6]
    more_known, less_known = contracted(prior, rules)[0], contracted(prior, fewer)[0]
    assert (more_known.low >= less_known.low - 1e-9).all()
    assert (more_known.high <= less_known.high + 1e-9).all()


@given(seed=SEEDS)
def test_once_nothing_changes_any_more_the_order_of_the_rules_did_not_matter(seed: int) -> None:
    rng = np.random.default_rng(seed)
    body = a_body(rng)
    prior, rules = boxes_around(rng, body), true_rules(rng, body)
    shuffled = [rules[i] for i in rng.permutation(len(rules))]
    one, other = contracted(prior, rules, sweeps=60)[0], contracted(prior, shuffled, sweeps=60)[0]
    np.testing.assert_allclose(one.low, other.low, atol=1e-3)
    np.testing.assert_allclose(one.high, other.high, atol=1e-3)


def test_a_bone_that_cannot_reach_the_other_side_fixes_the_side() -> None:
    prior = anywhere()
    prior.low[[A, B]], prior.high[[A, B]] = [[-0.01] * 3, [-0.05, -0.05, 0.0]], [[0.01] * 3, [0.05, 0.05, 0.5]]
    found, _ = contracted(prior, [Distance(A, B, 0.29, 0.31)])
    assert found.low[B, 2] > 0.25
    assert found.high[B, 2] < 0.33


def test_a_rule_that_leaves_nothing_is_not_used_and_is_told() -> None:
    prior = anywhere()
    prior.low[A], prior.high[A] = 0.0, 0.1
    wrong = Place(A, np.ones(3), 0.1)
    found, unused = contracted(prior, [wrong, Place(A, np.full(3, 0.1), 0.05)])
    assert unused == (wrong,)
    np.testing.assert_allclose(found.low[A], 0.05)
