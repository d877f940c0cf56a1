"""The unit of CAD shapes, and files whose unit is in doubt."""

from turgor.foundation.finding import Finding, Severity
from turgor.units import UNITS, mm

#: Shapes are built in millimeters: the tolerances of the CAD kernel (1e-7 of its unit) suit parts of 1 to 1000 units.
METERS_PER_CAD_UNIT = 1e-3

#: Smallest and largest longest side of an actuator [m]; outside this range its unit is wrong.
SMALLEST_EXTENT, LARGEST_EXTENT = 1e-3, 2.0

#: Parts up to this length are more likely drawn in centimeters or inches [m].
RARELY_SO_SMALL = 5e-3


def unit_in_doubt(file: str, longest: float) -> tuple[Finding, ...]:
    """Say that a file that states no unit holds a tiny part if its numbers are millimeters (P09).

    Parameters
    ----------
    file : str
        Its name.
    longest : float [m]
        Longest side of the part in millimeters, as it was read.

    Examples
    --------
    >>> (finding,) = unit_in_doubt("finger.vtk", 3e-3)
    >>> finding.message
    "'finger.vtk' states no unit; read in mm, the part is only 3 mm long."
    >>> unit_in_doubt("finger.vtk", 30e-3)
    ()
    """
    if longest > RARELY_SO_SMALL:
        return ()
    number = longest / mm
    cm, inches = (number * UNITS["length"][unit] / mm for unit in ("cm", "in"))
    return (
        Finding(
            code="P09",
            severity=Severity.WARNING,
            message=f"'{file}' states no unit; read in mm, the part is only {number:.3g} mm long.",
            advice=f"State its unit; in cm the part is {cm:.3g} mm long, in inches {inches:.3g} mm.",
        ),
    )
