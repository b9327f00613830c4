"""What passes between session and browser: the link follows, files are bounded, messages are hostile."""

import asyncio
from pathlib import Path
from types import SimpleNamespace

import panel as pn
import pytest
from panel_material_ui.notifications import NotificationArea

import trackig_core as tig
from dashboard.client import exchange as exchange_module
from dashboard.client.exchange import Exchange, opening
from dashboard.compute.pacing import Pace
from dashboard.session.inputs import values_of
from dashboard.session.shelf import Shelf
from tests.waiting import until_at_rest

LIMITS = tig.Specification([(63, -3.0)])


@pytest.fixture
def exchange(session):
    return Exchange(session.snapshot)


def restored(other):
    """Return what a browser sends back that showed another session before."""
    _, study, typed = Exchange(other.snapshot).kept
    return {"kind": "restore", "data": study, "typed": typed}


def handle_message(exchange, message):
    """Have a message handled where changes are followed: in a loop, as a session has."""

    async def run():
        exchange.handle_message(message)

    asyncio.run(run())


@pytest.fixture
def sent(exchange, monkeypatch):
    messages = []
    monkeypatch.setattr(exchange, "_send_msg", messages.append)
    return messages


@pytest.fixture
def told(monkeypatch):
    words = []
    monkeypatch.setattr(exchange_module, "notify", lambda kind, text: words.append((kind, text)))
    return words


@pytest.mark.parametrize(("drawing", "at_rest"), [(0.01, "REST"), (1.0, "BUSY_REST")])
def test_link_and_study_are_there_at_once_and_follow_at_rest(session, monkeypatch, drawing, at_rest):
    async def run():
        rest = asyncio.Event()
        waited = []

        def until_rest(seconds):
            waited.append(seconds)
            return rest.wait()

        monkeypatch.setattr(exchange_module, "asyncio", SimpleNamespace(sleep=until_rest))
        pace = Pace()
        pace.drew(drawing)
        exchange = Exchange(session.snapshot, pace=pace)
        assert exchange.kept == [session.snapshot.query(), session.snapshot.study().to_toml(), ""]
        noted = []
        exchange.param.watch(lambda event: noted.append(event.new), "kept")
        for stiffness in range(30, 40):
            session.inputs.boot_stiffness = stiffness
            await asyncio.sleep(0.001)
        session.assessment.specification = LIMITS
        assert noted == []
        rest.set()
        await until_at_rest()
        assert set(waited) == {getattr(exchange_module, at_rest)}
        assert len(waited) == 2, "changes that come while others rest are waited for too"
        assert noted == [[session.snapshot.query(), session.snapshot.study().to_toml(), ""]]
        assert "boot_stiffness=39" in noted[0][0]

    asyncio.run(run())


def test_the_address_follows_the_tab_at_once(session):
    async def run():
        exchange = Exchange(session.snapshot)
        session.snapshot.tab = "keep"
        assert "tab=keep" in exchange.kept[0], "a page that is loaded anew opens where it was"

    asyncio.run(run())


@pytest.mark.parametrize("typed", ["", "nonsense", 5, None])
def test_what_a_browser_remembers_is_restored(session, exchange, sent, summary, typed):
    other = type(session)(summary)
    other.assessment.specification = LIMITS
    other.pin("slab-track", "Slab")
    handle_message(exchange, {**restored(other), "typed": typed})
    assert session.assessment.specification == LIMITS
    assert [pin.name for pin in session.pins.pinned] == ["Slab"]
    assert exchange.kept == [session.snapshot.query(), session.snapshot.study().to_toml(), ""]
    assert sent == [{"kind": "keep"}]


def test_a_memory_that_is_no_study_changes_nothing_and_is_told(session, exchange, sent, told):
    before = session.snapshot.study()
    exchange.handle_message({"kind": "restore", "data": "<script>alert(1)</script>", "typed": "<script>"})
    assert session.snapshot.study() == before
    assert told == [("warning", exchange_module.NOT_RESTORED)]
    assert sent == [{"kind": "keep"}]


@pytest.mark.parametrize(
    "message",
    [
        None,
        "restore",
        7,
        [],
        {},
        {"kind": "restore"},
        {"kind": "restore", "data": 7, "typed": ""},
        {"kind": "study", "data": "text where bytes are due"},
        {"kind": "specification"},
        {"kind": "__class__", "data": b""},
    ],
)
def test_messages_of_another_form_are_dropped(session, exchange, sent, message):
    opened = []
    exchange.on_file("study", opened.append)
    before = session.snapshot.query()
    exchange.handle_message(message)
    assert (opened, sent, session.snapshot.query()) == ([], [], before)


def test_keys_go_to_the_figure_on_which_they_were_pressed(exchange):
    pressed = []
    exchange.on_key("map_figure", lambda *key: pressed.append(key))
    key = {"kind": "key", "figure": "map_figure", "key": "ArrowUp", "shift": True}
    others = ({"figure": "another"}, {"figure": ["map_figure"]}, {"key": 1}, {"shift": "yes"})
    for message in (key, *(key | other for other in others)):
        handle_message(exchange, message)
    assert pressed == [("ArrowUp", True)]


def test_scripts_are_made_of_quoted_words():
    assert opening("source") == f'window.trackig.choose("source", ".csv,.txt,.tsv", {64 * 1024})'


def test_a_success_takes_away_what_was_said_before(monkeypatch):
    monkeypatch.setattr(pn.state.__class__, "notifications", NotificationArea())
    exchange_module.notify("warning", "There is no room.")
    exchange_module.notify("error", "It failed.")
    area = pn.state.notifications
    assert [each.message for each in area.notifications] == ["There is no room.", "It failed."]
    exchange_module.notify("success", "It is open.")
    assert [each.message for each in area.notifications] == ["It is open."]
    assert area.notifications[0].duration < 5000
    exchange_module.notify("warning", "word " * 60)
    assert area.notifications[1].duration >= 15000, "it stays until it is read"


COMPANY = (Path(__file__).parents[2] / "data" / "company_catalogue.toml").read_bytes()


def test_a_catalogue_is_remembered_by_the_browser_and_recalled(session, monkeypatch):
    shelf, sent = Shelf(), []
    exchange = Exchange(session.snapshot, shelf)
    monkeypatch.setattr(exchange, "_send_msg", sent.append)
    shelf.open(COMPANY)
    (kept,) = sent
    assert kept["kind"] == "remember"
    shelf.close()
    assert sent[-1] == {"kind": "remember", "data": ""}
    exchange.handle_message({"kind": "recalled", "data": kept["data"]})
    assert shelf.catalogue.name == "Ours"


@pytest.mark.parametrize("data", ["", "<script>", "x" * 300_000, "format = 'trackig catalogue'"])
def test_a_remembered_catalogue_that_is_none_is_forgotten(exchange, sent, told, data):
    exchange.handle_message({"kind": "recalled", "data": data})
    assert told == [("warning", exchange_module.NOT_RECALLED)]
    assert sent == [{"kind": "remember", "data": ""}]


def test_a_copied_link_says_what_needs_the_study_file(session, exchange, told):
    exchange.handle_message({"kind": "copied", "data": True})
    assert told == [("success", exchange_module.COPIED)]
    curve = tig.StiffnessCurve([(5, 20e6, 0.1), (500, 30e6, 0.2)])
    design = session.inputs.to_design().replace(boot_stiffness=curve, boot_loss_factor=None)
    told.clear()

    async def run():
        session.inputs.take(values_of(design))
        exchange.handle_message({"kind": "copied", "data": True})

    asyncio.run(run())
    ((kind, words),) = told
    assert kind == "warning"
    assert "only the study file holds: the boot stiffness. " in words


def test_the_browser_looks_at_what_it_copied_once_changes_rest(session, monkeypatch):
    """A change of which the server hears a little after the click is part of the link."""
    exchange, told = Exchange(session.snapshot), []
    monkeypatch.setattr(exchange, "_send_msg", lambda message: told.append((message, exchange.kept[0])))

    async def run():
        rest = asyncio.Event()

        async def until_rest(_):
            await rest.wait()
            await asyncio.sleep(0)

        monkeypatch.setattr(exchange_module, "asyncio", SimpleNamespace(sleep=until_rest))
        for _ in range(3):  # clicks while one is being dealt with are answered with it
            exchange.handle_message({"kind": "copying"})
        await asyncio.sleep(0)
        session.inputs.boot_stiffness = 39
        await asyncio.sleep(0)
        assert told == [], "changes have not rested"
        rest.set()
        await until_at_rest()
        ((message, kept),) = told
        assert message == {"kind": "copied"}
        assert "boot_stiffness=39" in kept
        exchange.handle_message({"kind": "copying"})
        await until_at_rest()
        assert len(told) == 2

    asyncio.run(run())
