"""One event, one computation and one drawing: whatever happens, nothing is computed or drawn twice."""

from collections import Counter

import pytest

import trackig_core as tig
from dashboard.compute.pinned import PinnedSummaries
from dashboard.compute.workers import AT_REST
from dashboard.figures.comparison import BaseDifferenceFigure
from dashboard.figures.force import ForceFigure
from dashboard.figures.insertion_gain import InsertionGainFigure
from dashboard.session.assessment import Assessment
from dashboard.session.inputs import DesignInputs, GainDefinition
from dashboard.session.pins import Pins
from dashboard.session.results import Outcome
from dashboard.theme import MOST_PINNED
from dashboard.views import compare, received_level, specification
from dashboard.views.explore import Explore
from tests.waiting import WAIT, on_a_loop
from trackig_core import solution as solution_module

OPENING = tig.PRESETS["booted-block-low-mass"]
DRAWN = {
    "insertion gain": (InsertionGainFigure, "show"),
    "force": (ForceFigure, "show"),
    "differences": (BaseDifferenceFigure, "show"),
    "comparison": (compare, "table_html"),
    "verdicts": (specification, "verdicts_html"),
    "levels": (received_level, "levels_html"),
}


class FakeExchange:
    def on_file(self, purpose, callback):
        """Take no file."""


class Everything:
    """A session with seven pins, a specification and a source, all of its views in sight."""

    def __init__(self, store, fake_picture):
        self.fake_picture = fake_picture
        self.inputs, self.definition, self.pins = DesignInputs(), GainDefinition(), Pins()
        self.outcome = Outcome(summary=fake_picture(OPENING))
        pinned = PinnedSummaries(self.pins, store, store)
        self.assessment = Assessment(self.inputs, self.outcome, self.definition, self.pins, pinned)
        self.assessment.specification = tig.Specification([(63, -3.0)])
        self.assessment.source = tig.SourceSpectrum([(63, 60.0)])
        self.views = [
            Explore(self.outcome, self.definition, self.pins, self.assessment),
            compare.Compare(self.inputs, self.pins, self.definition, self.assessment, None),
            specification.SpecificationView(self.assessment, FakeExchange()),
            received_level.ReceivedLevel(self.assessment, self.pins, FakeExchange()),
        ]
        for view in self.views[1:]:
            view.look(True)
        self.pins.add_all((varied(count), f"Pin {count}", None) for count in range(MOST_PINNED - 1))

    def frame(self):
        """Show a live run of another design."""
        self.outcome.param.update(
            summary=self.fake_picture(varied(99), fidelity="live"), preset_summary=self.fake_picture(OPENING)
        )


def varied(count):
    return OPENING.replace(block_mass=100.0 + count)


@pytest.fixture
def everything(make_store, fake_picture):
    store = make_store(lambda key, *_: fake_picture(key[0]), capacity=20)
    for count in range(MOST_PINNED):
        store.request((varied(count), AT_REST)).future.result(WAIT)
    return on_a_loop(Everything, store, fake_picture)


@pytest.fixture
def counted(everything, monkeypatch):
    """Return a counter of what is drawn, and of solutions whose insertion gain is integrated."""
    counts = Counter()

    def counting(name, function):
        def call(*arguments, **options):
            counts[name] += 1
            return function(*arguments, **options)

        return call

    for name, (place, attribute) in DRAWN.items():
        monkeypatch.setattr(place, attribute, counting(name, getattr(place, attribute)))
    whole = solution_module.insertion_gain

    def integrated(spectrum, design, *arguments, **options):
        counts[design] += 1
        return whole(spectrum, design, *arguments, **options)

    monkeypatch.setattr(solution_module, "insertion_gain", integrated)
    everything.assessment.param.watch(lambda *_: counts.update(["assessed"]), ["results", "base", "preset"])
    return counts


def first(pins):
    return pins.pinned[0].key


EVENTS = {
    "pin": (lambda session: session.pins.add(varied(MOST_PINNED - 1), "Eighth"), 0),
    "rename": (lambda session: session.pins.rename(first(session.pins), "Renamed"), 0),
    "hide": (lambda session: session.pins.show(first(session.pins), False), 0),
    "remove": (lambda session: session.pins.remove(first(session.pins)), 0),
    "reference": (lambda session: setattr(session.definition, "reference", "rigid"), MOST_PINNED),
    "frame": (Everything.frame, 0),
}


@pytest.mark.parametrize(("event", "integrations"), EVENTS.values(), ids=EVENTS)
def test_one_event_is_computed_and_drawn_once(everything, counted, event, integrations):
    on_a_loop(event, everything)
    assert counted.pop("assessed") == 1
    drawn = {name: counted.pop(name, 0) for name in DRAWN}
    assert drawn == dict.fromkeys(DRAWN, 1)
    assert set(counted.values()) <= {1}
    assert len(counted) == integrations


def test_a_live_frame_computes_the_current_design_and_nothing_of_eight_pins(everything, counted):
    on_a_loop(everything.pins.add, varied(MOST_PINNED - 1), "Eighth")
    everything.definition.param.update(reference="rigid", summation="coherent")
    counted.clear()
    before = everything.assessment.results
    everything.frame()
    assert everything.assessment.results[0] is not before[0]
    assert everything.assessment.results[1:] == before[1:]
    assert counted.pop("assessed") == 1
    assert {name: counted.pop(name, 0) for name in DRAWN} == dict.fromkeys(DRAWN, 1)
    # the current design, and the preset from which it now departs
    assert counted == {varied(99): 1, OPENING: 1}


def test_a_new_name_computes_nothing_but_the_record(everything):
    before = everything.assessment.results
    on_a_loop(everything.pins.rename, first(everything.pins), "Renamed")
    renamed = everything.assessment.results[1]
    assert renamed.name == "Renamed"
    for part in ("summary", "gain", "verdict", "level"):
        assert getattr(renamed, part) is getattr(before[1], part)
    assert everything.assessment.results[2:] == before[2:]


def test_a_base_is_chosen_once(everything, counted):
    everything.pins.choose_base(first(everything.pins))
    assert everything.assessment.base is everything.assessment.results[1]
    assert counted == {"assessed": 1, "differences": 1, "comparison": 1, "levels": 1}
