"""Central differences of the residual."""

import numpy as np


def difference(system, unknowns, h=1e-5):
    """Tangent by central differences of the residual; one column for each unknown."""
    columns = []
    for j in range(len(unknowns)):
        step = np.zeros_like(unknowns)
        step[j] = h
        columns.append((system.residual(unknowns + step, 1.0) - system.residual(unknowns - step, 1.0)) / (2 * h))
    return np.array(columns).T
