"""The thick tube of V05: its radii, and its states under pressure."""

import problems
import turgor as tg

INNER, OUTER = 5 * problems.MM, 7 * problems.MM


def inflate(law, pressures, mesh):
    """States of the tube at the given pressures [Pa]."""
    model = problems.one_material(
        mesh, law, supports=problems.PLANE_STRAIN, loads=[tg.Pressure("cavity", pressures[-1])]
    )
    factors = tuple(p / pressures[-1] for p in pressures)
    solution = problems.solve(model, tg.Static(first_step=factors[0], at=factors, tolerance=1e-8))
    return [problems.state_at(solution, factor) for factor in factors]
