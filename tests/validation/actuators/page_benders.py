"""The bending actuators on docs/measured-actuators.md: free bending, and what decides."""

from typing import Any

import numpy as np
from bender import LINE, STATED
from bender_data import TURN, angle_at, from_zero, measured_free, pressure_at, repeated_free, soft_distance
from bender_facts import decides_facts, free_facts, moduli
from ecoflex import fitted
from measured_runs import ALONE, BLIND_BENDERS, VARIATIONS, free, whole
from page_parts import COLORS, Page, lines_of, new_figure, number, save

from turgor.studies.runs.run import Run

#: Pressures [kPa] in the tables.
AT = (20.0, 30.0, 34.0)


def part(page: Page) -> dict[str, Any]:
    """Tables, figures and numbers of the free bending, by the names that the text asks for."""
    return {
        "laws": _laws(page),
        "free_figure": _figure(page),
        "picture": page.picture(whole(), "bender.png"),
        "free": _free(page),
        "decides": _decides(page),
        "angles": _angles(page),
        **moduli(),
        **free_facts(page, calibrated(page, free(7, "as stated"))),
        **decides_facts(page),
    }


def _longest(chambers: int, name: str) -> Run:
    return whole() if (chambers, name) == (5, "as stated") else free(chambers, name)


def calibrated(page: Page, run: Run) -> tuple[np.ndarray, np.ndarray]:
    """Pressure [kPa] and angle [deg] of a run with all stresses times the factor of the page.

    The film hardly stretches and no weight acts, so the pressures are proportional to the stresses.
    """
    pressure, angle = from_zero(page.of(run), zero=10.0 / page.factor)
    return pressure * page.factor, angle


def _laws(page: Page) -> str:
    """The laws, how well each fits both tests, and where each lets the chambers balloon."""
    rows = []
    for name, (group, how) in VARIATIONS.items():
        if group not in ("", "law") or "factor" in how:
            continue
        given = {**STATED, **how}
        fit = fitted(given["law"], given["upto"], given["zero"], given["tests"])
        rows.append([
            "Yeoh" if not group else name.removeprefix("law: "),
            f"{min(fit.stretch_range):.2g} to {max(fit.stretch_range):.2g}",
            f"{2 * fit.law.shear_modulus / 2e3:.1f} kPa",
            *_off(fit),
            number(_turn(page, 5, name)),
        ])  # fmt: skip
    head = ["law", "stretches", "shear modulus", "off the dumb-bell", "off the planar tests", "15° at [kPa]"]
    return lines_of(head, rows)


def _off(fit: Any) -> list[str]:
    """Relative errors of a fit, in the dumb-bell and in the planar tests (root mean square)."""
    uniaxial = [each.relative for each in fit.quality if each.mode == "uniaxial"]
    planar = [each.relative for each in fit.quality if each.mode == "planar"]
    return [f"{100 * np.sqrt(np.mean(np.square(each))):.0f} %" if each else "–" for each in (uniaxial, planar)]


def _turn(page: Page, chambers: int, name: str) -> float:
    return pressure_at(*from_zero(page.of(free(chambers, name))), TURN[chambers])


def _figure(page: Page) -> str:
    figure, axes = new_figure(2, 4.0)
    for where, chambers in zip(axes, (5, 7), strict=True):
        data = measured_free(chambers)
        where.fill_between(data["pressure"], data["angle"] - data["sd"], data["angle"] + data["sd"], color="0.75", lw=0)
        where.plot(data["pressure"][::2], data["angle"][::2], "o", ms=2.5, color="black", label="measured, ramp")
        if chambers == 7:
            again = repeated_free()
            where.plot(again["pressure"], again["angle"], "s", ms=4, mfc="none", color="black", label="measured, steps")
        for name in BLIND_BENDERS[chambers]:
            color = COLORS[BLIND_BENDERS[5].index(name)]
            pressure, angle = from_zero(page.of(_longest(chambers, name)))
            where.plot(pressure, angle, "--", color=color, lw=1.2, label=_said(name))
        pressure, angle = calibrated(page, _longest(chambers, "as stated"))
        where.plot(pressure, angle, "-", color=COLORS[0], lw=1.6, label="calibrated")
        where.set(
            title=f"{chambers} chambers", xlabel="pressure [kPa]", ylabel="angle [deg]", xlim=(10, 46), ylim=(0, None)
        )
        where.legend(frameon=False, fontsize=7)
    return save(figure, "benders-free.svg")


def _free(page: Page) -> str:
    """Measured, blind and calibrated angles of both actuators."""
    rows = []
    for chambers in (5, 7):
        data = measured_free(chambers)
        rows.append(_row(f"{chambers} chambers, **measured**", data["pressure"], data["angle"], chambers, ""))
        if chambers == 7:
            again = repeated_free()
            rows.append(_row("measured again, in steps", again["pressure"], again["angle"], chambers, ""))
        runs = [(_said(name), free(chambers, name)) for name in BLIND_BENDERS[chambers]]
        for said, run in runs:
            curve = from_zero(page.of(run))
            off = page.record(f"free bending, {chambers} chambers", said, soft_distance(curve, chambers))
            rows.append(_row(said, *curve, chambers, off))
        said = "calibrated here" if chambers == 5 else "calibrated on 5 chambers"
        curve = calibrated(page, _longest(chambers, "as stated"))
        off = page.record(f"free bending, {chambers} chambers", said, soft_distance(curve, chambers))
        rows.append(_row(said, *curve, chambers, off))
    head = [
        "",
        *(f"{each:.0f} kPa [°]" for each in AT),
        "36 kPa [°]",
        "15° (5) or 20° (7) at [kPa]",
        "distance, 10 to 34 kPa",
    ]
    return lines_of(head, rows)


def _said(name: str) -> str:
    """How the curve of a law is called: the dumb-bell alone was tried after the measured curve had been seen."""
    law = "Yeoh" if name == "as stated" else name.removeprefix("law: ")
    return f"{'afterwards' if name == ALONE else 'blind'}, {law}"


def _row(said: str, pressure: np.ndarray, angle: np.ndarray, chambers: int, off: str) -> list[str]:
    values = [number(angle_at(pressure, angle, each)) for each in (*AT, 36.0)]
    return [said, *values, number(pressure_at(pressure, angle, TURN[chambers])), off]


def _decides(page: Page) -> str:
    """What each variation does to the angles before ballooning, and to the pressure of 15°; 5 chambers."""
    data = measured_free(5)
    aims = [angle_at(data["pressure"], data["angle"], each) for each in AT]
    turn = pressure_at(data["pressure"], data["angle"], TURN[5])
    stated = from_zero(page.of(free(5, "as stated")))
    base = [angle_at(*stated, each) for each in AT]
    base_turn = pressure_at(*stated, TURN[5])
    rows = [["as stated", *(f"{each:.2f}°" for each in base), f"{base_turn:.1f} kPa"]]
    for name in VARIATIONS:
        if name == "as stated":
            continue
        curve = from_zero(page.of(free(5, name)))
        angles = [_change(angle_at(*curve, each), old) for each, old in zip(AT, base, strict=True)]
        rows.append([name, *angles, _change(pressure_at(*curve, TURN[5]), base_turn)])
    measured = [_change(each, old) for each, old in zip(aims, base, strict=True)]
    rows.append(["**measured**", *measured, _change(turn, base_turn)])
    return lines_of(["", *(f"angle at {each:.0f} kPa" for each in AT), "pressure of 15°"], rows)


def _change(new: float, old: float) -> str:
    return f"{100 * (new / old - 1):+.1f} %" if np.isfinite(new) else "not reached"


def _angles(page: Page) -> str:
    """The same path read in other ways; 5 chambers as stated."""
    result = page.of(free(5, "as stated"))
    readings = {
        "as stated: line from the lower edge of the base to that of the tip, zero at 10 kPa": (LINE, 10.0, 0.0),
        "line to the upper edge of the tip": ("base_bottom tip_top", 10.0, 0.0),
        "line between the upper edges": ("base_top tip_top", 10.0, 0.0),
        "turn of the tip (tangent angle)": ("tangent", 10.0, 0.0),
        "zero at 0 kPa": (LINE, 0.0, 0.0),
        "pressure 1 kPa lower than written": (LINE, 10.0, -1.0),
        "pressure 1 kPa higher than written": (LINE, 10.0, 1.0),
    }
    rows, base = [], None
    for said, (line, zero, shift) in readings.items():
        pressure, angle = from_zero(result, line=line, zero=zero + shift)
        values = [angle_at(pressure, angle, each + shift) for each in AT]
        turn = pressure_at(pressure, angle, TURN[5]) - shift
        base = base or [*values, turn]
        told = [f"{values[0]:.2f}°", *(f"{each:.2f}°" for each in values[1:]), f"{turn:.1f} kPa"]
        rows.append([said, *told] if base == [*values, turn] else [said, *map(_change, [*values, turn], base)])
    data = measured_free(5)
    jump = float(data["angle"][1])
    less = data["angle"] - jump
    told = [angle_at(data["pressure"], less, each) for each in AT] + [pressure_at(data["pressure"], less, TURN[5])]
    rows.append([f"**measured**, less the {jump:.1f}° that appear before 10.5 kPa", *map(_change, told, base)])
    return lines_of(["how it is read", *(f"angle at {each:.0f} kPa" for each in AT), "pressure of 15°"], rows)
