"""Visitors go to the process that has least to do."""

from dashboard.server.processes import Shares


def test_it_is_the_turn_of_the_process_with_least_to_do():
    shares = Shares(3)
    assert not shares.is_turn_of(0) or shares.total() == 0
    shares.note(0, 2)
    shares.note(1, 1, waiting=2)
    assert [shares.is_turn_of(number) for number in (0, 1)] == [True, False]
    shares.note(2, 0)
    assert [shares.is_turn_of(number) for number in (0, 1, 2)] == [False, False, True]
    assert shares.total() == 3


def test_a_process_that_died_holds_nobody_up():
    shares = Shares(2)
    shares.note(0, 5)
    shares.note(1, 0)
    assert not shares.is_turn_of(0)
    shares.leave(1)
    assert shares.is_turn_of(0)
    assert shares.total() == 5
