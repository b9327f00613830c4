"""``trackig serve`` whole: below a prefix, from two processes, to pages of a proxy, after a death."""

import asyncio
import json
import os
import signal
import urllib.request

import pytest
from tornado.httpclient import HTTPClientError

import trackig_core as tig
from tests.dashboard.server.conftest import serving
from tests.visitor import Visitor, told
from tests.waiting import WAIT, until

pytestmark = pytest.mark.slow


def health(served, prefix="/tools"):
    with urllib.request.urlopen(f"{served.host}{prefix}/health", timeout=WAIT) as answer:
        return json.load(answer)


def test_a_page_moves_below_a_prefix(served):
    async def visit():
        visitor = await Visitor(served.host + "/tools/dashboard?wheel_mass=700").open()
        await visitor.move(21.0)
        await visitor.picture()
        # processes tell each other how many sessions they have a little later
        await until(lambda: health(served)["sessions"] >= 1)
        there = health(served)
        visitor.close()
        return visitor, there

    visitor, there = asyncio.run(visit())
    assert visitor.title == "trackig"
    assert "wheel_mass=700" in str(visitor.models)
    assert there["status"] == "ok"
    assert there["version"] == tig.__version__
    assert "static/extensions/panel/css/loading.css" in str(visitor.models)
    assert "://cdn." not in str(visitor.models), "a closed network has no internet"
    assert "EMPTY_LAYOUT" not in served.log.read_text()


def test_many_requests_of_the_page_make_no_session(served):
    requests, before = 10, health(served)["sessions"]
    for _ in range(requests):
        with urllib.request.urlopen(served.host + "/tools/dashboard", timeout=WAIT) as answer:
            assert b"<title>trackig</title>" in answer.read()
            assert answer.headers["Cache-Control"] == "no-store"
    # visitors of other tests may still come and go, but not as many
    assert health(served)["sessions"] < before + requests


def test_a_page_of_a_proxy_is_let_in_and_one_of_another_host_gets_advice_that_helps(served):
    async def visit(origin):
        visitor = await Visitor(served.host + "/tools/dashboard").open(pull=False, origin=origin)
        visitor.close()

    asyncio.run(visit("https://trackig.example"))
    with pytest.raises(HTTPClientError, match="403"):
        asyncio.run(visit("http://elsewhere.example:8080"))
    assert "if it is yours, add --allow-origin elsewhere.example:8080" in served.log.read_text()


def test_the_pages_of_a_process_that_is_killed_come_back_with_specification_and_pins(served):
    study = tig.Study(
        design=tig.PRESETS["booted-sleeper"],
        pinned=(tig.PinnedDesign("Softer", tig.PRESETS["booted-block-low-mass"], colour=1),),
        specification=tig.Specification([(31.5, 12.0), (63, 2.0)]),
        name="Mid-workshop",
    )

    async def come_back():
        visitors = await asyncio.gather(*(Visitor(served.host + "/tools/dashboard").open() for _ in range(3)))
        killed = served.children()
        for process in killed:
            os.kill(process, signal.SIGKILL)
        for visitor in visitors:
            with pytest.raises(ConnectionError):
                await visitor.receive("NOTHING THAT A SERVER SENDS")
        await until(lambda: not set(served.children()) & set(killed) and len(served.children()) == 2)
        return await asyncio.gather(*(restore() for _ in visitors))

    async def restore():
        visitor = await Visitor(served.host + "/tools/dashboard").open()
        await visitor.patch(
            told(visitor.component("kept"), {"kind": "restore", "data": study.to_toml(), "typed": ""})
        )
        while True:
            for event in (await visitor.receive("PATCH-DOC"))["events"]:
                if event.get("attr") == "kept":
                    visitor.close()
                    return event["new"][1]

    for text in asyncio.run(come_back()):
        opened = tig.Study.from_toml(text)
        assert opened.specification == study.specification
        assert [each.name for each in opened.pinned] == ["Softer"]
        assert opened.name == "Mid-workshop"
    assert "another takes its place" in served.log.read_text()


def test_nobody_comes_in_without_the_password_and_the_server_ends_when_told(tmp_path):
    path = tmp_path / "password.txt"
    path.write_text("squeeze\n")
    with serving(tmp_path, "--password-file", str(path)) as served:
        assert health(served, "")["status"] == "ok"
        jar = urllib.request.HTTPCookieProcessor()
        browser = urllib.request.build_opener(jar)
        page = browser.open(served.host + "/dashboard", timeout=WAIT).read().decode()
        assert "<title>trackig: password</title>" in page
        assert "http" not in page.replace('method="post"', "")
        for word, title in (("wrong", "trackig: password"), ("squeeze", "trackig")):
            data = f"username=Ada&password={word}".encode()
            page = browser.open(served.host + "/login", data, timeout=WAIT).read().decode()
            assert f"<title>{title}</title>" in page
        assert "This is not the password" not in page
    assert served.process.returncode == 0
    assert "Traceback" not in served.log.read_text()


def test_pages_that_open_at_once_have_their_pictures(served):
    async def come():
        visitors = [Visitor(served.host + "/tools/dashboard") for _ in range(8)]
        await asyncio.gather(*(each.open() for each in visitors))
        for each in visitors:
            each.close()

    said = len(served.log.read_text())
    asyncio.run(come())
    assert served.log.read_text()[said:] == ""
