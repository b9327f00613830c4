"""Types of the arrays that pass between functions; their shapes stand in each docstring."""

from typing import Any

import numpy as np
from numpy.typing import NDArray

RealArray = NDArray[np.float64]
"""Array of real numbers."""

ComplexArray = NDArray[np.complex128]
"""Array of complex numbers."""

BoolArray = NDArray[np.bool_]
"""Array of truth values."""

IntArray = NDArray[np.int64]
"""Array of whole numbers."""

AnyArray = NDArray[Any]
"""Array of real or complex numbers."""
