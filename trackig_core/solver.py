"""The door: one design in, one solution out, whichever solver is asked.

SI units. Source: the paper (see :mod:`trackig_core.design`). The one rule: whatever the fidelity, the
same reference, bands and gain follow the spectrum.
"""

import numpy as np

from trackig_core.bands import BAND_EDGES
from trackig_core.catalogue import PRESETS
from trackig_core.design import DesignError
from trackig_core.gain import LINE_FRACTION, REFERENCES, SUMMATIONS, check_choice, insertion_gain
from trackig_core.grid import make_grid
from trackig_core.harmonic import resolved_spectrum
from trackig_core.modes import natural_frequencies
from trackig_core.results import Solution
from trackig_core.simulate import DEFAULT_STEP, simulate
from trackig_core.spectrum import force_spectrum

FIDELITIES = ("paper", "exact")
"""Fidelities that :func:`solve` offers."""


def solve(
    design,
    fidelity="paper",
    *,
    reference="line",
    summation="energy",
    progress=None,
    cancelled=None,
):
    """Compute the insertion gain and natural frequencies of a track.

    Parameters
    ----------
    design : TrackDesign
        The track; ``PRESETS`` has four.
    fidelity : str
        ``"paper"``: the paper's finite-difference grid, time step, damping recursion and record.
        ``"exact"``: the same lattice, infinitely long and in continuous time, solved frequency by
        frequency in closed form; nothing is stepped, so there are no time records.
    reference : str
        ``"line"`` (the paper's straight line) or ``"rigid"`` (the exact rigid track).
    summation : str
        ``"energy"`` (squared support forces, the paper's) or ``"coherent"`` (forces).
    progress : callable, optional
        Called now and then with the fraction done, 0 to 1, from the calling thread.
    cancelled : callable, optional
        Asked now and then; the run ends when it answers true.

    Returns
    -------
    Solution
        Insertion gain (21,) [dB] and all that led to it.

    Raises
    ------
    RunTooLargeError
        If the run would need more than 2 GB or 60 s.
    SolveCancelled
        If ``cancelled`` answered true.
    DesignError
        If the exact solution has no bound, for want of any loss.
    ValueError
        If a choice is not one of the above.
    """
    check_choice("fidelity", fidelity, FIDELITIES)
    check_choice("reference", reference, REFERENCES)
    check_choice("summation", summation, SUMMATIONS)
    frequencies = natural_frequencies(design)
    grid, history, notes = None, None, ()
    if fidelity == "exact":
        spectrum = _exact_spectrum(design, frequencies.loaded_track)
    else:
        grid = make_grid(design)
        history = simulate(design, grid, progress=progress, cancelled=cancelled)
        spectrum = force_spectrum(history)
        notes = grid.notes + _record_notes(grid, history)
    return Solution(
        design=design,
        fidelity=fidelity,
        gain=insertion_gain(spectrum, design, frequencies.loaded_track, reference, summation),
        spectrum=spectrum,
        natural_frequencies=frequencies,
        grid=grid,
        history=history,
        notes=notes,
    )


def _exact_spectrum(design, loaded_track):
    """Return the twin's spectrum over all bands and down to where the reference line is anchored."""
    # With a loss-free spring on the ground there is a frequency at which waves never die along the track.
    last = "boot_loss_factor" if design.two_stage else "pad_loss_factor"
    if getattr(design, last) == 0:
        raise DesignError(last, 0.0, "more than 0: without loss the exact spectrum has no bound")
    anchor = LINE_FRACTION * loaded_track
    between = np.geomspace(BAND_EDGES[0], BAND_EDGES[-1], 12 * (len(BAND_EDGES) - 1) + 1)
    below = [anchor, *np.geomspace(anchor, BAND_EDGES[0], 12)[1:-1]] if anchor < BAND_EDGES[0] else []
    return resolved_spectrum(design, np.concatenate([below, between]), DEFAULT_STEP)


def _record_notes(grid, history):
    record = history.steps * grid.dt
    notes = ()
    if history.steps > grid.steps:
        notes += (
            f"record extended from {grid.steps * grid.dt:g} s to {record:g} s, "
            "for the force to die down by 80 dB",
        )
    if not history.decayed:
        notes += (
            f"the force had not died down by 80 dB when the record ended at {record:g} s: "
            "sharp resonances are less exact than usual",
        )
    return notes


def compile_kernels():
    """Compile every kernel, or load it from Numba's cache on disk, by solving one small track."""
    design = PRESETS["booted-block-low-mass"]
    simulate(design, make_grid(design, bays=3, record=0.25))
    natural_frequencies(design)
