"""Derivatives of training states by inputs are those of solves at other inputs."""

import numpy as np
import pytest

import turgor as tg
from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.runtime import EngineOptions
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.reduced.training.box import inputs_of
from turgor.reduced.training.trainer import Trainer
from turgor.units import MPa, kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.02 * MPa))


def test_faces_of_one_pressure_have_their_own_derivatives() -> None:
    """The full model joins faces whose pressure is the same; as inputs they differ, at the corners of a box, too."""
    mesh = swept_mesh(tg.FastPneuNet(chambers=1, length=12 * mm).build(), Fineness(size=6 * mm))
    loads = [tg.Pressure("cavity", 1 * kPa), tg.Pressure("tip", 1 * kPa)]
    model = tg.Model(mesh, {"body": RUBBER, "base": RUBBER}, [tg.Fixed("fixed")], loads)
    box = inputs_of(model, {f"loads.{face}.pressure": (0.0, 1 * kPa) for face in ("cavity", "tip")})
    trainer = Trainer(model_variation(model, list(box.keys), inputs=True).model, box, 2, EngineOptions(threads=1))
    values, step = np.array([1 * kPa, 1 * kPa]), 1.0
    rates = trainer.path(values).derivatives[0]
    assert len(rates) == 4  # at two states
    for place, change in enumerate(step * np.eye(2)):
        ends = [trainer.path(values + sign * change, False).displacements[-1].ravel() for sign in (1, -1)]
        slope = (ends[0] - ends[1]) * (1 * kPa / (2 * step))
        assert rates[2 + place] == pytest.approx(slope, abs=1e-3 * np.abs(slope).max())
