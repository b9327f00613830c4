"""How the half ring lies in memory, so that a processor's vectors step many bays at once.

The half ring is cut into :data:`trackig_core.time_domain.kernels.LANES` stretches of equal length that lie
side by side: element e of stretch l has place e LANES + l. Neighbours along the rail are one row of lanes
apart, and loops over places run over whole, aligned vectors:

    row    lane 0      lane 1      ...   lane 7
     0     element 0   element E   ...   element 7 E         S, W under lane 0
     1     element 1   element E+1 ...   element 7 E + 1
     :
    E-1    element E-1 element 2E-1 ...  element 8 E - 1

The last bays of the last stretches may lie beyond the middle of the ring; they move as the mirror images
that they are, and are left out of results. (Henretty et al., 2011, "Data layout transformation for
stencil computations on short-vector SIMD architectures".)
"""

import numpy as np

from trackig_core.arrays import IntArray, RealArray
from trackig_core.time_domain.grid import Grid
from trackig_core.time_domain.kernels import LANES, QUANTITIES

ALIGNMENT = 64
"""Bytes on which rows begin: a cache line, and a vector of eight doubles."""

COLUMNS = 8
"""The number of columns of a record is a multiple of this, so that rows are whole vectors."""

GHOSTS = 2
"""Rows of elements beyond either end of a stretch."""


class Layout:
    """Places of elements, supports and records of one grid.

    Parameters
    ----------
    grid : Grid
        The grid.

    Attributes
    ----------
    bays : int
        Bays in each stretch.
    elements : int
        Rail elements in each stretch.
    slots : int
        Bays stored: those of the half ring, and mirror images.
    """

    def __init__(self, grid: Grid) -> None:
        self._half_bays = grid.half_bays
        self._ring = grid.elements
        self.bays = -(-grid.half_bays // LANES)
        self.elements = self.bays * grid.elements_per_bay
        self.slots = self.bays * LANES
        stretch, row = np.divmod(np.arange(grid.half_bays), self.bays)
        self._order = row * LANES + stretch

    def rail_place(self, element: int) -> int:
        """Return where an element lies in the rail's displacements, ghosts included.

        Parameters
        ----------
        element : int
            Number of the element, counted from the wheel either way.
        """
        stretch, row = divmod(abs(element), self.elements)
        return (row + GHOSTS) * LANES + stretch

    def block_place(self, support: int) -> int:
        """Return where the block of a support lies among all that is kept of supports, as one row."""
        stretch, row = divmod(support, self.bays)
        return row * QUANTITIES * LANES + stretch

    def mirrors(self) -> IntArray:
        """Return the places that the ghosts beyond both ends mirror (4,)."""
        beyond = self._ring - LANES * self.elements
        return np.array([self.rail_place(element) for element in (2, 1, beyond, beyond - 1)])

    def columns(self, probes: int) -> int:
        """Return how many columns a record has for the forces and some more quantities."""
        return self.slots + -(-probes // COLUMNS) * COLUMNS

    def width(self, probes: int) -> int:
        """Return how many columns a record in order has."""
        return self._half_bays + probes

    def put_in_order(self, rows: RealArray, ordered: RealArray) -> None:
        """Copy rows of a record so that the supports come in order, then the other quantities.

        Parameters
        ----------
        rows : numpy.ndarray (rows, columns)
            As the kernel fills them.
        ordered : numpy.ndarray (rows, half_bays + probes)
            Filled.
        """
        ordered[:, : self._half_bays] = rows[:, self._order]
        ordered[:, self._half_bays :] = rows[:, self.slots : self.slots + ordered.shape[1] - self._half_bays]


def aligned_zeros(*shape: int) -> RealArray:
    """Return an array of zeros that begins on a cache line.

    Parameters
    ----------
    *shape : int
        Its shape.

    Returns
    -------
    numpy.ndarray
        Doubles, of that shape.
    """
    count = int(np.prod(shape))
    room = np.zeros(count + ALIGNMENT // 8)
    first = -room.ctypes.data % ALIGNMENT // 8
    return room[first : first + count].reshape(shape)
