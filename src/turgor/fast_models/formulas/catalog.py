"""The formulas that there are."""

from turgor.fast_models.formulas.bellows import CASTIGLIANO_BELLOWS
from turgor.fast_models.formulas.bender_arcs import CONSTANT_CURVATURE
from turgor.fast_models.formulas.bending_beam import EULER_BERNOULLI
from turgor.fast_models.formulas.braided_muscle import IDEAL_MCKIBBEN, MCKIBBEN
from turgor.fast_models.formulas.fiber_reinforced import FIBER_REINFORCED
from turgor.fast_models.formulas.formula import Formula
from turgor.fast_models.formulas.lumped import LUMPED
from turgor.fast_models.formulas.thick_walled import THICK_SPHERE, THICK_TUBE
from turgor.fast_models.formulas.wound_tubes import WOUND_TUBE
from turgor.foundation.errors import unknown

FORMULAS = (
    CONSTANT_CURVATURE,
    EULER_BERNOULLI,
    FIBER_REINFORCED,
    THICK_TUBE,
    THICK_SPHERE,
    WOUND_TUBE,
    IDEAL_MCKIBBEN,
    MCKIBBEN,
    CASTIGLIANO_BELLOWS,
    LUMPED,
)


def about(name: str) -> Formula:
    """Return what is known of a formula: its assumptions, families and source.

    Parameters
    ----------
    name : str
        Name of its function.

    Raises
    ------
    TurgorError
        If there is none of this name.

    Examples
    --------
    >>> about("euler_bernoulli").assumptions[0]
    'Strains are small, and the rubber is linear with the modulus that it has at rest.'
    >>> about("euler")
    Traceback (most recent call last):
    turgor.TurgorError: unknown formula 'euler'. Known: castigliano_bellows, ...
    """
    known = {each.name: each for each in FORMULAS}
    if name not in known:
        raise unknown("formula", name, known)
    return known[name]


def formulas_for(actuator: object) -> tuple[Formula, ...]:
    """Return the formulas that take an actuator.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.contracting_tube import ContractingTube
    >>> [each.name for each in formulas_for(ContractingTube())]
    ['thick_tube', 'wound_tube', 'ideal_mckibben', 'mckibben']
    """
    return tuple(each for each in FORMULAS if type(actuator).__name__ in each.families)
