"""Make the table of relaxation terms over the loss factor.

``python -m trackig_core.track.make_damping_table`` writes ``data/damping_table.csv``: at each node the
strengths, divided by the loss factor, for a stiffness of 1 N/m at 50 Hz [N/m], the times [s] and the largest
relative error [-] of the least-squares fit of :mod:`trackig_core.track.viscoelastic_law`.
"""

from pathlib import Path

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.track.damping_table import NODES
from trackig_core.track.viscoelastic_law import fit_loss_factor

COLUMNS = "loss_factor,strength_1,strength_2,strength_3,time_1_s,time_2_s,time_3_s,worst_error"
"""Head of the table; strengths are divided by the loss factor."""


def fitted_table() -> RealArray:
    """Return the rows of the table (nodes, 8), a least-squares fit each."""
    rows = []
    for loss_factor in NODES:
        law = fit_loss_factor(float(loss_factor))
        rows.append([loss_factor, *np.array(law.strengths) / loss_factor, *law.times, law.worst_error])
    return np.array(rows)


if __name__ == "__main__":
    path = Path(__file__).parent / "data" / "damping_table.csv"
    np.savetxt(path, fitted_table(), fmt="%.12g", delimiter=",", header=COLUMNS, comments="")
