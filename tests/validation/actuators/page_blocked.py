"""Blocked force of the bending actuators on docs/measured-actuators.md."""

from typing import Any

import numpy as np
from bender_data import blocked_distance, forces, measured_blocked, measured_rest_force, rest_force, slip
from bender_facts import blocked_facts
from measured_runs import BLOCKED_OF, blocked
from page_parts import COLORS, Page, lines_of, new_figure, number, percent, save

import turgor as tg

#: Pressures [kPa] in the tables.
AT = (20.0, 30.0, 35.0, 38.0)


def part(page: Page) -> dict[str, Any]:
    """Tables and figure of the blocked force, by the names that the text asks for."""
    return {
        "blocked_figure": _figure(page),
        "blocked": _table(page),
        "blocked_decides": _decides(page, 5),
        "blocked_decides7": _decides(page, 7),
        **blocked_facts(page),
    }


def _figure(page: Page) -> str:
    figure, axes = new_figure(2)
    for where, chambers in zip(axes, (5, 7), strict=True):
        data = measured_blocked(chambers)
        where.errorbar(data["pressure"], data["force"], data["sd"], fmt="o", ms=3, color="black", label="measured")
        where.plot(*forces(page.of(blocked(chambers, "as stated"))), "--", color=COLORS[0], label="blind, Yeoh")
        where.plot(*_calibrated(page, chambers), "-", color=COLORS[0], label="calibrated")
        where.set(title=f"{chambers} chambers", xlabel="pressure [kPa]", ylabel="blocked force [N]", ylim=(0, None))
        where.legend(frameon=False, fontsize=7)
    return save(figure, "benders-blocked.svg")


def _table(page: Page) -> str:
    rows = []
    for chambers in (5, 7):
        data = measured_blocked(chambers)
        values = [number(np.interp(each, data["pressure"], data["force"]), 3) for each in AT]
        rows.append([f"{chambers} chambers, **measured**", *values, ""])
        both = {"blind, Yeoh": forces(page.of(blocked(chambers, "as stated")))}
        both["calibrated on the free bending"] = _calibrated(page, chambers)
        for said, curve in both.items():
            off, upto = blocked_distance(curve, chambers)
            page.record(f"blocked force, {chambers} chambers", said, off)
            rows.append([said, *_values(curve), f"{percent(off)} up to {upto:.1f} kPa"])
    return lines_of(["", *(f"{each:.0f} kPa [N]" for each in AT), "distance"], rows)


def _calibrated(page: Page, chambers: int) -> tuple[np.ndarray, np.ndarray]:
    """As stated with all stresses scaled: pressures and forces are proportional to them."""
    pressure, force = forces(page.of(blocked(chambers, "as stated")))
    return pressure * page.factor, force * page.factor


def _values(curve: tuple[np.ndarray, np.ndarray]) -> list[str]:
    return [number(float(np.interp(each, *curve, right=np.nan)), 3) for each in AT]


def _decides(page: Page, chambers: int) -> str:
    """The force of the weight alone and, less that, of each variation."""
    found = {name: page.of(blocked(chambers, name)) for name in BLOCKED_OF[chambers]}
    rows = [[name, _rest(name, each), *_marked(each)] for name, each in found.items()]
    data = measured_blocked(chambers)
    values = [number(np.interp(each, data["pressure"], data["force"]), 3) for each in AT]
    rows.append(["**measured**", number(measured_rest_force(chambers), 3), *values])
    return lines_of(["", "at rest [N]", *(f"{each:.0f} kPa [N]" for each in AT)], rows)


def _marked(response: tg.Response) -> list[str]:
    """The forces, with a mark on those of another equilibrium, to which the path has slipped."""
    values = zip(AT, _values(forces(response)), strict=True)
    return [f"{value} (after a slip)" if each >= slip(response) else value for each, value in values]


def _rest(name: str, response: tg.Response) -> str:
    """The force of the weight alone, where there is a weight."""
    return number(rest_force(response), 3) if name.startswith("weight") else "no weight"
