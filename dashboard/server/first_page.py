"""The page that is sent before there is a session: a session begins when a browser asks for its document.

What the page's HTML holds is the same for every visitor but for a token, so it is made once, when the server
starts. Bokeh would make a whole session for every request of the page, and keep it for a while: link
previews, health checks and tabs that are closed at once would each cost what a reader costs.
"""

from types import SimpleNamespace
from weakref import WeakKeyDictionary

from bokeh.server.urls import per_app_patterns
from bokeh.util.token import generate_jwt_token, generate_session_id
from panel.io.document import _cleanup_doc
from panel.io.resources import Resources, get_dist_path
from panel.io.server import DocHandler, server_html_page_for_session
from panel.io.session import generate_session
from tornado.web import authenticated

from dashboard.server import sessions

_PLACE = "the-token-of-the-visitor"
"""What stands in a page where the token belongs."""

_samples = WeakKeyDictionary()
"""Document from which an application's page is written, by the application's context, until it is."""

_pages = WeakKeyDictionary()
"""HTML of an application's page, by the application's context."""


class FirstPageHandler(DocHandler):
    """Answers with the page, and makes no session; applications without a sample are served as ever."""

    @authenticated
    async def get(self, *args, **kwargs):
        """Answer with the page."""
        page = self._page()
        if page is None:
            await super().get(*args, **kwargs)
            return
        # a page that the browser keeps would hold the token of a session that is over
        self.set_header("Cache-Control", "no-store")
        self.set_header("Content-Type", "text/html")
        self.write(page.replace(_PLACE, self._token()))

    def _page(self):
        context = self.application_context
        if context in _samples:
            document = _samples.pop(context)
            _pages[context] = server_html_page_for_session(
                SimpleNamespace(document=document, token=_PLACE),
                resources=Resources.from_bokeh(self.application.resources()),
                title=document.title,
                template=document.template,
                template_variables=document.template_variables,
            )
            _cleanup_doc(document)
        return _pages.get(context)

    def _token(self):
        server = self.application
        return generate_jwt_token(
            generate_session_id(secret_key=server.secret_key, signed=server.sign_sessions),
            secret_key=server.secret_key,
            signed=server.sign_sessions,
            expiration=server.session_token_expiration,
            extra_payload=self._generate_token_payload(),
        )


def install():
    """Have servers that are made from now on answer so."""
    per_app_patterns[:] = [
        (route, FirstPageHandler if handler is DocHandler else handler, *more)
        for route, handler, *more in per_app_patterns
    ]


def use_own_files(document):
    """Have what is made in a session's document loaded from this server.

    Panel notes where its files are when it writes the page of a document. Our page is written of another, and
    without a note they are fetched from the internet, which a closed network does not have.

    Parameters
    ----------
    document : bokeh.document.Document or None
        The session's document, still empty; None without a session.
    """
    if document is not None:
        document.template_variables["dist_url"] = get_dist_path()


def prepare(application_context, title):
    """Make the sample from which an application's page is written.

    Parameters
    ----------
    application_context : bokeh.server.contexts.ApplicationContext
        The application.
    title : str
        Title of a page that could be made; if another comes out, requests are answered as ever, so that one
        failure at start is not everybody's page.
    """
    document = generate_session(application_context.application).document
    sessions.leave(document)
    if document.title == title:
        _samples[application_context] = document
    else:
        _cleanup_doc(document)
