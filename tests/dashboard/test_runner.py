"""From inputs to outcome: newest first, one at a time, the last good picture kept."""

import asyncio
import threading

import numpy as np
import pytest

import trackig_core as tig
from dashboard import runner as runner_module
from dashboard.runner import FIDELITY, STOPPED, Runner, readable, take_picture
from dashboard.state import DesignInputs, Outcome

WAIT = 30


class Session:
    """Inputs, outcome and runner of one user."""

    def __init__(self, store):
        self.inputs, self.outcome = DesignInputs(), Outcome()
        self.runner = Runner(self.inputs, self.outcome, store)

    def do(self, action, *arguments, **values):
        """Call something on an event loop, and wait for all that it set going."""

        async def acted():
            action(*arguments, **values)
            async with asyncio.timeout(WAIT):
                while tasks := asyncio.all_tasks() - {asyncio.current_task()}:
                    await asyncio.wait(tasks)

        asyncio.run(acted())

    def change(self, **values):
        """Change inputs, and wait for the outcome."""
        self.do(self.inputs.param.update, **values)


class Gate:
    """A solver that holds back designs with the pad stiffness 500 kN/mm until they are let through."""

    def __init__(self, fake_picture):
        self._picture = fake_picture
        self.open = threading.Event()
        self.begun = threading.Event()
        self.gave_up = []
        self.solved = []

    def solve(self, key, progress, cancelled):
        design, _ = key
        if design.pad_stiffness == 500e6:
            self.begun.set()
            while not self.open.wait(0.005):
                progress(0.25)
                if cancelled():
                    self.gave_up.append(design)
                    raise tig.SolveCancelled
        self.solved.append(design)
        return self._picture(design)


@pytest.fixture
def gate(fake_picture):
    gate = Gate(fake_picture)
    yield gate
    gate.open.set()


async def until(condition):
    """Let the event loop run until something is true."""
    async with asyncio.timeout(WAIT):
        while not condition():
            await asyncio.sleep(0.002)


def test_a_picture_holds_what_solve_returns(picture):
    design = tig.PRESETS["slab-track"]
    solution = tig.solve(design, fidelity=FIDELITY)
    taken = picture("slab-track")
    np.testing.assert_array_equal(taken.solution.insertion_gain, solution.insertion_gain)
    np.testing.assert_allclose(1000 * taken.total_force, solution.total_force)
    np.testing.assert_allclose(1000 * taken.loaded_support_force, solution.loaded_support_force)
    assert taken.step == pytest.approx(0.1)


def test_a_picture_leaves_the_large_record_behind(picture):
    taken = picture("slab-track")
    assert taken.solution.history is None
    arrays = (taken.time, taken.loaded_support_force, taken.total_force)
    assert all(array.base is None for array in arrays), "a view would keep the whole record alive"


def test_progress_and_cancellation_reach_the_core():
    heard = []
    key = (tig.PRESETS["slab-track"], FIDELITY)
    with pytest.raises(tig.SolveCancelled):
        take_picture(key, heard.append, lambda: bool(heard))
    assert 0 < heard[0] < 1


def test_a_kept_picture_is_there_at_once(instant_store):
    design = tig.PRESETS["booted-block-low-mass"]
    instant_store.request((design, FIDELITY)).future.result(WAIT)
    session = Session(instant_store)
    session.runner.start()
    assert session.outcome.picture.design == design
    assert session.outcome.from_cache


def test_start_solves_what_is_not_kept(instant_store):
    session = Session(instant_store)
    session.do(session.runner.start)
    assert session.outcome.picture.design == session.inputs.to_design()
    assert not session.outcome.from_cache


def test_a_change_is_solved(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=200)
    assert session.outcome.picture.design.pad_stiffness == 200e6
    assert not session.outcome.busy


def test_going_back_comes_from_the_cache(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=200)
    session.change(pad_stiffness=300)
    session.change(pad_stiffness=200)
    assert session.outcome.from_cache
    assert session.outcome.picture.design.pad_stiffness == 200e6


def test_while_one_solve_runs_only_the_newest_change_waits(make_store, gate):
    session = Session(make_store(gate.solve))

    async def drag():
        session.inputs.pad_stiffness = 500
        await until(gate.begun.is_set)
        for stiffness in range(501, 520):
            session.inputs.pad_stiffness = stiffness
            await asyncio.sleep(0)
        gate.open.set()
        await until(lambda: not session.outcome.busy)

    asyncio.run(drag())
    stiffnesses = [design.pad_stiffness for design in gate.solved if design != session.inputs.preset_design]
    assert stiffnesses == [500e6, 519e6]
    assert session.outcome.picture.design.pad_stiffness == 519e6


def test_a_short_solve_is_shown_though_newer_changes_wait(make_store, gate):
    session = Session(make_store(gate.solve))
    seen = []
    session.outcome.param.watch(lambda event: seen.append(event.new.design.pad_stiffness), "picture")

    async def drag():
        session.inputs.pad_stiffness = 500
        await until(gate.begun.is_set)
        session.inputs.pad_stiffness = 600
        await asyncio.sleep(0)
        gate.open.set()
        await until(lambda: not session.outcome.busy)

    asyncio.run(drag())
    assert seen == [500e6, 600e6]


def test_a_long_solve_gives_way_to_newer_inputs(make_store, gate, monkeypatch):
    monkeypatch.setattr(runner_module, "LONG", 0.01)
    monkeypatch.setattr(runner_module, "LOOK_EVERY", 0.002)
    session = Session(make_store(gate.solve))

    async def change_of_mind():
        session.inputs.pad_stiffness = 500
        await until(lambda: session.outcome.progress == 0.25)
        assert session.outcome.busy
        session.inputs.pad_stiffness = 600
        await until(lambda: not session.outcome.busy)
        await until(lambda: gate.gave_up)

    asyncio.run(change_of_mind())
    assert session.outcome.picture.design.pad_stiffness == 600e6
    assert session.outcome.progress is None


def test_nobody_cancels_what_another_session_waits_for(make_store, gate, monkeypatch):
    monkeypatch.setattr(runner_module, "LONG", 0.01)
    monkeypatch.setattr(runner_module, "LOOK_EVERY", 0.002)
    store = make_store(gate.solve)
    one, other = Session(store), Session(store)

    async def share():
        one.inputs.pad_stiffness = 500
        other.inputs.pad_stiffness = 500
        await until(lambda: one.outcome.progress is not None and other.outcome.progress is not None)
        one.inputs.pad_stiffness = 600
        await until(lambda: one.outcome.picture is not None)
        gate.open.set()
        await until(lambda: not other.outcome.busy)

    asyncio.run(share())
    assert gate.gave_up == []
    assert one.outcome.picture.design.pad_stiffness == 600e6
    assert other.outcome.picture.design.pad_stiffness == 500e6


def test_a_long_solve_can_be_stopped(make_store, gate, monkeypatch):
    monkeypatch.setattr(runner_module, "LOOK_EVERY", 0.002)
    session = Session(make_store(gate.solve))

    async def stop():
        session.inputs.pad_stiffness = 300
        await until(lambda: session.outcome.picture is not None and not session.outcome.busy)
        session.inputs.pad_stiffness = 500
        await until(gate.begun.is_set)
        session.runner.stop()
        await until(lambda: session.outcome.problem)
        await until(lambda: gate.gave_up)

    asyncio.run(stop())
    assert session.outcome.problem == STOPPED
    assert not session.outcome.busy
    assert session.outcome.picture.design.pad_stiffness == 300e6
    session.change(pad_stiffness=301)
    assert session.outcome.problem == ""
    assert session.outcome.picture.design.pad_stiffness == 301e6


def test_a_failure_is_told_and_leaves_the_last_good_picture(make_store, fake_picture):
    def solve(key, *_):
        if key[0].pad_stiffness == 666e6:
            raise FloatingPointError("overflow in <kernel>")
        return fake_picture(key[0])

    session = Session(make_store(solve))
    session.change(pad_stiffness=300)
    session.change(pad_stiffness=666)
    assert "FloatingPointError" in session.outcome.problem
    assert "Traceback" not in session.outcome.problem
    assert session.outcome.picture.design.pad_stiffness == 300e6
    assert not session.outcome.busy
    session.change(pad_stiffness=301)
    assert session.outcome.problem == ""


def test_a_refused_run_is_told_in_the_core_s_words():
    assert readable(tig.RunTooLargeError("this run would take an hour")) == (
        "Not solved: this run would take an hour."
    )


def test_a_picture_that_cannot_be_drawn_is_told(instant_store):
    session = Session(instant_store)
    session.outcome.param.watch(lambda *_: 1 / 0, "picture")
    session.change(pad_stiffness=300)
    assert "could not be drawn" in session.outcome.problem
    assert not session.outcome.busy


def test_a_modified_design_comes_with_its_preset(instant_store):
    session = Session(instant_store)
    session.do(session.runner.start)
    assert session.outcome.preset_picture is None
    session.change(pad_stiffness=200)
    assert session.outcome.preset_picture.design == tig.PRESETS["booted-block-low-mass"]
    session.do(session.inputs.revert)
    assert session.outcome.preset_picture is None


def test_the_preset_is_solved_when_no_one_has_yet(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=200)
    assert session.outcome.picture.design.pad_stiffness == 200e6
    assert session.outcome.preset_picture.design == tig.PRESETS["booted-block-low-mass"]


def test_a_closed_session_solves_no_more(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=300)
    session.runner.close()
    session.change(pad_stiffness=400)
    assert session.outcome.picture.design.pad_stiffness == 300e6


def test_waiting_for_a_worker_does_not_count_as_long(make_store, fake_picture, monkeypatch):
    """On a busy server a solve that has not begun is not given up for newer inputs, or none would finish."""
    monkeypatch.setattr(runner_module, "LONG", 0.01)
    monkeypatch.setattr(runner_module, "LOOK_EVERY", 0.002)
    solved, go_on = [], threading.Event()

    def solve(key, *_):
        go_on.wait(10)
        solved.append(key[0].pad_stiffness)
        return fake_picture(key[0])

    store = make_store(solve, workers=1)
    store.request((tig.PRESETS["slab-track"], runner_module.FIDELITY))
    session = Session(store)

    async def drag():
        for stiffness in (300, 400, 500):
            session.inputs.pad_stiffness = stiffness
            await asyncio.sleep(0.05)
        go_on.set()
        await until(lambda: not session.outcome.busy)

    asyncio.run(drag())
    assert solved[:3] == [1000e6, 300e6, 500e6]
    assert session.outcome.picture.design.pad_stiffness == 500e6
