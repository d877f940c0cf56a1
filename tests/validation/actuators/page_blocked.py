"""Blocked force of the bending actuators on docs/measured-actuators.md."""

from typing import Any

import numpy as np
from bender import STATED, actuator
from bender_data import blocked_distance, forces, measured_blocked, measured_rest_force
from bender_rig import FITTED_AT, STIFF, blocked_at
from ecoflex import DENSITY
from measured_runs import FITTED, HELD, MEETS, PRESSED, PRESSED_BY, PRESSED_TO, held, held_varied, plate, spring
from page_parts import COLORS, Page, lines_of, new_figure, number, save

import turgor as tg
from turgor.studies.runs.run import Run
from turgor.units import deg, mm

#: Pressures [kPa] in the tables.
AT = (20.0, 30.0, 35.0)
#: Acceleration that `tg.Gravity` has unless stated [m/s²].
GRAVITY = 9.80665
#: How the tip is stopped where nothing is fitted.
LEVEL, GAP = "level with the film", "5 mm below"


def part(page: Page) -> dict[str, Any]:
    """Tables, figure and numbers of the blocked force, by the names that the text asks for."""
    return {
        "blocked_figure": _figure(page),
        "blocked": _table(page),
        "blocked_springs": _springs(page),
        "blocked_decides": _decides(page),
        "pressed_to": PRESSED_TO,
        **_spring_facts(page),
        **_plate_facts(page),
        **_rest_facts(),
    }


def springs(page: Page) -> dict[str, float]:
    """The spring fitted to the actuator with walls of 10 mm with each law [N m/rad], to the digits that are told."""
    return {law: round(_fitted(page, FITTED, law), 2) for law in PRESSED_BY}


def _fitted(page: Page, name: str, law: str) -> float:
    return float(page.of(spring(name, law)).column("spring")[0])


def _curves(page: Page, name: str) -> dict[str, Run]:
    """How the tip of an actuator is stopped, in words, and the run."""
    chambers, wall = PRESSED[name]
    result = {} if wall != STATED["wall_mm"] else {"blind, Yeoh, on a plate": plate(chambers, LEVEL)}
    result["blind, Yeoh, on a hinge"] = held(name, "Yeoh", 0.0)
    result["blind, Yeoh, cannot turn"] = held(name, "Yeoh", STIFF)
    for law, stiffness in springs(page).items():
        result[f"on a spring, {law}"] = held(name, law, stiffness)
    return result


def _figure(page: Page) -> str:
    figure, axes = new_figure(3)
    for where, name in zip(axes, PRESSED, strict=True):
        data = measured_blocked(*PRESSED[name])
        shown = data["pressure"] <= PRESSED_TO
        values = (data[key][shown] for key in ("pressure", "force", "sd"))
        where.errorbar(*values, fmt="o", ms=3, color="black", label="measured")
        for said, run in _curves(page, name).items():
            color = COLORS[1] if MEETS in said else COLORS[0]
            style = "-" if "spring" in said else {"plate": ":", "hinge": "--"}.get(said.split()[-1], "-.")
            where.plot(*forces(page.of(run)), style, color=color, label=said)
        top = 3 * data["force"][shown].max()
        where.set(title=name, xlabel="pressure [kPa]", ylabel="blocked force [N]", ylim=(0, top), xlim=(0, PRESSED_TO))
        where.legend(frameon=False, fontsize=6)
    return save(figure, "benders-blocked.svg")


def _table(page: Page) -> str:
    rows = []
    for name, which in PRESSED.items():
        rows.append([f"{name}, **measured**", *(number(blocked_at(*which, each), 3) for each in AT), ""])
        for said, run in _curves(page, name).items():
            curve = forces(page.of(run))
            off, upto = blocked_distance(curve, *which, PRESSED_TO)
            distance = page.record(f"blocked force, {name}", said, off)
            short = "" if upto == PRESSED_TO else f" up to {upto:.0f} kPa"
            rows.append([said, *_values(curve), f"{distance}{short}"])
    return lines_of(["", *(f"{each:.0f} kPa [N]" for each in AT), f"distance, 10 to {PRESSED_TO:.0f} kPa"], rows)


def _springs(page: Page) -> str:
    """The spring that each actuator would need."""
    rows = [[name, *(number(_fitted(page, name, law), 2) for law in PRESSED_BY)] for name in PRESSED]
    return lines_of(["", *(f"{law} [N m/rad]" for law in PRESSED_BY)], rows)


def _values(curve: tuple[np.ndarray, np.ndarray]) -> list[str]:
    return [number(float(np.interp(each, *curve, right=np.nan)), 3) for each in AT]


def _decides(page: Page) -> str:
    """Seven chambers on the fitted spring, varied."""
    stiffness = springs(page)[MEETS]
    rows = [[name, *_values(forces(page.of(held_varied(name, stiffness))))] for name in HELD]
    rows.append(["**measured**", *(number(blocked_at(*PRESSED["7 chambers"], each), 3) for each in AT)])
    return lines_of(["", *(f"{each:.0f} kPa [N]" for each in AT)], rows)


def _at(response: tg.Response, column: str = "blocked_force", pressure: float = FITTED_AT) -> float:
    """A column at a pressure [SI]."""
    return float(np.interp(pressure, response.column("pressure") / 1e3, response.column(column)))


def _spring_facts(page: Page) -> dict[str, float]:
    """Numbers of the springs."""
    five, seven, ten = (page.of(held(name, MEETS, springs(page)[MEETS])) for name in PRESSED)
    changes = {name: _at(page.of(held_varied(name, springs(page)[MEETS]))) / _at(seven) - 1 for name in HELD}
    return {
        "spring": springs(page)[MEETS],
        "spring_blind": springs(page)["Yeoh"],
        "spring_five": _fitted(page, "5 chambers", MEETS),
        "turn7": _at(seven, "tab_rotation_y") / deg,
        **{f"seven{each:.0f}": _at(seven, pressure=each) for each in AT},
        **{f"seven{each:.0f}_aim": blocked_at(7, 7.0, each) for each in AT},
        "five_got": _at(five),
        "five_aim": blocked_at(5, 7.0, FITTED_AT),
        "five35": _at(five, pressure=35.0),
        "five35_aim": blocked_at(5, 7.0, 35.0),
        "ten35": _at(ten, pressure=35.0),
        "ten35_aim": blocked_at(5, 10.0, 35.0),
        "hinge7": _at(page.of(held("7 chambers", "Yeoh", 0.0))),
        "stiff7": _at(page.of(held("7 chambers", "Yeoh", STIFF))),
        "doubled": 100 * changes["spring × 2"],
        "law_off": 100 * changes["law: Yeoh, both tests"],
        "mesh_off": 100 * changes["mesh: cells of 2.5 mm"],
        "film_off": 100 * changes["film: stiffness / 100"],
        "plate_film_off": 100 * changes["film: a plate of 0.1 mm"],
        "clamp_off": 100 * changes["clamp: end face only"],
    }


def _plate_facts(page: Page) -> dict[str, float]:
    """Numbers of the tip before a plate."""
    results = {}
    for chambers in (5, 7):
        level = page.of(plate(chambers, LEVEL))
        results[f"plate{chambers}"] = _at(level)
        results[f"nose{chambers}"] = _at(level, "tip_gap") / mm
        results[f"bears{chambers}"] = _at(level, "bearing_distance") / mm
        results[f"gap{chambers}"] = _at(page.of(plate(chambers, GAP)))
    return results


def _rest_facts() -> dict[str, float]:
    """The force at rest, and 3/8 of the weight, as a beam whose tip alone is supported [N]."""
    results = {}
    for name, (chambers, wall) in PRESSED.items():
        which = {"5 chambers": "5", "7 chambers": "7"}.get(name, "10")
        results[f"rest{which}"] = measured_rest_force(chambers, wall)
        built = actuator(chambers, {**STATED, "wall_mm": wall})
        volume = built.length * built.width * built.height - 2 * built.cavity_volumes["cavity"]
        results[f"weight{which}"] = 3 / 8 * DENSITY * GRAVITY * volume
    return results
