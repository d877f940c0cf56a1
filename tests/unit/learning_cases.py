"""A chamber with a force on its tip and its reduced model of two inputs, which tests on learning and exports share."""

from functools import cache

import turgor as tg
from turgor.core.engine.runtime import EngineOptions
from turgor.core.meshing.sweeping.section import Fineness
from turgor.core.meshing.sweeping.swept import swept_mesh
from turgor.reduced.reduce import Budget, reduce
from turgor.reduced.states.reduced import Reduced
from turgor.units import MPa, kPa, mm


@cache
def chamber() -> tg.Model:
    """Half of a chamber of soft rubber."""
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.02 * MPa), density=1100.0)
    mesh = swept_mesh(tg.FastPneuNet(chambers=1, length=12 * mm).build(), Fineness(size=6 * mm))
    loads = [tg.Pressure("cavity", 1 * kPa), tg.loads.Force("tip", (0, 0, 0.01))]
    return tg.Model(mesh, {"body": rubber, "base": rubber}, [tg.Fixed("fixed")], loads)


@cache
def pushed() -> Reduced:
    """Two seconds of full solves."""
    box = {"loads.pressure": (0.0, 1e3), "loads.tip.vector.3": (-0.01, 0.01)}
    return reduce(chamber(), box, budget=Budget(held_out=0, steps=3, paths=4), options=EngineOptions(threads=1))
