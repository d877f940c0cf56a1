"""Reduced models refuse laws that they do not know by name: foams, and materials with directions."""

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


@pytest.mark.parametrize(("material", "what"), [(PRINT, "directions"), (FOAM, "foam")])
def test_they_say_which_material_they_do_not_take(material, what):
    mesh = tg.mesh(tg.FastPneuNet(chambers=1, length=10 * mm).build(), size=5 * mm)
    model = tg.Model(mesh, material, [tg.Fixed("fixed")], [tg.Pressure("cavity", 1e3)])
    system = System(model)
    with refused("materials.", "'part'", what):
        _rubber(system, np.zeros((system.size, 1)))
    with refused("materials.", "'part'", what, "section"):
        rubber_of(model, None, 1e5)
