"""The catalogue from which pads, blocks, boots and rails are chosen: the bundled one, or a company's own."""

import param

from trackig_core.study import Catalogue, bundled_catalogue


class Shelf(param.Parameterized):
    """The catalogue that is open."""

    catalogue = param.ClassSelector(class_=Catalogue, allow_None=False, doc="What is chosen from.")

    def __init__(self, **params):
        super().__init__(**{"catalogue": bundled_catalogue(), **params})

    @property
    def is_own(self):
        """Whether the catalogue is another than the bundled one."""
        return self.catalogue != bundled_catalogue()

    def open(self, data):
        """Take the catalogue that a file holds.

        Parameters
        ----------
        data : str or bytes
            What the file holds.

        Raises
        ------
        trackig_core.StudyError
            If it holds none; then the one that was open stays.
        """
        self.catalogue = Catalogue.from_toml(data)

    def close(self):
        """Go back to the bundled catalogue."""
        self.catalogue = bundled_catalogue()

    def fitted(self, kind, name, design):
        """Return a design with a component of the catalogue in it.

        Parameters
        ----------
        kind, name : str
            Of the component, whatever somebody may have sent.
        design : trackig_core.TrackDesign
            The track.

        Returns
        -------
        trackig_core.TrackDesign or None
            The changed design; None if there is no such component.

        Raises
        ------
        trackig_core.DesignError
            If the track has no place for it.
        """
        chosen = (each for each in self.catalogue.components if (each.kind, each.name) == (kind, name))
        component = next(chosen, None)
        return None if component is None else component.fitted_to(design)
