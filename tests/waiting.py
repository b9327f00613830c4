"""Waiting for what comes to be, never for a time: machines that run tests may be slow and busy."""

import asyncio
import time

WAIT = 120
"""Patience with whatever is going to happen, on a slow and busy machine [s]."""


async def until(condition):
    """Let the event loop run until something is true."""
    async with asyncio.timeout(WAIT):
        while not condition():
            await asyncio.sleep(0.002)


async def until_at_rest():
    """Let the event loop run until nothing else is under way on it."""
    async with asyncio.timeout(WAIT):
        while tasks := asyncio.all_tasks() - {asyncio.current_task()}:
            await asyncio.wait(tasks)


def on_a_loop(action, *arguments, **values):
    """Call something as a server does, on an event loop; return its result once all that it began rests."""

    async def acted():
        result = action(*arguments, **values)
        await until_at_rest()
        return result

    return asyncio.run(acted())


def wait_until(condition):
    """Wait, without an event loop, until something is true."""
    deadline = time.monotonic() + WAIT
    while not condition():
        assert time.monotonic() < deadline, "it never came to be"
        time.sleep(0.01)
