"""Blocked force of the bending actuators on docs/measured-actuators.md."""

import numpy as np
from bender_data import blocked_distance, forces, measured_blocked
from measured_runs import BLOCKED, blocked, calibrated_blocked
from page_parts import COLORS, Page, lines_of, new_figure, number, percent, save

#: Pressures [kPa] in the tables.
AT = (30.0, 35.0, 38.0, 42.0)


def part(page: Page) -> dict[str, str]:
    """Tables and figure of the blocked force, by the names that the text asks for."""
    return {"blocked_figure": _figure(page), "blocked": _table(page), "blocked_decides": _decides(page)}


def _figure(page: Page) -> str:
    figure, axes = new_figure(2)
    for where, chambers in zip(axes, (5, 7), strict=True):
        data = measured_blocked(chambers)
        where.errorbar(data["pressure"], data["force"], data["sd"], fmt="o", ms=3, color="black", label="measured")
        where.plot(*forces(page.of(blocked(chambers, "as stated"))), "--", color=COLORS[0], label="blind, Yeoh")
        where.plot(
            *forces(page.of(calibrated_blocked(chambers, page.factor))), "-", color=COLORS[0], label="calibrated"
        )
        where.set(title=f"{chambers} chambers", xlabel="pressure [kPa]", ylabel="blocked force [N]", ylim=(0, None))
        where.legend(frameon=False, fontsize=7)
    return save(figure, "benders-blocked.svg")


def _table(page: Page) -> str:
    rows = []
    for chambers in (5, 7):
        data = measured_blocked(chambers)
        values = [number(np.interp(each, data["pressure"], data["force"]), 3) for each in AT]
        rows.append([f"{chambers} chambers, **measured**", *values, ""])
        both = {"blind, Yeoh": blocked(chambers, "as stated")}
        both["calibrated on the free bending"] = calibrated_blocked(chambers, page.factor)
        for said, run in both.items():
            found = page.of(run)
            off, upto = blocked_distance(found, chambers)
            page.record(f"blocked force, {chambers} chambers", said, off)
            rows.append([said, *_values(found), f"{percent(off)} up to {upto:.1f} kPa"])
    return lines_of(["", *(f"{each:.0f} kPa [N]" for each in AT), "distance"], rows)


def _values(found) -> list[str]:
    pressure, force = forces(found)
    return [number(float(np.interp(each, pressure, force, right=np.nan)), 3) for each in AT]


def _decides(page: Page) -> str:
    """The force of each variation, 5 chambers."""
    rows = [[name, *_values(page.of(blocked(5, name)))] for name in BLOCKED]
    data = measured_blocked(5)
    rows.append(["**measured**", *(number(np.interp(each, data["pressure"], data["force"]), 3) for each in AT)])
    return lines_of(["", *(f"{each:.0f} kPa [N]" for each in AT)], rows)
