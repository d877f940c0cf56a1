"""Energies and the time of a moving actuator as columns of a response."""

import numpy as np

from turgor.core.solvers.solution import Solution
from turgor.foundation.response import Column

#: Columns of the energies, and the fields that they show.
ENERGIES = {
    "kinetic_energy": "kinetic", "strain_energy": "strain", "dissipated_energy": "dissipated", "external_work": "work",
    "missing_energy": "missing",
}  # fmt: skip


def time_column(solution: Solution) -> tuple[Column, ...]:
    """Return the column ``time``, where the procedure has times.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    tuple of Column
    """
    times = [state.time for state in solution.states if state.time is not None]
    return (Column("time", "s", np.array(times)),) if len(times) == len(solution.states) else ()


def energy_columns(solution: Solution) -> tuple[Column, ...]:
    """Return the energies of the whole actuator, where the procedure counted them.

    Parameters
    ----------
    solution : Solution

    Returns
    -------
    tuple of Column
        ``kinetic_energy``, ``strain_energy``, ``dissipated_energy``, ``external_work`` and ``missing_energy``, which
        closes the balance.
    """
    energies = [state.energies for state in solution.states if state.energies is not None]
    if len(energies) < len(solution.states):
        return ()
    whole = solution.model.mesh.symmetry_factor
    values = {name: [getattr(each, field) for each in energies] for name, field in ENERGIES.items()}
    return tuple(Column(name, "mJ", whole * np.array(numbers)) for name, numbers in values.items())
