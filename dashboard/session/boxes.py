"""What stands in boxes of the page that no study holds: it comes back with a page that is loaded anew."""

import json
from functools import partial

import param

MOST_TYPED = 65_536
"""Characters that are taken back from a browser [-]: several times what all boxes hold together."""


class Boxes(param.Parameterized):
    """What stands in the boxes that are kept, by the names that they were given.

    A box is made when its tab is first looked at, and some only for a design with a vehicle or ground: what
    came back for one that is not there yet, or does not offer it yet, waits.
    """

    typed = param.String(default="", doc="What stands in boxes, as JSON; empty if all is as it was at first.")

    def __init__(self):
        super().__init__()
        self._boxes, self._first, self._waiting = {}, {}, {}

    def keep(self, **boxes):
        """Keep what stands in boxes from now on, and put in what came back for them.

        Parameters
        ----------
        **boxes
            Widgets by name: boxes for text, to tick, or to choose from options.
        """
        for name, box in boxes.items():
            self._boxes[name], self._first[name] = box, box.value
            box.param.watch(partial(self._note, name), "value")
        self.put_waiting()

    def put_back(self, typed):
        """Put in what stood there before the page was loaded anew; what no box takes is ignored.

        Parameters
        ----------
        typed : str
            What :attr:`typed` was; it has been in the browser's memory, where anybody may write.
        """
        self._waiting = _read(typed)
        self.put_waiting()

    def put_waiting(self):
        """Put in what waits for a box that is there by now and takes it."""
        if not self._waiting:
            return
        # one that is put in may change others, which have had values of their own since
        for name, stood in [*self._waiting.items()]:
            value = _taken(self._boxes[name], stood) if name in self._boxes else None
            if value is not None:
                self._waiting.pop(name, None)
                self._boxes[name].value = value
        self._tell()

    def _note(self, name, _):
        self._waiting.pop(name, None)
        self._tell()

    def _tell(self):
        there = {name: box.value for name, box in self._boxes.items()}
        every = {**there, **self._waiting}
        self.typed = "" if every == self._first else json.dumps(every, ensure_ascii=False)


def _read(typed):
    """Return values by name, as far as that is what a text holds (dict)."""
    if len(typed) > MOST_TYPED:
        return {}
    try:
        values = json.loads(typed or "{}")
    except (ValueError, RecursionError):
        return {}
    return values if isinstance(values, dict) else {}


def _taken(box, value):
    """Return a value as a box takes it, or None if it takes no such value."""
    options = getattr(box, "options", None)
    if options is None:
        if type(value) is not type(box.value):
            return None
        is_too_long = isinstance(value, str) and len(value) > box.max_length
        return None if is_too_long else value
    there = list(options.values()) if isinstance(options, dict) else list(options)
    if isinstance(box.value, list):
        known = isinstance(value, list) and all(each in there for each in value)
        return [each for each in there if each in value] if known else None
    return next((each for each in there if type(each) is type(value) and each == value), None)
