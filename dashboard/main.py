"""The page that ``panel serve dashboard`` shows; if it cannot be made, a page that says so."""

import logging

import panel as pn

try:
    from dashboard.app import build

    page = build()
except Exception:
    logging.getLogger(__name__).exception("The dashboard could not start")
    page = pn.pane.Markdown(
        "# The dashboard could not start\n\nThe server's log says why. Reload to try again."
    )

# the location would be read back from the address bar, which anybody may have typed
page.servable(title="trackig", location=False)
