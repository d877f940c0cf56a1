"""Page of ``benchmarks/fast_models/which_model.py``: docs/which-model.md."""

from collections.abc import Mapping
from pathlib import Path
from typing import Any

import numpy as np

from turgor.studies.runs.executors.run_outcome import Ended

PAGE = Path(__file__).parents[2] / "docs" / "which-model.md"
MODELS = ("section", "rod", "formula")
QUANTITIES = {"bending_angle": "bending angle", "tip_displacement_x": "extension", "twist_angle": "twist"}

HEAD = """# Which model when

turgor has four models of one actuator: finite elements of the whole, its [section](howto/section.md), a
[rod](howto/rods.md) whose section is known, and a [formula](howto/formulas.md). The table takes each family at a
small and at a large pressure. Finite elements on the default mesh are the reference, with their estimated mesh error;
the other columns are the difference from them, and the CPU time. Section, rod and formula have no end walls: their
length is that between the walls. From "Semicircular bender on paper" on, the rows are example jobs of their families,
whose coarse meshes make the mesh error as large as it says: up to a third.

"""

TAIL = """

- **Finite elements** for a number that decides something, for PneuNets and bellows, for contact, and near the ends.
- **The section** for long actuators: every law, fibers and layers, in a second or two. It is the best first look at a
  bender or a wound tube, and the model for sweeps over walls, angles and pressures. Benders on paper are different:
  where the base bulges, the section hardly bends, and the whole turns near its end walls, which keep the base flat.
- **A rod** once a section is known: weight, tip loads, several segments, motion, control. Its time does not count the
  section.
- **A formula** for tubes, where it is exact but for the ends. For benders without fibers the classical beam is wrong
  by its nature (finding F02): the table shows by how much. For wound benders see finding F08.

The page is written by `python benchmarks/fast_models/which_model.py FOLDER`. Times are CPU seconds of one thread
without compilation; for the rod and the formula those of a second call.
"""


def write_page(ended: Mapping[str, Ended], cases: Mapping[str, Any]) -> None:
    """Write the table; a model that failed has its sentence below."""
    lines = ["| actuator | at | finite elements | section | rod | formula |", "| --- | --- | --- | --- | --- | --- |"]
    notes = []
    for name, case in cases.items():
        reference = ended[f"{name}: finite elements"]
        if reference.result is None:
            notes.append(f"{case.title}, finite elements: {reference.problem}")
            continue
        for row, pressure in enumerate(case.pressures):
            cells = [case.title if row == 0 else "", f"{pressure:g} kPa", _reference(reference, case, pressure, row)]
            for model in MODELS:
                other = ended.get(f"{name}: {model}")
                cells.append("–" if other is None else _difference(other, reference, case, pressure, row))
            lines.append(f"| {' | '.join(cells)} |")
        notes += [
            f"{case.title}, {model}: {ended[key].problem}"
            for model in MODELS
            if (key := f"{name}: {model}") in ended and ended[key].problem
        ]
    text = HEAD + "\n".join(lines) + "\n" + "".join(f"\n- {note}" for note in notes) + TAIL
    PAGE.write_text(text, encoding="utf-8")
    print(PAGE)


def _at(ended: Ended, case: Any, pressure: float) -> float:
    """Value of the quantity at a pressure [kPa], in the unit of its column; not a number beyond the path."""
    assert ended.result is not None
    response = ended.result.response
    column = response.find(case.quantity)
    pressures = next(each.values for each in response.columns if each.name.endswith("pressure")) / 1e3
    reached = np.flatnonzero(np.isclose(pressures, pressure, rtol=1e-6))
    return float(column.in_unit[reached[0]]) if len(reached) else float("nan")


def _reference(ended: Ended, case: Any, pressure: float, row: int) -> str:
    assert ended.result is not None
    response = ended.result.response
    value, unit = _at(ended, case, pressure), response.find(case.quantity).unit
    errors = response.mesh_error(case.quantity)
    column = response.find(case.quantity)
    spread = ""
    if errors is not None:
        k = int(np.nanargmin(abs(column.in_unit - value)))
        share = abs(errors[k] / column.values[k]) if column.values[k] else 0.0
        spread = f" ± {share:.1%}"
    seconds = f", {ended.result.seconds:.0f} s" if row == 1 else ""
    return f"{QUANTITIES[case.quantity]} {value:.4g} {unit}{spread}{seconds}"


def _difference(other: Ended, reference: Ended, case: Any, pressure: float, row: int) -> str:
    if other.result is None:
        return "failed, see below"
    truth, value = _at(reference, case, pressure), abs(_at(other, case, pressure))
    if not np.isfinite(value):
        return "not reached"
    share = value / abs(truth) - 1
    told = f"{share:+.1%}" if abs(share) < 1 else f"{value / abs(truth):.2g} times"
    return told + (f", {_time(other.result.seconds)}" if row == 1 else "")


def _time(seconds: float) -> str:
    if seconds < 0.001:
        return "below 1 ms"
    return f"{seconds * 1e3:.2g} ms" if seconds < 0.1 else f"{seconds:.2g} s"
