"""Claim 5-2: reinforced and multi-chambered actuators tolerate laws of low order, free ones do not."""

import numpy as np

import turgor as tg
from turgor.studies import Run
from turgor.units import kPa
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import change, line_of, verdict_of
from turgor_guidelines.modeling.benders import TUBE, bender, rubber_of, tube
from turgor_guidelines.multi_chamber.pneunets import ELASTOSIL, bend, run_of
from turgor_guidelines.values import Value, at

#: The same rubber by a law of low order and by one of high order.
LAWS = {"neo-Hooke": "elastosil-m4601/neo-hooke-polygerinos-2020", "Yeoh": ELASTOSIL}

#: Differences up to which a law is tolerated.
TOLERATED = 0.15

#: Motions at which pressures are compared: stretch of the length or of the inner wall.
WOUND, FREE = 1.2, 2.0


def runs(setting: Setting) -> tuple[Run, ...]:
    """Free tube, wound tube, bender and PneuNet with both laws."""
    out = []
    for law, rubber in LAWS.items():
        both = {"body": rubber, "base": rubber}
        out += [
            Run(name=f"free tube, {law}", function=tube, values={"rubber": rubber, "stretch": 2.5, "hoops": False}),
            Run(name=f"wound tube, {law}", function=tube, values={"rubber": rubber, "stretch": 1.5, "hoops": True}),
            Run(name=f"wound bender, {law}", function=bender, values={"rubber": rubber, "pressure": 60, "size": 2.0}),
            run_of(f"PneuNet, {law}", bend, setting, 14, {} if rubber == ELASTOSIL else {"rubbers": both}),
        ]
    return tuple(out)


def pressure_at(response: tg.Response, stretch: float) -> Value:
    """Pressure [kPa] of a tube when it has a stretch."""
    return Value(float(np.interp(stretch, response["stretch"], response["pressure"] / kPa)), 0.0, "kPa")


def _differences(runs: Runs) -> dict[str, float]:
    """Neo-Hooke against Yeoh for each actuator."""
    low, high = LAWS
    out = {}
    for name, stretch in (("free tube", FREE), ("wound tube", WOUND)):
        out[name] = change(*(pressure_at(runs[f"{name}, {law}"].response, stretch) for law in (low, high)))
    for name, pressure in (("wound bender", 60), ("PneuNet", 14)):
        angles = (
            at(runs[f"{name}, {law}"].response, "bending_angle", "pressure", pressure * kPa) for law in (low, high)
        )
        out[name] = change(*angles)
    return out


def _moduli() -> float:
    """Initial shear modulus of the neo-Hookean record over that of the Yeoh record, less one."""
    low, high = (float(rubber_of(rubber).law.shear_modulus) for rubber in LAWS.values())
    return low / high - 1


def judge(runs: Runs) -> Judgement:
    """The free tube differs by more than what is tolerated, the others do not."""
    differences = _differences(runs)
    holds = [
        abs(size) > TOLERATED if name == "free tube" else abs(size) < TOLERATED for name, size in differences.items()
    ]
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"neo-Hooke against Yeoh: pressure of the free tube whose inner wall is stretched {FREE:g} times "
        f"{differences['free tube']:+.1%}, of the wound tube stretched {WOUND:g} times "
        f"{differences['wound tube']:+.1%}; angle "
        f"of the wound bender at 60 kPa {differences['wound bender']:+.1%}, of the PneuNet at 14 kPa "
        f"{differences['PneuNet']:+.1%}",
        conditions=f"The initial shear moduli of the two records are {_moduli():+.0%} apart; what is beyond that "
        f"comes from "
        "the order of the law.",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Curves of all, and the differences."""
    tubes = tuple((name, each.response) for name, each in runs.items() if "tube" in name)
    others = tuple((name, each.response) for name, each in runs.items() if "tube" not in name)
    sizes = _differences(runs)
    bars = line_of(list(sizes), [Value(100 * size) for size in sizes.values()])
    return (
        tg.pictures.Panel(x="stretch", y="pressure", responses=tubes),
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=others),
        tg.pictures.Panel(x="actuator", y="neo-Hooke against Yeoh [%]", lines=[bars]),
    )


GUIDELINE = Guideline(
    key="5-2",
    rule="Fiber-reinforced and multi-chambered actuators balloon less, so that laws of low order serve for more "
    "rubbers.",
    sources=("Polygerinos et al. 2015", "Connolly et al. 2015"),
    families=("fiber_reinforced_bender", "extending_cylinder", "fast_pneunet"),
    studies=(
        GuidelineTest(
            title="Neo-Hooke and Yeoh of the same rubber",
            setup=TUBE
            + ", free and with hoops; a fiber-reinforced bender; a fast PneuNet of two chambers; all of Elastosil "
            "M4601, neo-Hookean (0.12 MPa) or Yeoh (0.11 and 0.02 MPa).",
            expected=f"More than {TOLERATED:.0%} apart for the free tube, less for the others.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
