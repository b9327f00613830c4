"""The page that ``panel serve dashboard`` shows; if it cannot be made, a page that says so."""

import logging

import panel as pn

title = "trackig"
try:
    from dashboard.app import TITLE, build
    from dashboard.server import first_page, sessions
    from dashboard.server.reserve import RESERVE

    first_page.use_own_files(pn.state.curdoc)
    if sessions.admit(pn.state.curdoc):
        is_ready = RESERVE.open(pn.state.curdoc)
        page, title = None if is_ready else build(), TITLE
    else:
        page, title = sessions.full_page(), f"{TITLE} is full"
except Exception:
    logging.getLogger(__name__).exception("The dashboard could not start")
    page = pn.pane.Markdown(
        "# The dashboard could not start\n\nThe server's log says why. Reload to try again."
    )
    title = "trackig could not start"

# the location would be read back from the address bar, which anybody may have typed
if page is not None:
    page.servable(title=title, location=False)
