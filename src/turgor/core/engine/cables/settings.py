"""Settings of cables: every number that was chosen, with its reason. All are without unit.

Cases that need them are in `tests/verification/fibers/test_tendon.py`.
"""

from dataclasses import dataclass


@dataclass(frozen=True, slots=True)
class CableSettings:
    """Settings of cables.

    Parameters
    ----------
    elastic_slip : float
        A cable that sticks slips elastically by this share of its length for each radian of its turn before it slides:
        a small share of what it slides as the body bends, and large enough for Newton's method.
    sliding : float
        Within this share of its limit friction counts as sliding, as after a step that has slid.
    straight : float
        Sine of the turn at a guide below which friction is flat there: the direction of a turn of zero is not defined.
    """

    elastic_slip: float = 1e-3
    sliding: float = 1e-9
    straight: float = 1e-9


CABLES = CableSettings()
