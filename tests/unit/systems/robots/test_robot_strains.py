"""Segments of constant strain: what they state is what their numbers give."""

import json

import numpy as np
import pytest
from reduced_cases import PRESSURE, reduced

import turgor as tg
from turgor.core.engine.runtime import EngineOptions
from turgor.systems.robots.strains import placed


@pytest.fixture(scope="module")
def segments():
    return tg.robots.strain_segments(reduced(), 3, options=EngineOptions(threads=1))


def test_shapes_are_those_that_soromox_takes(segments, tmp_path):
    made = json.loads(segments.save(tmp_path / "segments.json").read_text(encoding="utf-8"))
    shapes = {key: np.shape(made[key]) for key in ("lengths", "rest", "active", "stiffness", "routing", "radius")}
    assert shapes == {
        "lengths": (3,), "rest": (3, 6), "active": (3, 6), "stiffness": (3, 6, 6), "routing": (1, 3, 6), "radius": (3,),
    }  # fmt: skip
    assert made["pressures"] == ["pressure"]
    for block, active in zip(np.array(made["stiffness"]), np.array(made["active"]), strict=True):
        assert block == pytest.approx(block.T)
        assert np.linalg.eigvalsh(block[np.ix_(active, active)]).min() > 0
        assert active.tolist() == [False, True, False, True, False, False], "bending about y, and stretch"


def test_the_stated_error_is_that_of_the_tip(segments):
    from turgor.systems.robots.backbone import backbone_of

    backbone = backbone_of(reduced(), 3)
    assert segments.error < 0.03
    away = []
    for pressure in (np.arange(20) + 0.5) / 20 * PRESSURE:
        tip = segments.tip(segments.strains(np.array([pressure])))
        away.append(np.linalg.norm(tip - backbone.frames(reduced().solve(float(pressure)).q)[1][-1]))
    assert max(away) == pytest.approx(segments.error * backbone.length, rel=1e-6)


def test_a_segment_of_constant_curvature_is_an_arc():
    radius, length = 0.05, 0.04
    end = placed(np.zeros(3), np.array([length]), np.array([[0, 1 / radius, 0, 1.0, 0, 0]]))
    angle = length / radius  # about y, so to -z
    assert end == pytest.approx([radius * np.sin(angle), 0, -radius * (1 - np.cos(angle))])
