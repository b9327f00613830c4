"""One design in, one solution out, whichever solver is asked.

Whatever the fidelity, the same reference, bands and gain follow the spectrum. SI units. Source: the paper
(see :mod:`trackig_core.track.design`).
"""

from collections.abc import Callable
from dataclasses import replace

import numpy as np

from trackig_core.bands import ONE_THIRD_OCTAVES, WIDEST, chosen_bands
from trackig_core.frequency_domain import batch_kernels, floquet_waves
from trackig_core.frequency_domain.batch import solve_many
from trackig_core.frequency_domain.convergence import time_step_errors
from trackig_core.frequency_domain.lattice import INFINITE, Lattice
from trackig_core.frequency_domain.natural_frequencies import PEAK_REACH, natural_frequencies, peak_near
from trackig_core.frequency_domain.refinement import banded_spectrum, gain_of, stiff_spectrum
from trackig_core.frequency_domain.track_model import DAMPINGS, Track, TrackModel, track_model
from trackig_core.levels.insertion_gain import SUMMATIONS, check_choice, check_reference, own_reference
from trackig_core.results import ForceSpectrum, NaturalFrequencies, TimeHistory
from trackig_core.solution import Solution
from trackig_core.time_domain import adaptive_grid
from trackig_core.time_domain.grid import FEWEST_BAYS, Grid, make_grid, paper_memory_order
from trackig_core.time_domain.spectrum import block_to_rail, force_spectrum
from trackig_core.time_domain.time_stepping import Ending, simulate
from trackig_core.track.catalogue import PRESETS
from trackig_core.track.design import (
    ELEMENTS_PER_BAY,
    DesignError,
    TrackDesign,
    axle_elements,
    measured_curves,
)
from trackig_core.track.ground import GROUNDS

POOR_FIT = 0.1
"""Relative error of a fitted loss factor above which the solution says so [-]."""

LARGE_STEP_ERROR = 0.5
"""Error of insertion gain in any band, made by the time step, above which the solution says so [dB]."""

WIDE_NOTES = (
    "below 5 Hz a real wheel follows its suspension, and above 500 Hz the rail shears and three elements a "
    "bay are few: read the outer bands with care",
)
"""What bands from 1 Hz to 1 kHz cost in validity."""

FIDELITIES = ("paper", "live", "exact")
"""Fidelities that :func:`solve` offers."""


def solve(
    design: Track,
    fidelity: str = "paper",
    *,
    reference: str | None = None,
    summation: str = "energy",
    damping: str = "viscoelastic",
    bands: str = "one-third-octave",
    rail: str = "euler",
    progress: Callable[[float], object] | None = None,
    cancelled: Callable[[], object] | None = None,
) -> Solution:
    """Compute the insertion gain and natural frequencies of a track.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track; ``PRESETS`` has four.
    fidelity : str
        ``"paper"``: the paper's finite-difference grid, time step, damping recursion and record; where so
        much is lost that this recursion is unstable, one of second order, and ``notes`` says so.
        ``"live"``: the same scheme on the cheapest grid that keeps every band within 0.05 dB of the exact
        answer, with a second-order damping recursion; it says in ``grid`` and ``notes`` what it chose.
        ``"exact"``: the same lattice, infinitely long and in continuous time, solved frequency by
        frequency in closed form; nothing is stepped, so there are no time records.
    reference : str, optional
        ``"line"`` (the paper's straight line; with a suspension it rises as the rigid track's), ``"rigid"``
        (the exact rigid track) or ``"stiff"`` (a very stiff track on the same ground, under the same
        vehicle). By default the line, or where the ground yields, which leaves no other, the stiff track.
    summation : str
        ``"energy"`` (squared support forces, the paper's) or ``"coherent"`` (forces).
    damping : str
        ``"viscoelastic"`` (the paper's: loss stiffens with frequency) or, with fidelity ``"exact"`` alone,
        ``"hysteretic"`` (k (1 + i eta) at every frequency, as many other programs have it; not causal).
    bands : str
        ``"one-third-octave"`` (5 Hz to 500 Hz, the paper's), ``"octave"`` (8 Hz to 250 Hz) or, with fidelity
        ``"exact"`` alone, ``"wide one-third-octave"`` and ``"wide octave"`` (1 Hz to 1 kHz).
    rail : str
        ``"euler"`` (the rail bends) or, with fidelity ``"exact"`` alone, ``"timoshenko"`` (it also shears and
        has rotary inertia; natural frequencies stay those of the rail that bends).
    progress : callable, optional
        Called now and then with the fraction done, 0 to 1, from the calling thread; not when exact.
    cancelled : callable, optional
        Asked now and then, but not when exact; the run ends when it answers true.

    Returns
    -------
    Solution
        Insertion gain (bands,) [dB] and all that led to it.

    Raises
    ------
    RunTooLargeError
        If the run would need more than 2 GB or 60 s.
    SolveCancelled
        If ``cancelled`` answered true.
    FloatingPointError
        If the run left the finite numbers, which no stable grid should let it.
    DesignError
        If ``design`` is no design, or its exact solution has no bound for want of any loss.
    ValueError
        If a choice is not one of the above, the reference has no meaning for the design, or a choice is for
        fidelity ``"exact"`` alone.
    """
    check_choice("damping", damping, DAMPINGS)
    model = track_model(design, damping)
    check_choice("fidelity", fidelity, FIDELITIES)
    check_reference(model.design, own_reference(model.design) if reference is None else reference)
    check_choice("summation", summation, SUMMATIONS)
    in_bands, lattice = chosen_bands(bands), Lattice(rail=rail)
    wide = in_bands.last > ONE_THIRD_OCTAVES.last
    if fidelity != "exact":
        _check_stepped(model, bands if wide else None, lattice)
    grid: Grid | None = None
    history: TimeHistory | None = None
    if fidelity == "exact":
        spectrum = banded_spectrum(model, lattice, bands=WIDEST if wide else ONE_THIRD_OCTAVES)
        notes = _sharpness_notes(spectrum)
    elif fidelity == "live":
        chosen = adaptive_grid.plan(model)
        grid = chosen.grid
        history, spectrum = _stepped(
            model,
            grid,
            adaptive_grid.PADDING,
            progress,
            cancelled,
            memory_order=adaptive_grid.MEMORY_ORDER,
            ending=adaptive_grid.Settled,
        )
        notes = _plan_notes(chosen, history) + _record_notes(model.design)
    else:
        grid = make_grid(model)
        order = paper_memory_order(model, grid.dt)
        history, spectrum = _stepped(model, grid, 1, progress, cancelled, memory_order=order)
        notes = grid.notes + _extension_notes(grid, history) + _step_notes(model, grid, order)
        notes += _record_notes(model.design)
    frequencies = natural_frequencies(model)
    return Solution(
        design=model.design,
        fidelity=fidelity,
        gain=gain_of(model, spectrum, reference, summation, in_bands),
        spectrum=spectrum,
        natural_frequencies=_observed(model, frequencies, spectrum, history),
        pad_law=model.pad,
        boot_law=model.boot,
        grid=grid,
        history=history,
        notes=notes
        + _fit_notes(model)
        + _extrapolation_notes(model)
        + (WIDE_NOTES if wide else ())
        + _axle_notes(model.design),
        stiff_spectrum=stiff_spectrum,
    )


def _stepped(
    model: TrackModel,
    grid: Grid,
    padding: float,
    progress: Callable[[float], object] | None,
    cancelled: Callable[[], object] | None,
    memory_order: int = 1,
    ending: Callable[[], Ending] | None = None,
) -> tuple[TimeHistory, ForceSpectrum]:
    """Step a track through time, and return the record and the spectrum.

    Wheels whose roughness is independent are excited one after the other, each in a run of its own, and their
    energies add; the record is then that of the first.
    """
    wheels = len(model.design.axle_positions)
    independent = model.design.speed is None and wheels > 1
    first: TimeHistory | None = None
    spectra: list[ForceSpectrum] = []
    for wheel in range(wheels if independent else 1):
        history = simulate(
            model,
            grid,
            memory_order=memory_order,
            rough_wheel=wheel if independent else None,
            ending=None if ending is None else ending(),
            progress=_share(progress, wheel, wheels) if independent else progress,
            cancelled=cancelled,
        )
        first = first or history
        spectra.append(force_spectrum(history, padding, like=first))
    assert first is not None
    if not independent:
        return first, spectra[0]
    summed = replace(
        spectra[0],
        energy=np.sum([each.energy for each in spectra], axis=0),
        coherent_energy=np.sum([each.coherent_energy for each in spectra], axis=0),
    )
    return first, summed


def _share(
    progress: Callable[[float], object] | None, done: int, runs: int
) -> Callable[[float], object] | None:
    """Return what reports the progress of one of several runs as that of all."""
    return None if progress is None else lambda fraction: progress((done + fraction) / runs)


def _check_stepped(model: TrackModel, wide_bands: str | None, lattice: Lattice) -> None:
    """Raise a ValueError that names what cannot be stepped in time."""
    wrong = None
    if not model.causal:
        wrong = "damping = 'hysteretic' is not causal and cannot be stepped in time"
    elif lattice != INFINITE:
        wrong = f"rail = {lattice.rail!r} is not stepped in time"
    elif wide_bands is not None:
        wrong = f"bands = {wide_bands!r} reach beyond a run's record"
    if wrong is not None:
        raise ValueError(f"{wrong}: give fidelity 'exact'")


def _observed(
    model: TrackModel, frequencies: NaturalFrequencies, spectrum: ForceSpectrum, history: TimeHistory | None
) -> NaturalFrequencies:
    """Return the natural frequencies with those added that the solution itself shows."""
    block, near = None, frequencies.coupled_block
    if near is not None:
        if history is None:
            axis = np.geomspace(near / PEAK_REACH, near * PEAK_REACH, 200)
            block = peak_near(axis, floquet_waves.block_to_rail(model, axis), near)
        else:
            block = peak_near(*block_to_rail(history), near)
    per_line = spectrum.energy / spectrum.frequency**2
    return replace(
        frequencies,
        observed_loaded_track=peak_near(spectrum.frequency, per_line, frequencies.loaded_track),
        observed_coupled_block=block,
    )


def _fit_notes(model: TrackModel) -> tuple[str, ...]:
    if not model.causal:
        return ("hysteretic damping, k (1 + i eta): not causal, for comparison with other programs",)
    return tuple(
        f"the law fitted to the {part} misses the stated values by up to {law.worst_error:.0%}, 5 to 500 Hz"
        for part, law in zip(("pad", "boot"), model.springs, strict=False)
        if law.worst_error > POOR_FIT
    )


def _record_notes(design: TrackDesign) -> tuple[str, ...]:
    """Return what the record shows where wheels whose roughness is independent are excited one by one."""
    if design.speed is not None or len(design.axle_positions) == 1:
        return ()
    return ("independent roughness: energies of one run per axle are summed; the record is the first axle's",)


def _axle_notes(design: TrackDesign) -> tuple[str, ...]:
    """Return where the axles stand, if not where they were asked to."""
    dx = design.fastener_spacing / ELEMENTS_PER_BAY
    stand = [element * dx for element in axle_elements(design.axle_positions, design.fastener_spacing)]
    moved = (abs(here - there) for here, there in zip(stand, design.axle_positions, strict=True))
    if max(moved) < 1e-3 * dx:
        return ()
    places = ", ".join(f"{each:.3g}" for each in stand)
    return (f"axles stand on the nearest rail elements, {dx:.3g} m apart: at {places} m",)


def _extrapolation_notes(model: TrackModel) -> tuple[str, ...]:
    """Return which bands rest on more than was measured."""
    notes = []
    for name, curve in measured_curves(model.design).items():
        first, last = curve.points[0][0], curve.points[-1][0]
        low = [band for band in curve.extrapolated_bands if float(band) < first]
        high = [band for band in curve.extrapolated_bands if float(band) > last]
        parts = [f"up to {band} Hz" for band in low[-1:]] + [f"from {band} Hz on" for band in high[:1]]
        if parts:
            measured = f"the {name.replace('_', ' ')} was measured from {first:g} to {last:g} Hz"
            notes.append(f"{measured}: bands {' and '.join(parts)} rest on extrapolation")
    return tuple(notes)


def _extension_notes(grid: Grid, history: TimeHistory) -> tuple[str, ...]:
    """Return what is to be said of the length of the paper's record."""
    if history.steps == grid.steps:
        return _decay_notes(history)
    until = ", until the force had died down" if history.decayed else ""
    return (f"record extended to {history.steps * grid.dt:g} s{until}", *_decay_notes(history))


def _decay_notes(history: TimeHistory) -> tuple[str, ...]:
    """Return what is to be said of a force that had not died down when its record ended."""
    if history.decayed:
        return ()
    record = history.steps * history.time_step
    return (f"the force had not died down at {record:.3g} s: do not trust sharp resonances",)


def _plan_notes(chosen: adaptive_grid.Plan, history: TimeHistory) -> tuple[str, ...]:
    """Return what live fidelity chose, and whether that is good enough."""
    grid, record = chosen.grid, history.steps * history.time_step
    notes: tuple[str, ...] = (
        f"{grid.bays} bays, {1 / grid.dt:.0f} steps a second, a record of {record:.2g} s",
    )
    if chosen.error > adaptive_grid.BUDGET:
        notes += (f"time step and ring cost up to {chosen.error:.2f} dB in a band",)
    return notes + _decay_notes(history)


def _sharpness_notes(spectrum: ForceSpectrum) -> tuple[str, ...]:
    """Return what is to be said of resonances that are too sharp to be resolved."""
    if spectrum.frequency.size <= batch_kernels.MOST_FREQUENCIES:
        return ()
    return ("some resonances are too sharp to be resolved: do not trust their bands",)


def _step_notes(model: TrackModel, grid: Grid, memory_order: int) -> tuple[str, ...]:
    """Return what is to be said of the damping memory, and of the time step's error if that is large."""
    notes = () if memory_order == 1 else (SECOND_ORDER_NOTE,)
    try:
        error = time_step_errors(model, [grid.dt], memory_order)[0]
    except DesignError:  # for want of loss there is no frequency-domain solution to compare with
        return notes
    if error <= LARGE_STEP_ERROR:
        return notes
    whose = "the paper's time step" + (" and damping memory" if memory_order == 1 else "")
    return (*notes, f"{whose} cost up to {error:.1f} dB in a band")


SECOND_ORDER_NOTE = (
    "so much loss makes the paper's damping memory unstable at this time step: one of second order is used"
)
"""What is said of a run like the paper's that has another memory."""


def compile_kernels() -> None:
    """Compile every kernel, or load it from Numba's cache on disk, by solving one track in every way."""
    design = PRESETS["booted-block-low-mass"]
    surrounded = design.replace(axle_positions=(0.0, 0.6), ground=GROUNDS["rock"])
    for each in (design, surrounded):
        simulate(each, make_grid(each, bays=FEWEST_BAYS, record=0.25))
    banded_spectrum(design)
    floquet_waves.receptance(design, [50.0])
    for each in (design, surrounded.replace(speed=20.0)):
        solve(each, "exact")
    solve_many(design)
