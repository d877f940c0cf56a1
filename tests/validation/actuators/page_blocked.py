"""Blocked force of the bending actuators on docs/measured-actuators.md."""

from typing import Any

import numpy as np
from bender_data import blocked_distance, forces, measured_blocked
from bender_facts import blocked_facts
from measured_runs import BLOCKED, blocked
from page_parts import COLORS, Page, lines_of, new_figure, number, percent, save

#: Pressures [kPa] in the tables.
AT = (20.0, 30.0, 35.0, 38.0)


def part(page: Page) -> dict[str, Any]:
    """Tables and figure of the blocked force, by the names that the text asks for."""
    return {
        "blocked_figure": _figure(page),
        "blocked": _table(page),
        "blocked_decides": _decides(page),
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


def _decides(page: Page) -> str:
    """The force of each variation, 5 chambers."""
    rows = [[name, *_values(forces(page.of(blocked(5, name))))] for name in BLOCKED]
    data = measured_blocked(5)
    rows.append(["**measured**", *(number(np.interp(each, data["pressure"], data["force"]), 3) for each in AT)])
    return lines_of(["", *(f"{each:.0f} kPa [N]" for each in AT)], rows)
