"""A visitor without a browser: what Bokeh's client says over HTTP and the WebSocket, and nothing else.

Bokeh's own Python client does not know Panel's models; this one reads the document as plain JSON.
"""

import asyncio
import json
import re
import time
from urllib.parse import urlsplit

from tornado.httpclient import AsyncHTTPClient, HTTPRequest
from tornado.websocket import websocket_connect

from tests.waiting import WAIT

SLIDER = "Boot stiffness, kN/mm"

READY = {
    "kind": "MessageSent",
    "msg_type": "bokeh_event",
    "msg_data": {"type": "event", "name": "document_ready", "values": {"type": "map"}},
}


class Visitor:
    """One page that is open.

    Parameters
    ----------
    url : str
        Address of the dashboard, with a query if there is one.

    Attributes
    ----------
    models : dict
        Every model that the page was told of, by its identity.
    answered : int
        Number of the last move that was answered.
    pictures : int
        How often the insertion gain was drawn anew.
    """

    def __init__(self, url):
        self.url = url
        self.socket = None
        self.models = {}
        self.title = None
        self.answered = self.pictures = 0
        self._count = self._number = 0

    async def open(self, pull=True, origin=None, drawn=True):
        """Ask for the page, then for the document in it, then wait for the picture, unless left out."""
        page = await AsyncHTTPClient().fetch(self.url, request_timeout=WAIT)
        token = re.search(r'"token":"([^"]+)"', page.body.decode())[1]
        parts = urlsplit(self.url)
        request = HTTPRequest(
            f"ws://{parts.netloc}{parts.path}/ws",
            headers={"Origin": origin or f"http://{parts.netloc}"},
            request_timeout=WAIT,
        )
        self.socket = await websocket_connect(request, subprotocols=["bokeh", token], max_message_size=2**26)
        # as browsers do; else the second frame of a message waits until the first is acknowledged
        self.socket.protocol.stream.set_nodelay(True)
        await self.receive("ACK")
        if pull:
            await self.pull()
        if pull and drawn:
            await self.until(lambda: self.named("insertion_gain") is not None)
        return self

    async def pull(self):
        """Ask for the document, and say that it is drawn."""
        await self.send("PULL-DOC-REQ", {})
        document = (await self.receive("PULL-DOC-REPLY"))["doc"]
        self.title = document["title"]
        self.models = {}
        self._note(document)
        await self.patch(READY)

    def _note(self, part):
        if isinstance(part, dict):
            if "id" in part and "attributes" in part:
                self.models[part["id"]] = part
            part = part.values()
        if isinstance(part, list | type({}.values())):
            for each in part:
                self._note(each)

    def named(self, name):
        """Return the identity of the model of a name, or None."""
        named = (key for key, model in self.models.items() if model["attributes"].get("name") == name)
        return next(named, None)

    def component(self, attribute):
        """Return the identity of the component of ours whose script knows an attribute."""
        for key, model in self.models.items():
            data = model["attributes"].get("data")
            if isinstance(data, dict) and attribute in data.get("attributes", {}):
                return key
        raise LookupError(attribute)

    async def patch(self, *events):
        """Send changes of the document."""
        await self.send("PATCH-DOC", {"events": list(events)})

    async def send(self, kind, content):
        """Send one message."""
        self._count += 1
        for part in ({"msgid": f"{id(self)}-{self._count}", "msgtype": kind}, {}, content):
            await self.socket.write_message(json.dumps(part))

    async def refusals(self):
        """Return what the server refuses until it answers a plain question."""
        refused = []
        while (told := await self._message())[0] != "SERVER-INFO-REPLY":
            refused += [told[1]] if told[0] == "ERROR" else []
        return refused

    async def receive(self, kind=None):
        """Return the content of the next message of a kind, or of any; buffers are left out.

        Raises
        ------
        ConnectionError
            If the server has closed the socket.
        """
        while True:
            found, content = await self._message()
            if kind in (None, found):
                return content

    async def _message(self):
        header = await self._frame()
        await self._frame()
        content = await self._frame()
        for _ in range(2 * header.get("num_buffers", 0)):
            await self.socket.read_message()
        if header["msgtype"] == "PATCH-DOC":
            self._heed(content["events"])
        return header["msgtype"], content

    def _heed(self, events):
        """Note what a change of the document says."""
        source = self.named("insertion_gain")
        self.pictures += any(event.get("model", {}).get("id") == source for event in events)
        for event in events:
            data = dict(event.get("msg_data", {}).get("values", {}).get("entries", ())).get("data", {})
            told = dict(data.get("entries", ())) if isinstance(data, dict) else {}
            if told.get("kind") == "answered":
                self.answered = told["number"]
        self._note(events)

    async def _frame(self):
        frame = await self.socket.read_message()
        if frame is None:
            raise ConnectionError(
                f"closed by the server: {self.socket.close_code} {self.socket.close_reason}"
            )
        return json.loads(frame)

    async def move(self, value):
        """Set the boot stiffness [kN/mm], whether or not the last move was answered."""
        self._number += 1
        message = {"kind": "set", "number": self._number, "values": {"boot_stiffness": value}, "gesture": 1}
        await self.patch(told(self.component("groups"), message))

    async def click(self, label):
        """Click the button of a label, once it is there."""
        await self.until(lambda: self.labelled(label) is not None)
        await self.patch(event("dom_event", self.labelled(label), node="click", data={"type": "click"}))

    def labelled(self, label):
        """Return the identity of the component of a label, or None."""
        for key, model in self.models.items():
            data = model["attributes"].get("data")
            if isinstance(data, dict) and data.get("attributes", {}).get("label") == label:
                return key
        return None

    async def until(self, is_so, timeout=WAIT):
        """Hear the server out until something is so."""
        async with asyncio.timeout(timeout):
            while not is_so():
                await self.receive("PATCH-DOC")

    async def picture(self, timeout=WAIT):
        """Wait for the next insertion gain, and return how long that took [s]."""
        began, seen = time.perf_counter(), self.pictures
        await self.until(lambda: self.pictures > seen, timeout)
        return time.perf_counter() - began

    async def answer(self, timeout=WAIT):
        """Wait until the last move is answered, as the page does before it sends the next."""
        await self.until(lambda: self.answered == self._number, timeout)

    def close(self):
        """Leave."""
        if self.socket is not None:
            self.socket.close()


def changed(model, attribute, value):
    """Return the change of a model's attribute."""
    return {"kind": "ModelChanged", "model": {"id": model}, "attr": attribute, "new": value}


def told(model, message):
    """Return the message of a component's script."""
    return event("data_event", model, data=message)


def event(name, model, **values):
    """Return what a component says that happened."""
    entries = [["model", {"id": model}], *([key, each] for key, each in values.items())]
    return {
        "kind": "MessageSent",
        "msg_type": "bokeh_event",
        "msg_data": {"type": "event", "name": name, "values": {"type": "map", "entries": entries}},
    }
