"""Terms: one that is written here, in one file, enters the equations by the one list; its tangent is exact."""

from dataclasses import dataclass

import numpy as np
import pytest

import turgor as tg
from turgor.core.engine import terms
from turgor.core.engine.system import System
from turgor.core.engine.term import Term, displacements, lower
from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.model.history import RAMP, History
from turgor.core.model.loads import Load

STIFFNESS = 0.3


@dataclass(frozen=True)
class Springs(Term):
    """Springs between pairs of nodes that no cell ties, of zero length at rest."""

    couples = True

    nodes: np.ndarray
    apart: np.ndarray

    @property
    def unknowns(self):
        return displacements(self.nodes)

    def _stretched(self, position):
        return position[self.nodes[:, 1]] - position[self.nodes[:, 0]] - self.apart

    def add_forces(self, out, at):
        pull = STIFFNESS * self._stretched(at.position)
        np.add.at(out, self.nodes[:, 1], pull)
        np.add.at(out, self.nodes[:, 0], -pull)

    def energy(self, position):
        return 0.5 * STIFFNESS * float((self._stretched(position) ** 2).sum())

    def tangents(self, at, stresses):
        one = STIFFNESS * np.kron([[1.0, -1.0], [-1.0, 1.0]], np.eye(3))
        return lower(np.repeat(one[None], len(self.nodes), axis=0))


@dataclass(frozen=True)
class Laced(Load):
    """A load whose forces are those of the springs."""

    history: History = RAMP

    def terms(self, setting):
        return springs(setting)


def springs(setting):
    nodes = np.column_stack([np.arange(4), len(setting.points) - 1 - np.arange(4)])
    return [Springs(nodes, setting.points[nodes[:, 1]] - setting.points[nodes[:, 0]])]


@pytest.fixture
def model():
    mesh = tg.mesh(FastPneuNet(chambers=1, length=10e-3).build(), size=4e-3)
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.5e5))
    return tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 2e3)])


def test_a_term_of_ones_own_needs_one_name_in_the_list(model, monkeypatch):
    plain = System(model)
    monkeypatch.setattr(terms, "TERMS", (*terms.TERMS, springs))
    system = System(model)
    rng = np.random.default_rng(1)
    x, way = (rng.normal(0, 0.01, system.size) for _ in range(2))
    free, h = ~system.prescribed, 1e-6
    x[system.prescribed] = way[system.prescribed] = 0.0  # a cavity with a fixed rim has a potential
    change = (system.residual(x + h * way, 1.0) - system.residual(x - h * way, 1.0)) / (2 * h)
    assert (system.tangent(x, 1.0) @ way)[free] == pytest.approx(change[free], abs=1e-6 * np.abs(change).max())
    added = system.residual(x, 1.0) - plain.residual(x, 1.0)
    place, without = (each.terms.energy(each.points + each.split(x)[0], 1.0) for each in (system, plain))
    assert np.abs(added).max() > 0
    assert place - without == pytest.approx(0.5 * float(added @ x), rel=1e-9)


def test_a_load_brings_its_own_term(model, monkeypatch):
    laced = System(tg.Model(model.mesh, model.materials, model.supports, [*model.loads, Laced()]))
    plain = System(model)
    monkeypatch.setattr(terms, "TERMS", (*terms.TERMS, springs))
    x = np.random.default_rng(2).normal(0, 0.01, plain.size)
    assert laced.residual(x, 1.0) == pytest.approx(System(model).residual(x, 1.0), abs=1e-12)
    assert np.abs(laced.residual(x, 1.0) - plain.residual(x, 1.0)).max() > 0
