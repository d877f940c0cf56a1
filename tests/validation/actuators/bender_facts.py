"""Numbers in the text on the bending actuators."""

import numpy as np
from bender import STATED, actuator
from bender_data import (
    TURN,
    angle_at,
    forces,
    from_zero,
    measured_blocked,
    measured_free,
    measured_rest_force,
    pressure_at,
    repeated_free,
    rest_force,
    slip,
)
from ecoflex import DENSITY, dumbbell
from fit_data import ecoflex_planar
from measured_runs import ALONE, HEAVY, VARIATIONS, blocked, free
from page_parts import Page

from turgor.units import kPa

#: Acceleration that `tg.Gravity` has unless stated [m/s²].
GRAVITY = 9.80665
Curve = tuple[np.ndarray, np.ndarray]
#: Where the tests of the rubber are compared, within the planar ones [-].
COMPARED = 1.5
#: Variations of the blocked force that the text states in percent.
BLOCKED_NAMES = {
    "mesh": "mesh: cells of 2.5 mm",
    "film": "film: stiffness / 100",
    "law": ALONE,
    "friction": "contact: friction of 0.3 on the plate",
    "clamp": "clamp: end face only",
}
#: Laws that are fitted to the same points as the Yeoh law of the first row.
SAME_TESTS = ("neo-Hooke", "Gent", "Ogden, two terms")


def moduli() -> dict[str, float]:
    """Shear modulus that each test asks for at one stretch, as neo-Hookean rubber [kPa]."""
    planar = np.mean([np.interp(COMPARED, test.stretch, test.nominal_stress) for test in ecoflex_planar()])
    found = {"mu_planar": planar / (COMPARED - COMPARED**-3)}
    for zero in ("authors", "grips"):
        test = dumbbell(zero)
        found[f"mu_{zero}"] = np.interp(COMPARED, test.stretch, test.nominal_stress) / (COMPARED - COMPARED**-2)
    return {name: float(value / kPa) for name, value in found.items()}


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


def blocked_facts(page: Page) -> dict[str, float | str]:
    """Numbers of the blocked force."""

    def at(name: str, pressure: float = 30.0) -> float:
        return float(np.interp(pressure, *forces(page.of(blocked(5, name)))))

    turns = []
    for chambers in (5, 7):
        data = measured_blocked(chambers)
        low = data["pressure"] <= 42.0
        pressure, force = data["pressure"][low], data["force"][low]
        steepest = int(np.argmax(np.diff(force) / np.diff(pressure)))
        turns.append(f"{pressure[steepest]:.0f} to {pressure[steepest + 1]:.0f}")
    aim = measured_blocked(5)
    return {
        "blocked_got": at("as stated"),
        "blocked_aim": float(np.interp(30.0, aim["pressure"], aim["force"])),
        "blocked_gap": at("contact: plate 5 mm below"),
        "blocked_gap_alone": at("contact: plate 5 mm below, law: dumb-bell alone"),
        "blocked_slip": slip(page.of(blocked(5, ALONE))),
        "blocked_gap_38": at("contact: plate 5 mm below", 38.0),
        "blocked_aim_38": float(np.interp(38.0, aim["pressure"], aim["force"])),
        **{f"blocked_{name}_off": 100 * (at(varied) / at("as stated") - 1) for name, varied in BLOCKED_NAMES.items()},
        "blocked_turn": " and ".join(turns),
        **rest_facts(page),
    }


def rest_facts(page: Page) -> dict[str, float]:
    """Numbers of the force at rest, under the weight alone."""
    found = {}
    for chambers in (5, 7):
        found[f"rest{chambers}"] = measured_rest_force(chambers)
        found[f"rest{chambers}_got"] = rest_force(page.of(blocked(chambers, HEAVY)))
        found[f"tip_rest{chambers}"] = _rest_on_tip(chambers)
    for gap in (2, 5):
        response = page.of(blocked(5, f"{HEAVY}, {gap} mm below"))
        found[f"rest_gap{gap}"] = rest_force(response)
        found[f"heavy_gap{gap}"] = float(np.interp(30.0, *forces(response)))
    seven, aim = page.of(blocked(7, f"{HEAVY}, 10 mm below")), measured_blocked(7)
    found |= {"seven_rest_gap": rest_force(seven), "seven_heavy_gap": float(np.interp(30.0, *forces(seven)))}
    return found | {"blocked_aim7": float(np.interp(30.0, aim["pressure"], aim["force"]))}


def _rest_on_tip(chambers: int) -> float:
    """Force at rest of an actuator that touches the plate at its tip alone [N]: 3/8 of its weight, as a beam."""
    part = actuator(chambers, STATED)
    volume = part.length * part.width * part.height - 2 * part.cavity_volumes["cavity"]
    return 3 / 8 * DENSITY * GRAVITY * volume
