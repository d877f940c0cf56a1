"""The inflated membranes on docs/measured-actuators.md."""

import numpy as np
from inflated import WEIGHTS, measured, off, pressures_at
from measured_runs import BLIND_LAWS, FACTOR, MEMBRANE_VARIED, MIDDLE, calibrated_membranes, lifted, membrane_varied
from measured_tables import distance
from page_parts import COLORS, Page, lines_of, new_figure, number, save, signed, text

from turgor.units import mm

#: Heights in the table of what decides [mm].
COMPARED = (10.0, 35.0)
#: Laws at the middle weight.
MIDDLE_LAWS = (*BLIND_LAWS, "ogden-2")


def part(page: Page) -> str:
    """The section, with its numbers."""
    factor = float(page.of(FACTOR).column("factor")[0])
    fit = dict(
        zip(
            [(m, w) for m in ("membrane_01", "membrane_02") for w in WEIGHTS], calibrated_membranes(factor), strict=True
        )
    )
    rows = []
    for law in BLIND_LAWS:
        rows.append(_row(page, f"plain, blind: {_name(law)}", [lifted("membrane_01", w, law) for w in WEIGHTS]))
    rows.append(_row(page, "plain, calibrated", [fit["membrane_01", w] for w in WEIGHTS]))
    rows.append(
        _row(page, "two rings, blind: the authors' Gent", [lifted("membrane_02", w, "authors") for w in WEIGHTS])
    )
    rows.append(_row(page, "two rings, calibrated on the plain one", [fit["membrane_02", w] for w in WEIGHTS]))
    head = ["membrane and law", *(f"{weight:.1f} N" for weight in WEIGHTS)]
    last = page.of(lifted("membrane_01", MIDDLE, "authors"))
    stretch = float(np.interp(COMPARED[1] * mm, last.column("height"), last.column("stretch_p99")))
    return text("membranes").format(
        figure=_figure(page, fit), factor=factor, table=lines_of(head, rows), varied=_varied(page), stretch=stretch,
        slopes=_slopes(page), maximum=_maximum(page), rings=_rings(page, fit),
    )  # fmt: skip


def _name(law: str) -> str:
    return "the authors' Gent" if law == "authors" else f"{law}, other laboratory"


def _row(page: Page, name: str, found: list) -> list[str]:
    cells = [name]
    for run, weight in zip(found, WEIGHTS, strict=True):
        data = measured(run.values["membrane"], weight)
        got = pressures_at(page.of(run), data["height"])
        there = np.isfinite(got)
        share = page.record(f"membrane, {weight:.1f} N", name, distance(got[there], data["pressure"][there]))
        mean = np.nanmean(off(page.of(run), run.values["membrane"], weight))
        cells.append(f"{share} (mean {100 * mean:+.1f} %)")
    return cells


def _figure(page: Page, fit: dict) -> str:
    figure, axes = new_figure(2)
    for where, membrane, title in zip(axes, ("membrane_01", "membrane_02"), ("plain", "two rings"), strict=True):
        for color, weight in zip(COLORS, WEIGHTS, strict=False):
            data = measured(membrane, weight)
            where.errorbar(
                data["height"], data["pressure"], data["spread"], fmt="o", ms=3, color=color, label=f"{weight:.1f} N"
            )
            curves = [("--", lifted(membrane, weight, "authors")), ("-", fit[membrane, weight])]
            curves += [(":", lifted(membrane, weight, "yeoh"))] if membrane == "membrane_01" else []
            for style, run in curves:
                height = np.linspace(0, 50, 60)
                where.plot(height, pressures_at(page.of(run), height), style, color=color, lw=1.2)
        where.set(title=title, xlabel="height of the plate [mm]", ylabel="pressure [kPa]", ylim=(0, None))
    axes[0].legend(frameon=False, loc="lower right")
    return save(figure, "membranes.svg")


def _varied(page: Page) -> str:
    stated = page.of(lifted("membrane_01", MIDDLE, "authors"))
    heights = np.array(COMPARED)
    rows = []
    for name in MEMBRANE_VARIED:
        run = membrane_varied(name)
        change = pressures_at(page.of(run), heights) / pressures_at(stated, heights) - 1
        rows.append([name, *(f"{100 * each:+.1f} %" for each in change)])
    for law in MIDDLE_LAWS[1:]:
        change = pressures_at(page.of(lifted("membrane_01", MIDDLE, law)), heights) / pressures_at(stated, heights) - 1
        rows.append([f"law: {_name(law)}", *(f"{100 * each:+.1f} %" for each in change)])
    data = measured("membrane_01", MIDDLE)
    there = np.interp(heights, data["height"], data["pressure"]) / pressures_at(stated, heights) - 1
    rows.append(["**measured**", *(f"{100 * each:+.1f} %" for each in there)])
    return lines_of(["", *(f"at {height:.0f} mm" for height in heights)], rows)


def _slopes(page: Page) -> str:
    """Change of the pressure between two heights at the middle weight."""
    heights, said = np.array(COMPARED), []
    data = measured("membrane_01", MIDDLE)
    low, high = np.interp(heights, data["height"], data["pressure"])
    for law in MIDDLE_LAWS:
        first, last = pressures_at(page.of(lifted("membrane_01", MIDDLE, law)), heights)
        said.append(f"{_name(law)} {signed(last / first - 1)}")
    between = f"from {heights[0]:.0f} to {heights[1]:.0f} mm the pressure changes by"
    return f"{between} {signed(high / low - 1)} (measured), {', '.join(said)}"


def _maximum(page: Page) -> str:
    """Highest and lowest pressure of the heaviest weight, measured and by the authors' law."""
    data = measured("membrane_01", WEIGHTS[2])
    got = pressures_at(page.of(lifted("membrane_01", WEIGHTS[2], "authors")), data["height"])
    told = [
        f"{number(np.nanmax(each), 2)} kPa falling to {number(np.nanmin(each), 2)} kPa"
        for each in (data["pressure"], got)
    ]
    return f"measured {told[0]}, the authors' law {told[1]}"


def _rings(page: Page, fit: dict) -> str:
    """How far the calibrated law is below the membrane with rings, from weight to weight."""
    means = [-100 * np.nanmean(off(page.of(fit["membrane_02", each]), "membrane_02", each)) for each in WEIGHTS]
    return f"{min(means):.0f} to {max(means):.0f} %"
