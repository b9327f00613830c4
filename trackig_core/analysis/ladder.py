"""The ladder: what the simplified model leaves out, put back one thing after the other.

The paper's Figure 1 justifies its simplified model by taking things away one by one: other axles, bogie and
body, frequency-dependent damping, what lies below. Here they are put back for one design: the simplified
model (one wheel, unsprung mass only, rigid ground, constant loss factors); + measured damping, where the
design has any; + suspension; + other axles; + ground; and, beside them, the one-dimensional model, which
leaves the rail out too. What the design does not say is filled in with figures of the catalogue, and said.

Every rung is computed by the frequency-domain solution and refers to the very stiff track on the same ground
and under the same vehicle; on rigid ground that is the rigid track. The last rung is no tunnel: neighbouring
supports do not feel each other through the ground, which makes both tracks stand on softer ground than an
invert would, and nothing is said of the way from there to a receptor. Nor does any rung move along the track.

Hz, dB. Source: the paper (see :mod:`trackig_core.track.design`), Figure 1.
"""

from dataclasses import dataclass, field

import numpy as np

from trackig_core.analysis.lumped import lumped_insertion_gain
from trackig_core.arrays import RealArray
from trackig_core.bands import BAND_LABELS
from trackig_core.frequency_domain.natural_frequencies import loaded_track
from trackig_core.frequency_domain.refinement import banded_gain
from trackig_core.frequency_domain.track_model import Track, TrackModel, track_model
from trackig_core.track.design import ONE_AXLE, REFERENCE_FREQUENCY, TrackDesign
from trackig_core.track.fields import RANGES
from trackig_core.track.ground import GROUNDS, Ground
from trackig_core.track.measured_curves import LossFactorCurve, StiffnessCurve
from trackig_core.track.vehicle import VEHICLES, Vehicle
from trackig_core.words import extremes, largest

DEFAULT_VEHICLE = "regional"
"""Vehicle of the catalogue that fills in what a design does not say of suspension and axles."""

DEFAULT_GROUND = "stiff clay"
"""Ground of the catalogue that fills in what a design does not say of it."""

NOISE_BANDS = ("16", "250")
"""First and last band for which the cost is summed up [Hz]: ground-borne noise, ISO 14837-1."""


@dataclass(frozen=True, eq=False)
class Rung:
    """One model of the ladder.

    Attributes
    ----------
    name : str
        What it adds to the rung before.
    design : TrackDesign
        What was solved.
    insertion_gain : numpy.ndarray (21,) [dB]
        Against the very stiff track on the same ground, under the same vehicle.
    difference : numpy.ndarray (21,) [dB]
        Insertion gain less that of the simplified model, per band.
    source : str
        Where what was added comes from: "the design", or the entry of the catalogue that stands in.
    """

    name: str
    design: TrackDesign
    insertion_gain: RealArray = field(repr=False)
    difference: RealArray = field(repr=False)
    source: str

    @property
    def largest(self) -> float:
        """The difference that is largest in magnitude, in any band [dB]."""
        return float(self.difference[self._where])

    @property
    def largest_band(self) -> str:
        """Nominal mid-band frequency of that band, as text [Hz]."""
        return BAND_LABELS[self._where]

    @property
    def _where(self) -> int:
        return int(np.abs(self.difference).argmax())

    def __str__(self) -> str:
        """Return what it adds, and by how much that moves insertion gain [dB]."""
        if not self.difference.any():
            return f"{self.name}: insertion gain {extremes(self.insertion_gain, BAND_LABELS)}"
        moves = largest(self.difference, BAND_LABELS)
        return f"{self.name} ({self.source}): {moves} from the simplified model"


@dataclass(frozen=True, eq=False)
class Ladder:
    """The simplified model of a design and what it leaves out.

    Attributes
    ----------
    rungs : tuple of Rung
        The simplified model first, then each with one thing more.
    one_dimensional : Rung
        The lumped model of :mod:`trackig_core.analysis.lumped`, beside them.
    loaded_track : float
        Loaded-track frequency [Hz].
    summation : str
        ``"energy"`` or ``"coherent"``.
    """

    rungs: tuple[Rung, ...]
    one_dimensional: Rung
    loaded_track: float
    summation: str

    @property
    def cost(self) -> float:
        """Largest difference between simplified and fullest model from 16 to 250 Hz [dB]."""
        return float(np.abs(self.rungs[-1].difference[_noise()]).max())

    @property
    def sentence(self) -> str:
        """What the simplified model costs this design from 16 to 250 Hz, rung by rung, in one sentence."""
        pairs = zip(self.rungs, self.rungs[1:], strict=False)
        steps = [
            _worst(after.insertion_gain - before.insertion_gain)
            + f" with {after.name}"
            + (f" ({after.source})" if after.source.startswith("generic") else "")
            for before, after in pairs
        ]
        low, high = NOISE_BANDS
        return (
            f"Between {low} and {high} Hz the simplified model of this design moves, step by step, by up to "
            f"{', '.join(steps[:-1])} and {steps[-1]}; the one-dimensional model is up to "
            f"{_worst(self.one_dimensional.difference)} from it."
        )

    def __str__(self) -> str:
        """Return what the simplified model costs, in one sentence [dB]."""
        return self.sentence


def ladder(
    design: Track, vehicle: str = DEFAULT_VEHICLE, ground: str = DEFAULT_GROUND, summation: str = "energy"
) -> Ladder:
    """Return what the simplified model leaves out, put back one thing after the other.

    Parameters
    ----------
    design : TrackDesign or TrackModel
        The track, with what it says of measured damping, suspension, axles and ground.
    vehicle : str
        Key of ``VEHICLES``, for the suspension or the axles of a design that has none.
    ground : str
        Key of ``GROUNDS``, for a design on rigid ground.
    summation : str
        ``"energy"`` or ``"coherent"``, as for :func:`trackig_core.insertion_gain`.

    Returns
    -------
    Ladder
        Four or five rungs and the one-dimensional model, in some 0.1 s.

    Raises
    ------
    DesignError
        If the exact answer has no bound, for want of any loss.
    KeyError
        If there is no such vehicle or ground.
    ValueError
        If ``summation`` is not one of the choices.
    """
    model = track_model(design)
    steps = _steps(model, VEHICLES[vehicle], GROUNDS[ground], vehicle, ground)
    gains = [banded_gain(each, reference="stiff", summation=summation).levels for _, each, _ in steps]
    rungs = tuple(
        Rung(name, each, gain, gain - gains[0], source)
        for (name, each, source), gain in zip(steps, gains, strict=True)
    )
    simplified = rungs[0].design
    lumped = lumped_insertion_gain(simplified, "stiff", summation).levels
    one_dimensional = Rung("the rail left out", simplified, lumped, lumped - gains[0], "the design")
    return Ladder(rungs, one_dimensional, loaded_track(simplified), summation)


def _steps(
    model: TrackModel, vehicle: Vehicle, ground: Ground, vehicle_name: str, ground_name: str
) -> list[tuple[str, TrackDesign, str]]:
    """Return name, design and source of every rung."""
    own = model.design
    rung = own.simplified
    constant = _constant_loss(model, rung)
    steps = [("the simplified model", constant, "the design")]
    if constant != rung:
        steps.append(("measured damping", rung, "the design"))
    rung = rung.replace(suspension=own.suspension or vehicle.suspension)
    steps.append(("suspension", rung, _source(own.suspension is not None, vehicle_name)))
    has_axles = own.axle_positions != ONE_AXLE
    axles = own.axle_positions if has_axles else (0.0, vehicle.wheelbase)
    rung = rung.replace(axle_positions=axles, speed=own.speed)
    steps.append(("other axles", rung, _source(has_axles, vehicle_name)))
    rung = rung.replace(ground=own.ground or ground)
    steps.append(("ground", rung, _source(own.ground is not None, ground_name)))
    return steps


def _source(own: bool, catalogue: str) -> str:
    return "the design" if own else f"generic: {catalogue}"


def _constant_loss(model: TrackModel, design: TrackDesign) -> TrackDesign:
    """Return a design whose measured curves give way to their values at 50 Hz."""
    changes = {}
    for part, law in zip(("pad", "boot"), model.springs, strict=False):
        stiffness, loss_factor = f"{part}_stiffness", f"{part}_loss_factor"
        measured = isinstance(getattr(design, stiffness), StiffnessCurve)
        if measured:
            changes[stiffness] = law.stiffness(REFERENCE_FREQUENCY)
        if measured or isinstance(getattr(design, loss_factor), LossFactorCurve):
            low, high, _ = RANGES[loss_factor]
            changes[loss_factor] = float(np.clip(law.loss_factor(REFERENCE_FREQUENCY), low, high))
    return design.replace(**changes)


def _worst(difference: RealArray) -> str:
    """Return the largest difference from 16 to 250 Hz and its band, in words."""
    within = np.abs(difference[_noise()])
    return f"{within.max():.1f} dB ({BAND_LABELS[_noise().start + int(within.argmax())]} Hz band)"


def _noise() -> slice:
    """Return the bands of ground-borne noise."""
    first, last = (BAND_LABELS.index(each) for each in NOISE_BANDS)
    return slice(first, last + 1)
