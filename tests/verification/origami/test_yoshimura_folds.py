"""Yoshimura bellows: vacuum shortens it by more with more folds and with deeper ones, and does not twist it.

Problem: a film of 1 mm and 20 MPa at -6 kPa, a rigid end plate that may move and turn; one, two, three folds; valleys
of 18, 15 and 12 mm below crests of 20 mm.
Reference: folds in series add as much each; a single one adds less, because rim and plate hold it on both sides. Deeper
folds need less stretch for the same way: a slanted edge that keeps its length moves the valley inwards, by a share of
its radius that falls with the depth. No row leans to a side.
Tolerance: 10 % between the second and the third fold; signs; 1e-6 degrees of twist.
"""

from functools import lru_cache

import numpy as np
import pytest

import problems
import turgor as tg
from turgor.units import MPa, kPa, mm


@lru_cache
def shortened(folds, inner):
    """Way [mm] and twist [deg] of the end plate."""
    mesh = tg.mesh(tg.actuators.YoshimuraBellows(folds=folds, inner_radius=inner * mm), size=20 * mm)
    film = tg.Material(name="film", law=tg.laws.Hooke(E=20 * MPa, nu=0.45))
    supports = ["fixed", tg.supports.ReferencePoint("end", "tip")]
    sheets = {"film": tg.Shell(film, 1 * mm), "tip": tg.Shell(film, 5 * mm)}
    model = tg.Model(mesh, sheets, supports, [tg.Pressure("cavity", -6 * kPa)])
    last = problems.solve(model, tg.Static(first_step=0.5, max_step=0.5)).states[-1]
    turned = last.points["end"].rotation
    moved = last.displacement[mesh.face_nodes("tip"), 0].mean()
    return -moved / mm, np.rad2deg(np.arctan2(turned[2, 1], turned[1, 1]))


def test_each_fold_adds_as_much_and_none_twists(record_verification):
    ways, twists = np.transpose([shortened(folds, 12) for folds in (1, 2, 3)])
    added = tuple(np.diff(ways))
    record_verification(
        claim="Yoshimura bellows at -6 kPa: way that the second and the third fold add [mm]",
        source="folds in series", expected="equal", got=added, tolerance="10 %",
    )  # fmt: skip
    assert added[1] == pytest.approx(added[0], rel=0.1)
    assert added[0] > ways[0]  # rim and plate hold the first
    assert np.abs(twists).max() < 1e-6


def test_deeper_folds_shorten_further(record_verification):
    ways = tuple(shortened(2, inner)[0] for inner in (18, 15, 12))
    record_verification(
        claim="Yoshimura bellows at -6 kPa, valleys of 18, 15 and 12 mm below crests of 20 mm: way [mm]",
        source="guideline", expected="rises by a fifth at least", got=ways, tolerance="sign",
    )  # fmt: skip
    assert 1.2 * ways[0] < ways[1]
    assert 1.2 * ways[1] < ways[2]
