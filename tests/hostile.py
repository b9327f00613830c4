"""What nobody should send, seeded and repeatable: links, studies, tables and messages on the socket."""

import json
import random

STRINGS = (
    "",
    "\x00",
    "~" * 50,
    "<img src=x onerror=alert(1)>",
    "NaN",
    "1e999",
    "-1",
    "\ud7ff",
    "é" * 2000,
    "x" * 70_000,
)


def value(chance, depth=0):
    """Return a value of whatever type."""
    kind = chance.randrange(9 if depth < 4 else 6)
    match kind:
        case 0:
            return chance.choice(STRINGS)
        case 1:
            return chance.choice((float("nan"), float("inf"), -1e308, 10**400, 0, -1, True, None))
        case 2:
            return chance.uniform(-1e6, 1e6)
        case 3:
            return deep(chance.randrange(1, 400))
        case 4:
            return {
                "type": chance.choice(("map", "ndarray", "bytes", "ref", "object", "set", "slice", "symbol"))
            }
        case 5:
            return {"id": f"p{chance.randrange(9999)}"}
        case 6:
            return [value(chance, depth + 1) for _ in range(chance.randrange(4))]
    return {chance.choice(STRINGS)[:50]: value(chance, depth + 1) for _ in range(chance.randrange(4))}


def deep(levels):
    """Return lists within lists."""
    nested = []
    for _ in range(levels):
        nested = [nested]
    return nested


def mutated(text, chance):
    """Return a text with some of its characters cut, doubled, swapped or replaced."""
    characters = list(text)
    for _ in range(chance.randrange(1, 8)):
        place = chance.randrange(len(characters) + 1)
        match chance.randrange(5):
            case 0:
                del characters[place : place + chance.randrange(20)]
            case 1:
                characters[place:place] = chance.choice(STRINGS)
            case 2:
                characters[place:place] = characters[place : place + chance.randrange(200)]
            case 3:
                characters[place : place + 1] = chr(chance.randrange(1, 0xD800))
            case 4:
                characters[place : place + 1] = chance.choice('[]{}"=,.;\n\t-0123456789e')
    return "".join(characters)


def events(chance, models):
    """Return changes of a document that no page would send.

    Parameters
    ----------
    chance : random.Random
        Decides.
    models : mapping of str to dict
        Models of the page, by identity.
    """
    made = []
    for _ in range(chance.randrange(1, 4)):
        model = chance.choice([*models, "p999999"])
        attributes = [*models.get(model, {}).get("attributes", {}), "no_such_attribute"]
        kinds = (
            "ModelChanged",
            "MessageSent",
            "ColumnDataChanged",
            "ColumnsStreamed",
            "RootAdded",
            "NoSuchKind",
        )
        event = {
            "kind": chance.choice(kinds),
            "model": {"id": model},
            "attr": chance.choice(attributes),
            "new": value(chance),
            "msg_type": chance.choice(("bokeh_event", "nonsense")),
            "msg_data": {
                "type": "event",
                "name": chance.choice(("data_event", "button_click", "document_ready", "no_event")),
                "values": {"type": "map", "entries": [["model", {"id": model}], ["data", value(chance)]]},
            },
        }
        for key in list(event):
            if chance.random() < 0.1:
                event[key] = value(chance)
        made.append(event)
    return made


def frames(chance, models):
    """Return the frames of one message, well-formed as the protocol goes or not."""
    header = {
        "msgid": "1",
        # whatever else is sent cuts the connection off
        "msgtype": "PATCH-DOC" if chance.random() < 0.95 else chance.choice(("PUSH-DOC", "ACK", "NONE")),
    }
    content = {"events": events(chance, models)}
    parts = [json.dumps(header), "{}", json.dumps(content)]
    if chance.random() < 0.05:
        broken = chance.randrange(3)
        parts[broken] = mutated(parts[broken], chance)
    if chance.random() < 0.02:
        parts.insert(chance.randrange(3), chance.randbytes(chance.randrange(1, 2000)))
    return parts


def seeded(seed):
    """Return what decides, the same for the same seed."""
    return random.Random(seed)
