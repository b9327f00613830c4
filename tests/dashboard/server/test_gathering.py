"""What is written within one turn of the event loop is sent in one go, in order, and none of it is lost."""

import asyncio
import socket

import pytest

from dashboard.server.gathering import GatheringStream

FRAMES = [b"header", b"metadata", b"x" * 500, b"content"]


class Counting(GatheringStream):
    """Counts how often something was sent."""

    sent = 0

    def write_to_fd(self, data):
        count = super().write_to_fd(data)
        self.sent += count > 0
        return count


@pytest.fixture
def pair():
    ours, theirs = socket.socketpair()
    with ours, theirs:
        yield ours, theirs


@pytest.mark.parametrize(("gathers", "sent"), [(True, 1), (False, len(FRAMES))])
def test_frames_of_one_turn_are_sent_together_once_a_stream_gathers(pair, gathers, sent):
    async def send():
        stream = Counting(pair[0])
        stream.gathers = gathers
        await asyncio.gather(*[stream.write(each) for each in FRAMES])
        return stream.sent

    assert asyncio.run(send()) == sent
    assert pair[1].recv(4096) == b"".join(FRAMES)


def test_what_is_held_back_is_sent_before_a_stream_closes(pair):
    async def send():
        stream = GatheringStream(pair[0])
        stream.gathers = True
        stream.write(b"goodbye")
        stream.close()

    asyncio.run(send())
    assert pair[1].recv(4096) == b"goodbye"
    assert pair[1].recv(4096) == b""
