"""What all tabs have in common."""

from panel.viewable import Viewer


class Tab(Viewer):
    """A view that fills a tab: made when the tab is first looked at, and told whether it still is.

    Attributes
    ----------
    title : str
        What the tab is called.
    link_name : str
        What a link calls it: links that somebody kept go on opening it, whatever its title becomes.
    in_sight : bool
        Whether the tab is the one that is open.
    """

    title = link_name = ""

    def __init__(self):
        super().__init__()
        self.in_sight = False

    def look(self, active):
        """Note whether the tab is in sight, and show what has changed meanwhile."""
        self.in_sight = active
        self.refresh()

    def refresh(self):
        """Show what is there, for a tab that draws only in sight."""

    def build(self):
        """Return what is put on the page."""
        raise NotImplementedError

    def fill(self, place):
        """Put the view into its place; between two steps the server may have other work to do.

        Parameters
        ----------
        place : panel.Column
            Where the view goes.
        """
        place.objects = [self]
        yield

    def __panel__(self):
        """Return what is put on the page."""
        return self.build()
