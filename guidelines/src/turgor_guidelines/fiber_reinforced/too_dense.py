"""Guideline 7.2-3: with too many fibers an actuator needs more pressure."""

from math import pi

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.fiber_reinforced.wound import TUBE, cells
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.parts import elastosil, threads
from turgor_guidelines.sections import solved_twice
from turgor_guidelines.values import Value, at, listed, rises

#: Diameter of a thread [mm], distances between threads [mm], requested stretch, last pressure [kPa].
DIAMETER, SPACINGS, STRETCH, PRESSURE = 0.1778, (8.0, 4.0, 2.0, 1.0, 0.5, 0.25, 0.18), 1.2, 140.0

#: Rise of the pressure that counts as higher.
HIGHER = 0.03


def inflate(spacing: float, bonded: bool, size: float) -> Computed:
    """Inflate a tube in hoops [mm] that are bare, or bonded into a skin of the same rubber as thick as they are.

    Across the threads a skin is a series of thread and rubber: 1 / (1 - share of the threads) as stiff as the rubber.
    """
    rubber = elastosil()
    full = DIAMETER * pi / 4 / spacing  # share of the skin's volume
    skin = tg.Material(name="skin", law=tg.laws.NeoHooke(C10=rubber.law.shear_modulus / 2 / (1 - full)))
    shape = tg.actuators.FiberReinforcedCylinder(skin=DIAMETER * mm if bonded else 0.0)
    materials = {"body": rubber, "skin": skin} if bonded else {"body": rubber}
    wound = threads("winding" if bonded else "outside", spacing=spacing)

    def solve(cell: float) -> tg.sections.SectionSolution:
        section = tg.Section(shape, materials, reinforcements=[wound], size=cell)
        return section.solve(np.linspace(0, PRESSURE * kPa, 29), throw=False, mesh_error=False)

    return solved_twice(solve, size * mm)


def _runs(setting: Setting, bonded: bool) -> tuple[Run, ...]:
    return tuple(
        Run(
            name=f"{spacing:g} mm",
            function=inflate,
            values={"spacing": spacing, "bonded": bonded, "size": cells(setting)},
        )
        for spacing in SPACINGS
    )


def bare_runs(setting: Setting) -> tuple[Run, ...]:
    """Threads that lie on the tube."""
    return _runs(setting, bonded=False)


def bonded_runs(setting: Setting) -> tuple[Run, ...]:
    """Threads in a skin."""
    return _runs(setting, bonded=True)


def needed(runs: Runs) -> list[Value]:
    """Pressure of each run at the requested stretch, with the mesh error of the stretch there [kPa]."""
    out = []
    for each in runs.values():
        pressure, stretch = each.response["pressure"] / kPa, each.response["stretch"]
        where = float(np.interp(STRETCH, stretch, pressure, right=np.nan))
        error = at(each.response, "stretch", "pressure", where * kPa).error
        out.append(Value(where, error * float(np.interp(where, pressure, np.gradient(pressure, stretch))), "kPa"))
    return out


def judge(runs: Runs) -> Judgement:
    """Whether the pressure for a stretch rises again where threads are dense."""
    pressures = needed(runs)
    numbers = [each.number for each in pressures]
    least = int(np.argmin(numbers))
    more = numbers[-1] / numbers[least] - 1
    names = list(runs)
    if more > HIGHER and rises(pressures[least:]):
        first = next(name for name, each in zip(names, numbers, strict=True) if each > (1 + HIGHER) * numbers[least])
        verdict = Verdict.CONFIRMED
        summary = f"More than {HIGHER:.0%} above the least from {first} on, {more:.0%} at {names[-1]}."
    else:
        verdict = Verdict.NOT_REPRODUCED
        summary = f"The densest winding needs {more:+.2%} of the least pressure, which has {names[least]}."
    return Judgement(
        verdict=verdict,
        finding=f"Distance between threads {', '.join(names)}: {listed(pressures)} for a stretch of {STRETCH:g}.",
        conditions=f"{summary} Threads that are free to part as the tube lengthens cost no pressure however dense they "
        "are; it is what binds them that stretches with the tube.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Stretch against pressure, and the pressure that is needed against the distance."""
    pressures = needed(runs)
    line = tg.pictures.Line(
        x=[float(name.split()[0]) for name in runs],
        y=[each.number for each in pressures],
        error=[each.error for each in pressures],
    )
    curves = tuple((name, each.response) for name, each in runs.items())
    return (
        tg.pictures.Panel(x="pressure", y="stretch", responses=curves),
        tg.pictures.Panel(
            x="distance between threads [mm]", y=f"pressure for a stretch of {STRETCH:g} [kPa]", lines=[line]
        ),
    )


EXPECTED = "The pressure for a stretch of 1.2 has a least value and rises by more than 3 % where threads are denser."

GUIDELINE = Guideline(
    key="7.2-3",
    rule="If the fiber density is too large, the actuator needs a higher pressure.",
    sources=("Zhang et al. 2019",),
    families=("fiber_reinforced_cylinder",),
    studies=(
        GuidelineTest(
            title="Bare threads, 8 mm apart to side by side",
            setup=f"{TUBE}, hoops; pressure for a stretch of 1.2.",
            expected=EXPECTED,
            runs=bare_runs,
            judge=judge,
            panels=panels,
        ),
        GuidelineTest(
            title="Threads bonded in a skin of rubber",
            setup=f"{TUBE}, hoops in a skin of the same rubber, 0.1778 mm thick, that the threads stiffen across "
            "them as springs in series do: by 1 / (1 - their share of its volume); pressure for a stretch of 1.2.",
            expected=EXPECTED,
            runs=bonded_runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
