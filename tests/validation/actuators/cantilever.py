"""The cantilever of the ETH recordings: a clamped block of Dragon Skin 10 under its weight and a load at its tip.

The block is 100 × 30 × 30 mm (x from the clamp to the tip, z up), modeled as the half with y <= 0 in cells of 27 nodes.
Its clamped face is held, as in the model of the authors. Markers stand 6 mm off the surface, where the authors say.
"""

from typing import Any

import numpy as np
from measured_tables import DATA, table
from scipy.optimize import least_squares

import turgor as tg
from meshes import box
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.foundation.response import Column
from turgor.foundation.source import Source
from turgor.studies.runs.run import Computed, Run
from turgor.units import kPa, mm

FOLDER = DATA / "eth-dragonskin10-beam"
LOAD = 0.51012  # N, of 52 g
DENSITY = 1070.0  # kg/m³
#: In the frame of the model: the authors count x from the tip, y from a side and z from the bottom.
MARKERS = {"tip1": (100 * mm, 0.0, 36 * mm), "tip2": (100 * mm, -21 * mm, 24 * mm), "tip3": (100 * mm, 21 * mm, 6 * mm)}
CLAMP = ("base1", "base2", "base3")
RECORDS = ("neo-hooke-polygerinos-2020", "neo-hooke-connolly-2017", "yeoh-caasenbrood-2020", "ogden-nuthi-2018",
           "hooke-bilodeau-2018")  # fmt: skip
#: Cells along, across the half and up: the mesh of all runs, and a finer one for its error.
COARSE, FINE = (8, 2, 4), (16, 4, 8)
SOURCE = Source(text="turgor, clamped block of 27-node hexahedra")


def rubber(record: str, modulus_kPa: float) -> tg.Material:
    """A record of the library, or neo-Hookean rubber of a Young's modulus: a calibrated one, or that of Hooke's law."""
    result = None if record == "calibrated" else tg.from_library("dragon-skin-10", record=record)
    if result is not None and not isinstance(result.law, tg.laws.Hooke):
        return result
    modulus = modulus_kPa * kPa if result is None else result.law.E
    return tg.Material(name=record, law=tg.laws.NeoHooke(C10=modulus / 6), density=DENSITY)


def hangs(record: str, modulus_kPa: float = 0.0, cells: tuple[int, int, int] = COARSE) -> Computed:
    """How far each marker sinks: without load, under the weight, and with the load at the upper edge of the tip."""
    mesh = box((100 * mm, 15 * mm, 30 * mm), tuple(cells), lambda at: at - [0, 15 * mm, 0], kind=HEXAHEDRON)
    edge = tg.loads.LineForce(("x1", "z1"), (0, 0, -LOAD / (30 * mm)))
    model = tg.Model(
        mesh,
        materials={"body": rubber(record, modulus_kPa)},
        supports=[tg.Fixed("x0"), tg.supports.Symmetry("y1")],
        loads=[],
    )
    weight = tg.Stage("weight", loads=[tg.Gravity((0, 0, -1))])
    solution = tg.solve(model, tg.Stages([weight, tg.Stage("load", loads=[edge])]))
    measures = [each for name, place in MARKERS.items() for each in tg.measures.marker(name, place)]
    response = tg.measure(solution, *measures, mesh_error=False)
    stages = [state.stage for state in solution.states]
    rows = [0, max(n for n, name in enumerate(stages) if name == "weight"), len(stages) - 1]
    columns = [Column("tip_load", "N", np.array([0.0, 0.0, LOAD]))]
    for name in MARKERS:
        for axis in "xz":
            places = response.column(f"{name}_{axis}")[rows]
            columns.append(Column(f"{name}_{axis}_moved", "mm", places - places[0]))
    return Computed(response=tg.Response(columns=tuple(columns), source=SOURCE))


def calibrated(of_clamp: bool) -> Computed:
    """As `hangs`, with the modulus that fits the recordings without load best; the loaded ones stay out."""
    aim = np.mean([track[:, 2] for name, track in measured(of_clamp=of_clamp).items() if "gravity" in name], axis=0)

    def off(log_modulus: np.ndarray) -> np.ndarray:
        return sinks(hangs("calibrated", float(np.exp(log_modulus[0]))).response)[0] - aim

    modulus = float(np.exp(least_squares(off, [np.log(250.0)], diff_step=0.01, xtol=1e-4).x[0]))
    result = hangs("calibrated", modulus).response
    column = Column("modulus", "kPa", np.full(3, modulus * kPa))
    return Computed(response=tg.Response(columns=(*result.columns, column), source=SOURCE))


def runs() -> list[Run]:
    """Blind runs, one of them on a finer mesh, and the calibrated ones."""
    return [
        *(Run(name=record, function=hangs, values={"record": record}) for record in RECORDS),
        Run(name="fine", function=hangs, values={"record": RECORDS[0], "cells": list(FINE)}),
        Run(name="calibrated", function=calibrated, values={"of_clamp": False}),
        Run(name="calibrated, of clamp", function=calibrated, values={"of_clamp": True}),
    ]


def measured(*, of_clamp: bool) -> dict[str, np.ndarray]:
    """Motion of the tip markers of each recording, (3 markers, 3) [mm]: along the beam, across it, up.

    With ``of_clamp`` the rigid motion of the three markers on the clamp is taken out.
    """
    rows = table(FOLDER / "static_marker_displacements.csv")
    results = {}
    for recording in dict.fromkeys(row["recording"] for row in rows):
        points = {row["marker"]: _track(row) for row in rows if row["recording"] == recording}
        tracks = tg.experiments.Tracks(drive=Column("frame", "", np.arange(2.0)), points=points, source=SOURCE)
        tracks = tracks.relative_to(*CLAMP) if of_clamp else tracks
        moved = np.array([tracks.of(name)[1] - tracks.of(name)[0] for name in MARKERS]) / mm
        results[recording] = np.column_stack([moved[:, 2], moved[:, 1], moved[:, 0]])
    return results


def lifted(*, of_clamp: bool) -> np.ndarray:
    """What the load alone does, from one rest to the other: (2 pairs of recordings, 3 markers) [mm], positive up.

    The start, held by hand, does not enter. The camera's frame is that of the clamp at the end of the first recording.
    """
    rows = table(FOLDER / "static_marker_displacements.csv")
    results = []
    for letter in "ab":
        pairs = {}
        for row in rows:
            if row["recording"] in (f"beam_gravity_V2_{letter}", f"beam_load52_V2_{letter}"):
                pairs.setdefault(row["marker"], []).append(_track(row)[1])
        points = {name: np.array(track) for name, track in pairs.items()}
        tracks = tg.experiments.Tracks(drive=Column("frame", "", np.arange(2.0)), points=points, source=SOURCE)
        tracks = tracks.relative_to(*CLAMP) if of_clamp else tracks
        results.append([(tracks.of(name)[1, 0] - tracks.of(name)[0, 0]) / mm for name in MARKERS])
    return np.array(results)


def _track(row: dict[str, Any]) -> np.ndarray:
    """First and last place of a marker, (2, 3) [m]."""
    return np.array([[float(row[f"{when}_{axis}_mm"]) * mm for axis in "xyz"] for when in ("start", "end")])


def sinks(response: tg.Response) -> np.ndarray:
    """Computed motion upwards, (2 loads, 3 markers) [mm]: under the weight, and with the load."""
    return np.array([response.column(f"{name}_z_moved")[1:] for name in MARKERS]).T / mm
