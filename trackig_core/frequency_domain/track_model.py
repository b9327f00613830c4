"""One track made ready to be solved: its design and the laws of its pads and boots, derived once.

Every function that solves or analyses a track takes a design or a :class:`TrackModel`; it makes a model of a
design by :func:`track_model` and passes the model on, so that laws and natural frequencies are computed once
however many functions ask for them. SI units and Hz.
"""

from collections.abc import Callable
from dataclasses import dataclass, field
from functools import cached_property, wraps
from typing import Any, TypeAlias, TypeVar, cast

from trackig_core.arrays import AnyArray, ComplexArray, RealArray
from trackig_core.frequency_domain.kernel_rows import track_row
from trackig_core.frequency_domain.lattice import INFINITE, Lattice, dynamic_stiffness
from trackig_core.track.design import DesignError, TrackDesign
from trackig_core.track.hysteretic import hysteretic_laws
from trackig_core.track.vehicle import dynamic_stiffness_above
from trackig_core.track.viscoelastic_law import Relaxation, laws

_Computed = TypeVar("_Computed")

_Laws: TypeAlias = Callable[[TrackDesign], tuple[Relaxation, Relaxation | None]]

DAMPINGS: dict[str, _Laws] = {"viscoelastic": laws, "hysteretic": hysteretic_laws}
"""How pads and boots may be damped, and what makes their laws of a design."""


@dataclass(frozen=True, eq=False)
class Supports:
    """Dynamic stiffnesses of a support at some frequencies.

    Attributes
    ----------
    pad : numpy.ndarray of complex (frequencies,) [N/m]
        Dynamic stiffness of the pad.
    boot : numpy.ndarray of complex (frequencies,) [N/m] or None
        Dynamic stiffness of the boot; None when single-stage.
    inertia : numpy.ndarray (frequencies,) [N/m] or None
        Mass of the block times angular frequency squared; None when single-stage.
    foot : numpy.ndarray of complex (frequencies,) [N/m] or None
        Dynamic stiffness of the ground with the mass that moves with the foot; None on rigid ground.
    into_ground : numpy.ndarray of complex (frequencies,) [N/m] or None
        Force into the ground proper per displacement of the foot: that of its spring and dashpot.
    """

    pad: ComplexArray
    boot: ComplexArray | None = None
    inertia: RealArray | None = None
    foot: ComplexArray | None = None
    into_ground: ComplexArray | None = None

    @cached_property
    def block(self) -> ComplexArray | None:
        """Force on the block per displacement of it, the rail held (frequencies,) [N/m], or None."""
        if self.boot is None or self.inertia is None:
            return None
        return self.pad + self.below(self.boot)[0] - self.inertia

    @property
    def foot_to_rail(self) -> ComplexArray | None:
        """Displacement of the foot per displacement of the rail (frequencies,) [-]; None on rigid ground."""
        return None if self.into_ground is None else self.transfer / self.into_ground

    def below(self, spring: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
        """Return what the lowest spring does per displacement of its upper end.

        Parameters
        ----------
        spring : numpy.ndarray of complex (frequencies,)
            Dynamic stiffness of the spring that stands on the ground [N/m].

        Returns
        -------
        stiffness, transfer : numpy.ndarray of complex (frequencies,)
            Force on its upper end and force into the ground proper [N/m]; on rigid ground the spring's own.
        """
        if self.foot is None or self.into_ground is None:
            return spring, spring
        share = spring / (spring + self.foot)
        return share * self.foot, share * self.into_ground

    @property
    def stiffness(self) -> ComplexArray:
        """Force of the support on the rail per displacement of the rail (frequencies,) [N/m]."""
        block = self.block
        return self.below(self.pad)[0] if block is None else self.pad - self.pad**2 / block

    @property
    def transfer(self) -> ComplexArray:
        """Force into the ground proper per displacement of the rail (frequencies,) [N/m]."""
        boot, block = self.boot, self.block
        if boot is None or block is None:
            return self.below(self.pad)[1]
        return self.pad * self.below(boot)[1] / block


@dataclass(frozen=True, eq=False)
class TrackModel:
    """A design and the laws of its pads and boots.

    Attributes
    ----------
    design : TrackDesign
        The track.
    pad : Relaxation
        Law of the pads.
    boot : Relaxation or None
        Law of the boots; None when single-stage.
    """

    design: TrackDesign
    pad: Relaxation
    boot: Relaxation | None
    _computed: dict[object, Any] = field(default_factory=dict, init=False, repr=False)

    @property
    def springs(self) -> tuple[Relaxation, ...]:
        """Laws of a support's springs, from the rail down: pad and boot, or the pad alone."""
        return (self.pad,) if self.boot is None else (self.pad, self.boot)

    @cached_property
    def row(self) -> RealArray:
        """The track as compiled code takes it (19,); see :mod:`trackig_core.frequency_domain.kernel_rows`."""
        return track_row(self.design, self.pad, self.boot)

    @property
    def is_simplified(self) -> bool:
        """Whether it is the paper's simplified model: one unsprung wheel over a support, rigid ground."""
        return self.design.one_unsprung_wheel and self.design.ground is None

    @property
    def simplified(self) -> "TrackModel":
        """The paper's simplified model of the track, on the same laws."""
        return self if self.is_simplified else TrackModel(self.design.simplified, self.pad, self.boot)

    @property
    def causal(self) -> bool:
        """Whether every spring is, so that the track can be stepped in time and solved by compiled code."""
        return all(law.causal for law in self.springs)

    @property
    def rigid_blocks(self) -> "TrackModel":
        """The single-stage track on the same pads, its blocks held still."""
        if self.boot is None:
            return self
        changed = self.design.replace(block_mass=None, boot_stiffness=None, boot_loss_factor=None)
        return TrackModel(changed, self.pad, None)

    def supports(self, frequency: RealArray, lattice: Lattice = INFINITE) -> Supports:
        """Return the dynamic stiffnesses of a support.

        Parameters
        ----------
        frequency : numpy.ndarray (frequencies,)
            Frequencies [Hz].
        lattice : Lattice
            Continuous or discrete time, and the rule of the damping memory.

        Returns
        -------
        Supports
            Dynamic stiffnesses [N/m] at those frequencies.
        """
        pad = dynamic_stiffness(self.pad, frequency, lattice)
        foot = self._foot(frequency, lattice)
        if self.boot is None or self.design.block_mass is None:
            return Supports(pad, None, None, *foot)
        return Supports(
            pad,
            dynamic_stiffness(self.boot, frequency, lattice),
            self.design.block_mass * lattice.frequency_squared(frequency),
            *foot,
        )

    def _foot(self, frequency: RealArray, lattice: Lattice) -> tuple[ComplexArray, ComplexArray] | tuple[()]:
        """Return dynamic stiffness of the foot, and the part of it that reaches the ground proper [N/m]."""
        ground = self.design.ground
        if ground is None:
            return ()
        derivative = lattice.foot_derivative(frequency)
        into_ground = ground.stiffness + derivative * ground.damping
        return into_ground + ground.mass * derivative**2, into_ground

    def above(self, frequency: RealArray, lattice: Lattice = INFINITE) -> AnyArray:
        """Return D, the force on a wheel per displacement of it (frequencies,) [N/m].

        See :mod:`trackig_core.track.vehicle`.
        """
        squared = lattice.frequency_squared(frequency)
        return dynamic_stiffness_above(self.design, squared, lattice.derivative(frequency))


Track: TypeAlias = TrackDesign | TrackModel
"""A track as functions take it: a design, or the model made of it."""


def track_model(track: Track, damping: str = "viscoelastic") -> TrackModel:
    """Return the model of a track.

    Parameters
    ----------
    track : TrackDesign or TrackModel
        A design, or a model, which is returned as it is.
    damping : str
        Of a design: ``"viscoelastic"``, springs that stiffen with frequency as their loss demands, or
        ``"hysteretic"``, springs k (1 + i eta), which are not causal.

    Returns
    -------
    TrackModel
        Design and laws.

    Raises
    ------
    DesignError
        If it is neither, or a measured stiffness is to be hysteretic.
    ValueError
        If there is no such damping.
    """
    if isinstance(track, TrackModel):
        return track
    if not isinstance(track, TrackDesign):
        raise DesignError("design", track, "a TrackDesign, such as PRESETS['slab-track']")
    if damping not in DAMPINGS:
        raise ValueError(f"damping = {damping!r}: give {' or '.join(map(repr, DAMPINGS))}")
    return TrackModel(track, *DAMPINGS[damping](track))


def once_per_model(function: Callable[[TrackModel], _Computed]) -> Callable[[Track], _Computed]:
    """Have a function of a track computed once for each model, which remembers the result.

    Parameters
    ----------
    function : callable
        ``function(model)``; it returns a value that nobody changes.

    Returns
    -------
    callable
        The same function, which takes a design too.
    """

    @wraps(function)
    def remembered(design: Track) -> _Computed:
        model = track_model(design)
        if function not in model._computed:
            model._computed[function] = function(model)
        return cast(_Computed, model._computed[function])

    return remembered
