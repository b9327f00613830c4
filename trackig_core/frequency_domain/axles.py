"""Several wheels on one rail: the forces under them, and the energy that all supports pass on.

With alpha_ij the rail displacement at wheel i per force at wheel j, the contact forces f under roughness r
are

    (alpha + (1/k_H + 1/D) I) f = r,    r_i = exp(-i w x_i / v)

for wheels that follow each other over the same roughness at a speed v. Where their roughness is independent,
each is excited alone and the energies add. D stands in :mod:`trackig_core.track.vehicle`.

Wheels may stand on any rail element. With phi(e) either of the two waves that decay along the rail (see
:mod:`trackig_core.frequency_domain.floquet_waves`), 1 over support 0, and a its share of the point
receptance over a support, reciprocity gives the displacement at element e per force at element l as

    G(e, l) = sum over both waves of a phi(-l) phi(e),    e >= l,

and G(e, l) = G(l, e). Beyond the outermost wheels all their waves decay alike, so that energy is a geometric
sum; only supports between wheels are summed one by one. On the ring both waves also arrive the other way
round. Time dependence exp(+i w t); SI units and Hz.
"""

from __future__ import annotations

from dataclasses import dataclass
from typing import TYPE_CHECKING

import numpy as np

from trackig_core.arrays import BoolArray, ComplexArray, IntArray, RealArray
from trackig_core.frequency_domain.timoshenko import FreeBeam
from trackig_core.track.design import ELEMENTS_PER_BAY, TrackDesign, axle_elements

if TYPE_CHECKING:
    from trackig_core.frequency_domain.floquet_waves import Waves
    from trackig_core.frequency_domain.lattice import Lattice
    from trackig_core.frequency_domain.track_model import TrackModel

_FOURTH_DIFFERENCE = ((-2, 1.0), (-1, -4.0), (0, 6.0), (1, -4.0), (2, 1.0))
"""Offset and weight of the neighbours by which a rail element is bent [-]."""

_ALIKE = 1e-9
"""Difference of two factors from bay to bay below which they are taken as equal [-]."""


def bay_shapes(design: TrackDesign, rail: Waves, per_bay: int) -> ComplexArray:
    """Return both waves within one bay, 1 over the support that it begins with.

    Between supports each wave obeys the free rail,

        u[i-2] - 4 u[i-1] + 6 u[i] - 4 u[i+1] + u[i+2] = r^2 u[i],    r^2 = m w^2 / (EI/dx^3),

    with u[i + elements] = multiplier u[i] from bay to bay: as many linear equations as there are elements
    between two supports.

    Parameters
    ----------
    design : TrackDesign
        The track, for its rail and spacing.
    rail : Waves
        The waves.
    per_bay : int
        Rail elements per bay.

    Returns
    -------
    numpy.ndarray of complex (per_bay, 2, frequencies)
        Displacement of the elements [-].
    """
    if rail.rail == "timoshenko":
        beam = FreeBeam.of(design.rail, rail.frequency_squared)
        return beam.bay_shapes(design.fastener_spacing, rail.multipliers, per_bay)
    dx = design.fastener_spacing / per_bay
    inertia = design.rail.mass_per_metre * dx**4 / design.rail.bending_stiffness * rail.frequency_squared
    multipliers = rail.multipliers
    matrix = np.zeros((*multipliers.shape, per_bay - 1, per_bay - 1), dtype=complex)
    load = np.zeros((*multipliers.shape, per_bay - 1, 1), dtype=complex)
    for row in range(per_bay - 1):
        matrix[..., row, row] -= inertia
        for offset, weight in _FOURTH_DIFFERENCE:
            bay, within = divmod(row + 1 + offset, per_bay)
            share = weight * multipliers**bay
            if within == 0:
                load[..., row, 0] -= share
            else:
                matrix[..., row, within - 1] += share
    between = np.linalg.solve(matrix, load)[..., 0]
    return np.concatenate([np.ones((1, *multipliers.shape)), np.moveaxis(between, -1, 0)])


@dataclass(frozen=True, eq=False)
class LoadedRail:
    """The rail under wheels at some elements.

    Attributes
    ----------
    rail : Waves
        Its waves.
    shapes : numpy.ndarray of complex (per_bay, 2, frequencies) [-]
        Either wave within a bay.
    wheels : tuple of int
        Elements on which wheels stand, 0 over support 0.
    """

    rail: Waves
    shapes: ComplexArray
    wheels: tuple[int, ...]

    @property
    def per_bay(self) -> int:
        """Rail elements per bay."""
        return len(self.shapes)

    @property
    def ends(self) -> tuple[int, int]:
        """Last support not beyond the first wheel, and the first after it not before the last wheel."""
        before = min(self.wheels) // self.per_bay
        return before, max(-(-max(self.wheels) // self.per_bay), before + 1)

    def wave(self, element: int) -> ComplexArray:
        """Return both waves at an element (2, frequencies) [-]."""
        bay, within = divmod(element, self.per_bay)
        return self.shapes[within] * self.rail.multipliers**bay

    def receptance(self, element: int, load: int) -> ComplexArray:
        """Return the displacement of an element per force on another (frequencies,) [m/N]."""
        rail = self.rail
        low, high = min(element, load), max(element, load)
        bays = low // self.per_bay  # the bay of the one to the left becomes bay 0
        low, high = low - bays * self.per_bay, high - bays * self.per_bay
        shape = self.wave(-low) * self.wave(high)
        if rail.bays is not None:
            shape = (shape + self.wave(low) * self.wave(rail.bays * self.per_bay - high)) / (1 - rail.around)
        return np.sum(rail.amplitudes * shape, axis=0)

    def between_wheels(self, forces: ComplexArray) -> ComplexArray:
        """Return the rail displacements over supports between the outermost wheels.

        Parameters
        ----------
        forces : numpy.ndarray of complex (wheels, columns, frequencies)
            Forces under the wheels [N].

        Returns
        -------
        numpy.ndarray of complex (supports, columns, frequencies)
            Displacements [m].
        """
        before, beyond = self.ends
        rows = [
            sum(
                self.receptance(support * self.per_bay, wheel) * force
                for wheel, force in zip(self.wheels, forces, strict=True)
            )
            for support in range(before + 1, beyond)
        ]
        return np.array(rows) if rows else np.zeros((0, *forces.shape[1:]), dtype=complex)

    def outwards(self, forces: ComplexArray) -> tuple[ComplexArray, ComplexArray]:
        """Return the waves that run out to either side (2, columns, frequencies) [m].

        The first are those that run on, at the first support beyond the wheels; the second those that run
        back, at the last support before them.
        """
        before, beyond = (support * self.per_bay for support in self.ends)
        share = (self.rail.amplitudes / (1 - self.rail.around))[:, None]
        on, back = np.zeros((2, 2, *forces.shape[1:]), dtype=complex)
        for wheel, force in zip(self.wheels, forces, strict=True):
            on += share * self.wave(beyond - wheel)[:, None] * force
            back += share * self.wave(wheel - before)[:, None] * force
        return on, back

    def energy_sum(self, forces: ComplexArray) -> RealArray:
        """Return the squared rail displacement summed over all supports and columns (frequencies,) [m2]."""
        on, back = self.outwards(forces)
        energy = np.sum(np.abs(self.between_wheels(forces)) ** 2, axis=(0, 1))
        for this in range(2):
            for that in range(2):
                alike, opposite = self._wave_sums(this, that)
                pairs = on[this] * on[that].conj() + back[this] * back[that].conj()
                energy = energy + np.sum(pairs * alike, axis=0).real
                if self.rail.bays is not None:
                    crossed = np.sum(on[this] * back[that].conj(), axis=0)
                    energy = energy + 2 * (crossed * opposite).real
        return energy

    def coherent_sum(self, forces: ComplexArray) -> ComplexArray:
        """Return the rail displacement summed over all supports (columns, frequencies) [m]."""
        multipliers = self.rail.multipliers
        left = 0.0 if self.rail.bays is None else multipliers**self._outside
        series = ((1 - left) / (1 - multipliers))[:, None]
        on, back = self.outwards(forces)
        return np.sum((on + back) * series, axis=0) + np.sum(self.between_wheels(forces), axis=0)

    @property
    def _outside(self) -> int:
        """Number of the ring's supports that are not between wheels."""
        before, beyond = self.ends
        return (self.rail.bays or 0) - (beyond - before - 1)

    def _wave_sums(self, this: int, that: int) -> tuple[ComplexArray, ComplexArray]:
        """Return the sums over the supports outside of one wave times the conjugate of another.

        The first for waves that run the same way, the second for waves that run towards each other.
        """
        one, other = self.rail.multipliers[this], self.rail.multipliers[that].conj()
        if self.rail.bays is None:
            return 1 / (1 - one * other), np.zeros_like(one)
        count, apart = self._outside, one - other
        equal: BoolArray = np.abs(apart) < _ALIKE
        opposite = np.where(
            equal, count * one ** (count - 1), (one**count - other**count) / np.where(equal, 1.0, apart)
        )
        return (1 - (one * other) ** count) / (1 - one * other), opposite


def wheel_elements(design: TrackDesign, per_bay: int) -> tuple[int, ...]:
    """Return the rail elements on which wheels stand.

    Positions are rounded to elements of three a bay on every lattice, so that a finer one moves no wheel.

    Parameters
    ----------
    design : TrackDesign
        The track.
    per_bay : int
        Rail elements per bay of the lattice.

    Returns
    -------
    tuple of int
        Elements, 0 over support 0.
    """
    thirds = axle_elements(design.axle_positions, design.fastener_spacing)
    return tuple(round(each * per_bay / ELEMENTS_PER_BAY) for each in thirds)


def wheel_delays(design: TrackDesign) -> RealArray | None:
    """Return how much later than the first each wheel meets the same roughness (wheels,) [s], or None."""
    if design.speed is None:
        return None
    thirds: IntArray = np.array(axle_elements(design.axle_positions, design.fastener_spacing))
    from_first = (thirds - thirds.min()) * design.fastener_spacing / ELEMENTS_PER_BAY
    delays: RealArray = from_first / design.speed
    return delays


def loaded_rail(model: TrackModel, rail: Waves, lattice: Lattice) -> LoadedRail:
    """Return the rail of a track under its wheels.

    Parameters
    ----------
    model : TrackModel
        The track.
    rail : Waves
        Its waves on the lattice.
    lattice : Lattice
        What to solve.

    Returns
    -------
    LoadedRail
        Waves, their shapes within a bay, and the wheels' elements.

    Raises
    ------
    ValueError
        If the ring is too short for the wheels.
    """
    per_bay = lattice.elements_per_bay
    found = LoadedRail(rail, bay_shapes(model.design, rail, per_bay), wheel_elements(model.design, per_bay))
    before, beyond = found.ends
    if lattice.bays is not None and lattice.bays <= beyond - before:
        raise ValueError(
            f"bays = {lattice.bays}: give {beyond - before + 1} or more, for the axles stand that far apart"
        )
    return found


def contact_forces(model: TrackModel, loaded: LoadedRail, lattice: Lattice) -> ComplexArray:
    """Return the contact force under every wheel per unit roughness.

    Parameters
    ----------
    model : TrackModel
        The track and its wheels.
    loaded : LoadedRail
        Its rail.
    lattice : Lattice
        What to solve.

    Returns
    -------
    numpy.ndarray of complex (wheels, columns, frequencies)
        Contact force per unit roughness [N/m]: in one column where the wheels meet the same roughness, each
        with its delay; where theirs is independent, in a column for the roughness under each.
    """
    frequency, wheels = loaded.rail.frequency, loaded.wheels
    matrix = np.empty((frequency.size, len(wheels), len(wheels)), dtype=complex)
    for row, element in enumerate(wheels):
        for column, load in enumerate(wheels):
            matrix[:, row, column] = loaded.receptance(element, load)
        matrix[:, row, row] += 1 / model.design.contact_stiffness + 1 / model.above(frequency, lattice)
    delays = wheel_delays(model.design)
    if delays is None:
        roughness = np.broadcast_to(np.eye(len(wheels), dtype=complex), matrix.shape)
    else:
        roughness = np.stack([lattice.delay(frequency, each) for each in delays], axis=1)[..., None]
    return np.moveaxis(np.linalg.solve(matrix, roughness), 0, -1)
