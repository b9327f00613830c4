"""A connection that sends in one go what is written to it within one turn of the event loop.

A picture goes out as a dozen frames. Sent one by one, each has the event loop let go of the interpreter and
wait for it again, while other threads compute: under load a third of its time.
"""

from tornado.iostream import IOStream


class GatheringStream(IOStream):
    """Tornado's stream; once it gathers, what is written waits for its turn of the event loop.

    Attributes
    ----------
    gathers : bool
        Whether it does; what answers a request over HTTP relies on being sent at once.
    """

    gathers = False
    _writing = False

    def write(self, data):
        """Have data (bytes) sent, with what else is written in this turn; return the future of that."""
        self._writing = True
        try:
            return super().write(data)
        finally:
            self._writing = False

    def write_to_fd(self, data):
        """Send data unless it has only just been written, and return how many bytes were sent."""
        return 0 if self.gathers and self._writing else super().write_to_fd(data)

    def close(self, exc_info=False):
        """Send what is held back, and close."""
        if self.writing() and not exc_info:
            super().write(b"")
        super().close(exc_info)
