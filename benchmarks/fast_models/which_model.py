"""Which model when: finite elements, section, rod and formula on the same actuators: error and cost of each.

``python benchmarks/fast_models/which_model.py FOLDER`` runs what FOLDER does not hold yet, and writes
docs/which-model.md. Finite elements on the default mesh are the reference; their own error is the estimated mesh
error. Times are CPU seconds of one thread with meshing, without compilation.
"""

import sys
from collections.abc import Callable
from dataclasses import dataclass, field, replace
from pathlib import Path
from time import process_time
from types import MappingProxyType
from typing import Any

import numpy as np

import turgor as tg
from turgor.foundation.response import Column
from turgor.studies.runs.run import Computed, Run
from turgor.studies.runs.run_all import run_all
from turgor.units import deg, kPa, mm

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.fast_models.which_model_page import write_page

RUBBER = tg.Material(name="Elastosil M4601, neo-Hooke", law=tg.laws.NeoHooke(C10=0.12e6))
STIFF = tg.Material(name="Smooth-Sil 950, neo-Hooke", law=tg.laws.NeoHooke(C10=0.34e6))
THREAD = tg.Material(name="Kevlar", law=tg.laws.Hooke(E=31067e6, nu=0.36))
PAPER = tg.Material(name="paper", law=tg.laws.Hooke(E=6.5e9, nu=0.2))


@dataclass(frozen=True, slots=True, kw_only=True)
class Case:
    """An actuator, its two pressures, what it is judged by, and the formula for it."""

    title: str
    family: str
    pressures: tuple[float, float]  # kPa
    quantity: str
    formula: str = ""
    threads: tuple[tuple[str, float, str], ...] = ()  # face, angle from the axis in degrees, hand
    sheet: bool = False
    dimensions: dict[str, Any] = field(default_factory=dict)
    cells: str = "hexahedra"
    section: bool = True
    loaded: str = "cavity"
    job: bool = False  # model, materials and mesh are those of the family's example job


BENDS, EXTENDS, TWISTS = "bending_angle", "tip_displacement_x", "twist_angle"


def of_job(title: str, family: str, pressures: tuple[float, float], **more: Any) -> Case:
    """Give a case that its example job describes; the larger pressure is that of the job."""
    return Case(title=title, family=family, pressures=pressures, quantity=BENDS, job=True, **more)


CASES = {
    "tube": Case(
        title="Extending cylinder, bare", family="ExtendingCylinder", pressures=(10, 30), quantity=EXTENDS,
        formula="thick_tube", cells="axisymmetric",
    ),
    "wound": Case(
        title="Fiber-reinforced cylinder, both hands at 70°", family="FiberReinforcedCylinder", pressures=(20, 60),
        quantity=EXTENDS, formula="wound_tube", threads=(("outside", 70, "both"),),
    ),
    "twisting": Case(
        title="Twisting tube, one hand at 60°", family="TwistingTube", pressures=(10, 30), quantity=TWISTS,
        formula="wound_tube", threads=(("outside", 60, "right"),),
    ),
    "muscle": Case(
        title="Contracting tube (McKibben), both hands at 25°", family="ContractingTube", pressures=(10, 60),
        quantity=EXTENDS, formula="wound_tube", threads=(("outside", 25, "both"),),
    ),
    "eccentric": Case(
        title="Eccentric bender", family="EccentricBender", pressures=(10, 35), quantity=BENDS,
        formula="euler_bernoulli",
    ),
    "two materials": Case(
        title="Two-material bender, base 2.8 times as stiff", family="TwoMaterialBender", pressures=(10, 30),
        quantity=BENDS, formula="euler_bernoulli",
    ),
    "omnidirectional": Case(
        title="Omnidirectional actuator, one round chamber of three", family="OmnidirectionalActuator",
        pressures=(4, 10), quantity=BENDS, loaded="cavity_1",
    ),
    "bellows": Case(
        title="Bellows of revolution", family="BellowsOfRevolution", pressures=(0.5, 5), quantity=EXTENDS,
        formula="castigliano_bellows", cells="axisymmetric", section=False, dimensions={"folds": 2},
    ),
    "pneunet": Case(
        title="Fast PneuNet of three chambers on paper", family="FastPneuNet", pressures=(2, 6), quantity=BENDS,
        section=False, sheet=True, dimensions={"chambers": 3, "length": 30 * mm},
    ),
    "half round": of_job("Semicircular bender on paper", "semicircular_bender", (5, 10), formula="euler_bernoulli"),
    "wound bender": of_job(
        "Fiber-reinforced bender, hoops every 3 mm, on paper", "fiber_reinforced_bender", (5, 10),
        formula="fiber_reinforced_bender",
    ),
    "rectangular": of_job("Rectangular bender on paper", "rectangular_bender", (10, 20), formula="euler_bernoulli"),
    "two-way bender": of_job(
        "Bidirectional bender, one chamber", "bidirectional_bender", (15, 30), loaded="cavity_1"
    ),
    "slow": of_job("Slow PneuNet of four chambers on paper", "slow_pneunet", (7.5, 15), section=False),
    "free bottom": of_job("Free-bottom PneuNet of three chambers", "free_bottom_pneunet", (1.5, 3), section=False),
    "two-way pneunet": of_job(
        "Bidirectional PneuNet of three chambers", "bidirectional_pneunet", (1.5, 3), section=False, loaded="cavity_1"
    ),
    "helical": of_job("Helical PneuNet of three chambers, 30°", "helical_pneunet", (1.5, 3), section=False),
    "trapezoidal": of_job("Trapezoidal PneuNet of four chambers", "trapezoidal_pneunet", (3, 6), section=False),
    "triangular": of_job("Triangular PneuNet of four chambers", "triangular_pneunet", (3, 6), section=False),
    "fin": of_job("Manta fin of four chambers", "manta_fin", (4, 8), section=False),
    "three bellows": of_job(
        "Parallel bellows of four folds, one of three", "parallel_bellows", (0.75, 1.5), section=False,
        loaded="cavity_1",
    ),
    "three extenders": of_job(
        "Three extenders, one of three", "three_extenders", (1.5, 3), section=False, loaded="cavity_1"
    ),
    "joint": of_job("Revolute joint of two cylinders", "revolute_joint", (2.5, 5), section=False, loaded="cavity_1"),
}  # fmt: skip


def parts(case: Case) -> tuple[Any, dict[str, Any], list[tg.Fibers]]:
    """Actuator, materials by region, and threads of a case."""
    if case.job:
        job = tg.jobs.read_job(tg.jobs.example_job(case.family))
        return job.actuator, dict(job.materials), list(job.fibers.values())
    actuator = getattr(tg.actuators, case.family)(**case.dimensions)
    built = actuator.build()
    materials: dict[str, Any] = {name: STIFF if name == "cap" else RUBBER for name in built.regions}
    if case.family == "TwoMaterialBender":
        materials["base"] = STIFF
    if case.sheet:
        materials["strain_limiting_layer"] = tg.Shell(PAPER, thickness=0.1 * mm)
    fibers = []
    for face, angle, hand in case.threads:
        winding = tg.Winding(angle_from_axis=angle * deg, spacing=2 * mm, hand=hand)
        faces = tuple(face.split("+"))
        fibers.append(
            tg.Fibers(
                face=faces if len(faces) > 1 else face, material=THREAD, diameter=0.1778 * mm, winding=winding,
                compression=1.0,
            )
        )  # fmt: skip
    return actuator, materials, fibers


def elements(name: str) -> Computed:
    """Finite elements on the default mesh, at both pressures."""
    case = CASES[name]
    low, high = case.pressures
    if case.job:
        job = tg.jobs.read_job(tg.jobs.example_job(case.family))
        model, _ = tg.jobs.prepare(job)
        solution = tg.solve(model, replace(job.procedure, at=(low / high, 1.0)), throw=False)
        return Computed(response=tg.measure(solution, tg.bending_angle))
    actuator, materials, fibers = parts(case)
    model = tg.Model(
        tg.mesh(actuator.build(), cells=case.cells),
        materials=materials,
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure(case.loaded, high * kPa)],
        reinforcements=fibers,
    )
    solution = tg.solve(model, tg.Static(at=(low / high, 1.0)), throw=False)
    measure = tg.bending_angle if case.quantity == BENDS else getattr(tg.measures, case.quantity)
    return Computed(response=tg.measure(solution, measure))


def section(name: str) -> Computed:
    """The section alone, times the length that is free to move."""
    case = CASES[name]
    actuator, materials, fibers = parts(case)
    uniform = tg.Section(actuator, materials, reinforcements=fibers)
    pressure: Any = np.array([0.0, 0.5 * case.pressures[0], *case.pressures]) * kPa
    if case.loaded != "cavity":
        pressure = {case.loaded: pressure}
    return Computed(response=_of_length(case, actuator, uniform.solve(pressure, throw=False).response))


def rod(name: str) -> Computed:
    """A rod whose section is solved; its time is that of the rod alone, the section is known."""
    case = CASES[name]
    actuator, materials, fibers = parts(case)
    low, high = case.pressures
    uniform = tg.Section(actuator, materials, reinforcements=fibers)
    known = tg.sections.rod_section(uniform.solve(np.linspace(0, high, 7) * kPa))
    one = tg.rods.RodModel(
        rods=[tg.rods.Rod(section=known, length=_free(actuator))],
        loads=[tg.rods.ChamberPressure(pressure=high * kPa)],
    )
    tg.rods.static(one, at=[low / high, 1.0])
    began = process_time()
    solution = tg.rods.static(one, at=[low / high, 1.0])
    seconds = process_time() - began
    result = solution.response()
    moved = result.find(case.quantity)
    columns = (
        Column("pressure", "kPa", np.array(case.pressures) * kPa),
        Column(case.quantity, moved.unit, moved.values[-2:]),
    )
    return Computed(response=tg.Response(columns=columns, source=result.source), seconds=seconds)


def formula(name: str) -> Computed:
    """The formula for the family; its time is that of the second call."""
    case = CASES[name]
    actuator, materials, fibers = parts(case)
    pressures = np.array(case.pressures) * kPa
    function = getattr(tg.formulas, case.formula)
    body = materials["body"]

    def call() -> tg.Response:
        if case.formula == "wound_tube":
            return function(actuator, body, fibers, pressures)
        if case.family == "TwoMaterialBender":
            return function(actuator, {"body": body, "base": materials["base"]}, pressures)
        return function(actuator, body, pressures)

    call()
    began = process_time()
    result = call()
    seconds = process_time() - began
    columns = (result.find("pressure"), result.find(case.quantity))
    return Computed(response=tg.Response(columns=columns, source=result.source), seconds=seconds)


def _free(actuator: Any) -> float:
    """Length between the end walls."""
    ends = 2 * max((getattr(actuator, each, 0.0) for each in ("cap", "end_wall")), default=0.0)
    return float(actuator.length - ends)


def _of_length(case: Case, actuator: Any, found: tg.Response) -> tg.Response:
    """Angle, twist or extension of a length that is uniform all along."""
    length = _free(actuator)
    if case.quantity == EXTENDS:
        column = Column(EXTENDS, "mm", (found["stretch"] - 1) * length)
    elif case.quantity == TWISTS:
        column = Column(TWISTS, "deg", found["twist"] * length)
    else:
        column = Column(BENDS, "deg", np.hypot(found["curvature_y"], found["curvature_z"]) * length)
    pressure = next(each for each in found.columns if each.name.endswith("pressure"))
    return tg.Response(columns=(Column("pressure", "kPa", pressure.values), column), source=found.source)


MODELS: dict[str, Callable[[str], Computed]] = {
    "finite elements": elements, "section": section, "rod": rod, "formula": formula,
}  # fmt: skip


def runs() -> tuple[Run, ...]:
    """Every model that takes a case."""
    results = []
    for name, case in CASES.items():
        for model, function in MODELS.items():
            if (model in ("section", "rod") and not case.section) or (model == "formula" and not case.formula):
                continue
            if model == "rod" and (case.loaded != "cavity" or case.quantity == TWISTS):
                continue
            results.append(Run(name=f"{name}: {model}", function=function, values=MappingProxyType({"name": name})))
    return tuple(results)


def main(folder: Path) -> None:
    """Run and write the page."""
    ended = run_all(
        [Run(name=run.name, function=run.function, values=dict(run.values)) for run in runs()],
        folder,
        progress=lambda each: print(f"{each.run.name}: {each.problem or 'ended'}", flush=True),
    )
    write_page({each.run.name: each for each in ended.values()}, CASES)


if __name__ == "__main__":
    main(Path(sys.argv[1]))
