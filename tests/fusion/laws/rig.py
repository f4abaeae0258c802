"""Sensors that stand anywhere, limbs that use their limits to the full, and errors at the very edge of their box."""

from __future__ import annotations

from dataclasses import dataclass

import numpy as np
from scipy.spatial.transform import Rotation

from fusion.estimation.evidence import BELIEVED_HALF_WIDTH_M, DOUBTED_HALF_WIDTH_M
from fusion.estimation.motion_set import ACCELERATION_MAX, SPEED_MAX
from fusion.messages import AlignedSample
from fusion.skeleton import JOINT_COUNT, TrackingState

CORNERS = np.array([[a, b, c] for a in (-1.0, 1.0) for b in (-1.0, 1.0) for c in (-1.0, 1.0)])
TURN_EVERY_S = 0.02
FAR_FROM_HOME_M = 0.4


@dataclass(frozen=True)
class Lens:
    """Where a sensor stands, and which way it looks."""

    name: str
    place: np.ndarray  # (3,) m in room
    rotation: np.ndarray  # (3, 3) sensor to room


def a_lens(rng: np.random.Generator, name: str) -> Lens:
    """3.5 to 5 m from the room's middle on any side, above or below, rolled anyhow; the middle is well in its view."""
    away = rng.normal(size=3)
    place = rng.uniform(3.5, 5.0) * away / np.linalg.norm(away)
    to_middle = Rotation.align_vectors([-place], [[0.0, 0.0, 1.0]])[0]
    aside = Rotation.from_euler("xyz", [*rng.uniform(-0.4, 0.4, 2), rng.uniform(-np.pi, np.pi)])
    return Lens(name, place, (to_middle * aside).as_matrix())


def spherical(points: np.ndarray) -> np.ndarray:
    """(N, 3) range, azimuth, elevation in a sensor's frame."""
    r = np.linalg.norm(points, axis=1)
    return np.stack([r, np.arctan2(points[:, 0], points[:, 2]), np.arcsin(points[:, 1] / r)], axis=1)


def cartesian(ray: np.ndarray) -> np.ndarray:
    r, azimuth, elevation = ray.T
    flat = r * np.cos(elevation)
    return np.stack([flat * np.sin(azimuth), r * np.sin(elevation), flat * np.cos(azimuth)], axis=1)


def measured(lens: Lens, true: np.ndarray, share: np.ndarray, half_width_m: np.ndarray) -> np.ndarray:
    """(N, 3) m in room: measurements whose boxes hold the points `true`, at `share` (N, 3) of each half-width (N, 3).

    A box is in range, azimuth and elevation around what is measured; the metres are those seen at the range measured.
    """
    ray = spherical((true - lens.place) @ lens.rotation)
    ray[:, 0] += share[:, 0] * half_width_m[:, 0]
    ray[:, 2] += share[:, 2] * half_width_m[:, 2] / ray[:, 0]
    ray[:, 1] += share[:, 1] * half_width_m[:, 1] / (ray[:, 0] * np.cos(ray[:, 2]))
    return cartesian(ray) @ lens.rotation.T + lens.place


@dataclass(frozen=True)
class Motion:
    """What every joint does: at constant acceleration from each instant to the next."""

    t_s: np.ndarray  # (T,)
    positions: np.ndarray  # (T, J, 3) m
    velocities: np.ndarray  # (T, J, 3) m/s


def a_motion(rng: np.random.Generator, times_s: np.ndarray, together: bool) -> Motion:
    """|a| = 20 m/s² nearly always and up to 6 m/s; all joints alike when `together`, so that bones keep their length.

    Directions are as often the room's axes as any other, and change every 20 ms or so.
    """
    shape = (1, 3) if together else (JOINT_COUNT, 3)
    home = rng.uniform(-0.3, 0.3, (JOINT_COUNT, 3))
    away, velocity = np.zeros(shape), _direction(rng, shape) * rng.uniform(0, SPEED_MAX)
    push, turn_s = np.zeros(shape), -np.inf
    found: list[tuple[np.ndarray, np.ndarray]] = []
    before_s = times_s[0]
    for t_s in times_s.tolist():
        dt = t_s - before_s
        stopped = np.linalg.norm(velocity + push * dt, axis=1) > SPEED_MAX
        push = np.where(stopped[:, None], 0.0, push)
        away, velocity = away + velocity * dt + push * dt**2 / 2, velocity + push * dt
        found.append((home + away, np.broadcast_to(velocity, home.shape)))
        if t_s - turn_s > TURN_EVERY_S:
            push, turn_s = _push(rng, away, velocity), t_s
        before_s = t_s
    return Motion(times_s, np.array([p for p, _ in found]), np.array([v for _, v in found]))


def _direction(rng: np.random.Generator, shape: tuple[int, int]) -> np.ndarray:
    free = rng.normal(size=shape)
    axes = np.eye(3)[rng.integers(3, size=shape[0])] * rng.choice([-1.0, 1.0], (shape[0], 1))
    chosen = np.where(rng.uniform(size=(shape[0], 1)) < 0.5, free, axes)
    return np.asarray(chosen / np.linalg.norm(chosen, axis=1, keepdims=True))


def _push(rng: np.random.Generator, away: np.ndarray, velocity: np.ndarray) -> np.ndarray:
    """Full acceleration in any direction, but back towards home once a joint is or will be far from it."""
    ahead = away + velocity * 0.15
    back = -ahead / np.maximum(np.linalg.norm(ahead, axis=1, keepdims=True), 1e-9)
    is_far = np.linalg.norm(ahead, axis=1, keepdims=True) > FAR_FROM_HOME_M
    return np.asarray(ACCELERATION_MAX * np.where(is_far, back, _direction(rng, away.shape)))


@dataclass(frozen=True)
class Word:
    """A sample, and how long after its instant it comes in."""

    sample: AlignedSample
    late_s: float


class Adversary:
    """Picks, for one sensor, where in their boxes the errors stand."""

    KINDS = ("any corner", "constant", "switching", "behind the motion", "against each other", "anywhere")

    def __init__(self, rng: np.random.Generator, kind: str, number: int) -> None:
        self._rng, self._kind = rng, kind
        self._constant = rng.choice([-1.0, 1.0], (JOINT_COUNT, 3))
        self._pull = np.array([1.0, 1.0, 1.0]) * (-1.0) ** number

    def shares(self, lens: Lens, true: np.ndarray, velocity: np.ndarray, half_width_m: np.ndarray) -> np.ndarray:
        """(J, 3) in -1..1."""
        if self._kind == "anywhere":
            return self._rng.uniform(-1, 1, true.shape)
        if self._kind == "any corner":
            return self._rng.choice([-1.0, 1.0], true.shape)
        if self._kind == "switching":
            self._constant = np.where(self._rng.uniform(size=(JOINT_COUNT, 1)) < 0.1, -self._constant, self._constant)
        if self._kind in ("constant", "switching"):
            return self._constant
        pull = -velocity if self._kind == "behind the motion" else np.broadcast_to(self._pull, true.shape)
        ends = [measured(lens, true, np.broadcast_to(corner, true.shape), half_width_m) for corner in CORNERS]
        reach = np.array([((end - true) * pull).sum(axis=1) for end in ends])
        return np.asarray(CORNERS[reach.argmax(axis=0)])


def half_widths(state: np.ndarray) -> np.ndarray:
    """(J, 3) m of what a sensor's states allow its errors."""
    tracked = state[:, None] == TrackingState.TRACKED
    return np.where(tracked, np.array(BELIEVED_HALF_WIDTH_M), np.array(DOUBTED_HALF_WIDTH_M))


def states(rng: np.random.Generator, before: np.ndarray) -> np.ndarray:
    """(J,) lost or inferred at times, for a while."""
    fresh = rng.choice([0, 1, 2, 2, 2, 2], JOINT_COUNT).astype(np.uint8)
    return np.where(rng.uniform(size=JOINT_COUNT) < 0.05, fresh, before)


def times_of(rng: np.random.Generator, length_s: float) -> np.ndarray:
    """A sensor's instants: 15 or 30 Hz, trembling, with a frame missing here and there and a silence of a second."""
    period_s = float(rng.choice([1 / 30, 1 / 15]))
    ticks = np.arange(rng.uniform(0, period_s), length_s, period_s)
    ticks = np.sort(ticks + rng.uniform(-0.2, 0.2, len(ticks)) * period_s)
    silent_s = rng.uniform(0, length_s)
    kept = (rng.uniform(size=len(ticks)) < 0.9) & ~(
        (silent_s < ticks) & (ticks < silent_s + rng.choice([0.0, 0.3, 1.2]))
    )
    return np.asarray(ticks[kept])


def words_of(
    rng: np.random.Generator, lenses: list[Lens], kind: str, motion: Motion, instants: list[np.ndarray], latest_s: float
) -> list[Word]:
    """All sensors' samples by their own time; `instants` are indices into the motion's, per sensor."""
    words = []
    for number, (lens, indices) in enumerate(zip(lenses, instants, strict=True)):
        adversary = Adversary(rng, kind, number)
        state = np.full(JOINT_COUNT, 2, np.uint8)
        late_s = rng.uniform(0, latest_s)
        for k in indices.tolist():
            state = states(rng, state)
            true, widths = motion.positions[k], half_widths(state)
            seen = measured(lens, true, adversary.shares(lens, true, motion.velocities[k], widths), widths)
            seen = np.where(state[:, None] == TrackingState.LOST, np.nan, seen)
            t_s = float(motion.t_s[k])
            sample = AlignedSample(lens.name, t_s, t_s, seen, state, lens.place, lens.rotation)
            words.append(Word(sample, late_s))
    return sorted(words, key=lambda word: word.sample.t_s)


@dataclass(frozen=True)
class Scene:
    """Sensors, what the limbs do, and what is said of it."""

    motion: Motion
    words: list[Word]

    def at(self, t_s: float) -> tuple[np.ndarray, np.ndarray]:
        """Positions and velocities (J, 3) at one of the motion's instants."""
        k = int(np.searchsorted(self.motion.t_s, t_s - 1e-12))
        return self.motion.positions[k], self.motion.velocities[k]


def a_scene(
    rng: np.random.Generator,
    sensors: int,
    kind: str,
    together: bool,
    latest_s: float = 0.0,
    length_s: float = 1.5,
) -> Scene:
    """Anything that keeps its bounds."""
    lenses = [a_lens(rng, f"sensor {k}") for k in range(sensors)]
    ticks = [times_of(rng, length_s) for _ in lenses]
    times_s = np.unique(np.concatenate([*ticks, np.arange(0, length_s, 0.02)]))
    motion = a_motion(rng, times_s, together)
    instants = [np.searchsorted(times_s, own) for own in ticks]
    return Scene(motion, words_of(rng, lenses, kind, motion, instants, latest_s))
