"""Make the tables of relaxation terms over the loss factor.

``python -m trackig_core.track.make_damping_table`` writes the files of
:data:`trackig_core.track.damping_table.TABLES`: at each node the
strengths, divided by the loss factor, for a stiffness of 1 N/m at 50 Hz [N/m], the times [s] and the largest
relative error [-] of the least-squares fit of :mod:`trackig_core.track.viscoelastic_law`.
"""

from pathlib import Path

import numpy as np

from trackig_core.arrays import RealArray
from trackig_core.track.damping_table import TABLES, nodes
from trackig_core.track.viscoelastic_law import fit_loss_factor

COLUMNS = "loss_factor,strength_1,strength_2,strength_3,time_1_s,time_2_s,time_3_s,worst_error"
"""Head of the table; strengths are divided by the loss factor."""


def fitted_table(low: float, high: float) -> RealArray:
    """Return the rows of the table between two loss factors (nodes, 8), a least-squares fit each."""
    rows = []
    for loss_factor in nodes(low, high):
        law = fit_loss_factor(float(loss_factor))
        rows.append([loss_factor, *np.array(law.strengths) / loss_factor, *law.times, law.worst_error])
    return np.array(rows)


if __name__ == "__main__":
    for file, low, high in TABLES:
        path = Path(__file__).parent / "data" / file
        np.savetxt(path, fitted_table(low, high), fmt="%.12g", delimiter=",", header=COLUMNS, comments="")
