"""Which pad or boot has its measured stiffness on the desk, and what lies there to be used.

Nothing of it is kept in a study before it is the design's.
"""

import param

import trackig_core as tig
from dashboard.session.special import is_curve

PARTS = {"Pad": "pad", "Boot": "boot"}
"""What may be measured, by what it is called."""


class Measuring(param.Parameterized):
    """A part, and a table of it that was read but is not used yet."""

    part = param.Selector(default="pad", objects=PARTS, label="Measured of the")
    reading = param.Parameter(default=None, doc="A trackig_core StiffnessReading, or None.")
    answered = param.Boolean(default=False, doc="Whether the unit of the reading was chosen by somebody.")

    @property
    def is_open(self):
        """Whether a question on the unit waits for its answer."""
        return self.reading is not None and bool(self.reading.question) and not self.answered


def curve_of(design, part):
    """Return what was measured of a part of a design, stiffness before loss factor, or None."""
    values = (getattr(design, f"{part}_{what}") for what in ("stiffness", "loss_factor"))
    return next((each for each in values if is_curve(each)), None)


def with_curve(inputs, part, curve):
    """Return the special inputs with a measured stiffness of a part.

    Parameters
    ----------
    inputs : DesignInputs
        The current design.
    part : str
        ``"pad"`` or ``"boot"``.
    curve : trackig_core.StiffnessCurve or None
        What was measured; None: neither stiffness nor loss factor is a curve any longer.

    Returns
    -------
    dict
        Values by field, for :meth:`DesignInputs.take`.
    """
    fields = (f"{part}_stiffness", f"{part}_loss_factor")
    special = {name: value for name, value in inputs.special.items() if name not in fields}
    return special if curve is None else {**special, fields[0]: curve}


def fit_text(fit):
    """Return how well a law (trackig_core.analysis.CurveFit) follows what was measured, in words."""
    if fit.error_at_points is None:
        return "no point lies from 5 to 500 Hz, where the law is fitted"
    return (
        f"fit error {fit.error_at_points:.1%} at most at the points from 5 to 500 Hz, "
        f"{fit.error_between:.1%} against straight lines between them"
    )


def extrapolated_words(curve):
    """Return which bands rest on extrapolation of a curve, in words; empty if none does."""
    bands = curve.extrapolated_bands
    if not bands:
        return ""
    first = curve.points[0][0]
    low, high = ([band for band in bands if (float(band) < first) == is_low] for is_low in (True, False))
    parts = [f"up to {band} Hz" for band in low[-1:]] + [f"from {band} Hz on" for band in high[:1]]
    return f"Bands {' and '.join(parts)} rest on extrapolation ({len(bands)} of {len(tig.BAND_LABELS)})."
