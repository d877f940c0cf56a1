"""Energies and the time of a moving actuator as columns of a response."""

import numpy as np

from turgor.response import Column
from turgor.solvers.solution import Solution


def time_column(solution: Solution) -> tuple[Column, ...]:
    """Return the column ``time``, where the procedure knows times.

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
    values = {
        "kinetic_energy": [each.kinetic for each in energies],
        "strain_energy": [each.strain for each in energies],
        "dissipated_energy": [each.dissipated for each in energies],
        "external_work": [each.work for each in energies],
        "missing_energy": [each.missing for each in energies],
    }
    return tuple(Column(name, "mJ", whole * np.array(numbers)) for name, numbers in values.items())
