"""One short bender, solved in many ways: what it bends, and what the solve took."""

from collections.abc import Mapping
from typing import Any

import numpy as np

import turgor as tg
from turgor.studies import Computed
from turgor.units import kPa, mm
from turgor_guidelines.pictures import picture_of
from turgor_guidelines.values import Value, last

#: The bender [mm]: short, so that a fine mesh is cheap.
LENGTH = 30

SETUP = (
    "Semicircular bender of 30 mm without hoops: void of radius 8 mm, wall 2 mm, floor and base 1.5 mm, end walls 5 "
    "mm, "
    "Elastosil M4601 (Yeoh, 0.11 and 0.02 MPa), paper of 0.1 mm in the base, one end fixed"
)


def solve(
    size: float,
    pressure: float,
    cells: str = "hexahedra",
    symmetric: bool = True,
    steps: Mapping[str, Any] | None = None,
) -> Computed:
    """Bend the bender to a pressure [kPa]; ``steps`` are options of `Static`.

    Besides angle and bulge, the response has what the solve took, the same in every row.
    """
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    paper = tg.Shell(tg.from_library("paper", record="hooke-polygerinos-2020"), thickness=0.1 * mm)
    actuator = tg.actuators.SemicircularBender(length=LENGTH * mm, symmetric=symmetric)
    model = tg.Model(
        tg.mesh(actuator.build(), size=size * mm, cells=cells),
        materials={"body": rubber, "base": rubber, "strain_limiting_layer": paper},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", pressure * kPa)],
        contact=tg.Contact(self_contact=False),
    )
    solution = tg.solve(model, tg.Static(**dict(steps or {})), throw=False)
    response = tg.measure(solution, tg.bending_angle, tg.measures.tip_displacement, TOP, mesh_error=False)
    spent = {
        "unknowns": model.mesh.unknown_count,
        "factorizations": solution.timing.factorizations,
        "rejected_steps": sum(not step.accepted for step in solution.steps),
        "iterations": sum(step.iterations for step in solution.steps),
    }
    columns = [
        tg.experiments.Column(name, "", np.full(len(solution.states), float(value))) for name, value in spent.items()
    ]
    reduced = tg.Response(
        columns=(*response.columns, *columns),
        source=response.source,
        status=response.status,
        message=response.message,
    )
    return Computed(response=reduced, picture=picture_of(solution))


def _top(at: Any) -> float:
    return float(np.abs(at.displacement).max())


#: Largest displacement anywhere: how far the wall balloons.
TOP = tg.measures.Measure(name="ballooning", unit="mm", function=_top, definition="largest displacement of any point")


def spent(computed: Computed, name: str) -> float:
    """What the solve took."""
    return float(computed.response.column(name)[-1])


def reached(computed: Computed) -> float:
    """Largest share of the load that was reached."""
    return float(computed.response.column("load_factor")[-1])


def end(computed: Computed, name: str = "bending_angle") -> Value:
    """Value of a column at the end."""
    return last(computed.response, name)
