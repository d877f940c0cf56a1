"""The cantilever on docs/measured-actuators.md."""

import numpy as np
from cantilever import FOLDER, RECORDS, lifted, measured, rubber, runs, sinks
from measured_tables import distance, table
from page_parts import Page, lines_of, number, percent, text

from turgor.units import kPa

#: Names of the recordings, in the order of the data.
WEIGHT, LOAD = ("beam_gravity_V2_a", "beam_gravity_V2_b"), ("beam_load52_V2_a", "beam_load52_V2_b")


def _row(name: str, values: np.ndarray, *more: str) -> list[str]:
    return [name, *(" / ".join(number(-each) for each in row) for row in values), *more]


def _tilt(recordings: tuple[str, ...]) -> float:
    """Tilt of the line from the lower to the upper tip marker in the first frame, mean of the recordings [deg]."""
    results = []
    for row in recordings:
        start = {
            each["marker"]: [float(each[f"start_{axis}_mm"]) for axis in "xz"]
            for each in table(FOLDER / "static_marker_displacements.csv")
            if each["recording"] == row
        }
        up, along = np.subtract(start["tip1"], start["tip3"])
        results.append(np.degrees(np.arctan2(along, up)))
    return float(np.mean(results))


def part(page: Page) -> str:
    """The section, with its numbers."""
    rows, got = [], {}
    means = {}
    for clamp in (False, True):
        tracks = measured(of_clamp=clamp)
        means[clamp] = np.array([np.mean([tracks[name][:, 2] for name in names], axis=0) for names in (WEIGHT, LOAD)])
        said = "measured, clamp motion taken out" if clamp else "**measured**"
        for letter in (0, 1):
            values = np.array([tracks[names[letter]][:, 2] for names in (WEIGHT, LOAD)])
            rows.append(_row(f"{said}, recording {'ab'[letter]}", values, ""))
    by_name = {run.name: page.of(run) for run in runs()}
    for name in RECORDS:
        got[name] = sinks(by_name[name])
        modulus = 3 * rubber(name, 0.0).law.shear_modulus / kPa
        off = page.record("cantilever", f"blind, {name}", distance(got[name], means[False]))
        rows.append(_row(f"blind: `{name}`, E = {modulus:.0f} kPa", got[name], off))
    for name, clamp in (("calibrated", False), ("calibrated, of clamp", True)):
        got[name] = sinks(by_name[name])
        modulus = by_name[name].column("modulus")[0] / kPa
        off = page.record("cantilever", name, distance(got[name], means[clamp]))
        said = ", clamp motion taken out" if clamp else ""
        rows.append(_row(f"calibrated{said}, E = {modulus:.0f} kPa", got[name], off))
    return _text(rows, got, means, by_name)


def _text(rows: list[list[str]], got: dict, means: dict, by_name: dict) -> str:
    fine, coarse, fit = sinks(by_name["fine"]), got[RECORDS[0]], got["calibrated"]
    moduli = [rubber(name, 0.0).law.shear_modulus for name in RECORDS]
    offs = {name: distance(got[name], means[False]) for name in RECORDS}
    out = [measured(of_clamp=False)[name][:, 2].mean() - measured(of_clamp=True)[name][:, 2].mean() for name in LOAD]
    held = np.max(np.abs(fit[1] - means[False][1])) / np.max(np.abs(means[False][1]))
    error = np.max(np.abs(fine - coarse), axis=1)
    return text("cantilever").format(
        table=lines_of(["", "weight", "weight and load", "distance (RMS, of the largest)"], rows),
        mesh=f"{error[0]:.2f} mm under the weight and {error[1]:.2f} mm with the load, at the edge that bears it",
        factor=max(moduli) / min(moduli), best=percent(min(offs.values())),
        worst=percent(max(offs.values()), 0),
        modulus=by_name["calibrated"].column("modulus")[0] / kPa, held=f"{100 * held:.1f} %",
        tilt_weight=_tilt(WEIGHT), tilt_load=_tilt(LOAD), out_a=-out[0], out_b=-out[1],
        alone=-lifted(of_clamp=False).mean(), alone_model=-(fit[1] - fit[0]).mean(),
        alone_blind=-(coarse[1] - coarse[0]).mean(),
    )  # fmt: skip
