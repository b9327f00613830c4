"""Pictures of pins: there at once when kept, solved when not, gone with the pin; no event loop waits."""

import asyncio
import threading

import pytest

import trackig_core as tig
from dashboard.compute.pinned import PinnedSummaries
from dashboard.compute.workers import AT_ONCE, AT_REST, solve_summary
from dashboard.session.pins import Pins
from dashboard.theme import MOST_PINNED
from tests.waiting import WAIT, on_a_loop, until, until_at_rest


def varied(count):
    """Return a design that no preset is."""
    return tig.PRESETS["booted-block-low-mass"].replace(block_mass=100.0 + count)


def many(count, *names):
    """Return designs to be pinned, each of its own, named if there are names."""
    return [(varied(each), names[each] if names else "", None) for each in range(count)]


@pytest.fixture
def pins():
    return Pins()


def test_what_the_store_knows_is_there_at_once(pins, make_store, fake_picture):
    store = make_store(lambda key, *_: fake_picture(key[0]))
    known = store.request((tig.PRESETS["slab-track"], AT_REST)).future.result(WAIT)
    asked = []
    exact = make_store(lambda key, *_: asked.append(key) or fake_picture(*key))
    pinned = PinnedSummaries(pins, store, exact)

    async def pin():
        added = pins.add(tig.PRESETS["slab-track"])
        assert pinned.summaries == {added.key: known}
        await until_at_rest()
        assert pinned.summaries == {added.key: known}

    asyncio.run(pin())
    assert asked == []


def test_a_pin_under_a_vehicle_has_its_exact_curve_while_its_run_takes_long(pins, make_store, fake_picture):
    """The run's gate stays closed until the curve is there; it is that of the library."""
    gate = Gate(fake_picture)
    pinned = PinnedSummaries(pins, make_store(gate), make_store(solve_summary))
    design = varied(0).replace(suspension=tig.VEHICLES["metro"].suspension, ground=tig.GROUNDS["soft clay"])

    async def story():
        pin = pins.add(design)
        await until(lambda: pinned.summaries)
        early = pinned.summaries[pin.key]
        assert (early.design, early.time) == (design, None)
        assert early.solution.insertion_gain == pytest.approx(tig.solve(design, "exact").insertion_gain)
        gate.open.set()
        await until(lambda: pinned.summaries[pin.key] is not early)
        late = pinned.summaries[pin.key]
        assert (late.solution.fidelity, late.time is not None) == (AT_REST, True)

    asyncio.run(story())


def test_every_pin_has_its_curve_before_the_first_run_is_there(pins, instant_store, make_store, fake_picture):
    gate = Gate(fake_picture)
    pinned = PinnedSummaries(pins, make_store(gate), instant_store)

    async def story():
        pins.add_all(many(3))
        await until(lambda: len(pinned.summaries) == 3)
        late = pins.add(varied(3))
        gate.open.set()
        await until(lambda: late.key in pinned.summaries)
        await until_at_rest()

    asyncio.run(story())
    assert [each.solution.fidelity for each in pinned.summaries.values()] == [AT_REST] * 4


def test_a_pin_whose_run_fails_keeps_its_curve(pins, instant_store, make_store):
    def solve(*_):
        raise tig.RunTooLargeError("the record is too long")

    pinned = PinnedSummaries(pins, make_store(solve), instant_store)
    pin = on_a_loop(pins.add, varied(0))
    assert pinned.summaries[pin.key].solution.fidelity == AT_ONCE
    assert "the record is too long" in pinned.problems[pin.key]


def test_what_is_not_known_is_solved_at_rest_and_told(pins, instant_store):
    pinned, told = PinnedSummaries(pins, instant_store, instant_store), []
    pinned.param.watch(lambda event: told.append(set(event.new)), "summaries")
    new = on_a_loop(pins.add_all, many(MOST_PINNED))
    assert {key: summary.design for key, summary in pinned.summaries.items()} == {
        pin.key: pin.design for pin in new
    }
    assert {summary.solution.fidelity for summary in pinned.summaries.values()} == {AT_REST}
    assert told[-1] == {pin.key for pin in new}


def test_pins_that_differ_in_static_stiffness_share_one_solution(pins, make_store, fake_picture):
    solved = []

    def solve(key, *_):
        solved.append(key)
        return fake_picture(key[0])

    pinned = PinnedSummaries(pins, make_store(solve), make_store(without_exact_answer))
    designs = [varied(0).replace(pad_static_stiffness=each) for each in (None, 50e6, 80e6)]
    new = on_a_loop(pins.add_all, [(design, "", None) for design in designs])
    assert solved == [(varied(0), AT_REST)]
    assert [pinned.summaries[pin.key].design for pin in new] == designs


def test_pins_that_were_there_before_are_solved_too(pins, instant_store):
    pin = pins.add(varied(0))
    assert set(on_a_loop(PinnedSummaries, pins, instant_store, instant_store).summaries) == {pin.key}


def test_a_picture_goes_with_its_pin_and_stays_through_a_new_name(pins, instant_store):
    pinned = PinnedSummaries(pins, instant_store, instant_store)
    one, other = on_a_loop(pins.add_all, many(2, "one", "other"))
    shown = pinned.summaries[one.key]
    on_a_loop(pins.rename, one.key, "renamed")
    assert pinned.summaries[one.key] is shown
    on_a_loop(pins.remove, other.key)
    assert set(pinned.summaries) == {one.key}


class Gate:
    """A solver that waits to be let on, and counts how many designs are solved at a time."""

    def __init__(self, summary):
        self.summary, self.open, self.given_up = summary, threading.Event(), threading.Event()
        self.running = self.most = 0

    def __call__(self, key, _, cancelled):
        self.running += 1
        self.most = max(self.most, self.running)
        while not self.open.wait(0.01):
            if cancelled():
                self.given_up.set()
                raise RuntimeError("nobody waits")
        self.running -= 1
        return self.summary(key[0])


def test_the_event_loop_goes_on_and_one_pin_is_solved_at_a_time(pins, make_store, fake_picture):
    gate = Gate(fake_picture)
    pinned = PinnedSummaries(pins, make_store(gate), make_store(without_exact_answer))

    async def story():
        pins.add_all(many(3))
        await until(lambda: gate.running)
        await asyncio.sleep(0.05)
        assert pinned.summaries == {}
        gate.open.set()
        await until(lambda: len(pinned.summaries) == 3)

    asyncio.run(story())
    assert gate.most == 1


def without_exact_answer(*_):
    raise tig.DesignError("pad_loss_factor", 0.0, "some loss somewhere")


@pytest.mark.parametrize("end", ["remove", "close"])
def test_a_solve_that_nobody_waits_for_is_given_up(pins, make_store, fake_picture, end):
    gate = Gate(fake_picture)
    pinned = PinnedSummaries(pins, make_store(gate), make_store(without_exact_answer))

    async def story():
        pin = pins.add(varied(0))
        await until(lambda: gate.running)
        pinned.close() if end == "close" else pins.remove(pin.key)
        await until(gate.given_up.is_set)

    asyncio.run(story())
    assert pinned.summaries == {}
    assert pinned.problems == {}


def test_a_design_that_cannot_be_solved_says_why_and_stops_none_of_the_others(pins, make_store, fake_picture):
    def solve(key, *_):
        if key[0].block_mass == 100:
            raise tig.RunTooLargeError("the record is too long")
        return fake_picture(key[0])

    pinned = PinnedSummaries(pins, make_store(solve), make_store(without_exact_answer))
    refused, fine = on_a_loop(pins.add_all, many(2))
    assert "the record is too long" in pinned.problems[refused.key]
    assert set(pinned.summaries) == {fine.key}
    on_a_loop(pins.remove, refused.key)
    assert pinned.problems == {}
