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
    """

    def __init__(self, url):
        self.url = url
        self.socket = None
        self.models = {}
        self.title = None
        self._count = 0

    async def open(self, pull=True, origin=None):
        """Ask for the page, then for the document in it, unless that is left out."""
        page = await AsyncHTTPClient().fetch(self.url, request_timeout=120)
        token = re.search(r'"token":"([^"]+)"', page.body.decode())[1]
        parts = urlsplit(self.url)
        request = HTTPRequest(
            f"ws://{parts.netloc}{parts.path}/ws",
            headers={"Origin": origin or f"http://{parts.netloc}"},
            request_timeout=120,
        )
        self.socket = await websocket_connect(request, subprotocols=["bokeh", token], max_message_size=2**26)
        await self.receive("ACK")
        if pull:
            await self.pull()
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
        """Return the identity of the model of a name; None where no such model has been made yet."""
        names = ((key, model["attributes"].get("name")) for key, model in self.models.items())
        return next((key for key, each in names if each == name), None)

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

    async def receive(self, kind=None):
        """Return the content of the next message of a kind, or of any; buffers are left out.

        Raises
        ------
        ConnectionError
            If the server has closed the socket.
        """
        while True:
            header = await self._frame()
            await self._frame()
            content = await self._frame()
            for _ in range(2 * header.get("num_buffers", 0)):
                await self.socket.read_message()
            if kind in (None, header["msgtype"]):
                return content

    async def _frame(self):
        frame = await self.socket.read_message()
        if frame is None:
            raise ConnectionError(
                f"closed by the server: {self.socket.close_code} {self.socket.close_reason}"
            )
        return json.loads(frame)

    async def move(self, value):
        """Set the boot stiffness [kN/mm]."""
        self._count += 1
        values = {"boot_stiffness": value}
        message = {"kind": "set", "number": self._count, "values": values, "gesture": self._count}
        await self.patch(told(self.component("groups"), message))

    async def picture(self, timeout=60):
        """Wait for the next insertion gain, and return how long that took [s]."""
        began = time.perf_counter()
        async with asyncio.timeout(timeout):
            while True:
                content = await self.receive("PATCH-DOC")
                self._note(content)  # parts of the page come one after the other
                source = self.named("insertion_gain")
                if any(event.get("model", {}).get("id") == source for event in content["events"]):
                    return time.perf_counter() - began

    def close(self):
        """Leave."""
        if self.socket is not None:
            self.socket.close()


def told(model, message):
    """Return the message of a component's script."""
    values = {"type": "map", "entries": [["model", {"id": model}], ["data", message]]}
    return {
        "kind": "MessageSent",
        "msg_type": "bokeh_event",
        "msg_data": {"type": "event", "name": "data_event", "values": values},
    }
