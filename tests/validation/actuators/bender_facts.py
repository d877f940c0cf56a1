"""Numbers in the text on the bending actuators."""

import numpy as np
from bender_data import (
    TURN,
    angle_at,
    from_zero,
    measured_free,
    pressure_at,
    repeated_free,
)
from ecoflex import dumbbell
from fit_data import ecoflex_planar
from measured_runs import ALONE, VARIATIONS, free
from page_parts import Page

from turgor.units import kPa

Curve = tuple[np.ndarray, np.ndarray]
#: Where the tests of the rubber are compared, within the planar ones [-].
COMPARED = 1.5
#: Laws that are fitted to the same points as the Yeoh law of the first row.
SAME_TESTS = ("neo-Hooke", "Gent", "Ogden, two terms")


def moduli() -> dict[str, float]:
    """Shear modulus that each test asks for at one stretch, as neo-Hookean rubber [kPa]."""
    planar = np.mean([np.interp(COMPARED, test.stretch, test.nominal_stress) for test in ecoflex_planar()])
    results = {"mu_planar": planar / (COMPARED - COMPARED**-3)}
    for zero in ("authors", "grips"):
        test = dumbbell(zero)
        results[f"mu_{zero}"] = np.interp(COMPARED, test.stretch, test.nominal_stress) / (COMPARED - COMPARED**-2)
    return {name: float(value / kPa) for name, value in results.items()}


def _measured(chambers: int) -> Curve:
    data = measured_free(chambers)
    return data["pressure"], data["angle"]


def free_facts(page: Page, seven: Curve) -> dict[str, float]:
    """Numbers of the free bending; ``seven`` is the calibrated curve of 7 chambers."""
    stated, aim = from_zero(page.of(free(5, "as stated"))), _measured(5)
    again = repeated_free()
    steps = again["pressure"], again["angle"]
    return {
        "turn5": pressure_at(*aim, TURN[5]),
        "soft": 100 * (1 - angle_at(*stated, 30.0) / angle_at(*aim, 30.0)),
        "late": 100 * (pressure_at(*stated, TURN[5]) / pressure_at(*aim, TURN[5]) - 1),
        "steep_got": angle_at(*stated, 36.0),
        "steep": angle_at(*aim, 36.0),
        "seven_got": pressure_at(*seven, TURN[7]),
        "seven": pressure_at(*_measured(7), TURN[7]),
        "seven_again": pressure_at(*steps, TURN[7]),
        "repeat": abs(angle_at(*_measured(7), 40.0) - angle_at(*steps, 40.0)),
    }


def _change(page: Page, name: str, pressure: float = 30.0) -> float:
    """Change of the angle at a pressure by a variation [%]."""
    before = angle_at(*from_zero(page.of(free(5, "as stated"))), pressure)
    return 100 * (angle_at(*from_zero(page.of(free(5, name))), pressure) / before - 1)


def _later(page: Page, name: str) -> float:
    """Change of the pressure of 15° by a variation [%]."""
    before = pressure_at(*from_zero(page.of(free(5, "as stated"))), TURN[5])
    return 100 * (pressure_at(*from_zero(page.of(free(5, name))), TURN[5]) / before - 1)


def decides_facts(page: Page) -> dict[str, float]:
    """Numbers of the variations."""
    mesh = "mesh: cells of 2.5 mm"
    stated = page.of(free(5, "as stated"))
    lines = ("base_bottom tip_top", "base_top tip_top", "tangent")
    whole = angle_at(*from_zero(stated), 30.0)
    read = [abs(angle_at(*from_zero(stated, line=line), 30.0) / whole - 1) for line in lines]
    turns = {name: pressure_at(*from_zero(page.of(free(5, name))), TURN[5]) for name in VARIATIONS if "law" in name}
    same = [pressure_at(*from_zero(stated), TURN[5]), *(turns[f"law: {name}"] for name in SAME_TESTS)]
    return {
        "film_soft": max(abs(_change(page, f"film: stiffness / {each}")) for each in (10, 100)),
        "film_plate": _change(page, "film: bends as a plate of 0.5 mm"),
        "reading": 100 * max(read),
        "jump": float(measured_free(5)["angle"][1]),
        "alone30": angle_at(*from_zero(page.of(free(5, ALONE))), 30.0),
        "aim30": angle_at(*_measured(5), 30.0),
        **seven_facts(page),
        "hanging": _change(page, "weight: hanging, tip down"),
        "lying": _change(page, "weight: lying, film down"),
        **contact_facts(page),
        "clamp": _change(page, "clamp: 5 mm held all around"),
        "walls": _change(page, "walls: 6.7 mm"),
        "mesh": max(abs(_change(page, mesh, each)) for each in (20.0, 30.0, 34.0)),
        "mesh_turn": _later(page, mesh),
        "alone": turns[ALONE],
        "grips": turns["law: Yeoh, dumb-bell from 50 mm"],
        "same_low": min(same),
        "same_high": max(same),
        "beyond": turns["law: Yeoh, tests up to stretch 2"],
    }


def seven_facts(page: Page) -> dict[str, float]:
    """Numbers of the law of the dumb-bell alone, for 7 chambers."""
    alone, again = from_zero(page.of(free(7, ALONE))), repeated_free()
    return {
        "alone7_30": angle_at(*alone, 30.0),
        "blind7_30": angle_at(*from_zero(page.of(free(7, "as stated"))), 30.0),
        "alone7_turn": pressure_at(*alone, TURN[7]),
        "aim7_30": angle_at(*_measured(7), 30.0),
        "again7_30": angle_at(again["pressure"], again["angle"], 30.0),
    }


def contact_facts(page: Page) -> dict[str, float]:
    """Numbers of the table and of walls that may touch."""
    down = from_zero(page.of(free(5, "contact: lying on a table, film down")))
    return {
        "table_down": max(abs(angle_at(*down, each)) for each in (20.0, 30.0, 34.0)),
        "table_up": _change(page, "contact: lying on a table, film up"),
        "touching": max(abs(_change(page, "contact: walls may touch each other", each)) for each in (20.0, 30.0, 34.0)),
    }
