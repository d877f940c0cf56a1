"""Bonded layers and threads before any load: a layer shrinks, was stretched, or freezes; hoops are wound tight.

Shrinkage and stretch bend the strip, as Timoshenko's formula of 1925 for bimetals says for small strains. A core of a
low-melting polymer is soft while it is warm: a force bends the strip, the core freezes, and most of the bend stays.
Hoops that are wound around a tube under tension lose a part of it, because the wall gives way.
"""

from dataclasses import dataclass
from math import pi

from netgen.occ import Box, Glue, Pnt, X

import turgor as tg
from turgor.units import MPa, deg, mm, mN

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.1 * MPa))
POLYMER = tg.Material(name="low-melting polymer", law=tg.laws.NeoHooke(C10=5 * MPa))


# %% Two layers of the same thickness, glued


@dataclass(frozen=True, kw_only=True)
class TwoLayers:
    """A strip of two layers along x, fixed at its end."""

    length: float = 40 * mm
    width: float = 6 * mm
    layer: float = 1 * mm

    def build(self):
        a, b, t = self.length / mm, self.width / mm, self.layer / mm
        solids = [Box(Pnt(0, 0, 0), Pnt(a, b, t)), Box(Pnt(0, 0, t), Pnt(a, b, 2 * t))]
        for solid, name in zip(solids, ("lower", "upper"), strict=True):
            for face in solid.faces:
                face.name = "outside"
            solid.faces.Min(X).name, solid.faces.Max(X).name = "fixed", "tip"
            solid.name = name
        shape = Glue(solids)
        for solid, name in zip(shape.solids, ("lower", "upper"), strict=True):
            solid.name = name
        return tg.Geometry(
            name="two_layers",
            smallest_wall=self.layer,
            cavity_volumes={},
            solid_volume=2 * self.length * self.width * self.layer,
            regions=("lower", "upper"),
            faces=("fixed", "outside", "tip"),
            shape=shape,
        )


def angle(solution):
    """Bending angle along the path, positive downwards [rad]."""
    return tg.measure(solution, "bending_angle", mesh_error=False)


# %% The upper layer shrinks by 0.5 %, or was stretched by 0.5 %


def bent_by(load, part=TwoLayers()):
    """Angle of the strip and that of Timoshenko, κ L with κ = 3 ε / (2 h) for equal layers of together h [rad]."""
    mesh = tg.mesh(part.build(), size=2 * mm)
    response = angle(tg.solve(tg.Model(mesh, RUBBER, "fixed", [load])))
    exact = -1.5 * 0.005 / (2 * part.layer) * part.length
    return float(response.column("bending_angle")[-1]), exact


# %% A core that melts, is bent, and freezes


def frozen(part=TwoLayers()):
    """Path of a strip whose core melts, is bent, freezes, and is released."""
    mesh = tg.mesh(part.build(), size=2 * mm)
    model = tg.Model(mesh, {"lower": POLYMER, "upper": RUBBER}, "fixed", [])
    stages = tg.Stages(
        (
            tg.Stage("melt", loads=(tg.loads.Stiffness("lower", 1e-4),)),
            tg.Stage("bend", loads=(tg.loads.Force("tip", (0, 0, -0.3 * mN)),)),
            tg.Stage("freeze", loads=(tg.loads.Hardening("lower", 1.0),)),
            tg.Stage("release", loads=(tg.loads.Force("tip", (0, 0, 0)),)),
        )
    )
    return tg.solve(model, stages)


def at_the_ends(solution):
    """Angle at the end of each stage [rad]."""
    response = angle(solution)
    ends = {name: number for number, name in enumerate(response.stages)}
    return {name: float(response.column("bending_angle")[number]) for name, number in ends.items()}


# %% Hoops that were wound under tension


def wound(stretch=1.1):
    """Force of hoops around a tube per length: when they are wound, and after the wall gave way [N/m]."""
    modulus, diameter, spacing = 50 * MPa, 0.2 * mm, 1 * mm
    hoops = tg.Fibers(
        face="outside",
        material=tg.Material(name="elastic thread", law=tg.laws.Hooke(E=modulus, nu=0.3)),
        diameter=diameter,
        winding=tg.Winding(angle_from_circumference=0.0, spacing=spacing),
        name="hoops",
    )
    mesh = tg.mesh(tg.actuators.FiberReinforcedCylinder(length=40 * mm).build(), size=4 * mm, cells="hexahedra")
    loads = [tg.loads.PreStretch("hoops", stretch)]
    solution = tg.solve(tg.Model(mesh, RUBBER, "fixed", loads, reinforcements=[hoops]))
    at_first = modulus * pi * diameter**2 / 4 * (stretch - 1) / spacing
    return at_first, tg.measures.winding_force_per_length(solution.states[-1])


if __name__ == "__main__":
    for load in (tg.loads.Shrinkage("upper", 0.005), tg.loads.PreStretch("upper", 1.005)):
        got, exact = bent_by(load)
        print(f"{load.kind}: {got / deg:.2f} deg, Timoshenko {exact / deg:.2f} deg")
    for name, value in at_the_ends(frozen()).items():
        print(f"after '{name}': {value / deg:.1f} deg")
    print("force of the hoops: {:.0f} N/m when wound, {:.0f} N/m on the tube".format(*wound()))
