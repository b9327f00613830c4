"""What the subjects of the *Learn* tab say of a design: figures to draw, and sentences made from them.

Each function takes a design and choices, all hashable, and returns a frozen record; it may take half a second
and is called off the event loop (:mod:`dashboard.compute.questions`). Every number and every comparison in a
sentence is computed from what is drawn. SI units; Hz, dB.
"""

from dataclasses import dataclass, field

import numpy as np

import trackig_core as tig
from dashboard.fields import to_display, to_si
from dashboard.formats import difference_text, frequency_text, level_text, slope_text
from dashboard.session.inputs import DesignInputs
from dashboard.session.special import is_curve
from trackig_core.analysis.stiff_reference import STIFF

SWEPT = 60
"""Values of a slider at which natural frequencies are computed [-]."""

DAMPED = np.geomspace(5.0, 500.0, 120)
"""Frequencies at which damping is drawn [Hz]."""

NOT_THERE = np.full(DAMPED.size, np.nan)
"""What is drawn of a spring that is not there."""

NARROW = np.geomspace(tig.BAND_EDGES[0], tig.BAND_EDGES[-1], 240)
"""Frequencies of narrow-band curves [Hz]."""

SUMMATIONS, REFERENCES = ("energy", "coherent"), ("line", "rigid")


@dataclass(frozen=True, eq=False)
class Resonances:
    """Natural frequencies against one slider.

    Attributes
    ----------
    values : numpy.ndarray (values,)
        Values of the slider [display unit].
    sweep : trackig_core.FrequencySweep
        Frequencies.
    words : tuple of str
        Why lumped model and beam differ for this design, and how coupling moves the frequencies apart.
    """

    values: np.ndarray = field(repr=False)
    sweep: tig.FrequencySweep
    words: tuple[str, ...]


def resonances(design, name):
    """Return natural frequencies of a design against the slider of one of its fields.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    name : str
        A slider that is a number.

    Returns
    -------
    Resonances
        Frequencies over the slider's whole range.
    """
    values = np.geomspace(*DesignInputs.param[name].bounds, SWEPT)
    sweep = tig.frequency_sweep(design, name, [to_si(name, value) for value in values])
    return Resonances(values, sweep, (*_straddling(design, sweep), *tig.departure(design).reasons))


def _straddling(design, sweep):
    found = tig.lumped_frequencies(design)
    if not design.two_stage:
        return ("One stage has one mass that moves, the wheel, and so one resonance: nothing to couple.",)
    wheel, block = found.uncoupled
    apart = max(wheel, block) / min(wheel, block)
    near = "close together, so that each pushes the other far aside" if apart < VEERING else "far apart"
    lower, upper = (frequency_text(each) for each in found.coupled)
    below, above = (frequency_text(each) for each in sorted((wheel, block)))
    sentences = (
        f"Uncoupled, the wheel would be at {frequency_text(wheel)} with the block held, the block at "
        f"{frequency_text(block)} on its boot alone: {near}. Coupled, the lumped model is at {lower} and "
        f"{upper}: one below {below}, one above {above}. So it is on every design.",
    )
    if np.ptp(np.sign(np.subtract(*sweep.lumped_uncoupled))) == 0:
        return sentences
    return (*sentences, "Follow the lines to where the thin ones cross: the coupled ones turn away.")


VEERING = 1.5
"""Ratio of the uncoupled frequencies below which they are called close [-]."""


@dataclass(frozen=True, eq=False)
class Slopes:
    """Insertion gain and its asymptotes, with and without blocks.

    Attributes
    ----------
    levels : numpy.ndarray (21,) [dB]
        Of the design.
    asymptotes : tuple of trackig_core.Asymptote
        Of the design.
    measured : tuple of trackig_core.MeasuredSlope
        Of the design, one per asymptote.
    one_stage_levels : numpy.ndarray (21,) [dB] or None
        Of the same track without blocks; None when the design has none.
    one_stage_asymptotes : tuple of trackig_core.Asymptote
        Of the same.
    words : tuple of str
        What is to be seen.
    """

    levels: np.ndarray = field(repr=False)
    asymptotes: tuple
    measured: tuple
    one_stage_levels: np.ndarray | None = field(repr=False)
    one_stage_asymptotes: tuple
    words: tuple[str, ...]


def slopes(design, reference, summation):
    """Return insertion gain and its asymptotes.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    reference, summation : str
        As for ``trackig_core.insertion_gain``.

    Returns
    -------
    Slopes
        The design, and if it has two stages the same without blocks.
    """
    choices = {"reference": reference, "summation": summation}
    levels = tig.solve(design, "exact", **choices).insertion_gain
    measured = tig.measured_slopes(design, summation)
    steepest = measured[-1]
    words = [_about_steepness(design, steepest)]
    if not design.two_stage:
        words.append("One stage: 12 dB per octave above its one resonance.")
        return Slopes(levels, tig.gain_asymptotes(design, **choices), measured, None, (), tuple(words))
    single = without_blocks(design)
    single_levels = tig.solve(single, "exact", **choices).insertion_gain
    gained = single_levels - levels
    at = int(np.argmax(gained))
    words.append(
        "Two stages: 12 dB per octave above the first resonance, 24 above the second. The dashed track is "
        f"as stiff under the wheel at 50 Hz, but has no blocks. The block buys most at {tig.BAND_LABELS[at]} "
        f"Hz, {gained[at]:.1f} dB, and costs most at {tig.BAND_LABELS[int(np.argmin(gained))]} Hz, "
        f"{max(0.0, -gained.min()):.1f} dB."
    )
    return Slopes(
        levels,
        tig.gain_asymptotes(design, **choices),
        measured,
        single_levels,
        tig.gain_asymptotes(single, **choices),
        tuple(words),
    )


def _about_steepness(design, steepest):
    """Return how steep lumped model and beam are at the end of the bands, and why."""
    resonance = tig.lumped_frequencies(design).coupled[-1]
    waves_run = tig.cut_on(design)[0] < steepest.frequency
    lumped = (
        f"steeper, since it still comes down from its resonance at {frequency_text(resonance)}"
        if steepest.lumped < steepest.asymptote.slope
        else "less, since its dampers stiffen with frequency"
    )
    beam = (
        ": waves along the rail pass what the lumped model isolates"
        if waves_run and steepest.beam > steepest.lumped + NOTABLE_SLOPE
        else ""
    )
    return (
        f"At {frequency_text(steepest.frequency)} the asymptote has {_slope(steepest.asymptote.slope)} dB "
        f"per octave. The damped lumped model has {_slope(steepest.lumped)} there, {lumped}; the beam "
        f"{_slope(steepest.beam)}{beam}."
    )


NOTABLE_SLOPE = 1.0
"""Difference of slopes of which something is said [dB per octave]."""


def _slope(slope):
    return f"{slope:+.1f}".replace("-", "−")


def without_blocks(design):
    """Return a two-stage design with pad and boot in one, as stiff as both in a row, and no blocks.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        A two-stage design.

    Returns
    -------
    trackig_core.TrackDesign
        The single-stage design; stiffness and loss factor at 50 Hz are those of the pair.
    """
    pad, boot = (_stated_stiffness(design, part) for part in ("pad", "boot"))
    both = pad * boot / (pad + boot)
    return design.replace(
        pad_stiffness=both.real,
        pad_loss_factor=both.imag / both.real,
        block_mass=None,
        boot_stiffness=None,
        boot_loss_factor=None,
    )


def _stated_stiffness(design, part):
    """Return the complex stiffness of a pad or boot [N/m]; of curves what they are where it is stated."""
    stiffness, loss_factor = getattr(design, f"{part}_stiffness"), getattr(design, f"{part}_loss_factor")
    for curve in (stiffness, loss_factor):
        if is_curve(curve):
            loss_factor = float(curve.loss_factor(design.stiffness_frequency))
    if is_curve(stiffness):
        stiffness = float(stiffness.stiffness(design.stiffness_frequency))
    return stiffness * (1 + 1j * loss_factor)


@dataclass(frozen=True, eq=False)
class Damping:
    """What damping does.

    Attributes
    ----------
    pad, boot : trackig_core.DampingCurve or None
        Stiffness over that at 50 Hz, and loss factor, over :data:`DAMPED`.
    levels : numpy.ndarray (3, 21) [dB]
        Insertion gain at the loss factors 0.05, 0.2 and 0.5.
    words : tuple of str
        Gain and cost.
    """

    pad: tig.DampingCurve
    boot: tig.DampingCurve | None
    levels: np.ndarray = field(repr=False)
    words: tuple[str, ...]


def damping(design, reference, summation):
    """Return what damping does to a design's springs and to its insertion gain.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    reference, summation : str
        As for ``trackig_core.insertion_gain``.

    Returns
    -------
    Damping
        Curves and sentences.
    """
    pad, boot = tig.damping_curves(design, DAMPED)
    levels = tig.gain_by_loss_factor(design, tig.LOSS_FACTORS, reference, summation)
    low, high = (f"{factor:g}" for factor in (tig.LOSS_FACTORS[0], tig.LOSS_FACTORS[-1]))
    bought = levels[0].max() - levels[-1].max()
    name, curve = ("pad", pad) if boot is None else ("boot", boot)
    return Damping(
        pad,
        boot,
        levels,
        (
            f"The {name} has {curve.stiffness[0]:.2f} of its stiffness at 50 Hz when it moves at 5 Hz, and "
            f"{curve.stiffness[-1]:.2f} of it at 500 Hz. No material can lose energy and keep one stiffness: "
            "what answers only after a cause, and not before, must stiffen with frequency as it loses.",
            f"From a loss factor of {low} to {high}, the peak falls by {bought:.1f} dB, from "
            f"{level_text(levels[0].max())} to {level_text(levels[-1].max())}. {_price(levels)}",
        ),
    )


def _price(levels):
    """Return what loss costs where a track of little loss isolates, above its peak."""
    bands = np.arange(levels.shape[1])
    isolating = (bands > np.argmax(levels[0])) & (levels[0] < 0)
    dearer = np.where(isolating, levels[-1] - levels[0], -np.inf)
    dearest = int(np.argmax(dearer))
    if not dearer[dearest] > 0:
        return "Above it nothing is lost on this track."
    return (
        f"The price is paid where the track isolates: {dearer[dearest]:.1f} dB less of it at "
        f"{tig.BAND_LABELS[dearest]} Hz, where lossy springs are stiffer and pass more."
    )


@dataclass(frozen=True, eq=False)
class Definitions:
    """One track by four definitions, and relative to very stiff references.

    Attributes
    ----------
    levels : dict of numpy.ndarray (21,)
        Insertion gain by name, such as ``energy_line`` [dB].
    stiff : trackig_core.StiffReferences
        Very stiff references.
    words, stiff_words : tuple of str
        How far the definitions are apart; how the false peak arises and is avoided.
    """

    levels: dict = field(repr=False)
    stiff: tig.StiffReferences
    words: tuple[str, ...]
    stiff_words: tuple[str, ...]


def definitions(design):
    """Return a design's insertion gain by every definition on offer.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.

    Returns
    -------
    Definitions
        Levels and sentences.
    """
    design, also = (design, ()) if design.ground is None else (design.replace(ground=None), (ON_RIGID,))
    solution = tig.solve(design, "exact")
    levels = {
        f"{summation}_{reference}": solution.gain_for(reference, summation).levels
        for summation in SUMMATIONS
        for reference in REFERENCES
    }
    sums = np.abs(levels["energy_line"] - levels["coherent_line"])
    to_rigid = float(np.mean(levels["energy_rigid"] - levels["energy_line"]))
    coherent_step = float(np.mean(levels["coherent_rigid"] - levels["coherent_line"]))
    stiff = tig.stiff_references(design, NARROW)
    wrong = stiff.gain_real - stiff.gain_rigid
    return Definitions(
        levels,
        stiff,
        (
            _about_sums(sums, tig.cut_on(design)[0]),
            f"Relative to the rigid track, summed energy comes out {abs(to_rigid):.1f} dB "
            f"{'lower' if to_rigid < 0 else 'higher'} than relative to the line, in every band alike: the "
            "two are parallel. The line is drawn through the track's own energy, which is small when many "
            "supports share the load; the rigid track passes the whole load at one place. The coherent "
            f"force has no such step: line and rigid track are {abs(coherent_step):.2f} dB apart for it.",
            "The wheel always stands over a support: this model knows no other place for it.",
            *also,
        ),
        (
            f"On supports of {to_display('pad_stiffness', STIFF):,.0f} kN/mm the wheel still bounces on its "
            f"contact spring, at {frequency_text(stiff.contact_resonance)}. There such a reference passes "
            f"{stiff.real.max():.0f} dB more than a rigid track, and the insertion gain relative to it comes "
            f"out {-wrong.min():.1f} dB too low at {tig.BAND_LABELS[int(np.argmin(wrong))]} Hz: a dip that "
            "no track has.",
            "Stiffen the contact of the reference too, and its peak leaves the bands: what is left is "
            f"within {difference_text(np.abs(stiff.stiffened).max())} of the rigid track, the wheel's "
            "inertia alone. So the paper does it; the straight line and the exact rigid track never had "
            "the peak.",
        ),
    )


ON_RIGID = (
    "All this is drawn for the same track on rigid ground. On ground that yields neither line nor rigid "
    "track is a reference: the ground's own amplification would count as the track's."
)
"""What is said of a design whose own ground yields."""


def _about_sums(differences, waves_begin):
    """Return how far energy and coherent sum are apart, and why."""
    at = tig.BAND_LABELS[int(np.argmax(differences))]
    says = f"The two sums are farthest apart at {at} Hz, by {differences.max():.1f} dB: "
    if waves_begin > tig.BAND_EDGES[-1]:
        return f"{says}on this track waves begin to run along the rail at {frequency_text(waves_begin)} only."
    return (
        f"{says}waves, which run along the rail from about {frequency_text(waves_begin)}, push neighbouring "
        "supports in turn, which energy counts and a sum of forces lets cancel."
    )


@dataclass(frozen=True, eq=False)
class LumpedVsBeam:
    """Lumped model beside beam.

    Attributes
    ----------
    comparison : trackig_core.LumpedComparison
        Both.
    words : tuple of str
        Where the lumped model is good enough, and where not.
    """

    comparison: tig.LumpedComparison
    words: tuple[str, ...]


def lumped_vs_beam(design, reference, summation):
    """Return the insertion gain of the lumped model beside that of the beam.

    Parameters
    ----------
    design : trackig_core.TrackDesign
        The design.
    reference, summation : str
        As for ``trackig_core.insertion_gain``.

    Returns
    -------
    LumpedVsBeam
        Both, and sentences.
    """
    comparison = tig.compare_with_beam(design, reference, summation)
    good, gap = comparison.good_enough, comparison.difference
    worst = int(np.argmax(np.abs(gap)))
    more = "more" if gap[worst] < 0 else "less"
    supports = tig.effective_supports(design)
    where = band_ranges(good)
    return LumpedVsBeam(
        comparison,
        (
            f"The lumped model puts the wheel on {supports:.1f} supports side by side: as stiff as the rail "
            f"makes them. It is within {tig.GOOD_ENOUGH:g} dB of the beam in {good.sum()} of {good.size} "
            "bands" + (f": {where}." if where else "."),
            f"It is farthest off at {tig.BAND_LABELS[worst]} Hz, where the beam passes "
            f"{abs(gap[worst]):.1f} dB {more}. Below the waves' onset, about "
            f"{frequency_text(tig.cut_on(design)[0])} on this track, "
            f"{'two masses on springs describe' if design.two_stage else 'one mass on a spring describes'} "
            "it well; above it vibration travels along the rail, and the lumped model has no rail.",
            "It is the last rung of the ladder in “What was left out”, where vehicle, axles and ground are "
            "put back too.",
        ),
    )


def band_ranges(chosen):
    """Return in words which bands are chosen (21,): "5 to 50 Hz, 80 Hz"."""
    edges = np.flatnonzero(np.diff(np.concatenate([[0], chosen.astype(int), [0]])))
    ranges = [(first, end - 1) for first, end in zip(edges[::2], edges[1::2], strict=True)]
    labels = tig.BAND_LABELS
    return ", ".join(
        f"{labels[first]} Hz" if first == last else f"{labels[first]} to {labels[last]} Hz"
        for first, last in ranges
    )


def slope_rows(measured):
    """Return measured slopes as rows of text: where, asymptote, lumped model, beam.

    Parameters
    ----------
    measured : sequence of trackig_core.MeasuredSlope
        Slopes.

    Returns
    -------
    list of tuple of str
        One row per asymptote.
    """
    return [
        (
            frequency_text(each.frequency),
            slope_text(each.asymptote.slope),
            _slope(each.lumped),
            _slope(each.beam),
        )
        for each in measured
    ]


IN_STEP, OPPOSED = 45.0, 135.0
"""Phases up to which two movements are said to be in step, and from which against each other [degrees]."""


def shape_words(shape):
    """Return what a steady shape at one frequency shows, in words.

    Parameters
    ----------
    shape : trackig_core.SteadyShape
        The shape, of one frequency.

    Returns
    -------
    str
        Sentences.
    """
    at = shape.wheel_position[0]
    wheel, rail = shape.wheel[0], _nearest(shape.position, shape.rail, at)
    which = "the wheel" if shape.wheel_position.size == 1 else "the first wheel"
    amounts = f"{which} moves {_times(wheel)}, the rail under it {_times(rail)}"
    phases = f"Wheel and rail move {_phase(wheel, rail)}"
    if shape.block is not None:
        block = _nearest(shape.support_position, shape.block, at)
        amounts += f", the block {_times(block)}"
        phases += f"; rail and block {_phase(rail, block)}"
    if shape.foot is not None:
        amounts += f", the foot on the ground {_times(_nearest(shape.support_position, shape.foot, at))}"
    return f"At {frequency_text(float(shape.frequency[0]))} {amounts} the roughness. {phases}."


def _nearest(positions, moved, at):
    """Return the displacement of what stands nearest to a place [m], at the first frequency."""
    return moved[np.abs(positions - at).argmin(), 0]


def _times(movement):
    return f"{abs(movement):.2g} times"


def _phase(one, other):
    angle = abs(float(np.degrees(np.angle(one * np.conj(other)))))
    if angle <= IN_STEP:
        return f"in step ({angle:.0f} degrees apart)"
    return f"{'against each other' if angle >= OPPOSED else 'out of step'} ({angle:.0f} degrees apart)"
