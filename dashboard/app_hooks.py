"""What the server does before the first session and after the last.

The one rule: no session compiles anything; at a first start the page is there meanwhile, and says so.
"""

import trackig_core as tig
from dashboard.runner import AT_REST, compiled, shared_live_store, shared_store
from dashboard.state import OPENING_PRESET


def on_server_loaded(server_context):  # noqa: ARG001  (the server calls it so)
    """Have the kernels compiled while pages are served, then the presets solved, the opening one first."""
    compiled()
    for key in sorted(tig.PRESETS, key=lambda key: key != OPENING_PRESET):
        shared_store().request((tig.PRESETS[key], AT_REST))


def on_server_unloaded(server_context):  # noqa: ARG001
    """End whatever is being solved, so that the process can end."""
    shared_store().close()
    shared_live_store().close()
