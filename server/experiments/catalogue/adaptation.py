"""Ours: whether every game finds the level at which hands of different ability succeed three times in four."""

from __future__ import annotations

from collections.abc import Iterator
from dataclasses import dataclass
from itertools import product
from typing import TYPE_CHECKING, Final

import numpy as np
from scipy.stats import t as student_t

from fusion.experiments.experiment import Chapter, Experiment, Setup
from fusion.experiments.outcome import Beside, Cell, Column, Outcome, Picture, Table, columns
from fusion.experiments.palette import FIRST, FUSED, PAPER, SECOND
from fusion.messages import Floats
from fusion.skeleton import Side
from games.catalogue import GAMES, open_game
from games.difficulty import SUCCESS_WANTED
from games.game import GameSettings, Trial, Workspace
from games.player import ABILITIES, Ability, Player, play

if TYPE_CHECKING:
    from matplotlib.axes import Axes
    from matplotlib.figure import Figure

PLAYERS: Final = 4
"""Of each ability, each with a seed and a side of its own."""
LEAST_PLAYERS: Final = 2
LENGTH_S: Final = 480.0
LEAST_S: Final = 45.0
STEP_S: Final = 0.1
"""The slowest that a game is ever stepped: what becomes of an attempt does not hang on it."""
CHUNK_S: Final = 30.0
"""Played at once: the pictures of a whole game need not be kept."""
START_LEVEL: Final = 0.2
TOLERANCE: Final = 0.07
SURE: Final = 0.95
RUNNING: Final = 12
"""Attempts over which the figure's share of successes runs."""
ACROSS: Final = 3
COLOURS: Final = {"weak": SECOND, "middle": FIRST, "quick": FUSED}


@dataclass(frozen=True, slots=True)
class Found:
    """What became of all players of one ability in one game."""

    game: str
    ability: Ability
    played: tuple[tuple[Trial, ...], ...]
    """The attempts of every player."""
    length_s: float

    @property
    def late(self) -> tuple[tuple[Trial, ...], ...]:
        """The later half of every player's attempts."""
        return tuple(trials[len(trials) // 2 :] for trials in self.played)

    @property
    def shares(self) -> Floats:
        """(players,) share of successes among the later half."""
        return np.array([np.mean([trial.success for trial in trials]) for trials in self.late])

    @property
    def share(self) -> float:
        """The players' mean."""
        return float(self.shares.mean())

    @property
    def either_way(self) -> float:
        """Half the width of the mean's confidence interval: Student's t over players, each of whom plays alone."""
        players = len(self.shares)
        return float(student_t.ppf((1.0 + SURE) / 2.0, players - 1) * self.shares.std(ddof=1) / np.sqrt(players))

    @property
    def levels(self) -> Floats:
        """(attempts,) of the later half, all players together."""
        return np.array([trial.level for trials in self.late for trial in trials])

    @property
    def met(self) -> bool:
        """Whether the mean is as near to what is wanted as it should be."""
        return abs(self.share - SUCCESS_WANTED) <= TOLERANCE


def run(setup: Setup) -> Outcome:
    """Every game, every ability, every player."""
    length_s = setup.long(LENGTH_S, LEAST_S)
    kinds = list(product(GAMES, ABILITIES))
    found = []
    for k, (game, ability) in enumerate(kinds):
        found.append(Found(game, ability, tuple(_players(setup, game, ability, length_s)), length_s))
        setup.progress((k + 1) / len(kinds))
    return Outcome(
        tuple(_beside(game, [each for each in found if each.game == game]) for game in GAMES),
        (_table(found), _by_player(found)),
        (
            Picture("success", _SUCCESS, lambda figure: _draw_success(figure, found), height_in=3.4),
            Picture("levels", _LEVELS, lambda figure: _draw_levels(figure, found), height_in=4.6),
            Picture("running", _RUNNING, lambda figure: _draw_running(figure, found), height_in=4.6),
        ),
        _WHY,
        (setup.seed,),
    )


def _players(setup: Setup, game: str, ability: Ability, length_s: float) -> Iterator[tuple[Trial, ...]]:
    for k in range(setup.many(PLAYERS, LEAST_PLAYERS)):
        seed = 1000 * setup.seed + k
        side = Side.RIGHT if k % 2 else Side.LEFT
        settings = GameSettings(rounds=1, round_s=length_s, start_level=START_LEVEL)
        opened, player = open_game(game, _workspace(side), seed, settings), Player(ability, seed)
        for _ in range(round(length_s / CHUNK_S)):
            play(opened, player, CHUNK_S, STEP_S)
        yield opened.trials


def _workspace(side: Side) -> Workspace:
    """An adult's arm in the cautious ranges in which a session begins."""
    outward = 1.0 if side is Side.RIGHT else -1.0
    shoulder = (0.18 * outward, 0.0, 0.0)
    return Workspace(side, shoulder, 0.28, 0.33, (0.2, 1.8), (0.2, 1.5), (-0.8, 0.8), (0.2, 2.0))


# ---------------------------------------------------------------- in figures


def _beside(game: str, found: list[Found]) -> Beside:
    words = " / ".join(f"{100 * each.share:.0f} ± {100 * each.either_way:.0f}" for each in found) + " %"
    names = " / ".join(each.ability.name for each in found)
    return Beside(
        f"{game}: success in the later half, {names}",
        f"{100 * SUCCESS_WANTED:.0f} ± {100 * TOLERANCE:.0f} %",
        words,
        all(each.met for each in found),
    )


def _table(found: list[Found]) -> Table:
    rows: list[tuple[Cell, ...]] = []
    for each in found:
        attempts = [len(trials) for trials in each.played]
        took_s = [trial.duration_s for trials in each.late for trial in trials]
        per_minute = float(np.mean(attempts)) / each.length_s * 60.0
        shares = 100 * each.share, 100 * each.either_way
        levels = np.percentile(each.levels, (10, 50, 90)).tolist()
        rows.append((each.game, each.ability.name, *shares, *levels, per_minute, float(np.mean(took_s))))
    headings = (
        *columns("game", "ability", "success, later half [%]", "± (95 %)"),
        *columns("level p10", "median", "p90", digits=2),
        *columns("attempts a minute", "one takes [s]"),
    )
    players = len(found[0].played)
    caption = f"{players} players of each ability, {found[0].length_s:.0f} s each, from level {START_LEVEL:g}"
    return Table("adaptation", caption, headings, tuple(rows))


def _by_player(found: list[Found]) -> Table:
    rows = [
        (each.game, each.ability.name, k + 1, 100 * float(share), len(trials))
        for each in found
        for k, (share, trials) in enumerate(zip(each.shares, each.late, strict=True))
    ]
    headings = (*columns("game", "ability"), Column("player"), Column("success [%]"), Column("attempts"))
    return Table("players", "Every player's later half", headings, tuple(rows), folded=True)


# ---------------------------------------------------------------- as pictures


def _draw_success(figure: Figure, found: list[Found]) -> None:
    axes = figure.subplots()
    low, high = 100 * (SUCCESS_WANTED - TOLERANCE), 100 * (SUCCESS_WANTED + TOLERANCE)
    axes.axhspan(low, high, color="#E9F3EC", zorder=0, label="wanted")
    axes.axhline(100 * SUCCESS_WANTED, color=PAPER, lw=1)
    games = list(GAMES)
    for shift, ability in zip((-0.22, 0.0, 0.22), ABILITIES, strict=True):
        own = [each for each in found if each.ability is ability]
        middle = [games.index(each.game) + shift for each in own]
        shares, either_way = [100 * each.share for each in own], [100 * each.either_way for each in own]
        axes.errorbar(middle, shares, either_way, fmt="o", capsize=3, color=COLOURS[ability.name], label=ability.name)
    axes.set_xticks(range(len(games)), games)
    axes.set_ylim(50, 100)
    axes.set_ylabel("success, later half [%]")
    axes.legend(ncols=4, loc="upper center")


def _panels(figure: Figure) -> Iterator[tuple[str, Axes]]:
    """A panel for every game."""
    rows = -(-len(GAMES) // ACROSS)
    grid = figure.subplots(rows, ACROSS, sharex=True, sharey=True, squeeze=False)
    for game, axes in zip(GAMES, grid.flat, strict=False):
        axes.set_title(game)
        yield game, axes
    grid[-1, 0].set_xlabel("attempt")


def _draw_levels(figure: Figure, found: list[Found]) -> None:
    for game, axes in _panels(figure):
        for each in (one for one in found if one.game == game):
            common = min(len(trials) for trials in each.played)
            levels = np.array([[trial.level for trial in trials[:common]] for trials in each.played])
            colour = COLOURS[each.ability.name]
            axes.fill_between(range(common), levels.min(axis=0), levels.max(axis=0), color=colour, alpha=0.15, lw=0)
            axes.plot(levels.mean(axis=0), color=colour, label=each.ability.name)
        axes.set_ylim(0, 1)
    figure.axes[0].set_ylabel("level")
    figure.axes[0].legend()


def _draw_running(figure: Figure, found: list[Found]) -> None:
    window = np.full(RUNNING, 1.0 / RUNNING)
    for game, axes in _panels(figure):
        axes.axhline(100 * SUCCESS_WANTED, color=PAPER, lw=1)
        for each in (one for one in found if one.game == game):
            common = min(len(trials) for trials in each.played)
            hits = np.array([[trial.success for trial in trials[:common]] for trials in each.played], float)
            if common >= RUNNING:
                share = 100 * np.convolve(hits.mean(axis=0), window, "valid")
                axes.plot(np.arange(len(share)) + RUNNING, share, color=COLOURS[each.ability.name])
        axes.set_ylim(0, 100)
    figure.axes[0].set_ylabel(f"success over {RUNNING} attempts [%]")


_SUCCESS = "Share of attempts that succeeded in the later half; the players' mean and its 95 % confidence interval."
_LEVELS = "The level of every attempt: the players' mean, and the span from the lowest to the highest player."
_RUNNING = "Share of successes over the last attempts, all players of an ability together."
_WHY = (
    "The staircase [Kaernbach 1991] rests where a failure's step down is worth three successes' steps up, wherever on "
    "its span of levels the game then is; it fails only where an ability's level is outside the span. The players are "
    "programs: speed, reaction, tremor and lapses were chosen to span what is seen in clinics, and no patient is like "
    "them. They neither tire nor learn, so the figures say that the staircase finds a level, not how fast a person's "
    "level moves."
)
EXPERIMENT = Experiment(
    "adaptation",
    Chapter.OURS,
    "Games: do they adapt to 75 % success?",
    "The goal: success near 75 %, within 7 points, for a weak, a middling and a quick hand in every game, by the "
    "weighted up-down staircase of Kaernbach (1991).",
    "Virtual players of three abilities (reaction, speed, tremor, lapses) play every game for eight minutes without "
    "rests, from the level at which a session begins, half of them with either arm. The share of successes in "
    "the later half of each player's attempts is judged; its uncertainty is that of the mean over players.",
    run,
    order=30,
    only_by_name=True,
)
