"""Whatever is sent, readers fail in their own words, and the server goes on serving others."""

import asyncio
import contextlib
from urllib.parse import parse_qs

import pytest
from tornado.websocket import WebSocketClosedError

import trackig_core as tig
from dashboard.persistence import link
from dashboard.session.inputs import preset_values
from tests.hostile import frames, mutated, seeded
from tests.visitor import Visitor

STUDY = tig.Study(
    design=tig.PRESETS["booted-block-low-mass"],
    pinned=(tig.PinnedDesign("Softer", tig.PRESETS["booted-sleeper"], colour=1),),
    specification=tig.Specification([(31.5, 12.0), (63, 2.0)]),
).to_toml()

TABLE = tig.Specification([(31.5, 12.0), (63, 2.0), (160, 0.0)]).to_csv()

LINK = link.encode(preset_values("booted-block-low-mass"))

COUNT = 300


def test_mutated_studies_are_read_or_refused_in_words():
    chance, refused = seeded(1), 0
    for _ in range(COUNT):
        try:
            tig.Study.from_toml(mutated(STUDY, chance))
        except tig.StudyError as error:
            refused += bool(str(error))
    assert 0 < refused < COUNT


def test_mutated_tables_are_read_or_refused_in_words():
    chance, refused = seeded(2), 0
    for _ in range(COUNT):
        try:
            tig.Specification.from_csv(mutated(TABLE, chance))
        except tig.SpecificationError as error:
            refused += bool(str(error))
    assert 0 < refused < COUNT


def test_mutated_links_open_a_design_that_the_sliders_can_show():
    chance, problems = seeded(3), 0
    for _ in range(COUNT):
        query = parse_qs(mutated(LINK, chance), keep_blank_values=True)
        arguments = {key: [each.encode() for each in values] for key, values in query.items()}
        problems += bool(link.decode(arguments).problems)
    assert problems > 0


SILENCE = 20
"""Time after which a connection counts as one that waits for the rest of a message [s]."""


async def disturb(url, seed, count):
    """Send nonsense, on each connection until it is cut off; return how many were opened, and what came back.

    A plain question follows each message: its answer, or the end of the connection, says that the message
    was dealt with.
    """
    chance, connections, refusals, sent = seeded(seed), 0, [], 0
    while sent < count:
        visitor = await Visitor(url).open(drawn=False)
        connections += 1
        with contextlib.suppress(WebSocketClosedError, ConnectionError, TimeoutError):
            while sent < count:
                sent += 1
                for frame in frames(chance, visitor.models):
                    await visitor.socket.write_message(frame, binary=isinstance(frame, bytes))
                await visitor.send("SERVER-INFO-REQ", {})
                async with asyncio.timeout(SILENCE):
                    refusals += await visitor.refusals()
        visitor.close()
    return connections, refusals


@pytest.mark.slow
def test_nonsense_on_the_socket_disturbs_nobody_else(served):
    async def beside():
        polite = await Visitor(served.host + "/tools/dashboard").open()
        busy = asyncio.create_task(disturb(served.host + "/tools/dashboard", 4, 30))
        pictures = 0
        while not busy.done() or not pictures:
            await polite.move(20.0 + pictures % 10)
            await polite.picture()
            pictures += 1
        polite.close()
        return pictures, *await busy

    said = len(served.log.read_text().splitlines())
    pictures, connections, answers = asyncio.run(beside())
    assert pictures > 0
    assert connections > 0
    assert answers
    assert [each["traceback"] for each in answers if each["traceback"] is not None] == []
    lines = served.log.read_text().splitlines()[said:]
    assert not any("Traceback" in each for each in lines)
    # one each, at most, and none of two screens
    assert len(lines) <= 30
    assert max(map(len, lines)) < 400
