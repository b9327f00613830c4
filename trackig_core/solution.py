"""What one call of :func:`trackig_core.solve` computed, and how it is shown in a notebook.

Pandas and Matplotlib are imported only by the methods that use them. SI units, Hz and dB.
"""

from __future__ import annotations

import html
from dataclasses import dataclass, field
from typing import TYPE_CHECKING

from trackig_core.bands import BAND_LABELS, chosen_bands
from trackig_core.levels.insertion_gain import insertion_gain, own_reference
from trackig_core.track.design import measured_curves
from trackig_core.words import extremes

if TYPE_CHECKING:
    from collections.abc import Callable

    import pandas
    from matplotlib.axes import Axes

    from trackig_core.arrays import RealArray
    from trackig_core.bands import Bands
    from trackig_core.results import ForceSpectrum, InsertionGain, NaturalFrequencies, TimeHistory
    from trackig_core.time_domain.grid import Grid
    from trackig_core.track.design import TrackDesign
    from trackig_core.track.viscoelastic_law import Relaxation

REFERENCE_WORDS = {
    "line": "straight reference line",
    "rigid": "rigid track",
    "stiff": "very stiff track on the same ground",
}
"""What insertion gain refers to, in words."""

SUMMATION_WORDS = {"energy": "squared support forces summed", "coherent": "support forces summed"}
"""What is summed over the supports, in words."""


@dataclass(frozen=True, eq=False, repr=False)
class Solution:
    """Insertion gain of a track, and all that led to it.

    Attributes
    ----------
    design : TrackDesign
        The track that was solved.
    fidelity : str
        The solver that was used.
    gain : InsertionGain
        Insertion gain and the energies behind it, as defined by the call of :func:`trackig_core.solve`.
    spectrum : ForceSpectrum
        Narrow-band energy of the force into the ground.
    natural_frequencies : NaturalFrequencies
        Natural frequencies computed from the design, and those observed in the solution.
    pad_law, boot_law : Relaxation
        The fitted damping laws and how well they fit; ``boot_law`` is None when single-stage.
    grid : Grid or None
        Grid in space and time; None when nothing was stepped in time.
    history : TimeHistory or None
        Low-passed time record; None when nothing was stepped in time.
    notes : tuple of str
        What the user should know: a halved time step, an extended record, a poor damping fit.
    stiff_spectrum : callable or None
        ``stiff_spectrum(design)`` returns the ForceSpectrum of the very stiff reference track.
    """

    design: TrackDesign
    fidelity: str
    gain: InsertionGain
    spectrum: ForceSpectrum
    natural_frequencies: NaturalFrequencies
    pad_law: Relaxation
    boot_law: Relaxation | None
    grid: Grid | None = None
    history: TimeHistory | None = None
    notes: tuple[str, ...] = ()
    stiff_spectrum: Callable[[TrackDesign], ForceSpectrum] | None = None
    _gains: dict[tuple[str, str, Bands], InsertionGain] = field(default_factory=dict, init=False)

    def __post_init__(self) -> None:
        """Remember the insertion gain that comes with the solution."""
        self._gains[self.gain.reference, self.gain.summation, self.gain.bands] = self.gain

    @property
    def band_centres(self) -> RealArray:
        """Exact mid-band frequencies (bands,) [Hz]."""
        return self.gain.bands.centres

    @property
    def band_labels(self) -> tuple[str, ...]:
        """Nominal mid-band frequencies, as text (bands,) [Hz]."""
        return self.gain.bands.labels

    @property
    def extrapolated_bands(self) -> tuple[str, ...]:
        """Nominal mid-band frequencies, as text, of bands beyond what was measured of pad or boot [Hz]."""
        beyond = {
            band for curve in measured_curves(self.design).values() for band in curve.extrapolated_bands
        }
        return tuple(label for label in BAND_LABELS if label in beyond)

    @property
    def insertion_gain(self) -> RealArray:
        """Insertion gain per band (bands,) [dB]."""
        return self.gain.levels

    @property
    def time(self) -> RealArray | None:
        """Sample times of the force records (samples,) [s]; None when nothing was stepped in time."""
        return None if self.history is None else self.history.time

    @property
    def loaded_support_force(self) -> RealArray | None:
        """Low-passed force into the ground under the wheel (samples,) [N], or None."""
        return None if self.history is None else self.history.support_force[:, 0]

    @property
    def total_force(self) -> RealArray | None:
        """Low-passed force into the ground, summed over all supports (samples,) [N], or None."""
        return None if self.history is None else self.history.support_force @ self.history.multiplicity

    def gain_for(
        self, reference: str | None = None, summation: str = "energy", bands: str = "one-third-octave"
    ) -> InsertionGain:
        """Return the insertion gain by another definition; each definition is computed once.

        Parameters
        ----------
        reference : str, optional
            ``"line"``, ``"rigid"`` or ``"stiff"``, as for :func:`trackig_core.solve`.
        summation : str
            ``"energy"`` or ``"coherent"``, as for :func:`trackig_core.insertion_gain`.
        bands : str
            A key of :data:`trackig_core.bands.BANDS`.

        Returns
        -------
        InsertionGain
            Levels (bands,) [dB] and the energies behind them.

        Raises
        ------
        ValueError
            If a choice is not one of the above, the reference has no meaning for the design, or the spectrum
            does not cover the bands.
        """
        reference = own_reference(self.design) if reference is None else reference
        in_bands = self._covered(bands)
        known = self._gains.get((reference, summation, in_bands))
        if known is None:
            loaded_track = self.natural_frequencies.loaded_track
            stiff = None
            if reference == "stiff" and self.stiff_spectrum is not None:
                stiff = self.stiff_spectrum(self.design)
            known = insertion_gain(
                self.spectrum, self.design, loaded_track, reference, summation, in_bands, stiff
            )
            self._gains[reference, summation, in_bands] = known
        return known

    def _covered(self, name: str) -> Bands:
        """Return the bands of a name, or raise a ValueError if the spectrum does not cover them."""
        bands = chosen_bands(name)
        lowest, highest = self.spectrum.frequency[[0, -1]]
        first, last = bands.edges[[0, -1]]
        if bands != self.gain.bands and not (lowest <= first and last <= highest):
            raise ValueError(
                f"bands = {name!r}: they reach from {first:.3g} to {last:.4g} Hz, and this solution from "
                f"{lowest:.3g} to {highest:.4g} Hz; give bands to solve(), with fidelity 'exact'"
            )
        return bands

    def to_dataframe(self) -> pandas.DataFrame:
        """Return the insertion gain as a table, one row per band.

        Returns
        -------
        pandas.DataFrame
            Index ``band_hz``: nominal mid-band frequencies as text [Hz]. Columns: ``centre_hz``, exact
            mid-band frequency [Hz]; ``insertion_gain_db`` [dB]; ``band_energy_n2s`` and
            ``reference_energy_n2s``, the two energies that it compares [N2 s].
        """
        import pandas

        return pandas.DataFrame(
            {
                "centre_hz": self.band_centres,
                "insertion_gain_db": self.gain.levels,
                "band_energy_n2s": self.gain.band_energy,
                "reference_energy_n2s": self.gain.reference_energy,
            },
            index=pandas.Index(self.band_labels, name="band_hz"),
        )

    def plot(self, ax: Axes | None = None) -> Axes:
        """Draw the insertion gain over the bands.

        Parameters
        ----------
        ax : matplotlib.axes.Axes, optional
            Axes to draw on, such as those of another solution; by default new ones.

        Returns
        -------
        matplotlib.axes.Axes
            The axes, with one more line; its label names the fidelity.
        """
        import matplotlib.pyplot as plt

        if ax is None:
            _, ax = plt.subplots(layout="constrained")
        places = range(len(self.band_labels))
        ax.plot(places, self.gain.levels, drawstyle="steps-mid", label=self.fidelity)
        ax.set_xticks(places, self.band_labels, rotation=90)
        ax.set_xlabel(f"{self.gain.bands.words} band [Hz]")
        ax.set_ylabel(f"Insertion gain re {REFERENCE_WORDS[self.gain.reference]} [dB]")
        ax.set_title(f"Insertion gain, {SUMMATION_WORDS[self.gain.summation]}")
        ax.grid(visible=True, alpha=0.3)
        return ax

    def _summary(self) -> dict[str, str]:
        """Return what is worth seeing at a glance, in words."""
        levels, frequencies = self.gain.levels, self.natural_frequencies
        summary = {"Fidelity": self.fidelity, "Loaded track": f"{frequencies.loaded_track:.1f} Hz"}
        if frequencies.coupled_block is not None:
            summary["Coupled block"] = f"{frequencies.coupled_block:.1f} Hz"
        summary["Insertion gain"] = extremes(levels, self.band_labels)
        return summary

    def __repr__(self) -> str:
        """Return fidelity, natural frequencies and the range of the insertion gain, on one line."""
        words = (f"{name[0].lower()}{name[1:]} {value}" for name, value in self._summary().items())
        return f"<Solution: {', '.join(words)}>"

    def _repr_html_(self) -> str:
        """Return the same as a small table, with the definition and the notes, for a notebook."""
        rows = self._summary()
        definition = f"{REFERENCE_WORDS[self.gain.reference]}; {SUMMATION_WORDS[self.gain.summation]}"
        rows["Definition"] = f"re {definition}"
        if self.notes:
            rows["Notes"] = "; ".join(self.notes)
        cells = (
            f"<tr><th style='text-align:left'>{html.escape(name)}</th>"
            f"<td style='text-align:left'>{html.escape(value)}</td></tr>"
            for name, value in rows.items()
        )
        return f"<table>{''.join(cells)}</table>"
