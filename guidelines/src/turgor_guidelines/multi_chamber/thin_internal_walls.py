"""Guideline 7.4-4: thin and large walls between chambers act fast and bulge little."""

from scipy.optimize import brentq

import turgor as tg
from turgor.studies import Run
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.multi_chamber.pneunets import (
    MULTI_CHAMBERED,
    SETUP,
    actuator_of,
    at_angle,
    bend,
    count_and_size,
    pneunet,
    run_of,
)
from turgor_guidelines.values import Value, falls, last, listed, rises

#: Angle at which they are compared [deg for each chamber], and the pressure up to which they are followed [kPa].
ANGLE, PRESSURE = 5, 30

#: Thickness of the walls between chambers [mm]; the outer ones follow from the same mass of silicone.
WALLS = {"quick": (1.5, 2.0, 2.5), "full": (1.0, 1.5, 2.0, 2.5)}

#: Heights [mm] that make the walls between chambers larger.
HEIGHTS = {"quick": (15, 19), "full": (15, 17, 19, 22)}


def outer_wall(wall: float, chambers: int) -> float:
    """Thickness of sides and top [mm] that keeps the mass of one whose walls all have 2 mm."""
    mass = actuator_of(pneunet(chambers, {"wall": 2})).solid_volume

    def excess(outer: float) -> float:
        changed = {"wall": wall, "side_wall": outer, "top_wall": outer}
        return float(actuator_of(pneunet(chambers, changed)).solid_volume / mass - 1)

    return round(float(brentq(excess, 0.5, 5.0)), 3)


def runs(setting: Setting) -> tuple[Run, ...]:
    """Walls between chambers thinner and thicker than the outer ones."""
    count, _ = count_and_size(setting)
    out = []
    for wall in WALLS[setting]:
        outer = outer_wall(wall, count)
        given = pneunet(count, {"wall": wall, "side_wall": outer, "top_wall": outer})
        name = f"{wall:g} mm between, {outer:.2f} mm outside"
        out.append(run_of(name, bend, setting, PRESSURE, {"given": given, "until": ANGLE * count}))
    return tuple(out)


def higher(setting: Setting) -> tuple[Run, ...]:
    """Larger walls between chambers."""
    count, _ = count_and_size(setting)
    return tuple(
        run_of(
            f"{height:g} mm high",
            bend,
            setting,
            PRESSURE,
            {"given": pneunet(count, {"height": height}), "until": ANGLE * count},
        )
        for height in HEIGHTS[setting]
    )


def _at_equal_angle(runs: Runs) -> tuple[float, dict[str, list[Value]]]:
    """Common angle [deg]; pressure, bulge and air there."""
    angle = 0.999 * min(last(each.response, "bending_angle").number for each in runs.values())
    named = {"pressure": False, "bulge": False, "cavity_volume": True}
    return angle, {
        name: [at_angle(each.response, name, angle, less_rest=less) for each in runs.values()]
        for name, less in named.items()
    }


def _energy(values: dict[str, list[Value]]) -> list[Value]:
    """Pressure times air [mJ], which a pump has to bring: kPa times mL."""
    pairs = zip(values["pressure"], values["cavity_volume"], strict=True)
    return [Value(p.number * v.number, abs(p.error * v.number) + abs(p.number * v.error), "mJ") for p, v in pairs]


def _judged(runs: Runs, better: str, order: object) -> Judgement:
    """Whether pressure times air and bulge at equal angle change in the expected direction."""
    angle, values = _at_equal_angle(runs)
    ordered = {"rises": rises, "falls": falls}[str(order)]
    work = _energy(values)
    holds = {"pressure times air": ordered(work), "bulge": ordered(values["bulge"])}
    missed = [name for name, confirmed in holds.items() if not confirmed]
    return Judgement(
        verdict=verdict_of(holds.values()),
        finding=f"{'; '.join(runs)}: at {angle:.3g} deg {listed(values['pressure'])}, air "
        f"{listed(values['cavity_volume'])}, "
        f"their product {listed(work)}, bulge of the sides {listed(values['bulge'])}",
        conditions=f"{better} does not reduce {' and '.join(missed)} by more than the mesh error." if missed else "",
    )


def judge(runs: Runs) -> Judgement:
    """Thinner walls between chambers: less work for the pump, less bulge."""
    return _judged(runs, "A thinner wall between chambers at equal mass", "rises")


def judge_higher(runs: Runs) -> Judgement:
    """Larger walls between chambers: less work for the pump, less bulge."""
    return _judged(runs, "A larger wall between chambers", "falls")


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves of angle and of bulge; pressure times air."""
    curves = tuple((name, each.response) for name, each in runs.items())
    angle, values = _at_equal_angle(runs)
    sizes = [float(name.split()[0]) for name in runs]
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=curves),
        tg.pictures.Panel(x="bending_angle", y="bulge", responses=curves),
        tg.pictures.Panel(
            x="wall between chambers [mm]" if "between" in next(iter(runs)) else "height [mm]",
            y=f"pressure times air at {angle:.3g} deg [mJ]",
            lines=[line_of(sizes, _energy(values))],
        ),
    )


GUIDELINE = Guideline(
    key="7.4-4",
    rule="For rapid actuation and low radial expansion, internal walls should be thinner than the exterior ones and "
    "have "
    "a larger surface.",
    sources=("Polygerinos et al. 2013", "Mosadegh et al. 2014"),
    families=MULTI_CHAMBERED,
    studies=(
        GuidelineTest(
            title="Internal against external walls at equal mass",
            setup="Fast "
            + SETUP.format(count="of two chambers (four at the full setting)")
            + "; walls between chambers of other thickness, sides and top such that the mass stays. At the same angle: "
            "pressure times air, which a pump has to bring and which decides how fast it fills, and the bulge of the "
            "sides.",
            expected="Both rise with the thickness of the walls between chambers.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
        GuidelineTest(
            title="Surface of the internal walls",
            setup="The same with other heights, at which the walls between chambers have other surfaces.",
            expected="Pressure times air and bulge at the same angle fall with the height.",
            runs=higher,
            judge=judge_higher,
            panels=panels,
        ),
    ),
)
