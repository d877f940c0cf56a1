"""Actuators of the families, as soft, as stiff, as thin-walled, as slender, as coarse and as fine as they come."""

from collections.abc import Callable
from typing import Any

import turgor as tg
from benchmarks.robustness.robustness_cases import checks
from benchmarks.robustness.robustness_cases.case import KPA, MM, RUBBER, Case
from turgor.core.materials.laws.laws import Hooke

SOFTEST = tg.from_library("ecoflex-00-30", record="yeoh-elsayed-2014")
SOFT_OGDEN = tg.from_library("ecoflex-00-30", record="ogden-steck-2019")
STIFFEST = tg.from_library("fiberglass", record="yeoh-polygerinos-2015")
ELASTOSIL = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
PAPER = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * MM)
LEAP = tg.Static(first_step=1.0, max_step=1.0)


def driven(actuator: Any, size: float, pressure: float, material: tg.Material = RUBBER, *, paper: bool = False,
           regions: Any = None, pressures: Any = None, cells: str = "tetrahedra",
           **more: Any) -> Callable[[], tg.Model]:  # fmt: skip
    """An actuator at a mesh size [mm], clamped at its fixed end, under a pressure [kPa] in ``cavity``, or several."""

    def model() -> tg.Model:
        mesh = tg.mesh(actuator.build(), size=size * MM, cells=cells)
        materials = dict.fromkeys(mesh.regions, material) | (regions or {})
        if paper:
            materials["strain_limiting_layer"] = PAPER
        loads = [tg.Pressure(name, each * KPA) for name, each in (pressures or {"cavity": pressure}).items() if each]
        return tg.Model(mesh, materials, [tg.Fixed("fixed")], loads, **more)

    return model


NO_CONTACT = tg.Contact(self_contact=False)
THIN = tg.actuators.ExtendingCylinder(wall=0.2 * MM, length=15 * MM, cap=1 * MM)
BENDER = tg.actuators.RectangularBender(length=50 * MM)
#: More than what the bender on a stiff base holds at its largest pressure [m³].
VOLUME_PAST_LIMIT = 6e-6
KEVLAR = tg.Material(name="kevlar", law=Hooke(E=31.067e9, nu=0.36))


def steps_agree(count: int = 20) -> checks.Check:
    """The same end by small steps."""
    return checks.small_steps(count)


CASES = (
    Case(
        name="bender of the softest row with paper, one step", hard="stiffness ratio of 700,000, first_step = 1",
        model=driven(BENDER, 6, 1.5, SOFTEST, paper=True), procedure=LEAP, check=steps_agree(),
    ),
    Case(
        name="bender of the softest row with paper", hard="stiffness ratio of 700,000, as it comes",
        model=driven(BENDER, 6, 1.5, SOFTEST, paper=True),
        check=checks.both(checks.energy(), checks.rises(tg.bending_angle)),
    ),
    Case(
        name="bender of Ecoflex, three Ogden terms, paper", hard="alpha = 7, close to ballooning",
        model=driven(BENDER, 6, 1.5, SOFT_OGDEN, paper=True), check=checks.energy(),
    ),
    Case(
        name="bender of the stiffest row", hard="16 MPa, 2 MPa of pressure, one step",
        model=driven(BENDER, 6, 2000, STIFFEST), procedure=LEAP, check=steps_agree(),
    ),
    Case(
        name="softest bender on a base of the stiffest row", hard="stiffness ratio of 1600, a law that gives way",
        model=driven(tg.actuators.TwoMaterialBender(length=50 * MM), 6, 4, SOFTEST, regions={"base": STIFFEST}),
        check=checks.limit_of_volume_control(VOLUME_PAST_LIMIT), stops=True,
    ),
    Case(
        name="softest bender on a base of the stiffest row, hexahedra",
        hard="the same, of cells that keep their shape",
        model=driven(tg.actuators.TwoMaterialBender(length=50 * MM), 6, 4, SOFTEST, regions={"base": STIFFEST},
                     cells="hexahedra"),
        check=checks.limit_of_volume_control(VOLUME_PAST_LIMIT), stops=True,
    ),
    Case(
        name="slender closed tube", hard="length 40 times the radius",
        model=driven(tg.actuators.ExtendingCylinder(inner_radius=3 * MM, wall=1 * MM, length=120 * MM), 4, 40),
        check=checks.energy(),
    ),
    Case(
        name="thin-walled closed tube, one step", hard="wall of 3 % of the radius, first_step = 1",
        model=driven(THIN, 0.8, 3, cells="hexahedra"),
        procedure=LEAP,
        check=steps_agree(),
    ),
    Case(
        name="closed tube past its limit, procedure auto", hard="a bulge forms and moves",
        model=driven(tg.actuators.ExtendingCylinder(length=60 * MM), 6, 70), procedure=tg.Auto(), check=checks.energy(),
    ),
    Case(
        name="closed tube past its limit, load control", hard="limit point of a bulge", stops=True,
        model=driven(tg.actuators.ExtendingCylinder(length=60 * MM), 6, 90),
        check=checks.limit_of_volume_control(32e-6),
    ),
    Case(
        name="fast PneuNet, walls of 0.5 mm", hard="one coarse cell through thin walls",
        model=driven(tg.FastPneuNet(chambers=2, length=20 * MM, wall=0.5 * MM), 2, 3, ELASTOSIL, paper=True),
        check=checks.energy(),
    ),
    Case(
        name="fast PneuNet, walls meet", hard="contact of three gaps, three times the pressure at which they meet",
        model=driven(tg.FastPneuNet(chambers=3, length=27 * MM), 4, 25, ELASTOSIL, paper=True),
        check=checks.both(checks.energy(0.02), checks.rises(tg.bending_angle), checks.not_through),
    ),
    Case(
        name="fast PneuNet, walls meet, one step", hard="first_step = 1 far beyond touching",
        model=driven(tg.FastPneuNet(chambers=3, length=27 * MM), 4, 20, ELASTOSIL, paper=True), procedure=LEAP,
        check=checks.both(steps_agree(20), checks.not_through),
    ),
    Case(
        name="fast PneuNet of the stiffest row", hard="1 MPa, one step",
        model=driven(tg.FastPneuNet(chambers=2, length=20 * MM), 4, 500, STIFFEST, contact=NO_CONTACT), procedure=LEAP,
        check=steps_agree(),
    ),
    Case(
        name="slow PneuNet of the softest row", hard="a law that gives way",
        model=driven(tg.actuators.SlowPneuNet(chambers=3, length=30 * MM), 5, 3, SOFTEST),
        check=checks.law_gives_way(SOFTEST.law), stops=True,
    ),
    Case(
        name="slow PneuNet, fine mesh", hard="cells of 2 mm",
        model=driven(tg.actuators.SlowPneuNet(chambers=1, length=12 * MM), 2, 30, ELASTOSIL),
        check=checks.energy(), limit=120,
    ),
    Case(
        name="bellows unfolded", hard="folds open, hexahedra, one step", procedure=LEAP,
        model=driven(tg.actuators.BellowsOfRevolution(folds=1), 6, 10, cells="hexahedra"), check=steps_agree(),
    ),
    Case(
        name="bellows under vacuum", hard="the fold closes",
        model=driven(tg.actuators.BellowsOfRevolution(folds=1), 6, -6, cells="hexahedra"),
        check=checks.both(checks.energy(0.02), checks.not_through),
    ),
    Case(
        name="eccentric bender, hexahedra, one step", hard="first_step = 1", procedure=LEAP,
        model=driven(tg.actuators.EccentricBender(length=50 * MM), 5, 30, cells="hexahedra"), check=steps_agree(),
    ),
    Case(
        name="McKibben muscle", hard="kevlar 10,000 times stiffer than the tube, slack at first",
        model=driven(
            tg.actuators.ContractingTube(length=40 * MM), 4, 60, regions={"cap": STIFFEST}, cells="hexahedra",
            reinforcements=[
                tg.Fibers(face="outside", material=KEVLAR, diameter=0.18 * MM,
                          winding=tg.Winding(angle_from_axis=0.5, spacing=1 * MM, hand="both"))
            ],
        ),
        check=checks.energy(0.02),
    ),
)  # fmt: skip
