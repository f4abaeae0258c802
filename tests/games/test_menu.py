"""Choices are meant: the pause is chosen by going to it, not by a hand that already lay there."""

from __future__ import annotations

from games.game import Point, Wish, Workspace
from games.menu import DWELL_S, Menu

DT_S = 0.1
AWAY: Point = (9.0, 9.0, 9.0)
PAUSE = (Wish.PAUSE,)
STEPS = round(2.0 * DWELL_S / DT_S)


def chosen(menu: Menu, hand: Point) -> bool:
    return any(menu.step(PAUSE, hand, DT_S) is Wish.PAUSE for _ in range(STEPS))


def spot(menu: Menu) -> Point:
    return menu.views(PAUSE)[0].position


def test_a_hand_that_goes_to_the_pause_and_stays_chooses_it(usual: Workspace) -> None:
    menu = Menu(usual)
    menu.step(PAUSE, AWAY, DT_S)
    assert chosen(menu, spot(menu))


def test_a_hand_that_lay_there_when_the_pause_was_offered_does_not_choose_it(usual: Workspace) -> None:
    menu = Menu(usual)
    assert not chosen(menu, spot(menu))


def test_such_a_hand_chooses_it_once_it_has_left_and_come_back(usual: Workspace) -> None:
    menu = Menu(usual)
    assert not chosen(menu, spot(menu))
    menu.step(PAUSE, AWAY, DT_S)
    assert chosen(menu, spot(menu))
