"""What production makes of the current design, for whoever draws it: a band of insertion gain."""

import param


class Production(param.Parameterized):
    """Insertion gain of production, of the design and by the definition for which it was computed."""

    wanted = param.Boolean(default=False, doc="Whether it is drawn with insertion gain.")
    computed = param.Parameter(
        default=None, doc="Design, reference, summation and percentiles (3, 21) [dB], or None."
    )

    def band(self, design, definition):
        """Return insertion gain of 5 and 95 % of production (2, 21) [dB], or None if there is none.

        Parameters
        ----------
        design : trackig_core.TrackDesign
            The current design: a band of another one would mislead.
        definition : GainDefinition
            Which insertion gain is shown.
        """
        if not self.wanted or self.computed is None:
            return None
        of, reference, summation, percentiles = self.computed
        same = (of, reference, summation) == (design, definition.reference_of(design), definition.summation)
        return percentiles[[0, 2]] if same else None
