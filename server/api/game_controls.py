"""What people want of the games while a session is open, and who may want it."""

from __future__ import annotations

from collections.abc import Callable, Mapping
from typing import Final

from fastapi.concurrency import run_in_threadpool

from db.account import Account
from db.database import Database
from fusion.errors import RefusedError
from games.game import GameView, Phase, Wish
from server.api import session_store
from server.api.authority import Authority, Client, Presence
from server.api.course import Course
from server.api.game_forms import GameAnswer, GameWish, SessionWorkspacePublic
from server.api.journal import Journal
from server.api.workspace import shown_workspace

POSSIBLE: Final[Mapping[Wish, frozenset[Phase]]] = {
    Wish.START: frozenset({Phase.WAITING, Phase.BETWEEN}),
    Wish.PAUSE: frozenset({Phase.WAITING, Phase.PLAYING, Phase.REST, Phase.BETWEEN}),
    Wish.GO_ON: frozenset({Phase.WAITING, Phase.REST, Phase.PAUSED, Phase.BETWEEN}),
    Wish.REST: frozenset({Phase.PLAYING}),
    Wish.NEXT: frozenset(Phase) - {Phase.OVER},
    Wish.QUIT: frozenset(Phase) - {Phase.OVER},
    Wish.PIN: frozenset(Phase) - {Phase.OVER, Phase.BETWEEN},
    Wish.ADAPT: frozenset(Phase) - {Phase.OVER, Phase.BETWEEN},
}
"""In which phases a wish does anything."""
GOES_ON: Final = (Wish.START, Wish.GO_ON, Wish.NEXT)
"""With these a game that has lost its screen goes on without one."""


class GameControls:
    """Carries wishes to the games, from those who may have them.

    Args:
        opened: the open session of that number; refuses where it is not open.
        database: where a session's workspace is kept.
        journal: where everything is noted.
        authority: who is in charge.
        presence: which pages are the patient's screen.
    """

    def __init__(
        self,
        opened: Callable[[int], Course],
        database: Database,
        journal: Journal,
        authority: Authority,
        presence: Presence,
    ) -> None:
        self._opened, self._database, self._journal = opened, database, journal
        self._authority, self._presence = authority, presence

    def wish(self, session_id: int, form: GameWish, client: Client, account: Account) -> GameAnswer:
        """Start, pause, go on, rest, next, quit, pin the difficulty or let it adapt; done with the next tick.

        Raises:
            RefusedError: not open, not in charge, not begun, or not possible as the game stands.
        """
        course, wish = self._opened(session_id), Wish(form.wish)
        self._require(wish, client, account)
        playing = course.playing
        if playing is None:
            return _before_the_games(course, wish)
        view = playing.picture
        _check_possible(wish, view)
        level = view.level if form.level is None else form.level
        playing.wish(wish, level)
        if wish in GOES_ON:
            course.screens.go_on_without()
        self._journal.note(session_id, "game", wish.value, by=client.account, level=level, game=view.game)
        return GameAnswer(game=view.game, phase=view.phase.value)

    def workspace(self, session_id: int) -> SessionWorkspacePublic:
        """What the healthy arm has shown so far, and what the games go by.

        Raises:
            RefusedError: the session is not open.
        """
        course = self._opened(session_id)
        course.ask_to_show()
        return _public(course)

    async def take_workspace(self, session_id: int, client: Client) -> SessionWorkspacePublic:
        """Let the games go by what the healthy arm has shown, from now on.

        Raises:
            RefusedError: not open, not in charge, not enough shown, or the games have begun.
        """
        course = self._opened(session_id)
        self._authority.require(client)
        measured = course.shown.read()
        if course.games_asked:
            raise RefusedError("the games have begun", "a workspace measured before", "it stays as it is this time")
        if measured.shown is None or not measured.enough:
            missing = f"too little movement: {', '.join(measured.missing)}" if measured.missing else "too short a time"
            raise RefusedError(
                f"the healthy arm has not shown enough yet ({missing})",
                "every joint moved as far as is comfortable",
                "let the patient go on showing",
            )
        course.workspace = shown_workspace(measured.shown, course.opening.workspace, course.opening.allowed)
        await run_in_threadpool(session_store.store_workspace, self._database, session_id, course.workspace)
        self._journal.note(session_id, "workspace", "measured with the healthy arm", by=client.account)
        return _public(course)

    def _require(self, wish: Wish, client: Client, account: Account) -> None:
        """Everybody may pause; the patient's screen may go on as well; the rest is for the page in charge."""
        if wish is Wish.PAUSE:
            return
        shows_patient = not account.role.may_treat or self._presence.shows_patient(client)
        if wish is Wish.GO_ON and shows_patient:
            return
        self._authority.require(client)


def _before_the_games(course: Course, wish: Wish) -> GameAnswer:
    """All that can be wished then is to do without a screen that has gone."""
    if wish is not Wish.GO_ON or not course.screens.is_lost:
        raise RefusedError(
            "the games have not begun", "an arm that has been engaged once", "start the arm; the first game follows"
        )
    course.screens.go_on_without()
    return GameAnswer(game=course.opening.exercises[0].game, phase=Phase.WAITING)


def _check_possible(wish: Wish, view: GameView) -> None:
    if wish is Wish.NEXT and not view.next_game:
        raise RefusedError("there is no further exercise", "a session with one more", "quit the game, or go on with it")
    if view.phase not in POSSIBLE[wish]:
        raise RefusedError(
            f"'{wish.value}' is not possible while the game is {view.phase.value}",
            f"a game that is {' or '.join(sorted(phase.value for phase in POSSIBLE[wish]))}",
            "look how the game stands",
        )


def _public(course: Course) -> SessionWorkspacePublic:
    measured = course.shown.read()
    return SessionWorkspacePublic(**measured.model_dump(), begun=course.games_asked, workspace=course.workspace)
