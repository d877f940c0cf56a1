"""Guidelines 7.3-2 and 7.3-3 share these runs: chambers of six shapes, of equal area or of equal distances."""

from scipy.optimize import brentq

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Runs, Setting
from turgor_guidelines.omnidirectional.chambers import REFERENCE, area_of, omni
from turgor_guidelines.values import Value, at

#: Shapes of chambers by their short names.
SHAPES = {
    "circular": "circular",
    "half, flat inward": "semicircular_flat_inward",
    "ring sector": "ring_sector",
    "half, flat outward": "semicircular_flat_outward",
    "triangular, flat outward": "triangular_flat_outward",
    "triangular, apex outward": "triangular_apex_outward",
}

#: Largest pressure [kPa].
PRESSURE = 60

#: Area of each chamber [mm²] in the comparison at equal area.
AREA = 30.0


def given_for(shape: str, area: float = AREA) -> dict[str, object]:
    """Dimensions [mm] of an actuator whose chambers of a shape have an area [mm²]."""

    def sized(size: float) -> dict[str, object]:
        return dict(REFERENCE) | {"chamber_shape": shape, "chamber_size": size}

    def excess(size: float) -> float:
        return area_of(sized(size)) / area - 1

    high = 14.0
    while True:
        try:
            excess(high)
            break
        except tg.TurgorError:  # larger than what fits
            high -= 0.25
    return sized(round(float(brentq(excess, 1.0, high, xtol=1e-4)), 3))


def runs_of(names: tuple[str, ...], setting: Setting) -> tuple[Run, ...]:
    """Runs of shapes of equal area."""
    size = 2.0 if setting == "quick" else 1.0
    return tuple(
        Run(name=name, function=omni, values={"given": given_for(SHAPES[name]), "size": size, "pressure": PRESSURE})
        for name in names
    )


def read(runs: Runs, name: str, pressure: float) -> dict[str, Value]:
    """A column of all shapes at a pressure [kPa]."""
    return {shape: at(each.response, name, "pressure", pressure * kPa) for shape, each in runs.items()}
