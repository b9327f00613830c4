"""What the solvers hand on: frozen records of arrays and numbers.

All in SI units. Records carry results and no behaviour beyond naming them.
"""

from __future__ import annotations

from dataclasses import dataclass, field
from typing import TYPE_CHECKING

import numpy as np

from trackig_core.bands import ONE_THIRD_OCTAVES, Bands
from trackig_core.words import extremes, hertz, quantity, span

if TYPE_CHECKING:
    from trackig_core.arrays import RealArray
    from trackig_core.time_domain.decimation import LowPass

__all__ = ["ForceSpectrum", "InsertionGain", "NaturalFrequencies", "TimeHistory"]


class SolveCancelled(Exception):  # noqa: N818  (it is no error: the caller asked for it)
    """The caller cancelled the run."""


@dataclass(frozen=True, eq=False)
class TimeHistory:
    """Low-passed, decimated record of one run of the time-stepping solver.

    Attributes
    ----------
    time : numpy.ndarray (samples,) [s]
        Time of each sample; it begins shortly before zero because the low-pass filter looks ahead.
    support_force : numpy.ndarray (samples, supports) [N]
        Force that each support passes into the ground: those of half the ring, or of the whole where
        several axles stand on it.
    multiplicity : numpy.ndarray (supports,) [-]
        How many supports of the whole ring each column stands for: of half the ring 1 under the wheel, else
        2; of the whole 1.
    wheel_displacement, rail_displacement, block_displacement : numpy.ndarray (samples,) [m]
        Displacement of the wheel, and of rail and block at the loaded support; ``block_displacement`` is
        None when single-stage.
    low_pass : LowPass
        The filter that was applied before samples were taken.
    time_step : float [s]
        Time step of the run, before decimation.
    step : float [m]
        Height of the step that squeezes the contact spring at time zero.
    steps : int [-]
        Time steps taken.
    decayed : bool
        Whether the low-passed force had died down at the end of the record.
    last_onset : float [s]
        When the step of roughness reached the last wheel.
    """

    time: RealArray = field(repr=False)
    support_force: RealArray = field(repr=False)
    multiplicity: RealArray = field(repr=False)
    wheel_displacement: RealArray = field(repr=False)
    rail_displacement: RealArray = field(repr=False)
    block_displacement: RealArray | None = field(repr=False)
    low_pass: LowPass = field(repr=False)
    time_step: float
    step: float
    steps: int
    decayed: bool
    last_onset: float = 0.0

    def __str__(self) -> str:
        """Return length and largest force of the record, in words."""
        force = quantity(float(np.abs(self.support_force @ self.multiplicity).max()), "N", 3)
        length = quantity(float(self.time[-1] - self.time[0]), "s", 3)
        end = "" if self.decayed else "; it had not died down at the end"
        return f"{self.time.size} samples over {length}, force into the ground up to {force}{end}"


@dataclass(frozen=True, eq=False)
class ForceSpectrum:
    """Energy spectrum of the force into the ground, summed over the supports.

    Attributes
    ----------
    frequency : numpy.ndarray (frequencies,) [Hz]
        Frequencies, ascending and greater than zero.
    energy : numpy.ndarray (frequencies,) [N2 s2]
        Sum over all supports of the squared magnitude of the force's Fourier transform.
    coherent_energy : numpy.ndarray (frequencies,) [N2 s2]
        Squared magnitude of the Fourier transform of the summed force.
    step : float [m]
        Height of the step in contact compression that excites the track.
    """

    frequency: RealArray = field(repr=False)
    energy: RealArray = field(repr=False)
    coherent_energy: RealArray = field(repr=False)
    step: float

    def __str__(self) -> str:
        """Return where it is known, and after which step."""
        step = quantity(self.step, "m")
        where = f"{self.frequency.size} frequencies, {span(self.frequency, 'Hz')}"
        return f"force spectrum at {where}, after a step of {step}"


@dataclass(frozen=True, eq=False)
class InsertionGain:
    """Insertion gain per band, and the two energies it compares.

    Attributes
    ----------
    levels : numpy.ndarray (bands,) [dB]
        Insertion gain; positive where the track amplifies, negative where it isolates.
    band_energy, reference_energy : numpy.ndarray (bands,) [N2 s]
        Energy of the track and of its reference, integrated over each band.
    reference : str
        ``"line"`` (line fitted below resonance), ``"rigid"`` (exact rigid track) or ``"stiff"`` (very stiff
        track on the same ground).
    summation : str
        ``"energy"`` (squared support forces summed) or ``"coherent"`` (forces summed, then squared).
    bands : Bands
        The bands, by default one-third octaves from 5 Hz to 500 Hz.
    """

    levels: RealArray = field(repr=False)
    band_energy: RealArray = field(repr=False)
    reference_energy: RealArray = field(repr=False)
    reference: str
    summation: str
    bands: Bands = ONE_THIRD_OCTAVES

    def __str__(self) -> str:
        """Return its definition, and least and greatest level [dB]."""
        definition = f"reference {self.reference}, summation {self.summation}"
        return f"insertion gain ({definition}) from {extremes(self.levels, self.bands.labels)}"


@dataclass(frozen=True)
class NaturalFrequencies:
    """Natural frequencies of a track [Hz]; None where a single-stage track has no such mode.

    Attributes
    ----------
    loaded_track : float
        Wheel on its contact spring on the supported rail: the bound mode.
    coupled_block : float or None
        Block between pad and boot, the rail held.
    wheel_on_rigid_blocks : float
        Loaded track with its blocks held still: one half of the uncoupled pair.
    block_on_boot : float or None
        Block on its boot alone: the other half of the uncoupled pair.
    cut_on : tuple of float
        Frequencies at which the free track (rail and block of one bay) resonates in phase all along.
    observed_loaded_track : float or None
        Where the solution's own force spectrum, over frequency squared, peaks near ``loaded_track``; None
        if it has no peak there or is not resolved so high.
    observed_coupled_block : float or None
        Where block over rail displacement at the loaded support peaks near ``coupled_block``; else None.
    """

    loaded_track: float
    coupled_block: float | None
    wheel_on_rigid_blocks: float
    block_on_boot: float | None
    cut_on: tuple[float, ...]
    observed_loaded_track: float | None = None
    observed_coupled_block: float | None = None

    def __str__(self) -> str:
        """Return the frequencies that there are [Hz]."""
        words = {
            "loaded track": self.loaded_track,
            "coupled block": self.coupled_block,
            "wheel on rigid blocks": self.wheel_on_rigid_blocks,
            "block on boot": self.block_on_boot,
            "observed loaded track": self.observed_loaded_track,
            "observed coupled block": self.observed_coupled_block,
        }
        found = [f"{name} {hertz([each])}" for name, each in words.items() if each is not None]
        return ", ".join([*found, f"cut-on {hertz(self.cut_on)}"])
