"""From inputs to outcome: newest first, one at a time, the last good picture kept."""

import asyncio
import threading
import time
from concurrent.futures import Future
from types import SimpleNamespace

import numpy as np
import pytest

import trackig_core as tig
from dashboard.compute import runner as runner_module
from dashboard.compute.latest import readable
from dashboard.compute.pacing import BUSY, Pace
from dashboard.compute.runner import EXACT_ALL_THE_SAME, STOPPED_EXACT, STOPPED_LIVE, Runner
from dashboard.compute.workers import AT_ONCE, AT_REST, MOVING, solve_summary
from dashboard.session.inputs import DesignInputs
from dashboard.session.results import Outcome
from tests.waiting import WAIT, on_a_loop, until


class Session:
    """Inputs, outcome and runner of one user."""

    def __init__(self, store, live_store=None):
        self.inputs, self.outcome = DesignInputs(), Outcome()
        self.runner = Runner(self.inputs, self.outcome, store, live_store or store)

    def do(self, action, *arguments, **values):
        """Call something on an event loop, and wait for all that it set going."""
        on_a_loop(action, *arguments, **values)

    def change(self, **values):
        """Change inputs, and wait for the outcome."""
        self.do(self.inputs.param.update, **values)


@pytest.fixture(autouse=True)
def _short_rest(monkeypatch):
    monkeypatch.setattr(runner_module, "REST", 0.02)
    monkeypatch.setattr(runner_module, "LOOK_EVERY", 0.005)
    monkeypatch.setattr(runner_module, "SOON", WAIT)


class Gate:
    """A solver that holds back designs with the pad stiffness 500 kN/mm until they are let through."""

    def __init__(self, fake_picture, fidelity):
        self._summary = fake_picture
        self._fidelity = fidelity
        self.open = threading.Event()
        self.begun = threading.Event()
        self.gave_up = []
        self.solved = []

    def solve(self, key, progress, cancelled):
        design, fidelity = key
        if design.pad_stiffness == 500e6 and fidelity == self._fidelity:
            self.begun.set()
            while not self.open.wait(0.005):
                progress(0.25)
                if cancelled():
                    self.gave_up.append(design)
                    raise tig.SolveCancelled
        self.solved.append((design.pad_stiffness / 1e6, fidelity))
        return self._summary(design, fidelity=fidelity)


@pytest.fixture
def gate(fake_picture):
    """Return a gate before runs at rest."""
    gate = Gate(fake_picture, AT_REST)
    yield gate
    gate.open.set()


@pytest.fixture
def live_gate(fake_picture):
    """Return a gate before live runs."""
    gate = Gate(fake_picture, MOVING)
    yield gate
    gate.open.set()


def shown_pictures(session):
    """Return a list to which each picture that is shown adds pad stiffness [kN/mm] and fidelity."""
    shown = []

    def note(event):
        shown.append((event.new.design.pad_stiffness / 1e6, event.new.solution.fidelity))

    session.outcome.param.watch(note, "summary")
    return shown


def test_a_picture_holds_what_solve_returns(summary):
    design = tig.PRESETS["slab-track"]
    solution = tig.solve(design, fidelity=AT_REST)
    taken = summary("slab-track")
    np.testing.assert_array_equal(taken.solution.insertion_gain, solution.insertion_gain)
    np.testing.assert_allclose(1000 * taken.total_force, solution.total_force)
    np.testing.assert_allclose(1000 * taken.loaded_support_force, solution.loaded_support_force)
    assert taken.step == pytest.approx(0.1)


def test_a_picture_leaves_the_large_record_behind(summary):
    taken = summary("slab-track")
    assert taken.solution.history is None
    arrays = (taken.time, taken.loaded_support_force, taken.total_force)
    assert all(array.base is None for array in arrays), "a view would keep the whole record alive"


def test_progress_and_cancellation_reach_the_core():
    heard = []
    key = (tig.PRESETS["slab-track"], AT_REST)
    with pytest.raises(tig.SolveCancelled):
        solve_summary(key, heard.append, lambda: bool(heard))
    assert 0 < heard[0] < 1


def test_a_kept_picture_is_there_at_once(instant_store):
    design = tig.PRESETS["booted-block-low-mass"]
    instant_store.request((design, AT_REST)).future.result(WAIT)
    session = Session(instant_store)
    session.runner.start()
    assert session.outcome.summary.design == design
    assert session.outcome.from_cache


def test_start_solves_what_is_not_kept(instant_store):
    session = Session(instant_store)
    session.do(session.runner.start)
    assert session.outcome.summary.design == session.inputs.to_design()
    assert not session.outcome.from_cache


def test_a_change_is_solved(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=200)
    assert session.outcome.summary.design.pad_stiffness == 200e6
    assert not session.outcome.busy


def test_going_back_comes_from_the_cache(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=200)
    session.change(pad_stiffness=300)
    session.change(pad_stiffness=200)
    assert session.outcome.from_cache
    assert session.outcome.summary.design.pad_stiffness == 200e6


def test_another_static_stiffness_is_shown_of_the_same_solution(make_store, fake_picture):
    solved = []

    def solve(key, *_):
        solved.append(key)
        return fake_picture(key[0], fidelity=key[1])

    session = Session(make_store(solve))
    session.do(session.runner.start)
    solution = session.outcome.summary.solution
    session.change(pad_static_stiffness=80, boot_static_stiffness=12)
    assert session.outcome.summary.design == session.inputs.to_design()
    assert session.outcome.summary.design.boot_static_stiffness == 12e6
    assert session.outcome.summary.solution is solution
    assert session.outcome.preset_summary.design == session.inputs.preset_design
    assert (session.outcome.from_cache, session.outcome.stale) == (True, False)
    assert solved == [(session.inputs.preset_design, AT_REST)]
    session.change(pad_static_stiffness=None)
    assert session.outcome.summary.design == session.inputs.to_design()
    # what the dynamics depends on is solved once at either fidelity, whatever is stated of statics
    session.change(stiffness_frequency=10)
    assert [(key[0].stiffness_frequency, key[1]) for key in solved[1:]] == [(10, MOVING), (10, AT_REST)]
    assert session.outcome.summary.design.boot_static_stiffness == 12e6


def test_a_change_is_followed_live_and_solved_as_in_the_paper_at_rest(instant_store):
    session = Session(instant_store)
    session.do(session.runner.start)
    shown = shown_pictures(session)
    session.change(pad_stiffness=200)
    assert shown == [(200, MOVING), (200, AT_REST)]


def test_while_inputs_move_nothing_but_live_runs_are_solved(make_store, gate, monkeypatch):
    monkeypatch.setattr(runner_module, "REST", WAIT)
    session = Session(make_store(gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)

    async def drag():
        for stiffness in range(300, 309):
            session.inputs.pad_stiffness = stiffness
            await asyncio.sleep(0.02)
        monkeypatch.setattr(runner_module, "REST", 0.02)
        session.inputs.pad_stiffness = 309
        await until(lambda: session.outcome.summary.solution.fidelity == AT_REST)

    asyncio.run(drag())
    assert [fidelity for _, fidelity in shown] == [MOVING] * (len(shown) - 1) + [AT_REST]
    stiffnesses = [stiffness for stiffness, _ in shown]
    assert stiffnesses == sorted(stiffnesses)
    assert shown[-2:] == [(309, MOVING), (309, AT_REST)]
    assert [each for each in gate.solved if each[1] == AT_REST] == [(100, AT_REST), (309, AT_REST)]


def test_a_hand_that_waits_for_pictures_of_a_busy_server_is_not_at_rest(make_store, gate, monkeypatch):
    monkeypatch.setattr(
        runner_module,
        "on_next_tick",
        lambda document, change: asyncio.get_running_loop().call_later(0.4, change, document),
    )
    session = Session(make_store(gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)

    async def drag():
        for stiffness in (300, 310, 320):
            session.inputs.pad_stiffness = stiffness
            await until(lambda: shown and shown[-1][0] == session.inputs.pad_stiffness)
            await asyncio.sleep(0.5)
        await until(lambda: session.outcome.summary.solution.fidelity == AT_REST)

    asyncio.run(drag())
    # once it is busy, there is one picture of a move, the exact one
    assert shown == [(300, MOVING), (310, AT_ONCE), (320, AT_ONCE), (320, AT_REST)]


def test_what_is_asked_for_anew_after_a_while_rests_as_soon_as_what_has_just_changed(
    make_store, gate, monkeypatch
):
    """The time since the inputs changed is no time that a picture took."""
    now, waits = [0.0], []
    monkeypatch.setattr(runner_module, "time", SimpleNamespace(monotonic=lambda: now[0]))
    store = make_store(gate.solve, capacity=1)
    session = Session(store)
    session.do(session.runner.start)
    session.change(pad_stiffness=300)
    store.at_once((tig.PRESETS["slab-track"], AT_REST))
    now[0] += WAIT

    async def note(seconds):
        waits.append(seconds)
        return False

    session.runner._latest.news_within = note
    session.do(session.runner.request)
    assert waits == [runner_module.REST]


def test_a_server_stays_busy_until_several_pictures_came_soon():
    pace = Pace()
    assert not pace.is_busy
    pace.drew(2 * BUSY)
    assert pace.is_busy
    pace.drew(0.0)
    assert pace.is_busy
    for _ in range(10):
        pace.drew(0.0)
    assert not pace.is_busy


def test_while_one_live_run_lasts_only_the_newest_change_waits(make_store, live_gate):
    session = Session(make_store(live_gate.solve))
    session.do(session.runner.start)

    async def drag():
        session.inputs.pad_stiffness = 500
        await until(live_gate.begun.is_set)
        for stiffness in range(501, 520):
            session.inputs.pad_stiffness = stiffness
            await asyncio.sleep(0)
        live_gate.open.set()
        await until(lambda: session.outcome.summary.design.pad_stiffness == 519e6)

    asyncio.run(drag())
    assert [stiffness for stiffness, fidelity in live_gate.solved if fidelity == MOVING] == [500, 519]


def test_a_live_run_is_shown_though_newer_changes_wait(make_store, live_gate):
    session = Session(make_store(live_gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)

    async def drag():
        session.inputs.pad_stiffness = 500
        await until(live_gate.begun.is_set)
        session.inputs.pad_stiffness = 600
        await asyncio.sleep(0)
        live_gate.open.set()
        await until(lambda: (600, AT_REST) in shown)

    asyncio.run(drag())
    assert shown == [(500, MOVING), (600, MOVING), (600, AT_REST)]


def test_a_run_at_rest_gives_way_to_newer_inputs_at_once(make_store, gate):
    session = Session(make_store(gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)

    async def change_of_mind():
        session.inputs.pad_stiffness = 500
        await until(gate.begun.is_set)
        session.inputs.pad_stiffness = 600
        await until(lambda: (600, AT_REST) in shown)
        await until(lambda: gate.gave_up)

    asyncio.run(change_of_mind())
    assert shown == [(500, MOVING), (600, MOVING), (600, AT_REST)]


def test_a_live_run_that_takes_too_long_is_left_for_the_paper_s(make_store, live_gate, monkeypatch):
    monkeypatch.setattr(runner_module, "PATIENCE", 0.02)
    session = Session(make_store(live_gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)
    session.change(pad_stiffness=500)
    assert shown == [(500, AT_REST)]
    assert live_gate.gave_up


def test_while_a_live_run_takes_long_the_exact_curve_is_shown(make_store, live_gate, monkeypatch):
    monkeypatch.setattr(runner_module, "SOON", 0.01)
    session = Session(make_store(live_gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)

    async def wait_for_force():
        session.inputs.pad_stiffness = 500
        await until(lambda: shown == [(500, AT_ONCE)])
        assert live_gate.begun.is_set()
        live_gate.open.set()
        await until(lambda: (500, AT_REST) in shown)

    asyncio.run(wait_for_force())
    assert shown == [(500, AT_ONCE), (500, MOVING), (500, AT_REST)]


def test_once_a_curve_is_there_a_long_live_run_gives_way_to_newer_inputs(make_store, live_gate, monkeypatch):
    monkeypatch.setattr(runner_module, "SOON", 0.01)
    monkeypatch.setattr(runner_module, "PATIENCE", WAIT)
    session = Session(make_store(live_gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)

    async def drag():
        session.inputs.pad_stiffness = 500
        await until(lambda: shown == [(500, AT_ONCE)])
        session.inputs.pad_stiffness = 600
        await until(lambda: (600, AT_REST) in shown)
        await until(lambda: live_gate.gave_up)

    asyncio.run(drag())
    assert (500, MOVING) not in shown
    assert shown[-2:] == [(600, MOVING), (600, AT_REST)]


def test_where_the_last_live_run_took_long_the_next_curve_is_exact_at_once(make_store, live_gate):
    session = Session(make_store(live_gate.solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)
    session.runner._live_is_slow = True

    async def drag():
        session.inputs.pad_stiffness = 500
        await until(lambda: shown == [(500, AT_ONCE)])  # SOON has not passed
        live_gate.open.set()
        await until(lambda: (500, AT_REST) in shown)
        session.inputs.pad_stiffness = 501
        await until(lambda: (501, AT_REST) in shown)

    asyncio.run(drag())
    assert shown == [(500, AT_ONCE), (500, MOVING), (500, AT_REST), (501, MOVING), (501, AT_REST)]


def test_what_live_fidelity_refuses_is_left_for_the_paper_s(make_store, fake_picture):
    def solve(key, *_):
        if key[1] == MOVING:
            raise tig.RunTooLargeError("too large")
        return fake_picture(key[0])

    session = Session(make_store(solve))
    session.do(session.runner.start)
    session.change(pad_stiffness=300)
    assert session.outcome.summary.design.pad_stiffness == 300e6
    assert session.outcome.problem == ""


def test_following_waits_for_nobody_s_run_at_rest(make_store, gate):
    """All workers busy with other users' runs, the picture still follows."""
    store = make_store(gate.solve, workers=1)
    live_store = make_store(gate.solve, workers=1)
    session = Session(store, live_store)
    session.do(session.runner.start)
    busy = tig.PRESETS["slab-track"].replace(pad_stiffness=500e6)
    job = store.request((busy, AT_REST))

    async def follow():
        await until(gate.begun.is_set)
        session.inputs.pad_stiffness = 200
        await until(lambda: session.outcome.summary.design.pad_stiffness == 200e6)
        assert session.outcome.summary.solution.fidelity == MOVING
        gate.open.set()
        await until(lambda: session.outcome.summary.solution.fidelity == AT_REST)

    asyncio.run(follow())
    store.release(job)


def test_while_the_solver_is_compiled_the_outcome_says_so(instant_store, monkeypatch):
    compiler = Future()
    monkeypatch.setattr(runner_module, "compiled", lambda: compiler)
    session = Session(instant_store)

    async def first_start():
        session.runner.start()
        await until(lambda: session.outcome.compiling)
        assert session.outcome.summary is None
        compiler.set_result(None)
        await until(lambda: session.outcome.summary is not None)

    asyncio.run(first_start())
    assert not session.outcome.compiling


def test_a_compiler_that_fails_leaves_it_to_the_solve_to_say_so(instant_store, monkeypatch):
    compiler = Future()
    compiler.set_exception(OSError("disk full"))
    monkeypatch.setattr(runner_module, "compiled", lambda: compiler)
    session = Session(instant_store)
    session.do(session.runner.start)
    assert session.outcome.summary is not None
    assert not session.outcome.compiling


def test_a_long_run_shows_its_progress_and_gives_way(make_store, gate, monkeypatch):
    monkeypatch.setattr(runner_module, "LONG", 0.01)
    session = Session(make_store(gate.solve))
    session.do(session.runner.start)

    async def change_of_mind():
        session.inputs.pad_stiffness = 500
        await until(lambda: session.outcome.progress == 0.25)
        assert session.outcome.busy
        session.inputs.pad_stiffness = 600
        await until(lambda: not session.outcome.busy and session.outcome.progress is None)
        await until(lambda: gate.gave_up)

    asyncio.run(change_of_mind())
    assert session.outcome.summary.design.pad_stiffness == 600e6


def test_nobody_cancels_what_another_session_waits_for(make_store, gate, monkeypatch):
    monkeypatch.setattr(runner_module, "LONG", 0.01)
    store = make_store(gate.solve)
    one, other = Session(store), Session(store)

    async def share():
        one.inputs.pad_stiffness = 500
        other.inputs.pad_stiffness = 500
        await until(lambda: one.outcome.progress is not None and other.outcome.progress is not None)
        one.inputs.pad_stiffness = 600
        await until(lambda: one.outcome.summary is not None)
        gate.open.set()
        await until(lambda: not other.outcome.busy)

    asyncio.run(share())
    assert gate.gave_up == []
    assert one.outcome.summary.design.pad_stiffness == 600e6
    assert other.outcome.summary.design.pad_stiffness == 500e6


def test_a_long_solve_can_be_stopped(make_store, gate):
    session = Session(make_store(gate.solve))

    async def stop():
        session.inputs.pad_stiffness = 300
        await until(lambda: session.outcome.summary is not None and not session.outcome.busy)
        session.inputs.pad_stiffness = 500
        await until(gate.begun.is_set)
        session.runner.stop()
        await until(lambda: session.outcome.problem)
        await until(lambda: gate.gave_up)

    asyncio.run(stop())
    assert session.outcome.problem == STOPPED_LIVE
    assert session.outcome.summary.design.pad_stiffness == 500e6
    assert session.outcome.summary.solution.fidelity == MOVING
    assert not session.outcome.busy
    session.change(pad_stiffness=301)
    assert session.outcome.problem == ""
    assert session.outcome.summary.design.pad_stiffness == 301e6


def test_a_stop_before_the_live_run_says_that_the_exact_curve_stands(make_store, live_gate, monkeypatch):
    monkeypatch.setattr(runner_module, "PATIENCE", WAIT)
    session = Session(make_store(live_gate.solve))
    session.do(session.runner.start)
    session.runner._live_is_slow = True

    async def stop():
        session.inputs.pad_stiffness = 500
        await until(lambda: session.outcome.summary.design.pad_stiffness == 500e6)
        session.runner.stop()
        await until(lambda: session.outcome.problem)

    asyncio.run(stop())
    assert session.outcome.problem == STOPPED_EXACT
    assert session.outcome.summary.design.pad_stiffness == 500e6
    assert session.outcome.summary.solution.fidelity == AT_ONCE


def test_a_failure_is_told_and_leaves_the_last_good_picture(make_store, fake_picture):
    def solve(key, *_):
        if key[0].pad_stiffness == 666e6:
            raise FloatingPointError("overflow in <kernel>")
        return fake_picture(key[0], fidelity=key[1])

    session = Session(make_store(solve))
    session.change(pad_stiffness=300)
    session.change(pad_stiffness=666)
    assert "FloatingPointError" in session.outcome.problem
    assert "Traceback" not in session.outcome.problem
    assert session.outcome.summary.design.pad_stiffness == 300e6
    assert not session.outcome.busy
    session.change(pad_stiffness=301)
    assert session.outcome.problem == ""


def test_the_exact_curve_stands_where_a_run_with_a_vehicle_is_too_large(make_store, fake_picture):
    def solve(key, *_):
        if key[1] != AT_ONCE:
            raise tig.RunTooLargeError("this run would take an hour")
        return fake_picture(key[0], fidelity=key[1])

    session = Session(make_store(solve))
    session.change(ground=tig.GROUNDS["rock"])
    outcome = session.outcome
    assert "this run would take an hour" in outcome.problem
    assert outcome.problem.endswith(EXACT_ALL_THE_SAME)
    assert outcome.summary.solution.fidelity == "exact"
    assert outcome.summary.design.ground == tig.GROUNDS["rock"]
    assert not outcome.stale


def test_a_refused_run_is_told_in_the_core_s_words():
    assert readable(tig.RunTooLargeError("this run would take an hour")) == (
        "Not solved: this run would take an hour."
    )


def test_a_picture_that_cannot_be_drawn_is_told(instant_store):
    session = Session(instant_store)
    session.outcome.param.watch(lambda *_: 1 / 0, "summary")
    session.change(pad_stiffness=300)
    assert "could not be drawn" in session.outcome.problem
    assert not session.outcome.busy


def test_a_modified_design_comes_with_its_preset(instant_store):
    session = Session(instant_store)
    session.do(session.runner.start)
    assert session.outcome.preset_summary is None
    session.change(pad_stiffness=200)
    assert session.outcome.preset_summary.design == tig.PRESETS["booted-block-low-mass"]
    session.do(session.inputs.revert)
    assert session.outcome.preset_summary is None


def test_the_preset_is_solved_when_no_one_has_yet(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=200)
    assert session.outcome.summary.design.pad_stiffness == 200e6
    assert session.outcome.preset_summary.design == tig.PRESETS["booted-block-low-mass"]


def test_a_closed_session_solves_no_more(instant_store):
    session = Session(instant_store)
    session.change(pad_stiffness=300)
    session.runner.close()
    session.change(pad_stiffness=400)
    assert session.outcome.summary.design.pad_stiffness == 300e6


def test_waiting_for_a_worker_does_not_count_as_long(make_store, fake_picture, monkeypatch):
    """On a busy server nothing is given up, and nothing said to be long, before it has begun."""
    monkeypatch.setattr(runner_module, "LONG", 0.01)
    monkeypatch.setattr(runner_module, "PATIENCE", 0.01)
    begun, go_on = threading.Event(), threading.Event()

    def solve(key, *_):
        begun.set()
        go_on.wait(WAIT)
        return fake_picture(key[0], fidelity=key[1])

    store = make_store(solve, workers=1)
    store.request((tig.PRESETS["slab-track"], AT_REST))
    assert begun.wait(WAIT)
    session = Session(store)
    session.outcome.summary = fake_picture(tig.PRESETS["slab-track"])
    shown = shown_pictures(session)

    async def wait():
        session.inputs.pad_stiffness = 300
        await asyncio.sleep(0.1)
        assert session.outcome.progress is None
        # from here on work is under way, which a busy machine may take longer for
        monkeypatch.setattr(runner_module, "PATIENCE", WAIT)
        go_on.set()
        await until(lambda: (300, AT_REST) in shown)

    asyncio.run(wait())
    # the exact curve comes first where the live run is not there by then
    assert [each for each in shown if each != (300, AT_ONCE)] == [(300, MOVING), (300, AT_REST)]


def test_where_others_wait_for_runs_a_move_has_one_picture(make_store, live_gate, monkeypatch):
    monkeypatch.setattr(runner_module, "SOON", WAIT)
    live_store = make_store(live_gate.solve, workers=2, spare=1)
    session = Session(make_store(live_gate.solve), live_store)
    session.do(session.runner.start)
    shown = shown_pictures(session)
    slow = tig.PRESETS["slab-track"].replace(pad_stiffness=500e6)
    for mass in (700, 800):
        live_store.request((slow.replace(wheel_mass=mass), MOVING), owner=mass)

    async def drag():
        session.inputs.pad_stiffness = 600
        await until(lambda: shown == [(600, AT_ONCE)])
        live_gate.open.set()
        await until(lambda: (600, AT_REST) in shown)

    asyncio.run(drag())
    assert shown == [(600, AT_ONCE), (600, AT_REST)]


def test_a_curve_stays_whose_live_run_was_given_up_before_it_came(make_store, fake_picture, monkeypatch):
    monkeypatch.setattr(runner_module, "SOON", 0.0)
    given_up = threading.Event()

    def solve(key, *_):
        if key[1] == MOVING:
            given_up.set()
            raise tig.RunTooLargeError("too large")
        if key[1] == AT_ONCE:
            given_up.wait(WAIT)
            time.sleep(0.05)  # the refusal is heard first
        return fake_picture(key[0], fidelity=key[1])

    session = Session(make_store(solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)
    session.runner._live_is_slow = True
    session.change(pad_stiffness=500)
    assert shown == [(500, AT_ONCE), (500, AT_REST)]


@pytest.mark.parametrize("takes_long", [False, True])
def test_a_hand_rests_only_after_some_times_that_a_picture_takes(
    make_store, fake_picture, monkeypatch, takes_long
):
    """While a busy server draws slowly, moves that follow each picture cause no run at rest."""
    now, solved = [0.0], []
    monkeypatch.setattr(runner_module, "time", SimpleNamespace(monotonic=lambda: now[0]))

    def solve(key, *_):
        if key[1] == MOVING and takes_long:
            now[0] += WAIT
        solved.append((key[0].pad_stiffness / 1e6, key[1]))
        return fake_picture(key[0], fidelity=key[1])

    session = Session(make_store(solve))
    session.do(session.runner.start)
    shown = shown_pictures(session)

    async def drag():
        session.inputs.pad_stiffness = 500
        await until(lambda: (500, MOVING) in shown)
        if takes_long:
            await asyncio.sleep(10 * runner_module.REST)
        else:
            await until(lambda: (500, AT_REST) in solved)
        session.inputs.pad_stiffness = 600
        await until(lambda: (600, MOVING) in shown)

    asyncio.run(drag())
    assert ((500, AT_REST) in solved) == (not takes_long)
