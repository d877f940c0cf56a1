"""Claim 6.2-5: hexahedra follow curved geometry with less distortion, so they are the better choice."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.convergence.trials import end, spent
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.values import Value

#: Pressure [kPa], and sizes of the cells [mm] by kind, the last one as reference; the full setting has a finer one.
PRESSURE, LENGTH = 35, 30
SIZES = {"hexahedra": (8.0, 4.0, 2.5, 1.8, 1.3), "tetrahedra": (8.0, 4.0, 2.5, 1.8, 1.3, 1.0)}
FINEST = {"hexahedra": 1.0, "tetrahedra": 0.8}
KINDS = tuple(SIZES)

#: Relative difference between the finest meshes of both kinds beyond which errors cannot be distinguished.
SAME = 0.005


def bend(size: float, cells: str) -> Computed:
    """Bend a round eccentric bender with one kind of cells; what the mesh loses of its cavity, and its worst cell."""
    actuator = tg.actuators.EccentricBender(length=LENGTH * mm)
    mesh = tg.mesh(actuator.build(), size=size * mm, cells=cells)
    model = tg.Model(
        mesh,
        materials={"body": tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", PRESSURE * kPa)],
        contact=tg.Contact(self_contact=False),
    )
    response = tg.measure(tg.solve(model, throw=False), tg.bending_angle, tg.cavity_volume, mesh_error=False)
    whole = tg.actuators.EccentricBender(length=LENGTH * mm, symmetric=False).build()
    values = {
        "unknowns": mesh.unknown_count,
        "lost_volume": abs(response["cavity_volume"][0] / whole.cavity_volumes["cavity"] - 1),
        "worst_cell": tg.bodies.quality(mesh).min_jacobian_ratio,
    }
    columns = [
        tg.experiments.Column(name, "", np.full(len(response["pressure"]), float(value)))
        for name, value in values.items()
    ]
    return Computed(response=tg.Response(columns=(*response.columns, *columns), source=response.source))


def runs(setting: Setting) -> tuple[Run, ...]:
    """Both kinds of cells in every size."""
    return tuple(
        Run(name=f"{kind} of {size:g} mm", function=bend, values={"size": size, "cells": kind})
        for kind in KINDS
        for size in (*SIZES[kind], *([FINEST[kind]] if setting == "full" else []))
    )


def _of(runs: Runs, kind: str) -> list[Computed]:
    """Runs with one kind of cells, the finest last."""
    return [each for name, each in runs.items() if name.startswith(kind)]


def _errors(runs: Runs, kind: str) -> list[float]:
    """Relative error of the angle of all but the finest, against the mean of the finest of both kinds."""
    exact = sum(end(_of(runs, each)[-1]).number for each in KINDS) / len(KINDS)
    return [abs(end(each).number / exact - 1) for each in _of(runs, kind)[:-1]]


def _counts(runs: Runs, kind: str) -> list[float]:
    return [spent(each, "unknowns") for each in _of(runs, kind)[:-1]]


def judge(runs: Runs) -> Judgement:
    """Less distortion, less volume lost, and a smaller error for as many degrees of freedom."""
    finest = [end(_of(runs, kind)[-1]).number for kind in KINDS]
    apart = finest[0] / finest[1] - 1
    worst = [min(spent(each, "worst_cell") for each in _of(runs, kind)) for kind in KINDS]
    lost = [max(spent(each, "lost_volume") for each in _of(runs, kind)) for kind in KINDS]
    cheaper = [_cheaper(runs, error, count) for error, count in zip(*_curve(runs, "hexahedra"), strict=True)]
    summary = "; ".join(
        f"{kind} "
        + ", ".join(f"{error:.2%} with {n:,.0f} unknowns" for error, n in zip(*_curve(runs, kind), strict=True))
        for kind in KINDS
    )
    return Judgement(
        verdict=verdict_of([worst[0] > worst[1], lost[0] < lost[1], *cheaper])
        if abs(apart) < SAME
        else Verdict.NOT_JUDGED,
        finding=f"error of the angle: {summary}; the finest of both differ by {abs(apart):.2%}; worst Jacobian ratio "
        f"{worst[0]:.2g} of hexahedra and {worst[1]:.2g} of tetrahedra; volume of the cavity lost at most "
        f"{lost[0]:.1e} and {lost[1]:.1e}",
        conditions="Hexahedra have a smaller error than tetrahedra with as many degrees of freedom in "
        f"{sum(cheaper)} of {len(cheaper)} sizes. Both kinds are quadratic and curved here; linear elements are not "
        "compared, because turgor has none.",
    )


def _curve(runs: Runs, kind: str) -> tuple[list[float], list[float]]:
    return _errors(runs, kind), _counts(runs, kind)


def _cheaper(runs: Runs, error: float, count: float) -> bool:
    """Whether every mesh of tetrahedra with at most so many unknowns has a larger error."""
    return all(other > error for other, n in zip(*_curve(runs, "tetrahedra"), strict=True) if n <= count)


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Error of the angle, and the worst cell, against the unknowns."""
    errors = [line_of(_counts(runs, kind), [Value(100 * e) for e in _errors(runs, kind)], kind) for kind in KINDS]
    cells = [
        line_of(_counts(runs, kind), [Value(spent(each, "worst_cell")) for each in _of(runs, kind)[:-1]], kind)
        for kind in KINDS
    ]
    return (
        tg.pictures.Panel(x="unknowns", y="error of the angle [%]", lines=errors),
        tg.pictures.Panel(x="unknowns", y="worst Jacobian ratio", lines=cells),
    )


GUIDELINE = Guideline(
    key="6.2-5",
    rule="A mesh of quadratic elements, mostly hexahedra, is preferable, because hexahedra are less distorted along "
    "curved geometry.",
    sources=("Xavier et al. 2021",),
    families=("eccentric_bender",),
    studies=(
        GuidelineTest(
            title="Hexahedra and tetrahedra",
            setup=f"Eccentric bender of {LENGTH} mm, round inside and outside, without a sheet, Elastosil M4601 (Yeoh, "
            f"0.11 and 0.02 MPa), {PRESSURE} kPa; quadratic hexahedra swept along the axis, or quadratic tetrahedra, "
            "in several sizes.",
            expected="Hexahedra have the less distorted elements, lose less of the volume of the cavity, and have the "
            "smaller error for as many degrees of freedom.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
