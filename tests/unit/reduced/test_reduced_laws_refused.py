"""Reduced models refuse by name what they do not know: foams, directions, networks that flow."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.engine.system import System
from turgor.fast_models.section.rubber import rubber_of
from turgor.reduced.training.assembly import _rubber
from turgor.units import mm

PRINT = tg.Material(
    name="part",
    law=tg.laws.Orthotropic(C10=1e6, a1=1e5),
    orientation=tg.laws.Orientation(along=(1, 0, 0), across=(0, 1, 0)),
)
FOAM = tg.Material(name="part", law=tg.laws.BlatzKo(mu=3e4))
FLOWING = tg.laws.BergstromBoyce(stiffness=1.6, rate=0.1, stress=1e5, exponent=4.0)


@pytest.mark.parametrize(
    ("changes", "what"),
    [
        ({"viscoelasticity": FLOWING}, "Bergström and Boyce"),
        ({"permanent_set": tg.laws.PermanentSet(stress=1e6, exponent=2.0)}, "a permanent_set"),
    ],
)
def test_they_say_what_they_do_not_remember(changes, what):
    material = tg.Material(name="part", law=tg.laws.NeoHooke(C10=1e5), **changes)
    mesh = tg.mesh(tg.FastPneuNet(chambers=1, length=10 * mm).build(), size=5 * mm)
    system = System(tg.Model(mesh, material, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1e3)]))
    with refused("materials.", "'part'", what, "reduced model"):
        _rubber(system, np.zeros((system.size, 1)))


@pytest.mark.parametrize(("material", "what"), [(PRINT, "directions"), (FOAM, "foam")])
def test_they_say_which_material_they_do_not_take(material, what):
    mesh = tg.mesh(tg.FastPneuNet(chambers=1, length=10 * mm).build(), size=5 * mm)
    model = tg.Model(mesh, material, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1e3)])
    system = System(model)
    with refused("materials.", "'part'", what):
        _rubber(system, np.zeros((system.size, 1)))
    with refused("materials.", "'part'", what, "section"):
        rubber_of(model, None, 1e5)
