"""A law, an actuator and a measure of your own, without a change in turgor: each is a few lines in your file.

A box with a square cavity swells. An exponential law stiffens, so that its roof rises less than with the neo-Hookean
law of the same shear modulus.
"""

from dataclasses import dataclass

import sympy
from netgen.occ import Box, Pnt, Z

import turgor as tg
from turgor.units import MPa, kPa, mm


@dataclass(frozen=True, kw_only=True)
class Exponential:
    """W = μ/(2b) (exp(b (Ī₁ − 3)) − 1) (Demiray 1972): a law needs its energy and its shear modulus."""

    mu: float
    b: float

    def energy(self, I1, I2):
        return self.mu / (2 * self.b) * (sympy.exp(self.b * (I1 - 3)) - 1)

    @property
    def shear_modulus(self):
        return self.mu


@dataclass(frozen=True, kw_only=True)
class Bladder:
    """A box with a cavity: an actuator needs dimensions and ``build()``."""

    side: float = 20 * mm
    wall: float = 2 * mm

    def build(self):
        a, t = self.side / mm, self.wall / mm  # CAD lengths are in mm
        room = Box(Pnt(t, t, t), Pnt(a - t, a - t, a - t))
        for face in room.faces:
            face.name = "cavity"
        shape = Box(Pnt(0, 0, 0), Pnt(a, a, a)) - room
        for face in shape.faces:
            face.name = face.name or "outside"
        shape.faces.Min(Z).name = "fixed"
        shape.faces.Max(Z).name = "tip"
        shape.solids[0].name = "body"
        hollow = (self.side - 2 * self.wall) ** 3
        return tg.Geometry(
            name="bladder",
            smallest_wall=self.wall,
            cavity_volumes={"cavity": hollow},
            solid_volume=self.side**3 - hollow,
            regions=("body",),
            faces=("cavity", "fixed", "outside", "tip"),
            shape=shape,
        )


rise = tg.measures.Measure(
    name="rise", unit="mm", function=lambda at: at.displacement[:, 2].max(), definition="largest displacement along z"
)

mesh = tg.mesh(Bladder().build())
risen = {}
for law in (tg.laws.NeoHooke(C10=0.1 * MPa), Exponential(mu=0.2 * MPa, b=3.0)):
    rubber = tg.Material(name=type(law).__name__, law=law)
    model = tg.Model(mesh, {"body": rubber}, [tg.Fixed("fixed")], [tg.Pressure("cavity", 30 * kPa)])
    response = tg.measure(tg.solve(model), rise)
    risen[rubber.name] = response.column("rise")[-1] / mm
    print(f"{rubber.name}: the roof rises by {risen[rubber.name]:.2f} mm")

assert abs(risen["Exponential"] / 3.20 - 1) < 0.02 and risen["NeoHooke"] > 4
