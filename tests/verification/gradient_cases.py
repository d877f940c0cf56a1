"""Small models for the checks of gradients: one for each kind of number and of procedure, as a function of values."""

from collections.abc import Callable, Mapping
from dataclasses import dataclass, replace

import numpy as np
from netgen.occ import Box, Pnt, Sphere

import contact_cases
import meshes
import problems
import turgor as tg
from problems import MPA
from turgor.accuracy.gradients.moved_mesh import on_moved_mesh
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.model.obstacles import Plane
from turgor.core.results.measures.measures import find_measure
from turgor.units import kPa, mm

Values = Mapping[str, float]

#: Where differences of whole solves are taken the tolerance must not show.
EXACT = {"tolerance": 1e-11, "max_iterations": 30}

#: Steps of a path that is short enough for few of them.
FEW = {"first_step": 0.5, "max_step": 0.5}

#: Changes for Taylor's theorem where a measure is so nearly linear that the third derivative would show.
NEAR = (0.005, 0.0025)


@dataclass(frozen=True)
class Case:
    """A model and its procedure as functions of numbers, and what is measured."""

    model: Callable[[Values], tg.Model]
    values: Values
    measures: tuple
    procedure: Callable[[Values], object] = lambda values: tg.Static(**FEW)
    changes: tuple[float, float] = (0.02, 0.01)  # for Taylor's theorem, as shares of the value

    @property
    def variation(self) -> tg.studies.Variation:
        """What `turgor.gradient` takes."""
        return tg.studies.Variation(self.model, self.values, procedure=self.procedure)

    def solve(self, values: Values) -> tg.Solution:
        """The path at values."""
        return problems.solve(self.model(values), self.procedure(values))

    def measured(self, values: Values, guide: tg.Solution) -> np.ndarray:
        """The measures of the last state, found exactly; the path at other values leads straight to it.

        Tetrahedra are those of the guide, moved along with the shape.
        """
        procedure = replace(self.procedure(values), **EXACT)
        model = on_moved_mesh(self.variation, guide.model.mesh).model(values)
        relaxes = any(material.viscoelasticity for material in model.region_materials.values())
        led = {"guide": guide} if isinstance(procedure, tg.Static) and not relaxes else {}
        state = problems.solve(model, replace(procedure, max_step=1.0) if led else procedure, **led).states[-1]
        return np.array([state.pressures["cavity"] if each == "pressure" else each(state) for each in self.measures])


def _moved(axis: int) -> tg.measures.Measure:
    """Largest displacement along an axis at the end of a bar."""

    def mean(at):
        return float(at.displacement[at.mesh.face_nodes("x1")][:, axis].mean())

    return tg.measures.Measure(name=f"moved_{'xyz'[axis]}", unit="mm", function=mean, definition="mean motion of x1")


RISE, STRETCH = _moved(2), _moved(0)
STRESS, REACTION = (find_measure(name) for name in ("von_mises_p99", "reaction"))


def bar(length: float = 30 * mm, height: float = 4 * mm) -> tg.Mesh:
    """A bar of 5 × 1 × 2 hexahedra, of which y0 is a mirror plane."""
    made = meshes.box((length, 4 * mm, height), (5, 1, 2), kind=HEXAHEDRON)
    return replace(made, faces={"symmetry_y" if name == "y0" else name: face for name, face in made.faces.items()})


def bent(values: Values) -> tg.Model:
    """A bar under pressure on its lower side, whose rim slides, with a sheet on its upper side and its own weight."""
    given = {
        "C10": 0.11 * MPA, "C20": 0.02 * MPA, "bulk": 2 * MPA, "density": 1070.0, "pressure": 0.5 * kPa,
        "thickness": 0.1 * mm, "E": 1 * MPA, "pull": 2 * kPa, "length": 30 * mm, "height": 4 * mm, **values,
    }  # fmt: skip
    law = tg.Yeoh(C10=given["C10"], C20=given["C20"])
    sheet = tg.Membrane(tg.Material(name="sheet", law=tg.laws.Hooke(E=given["E"], nu=0.3)), given["thickness"])
    return tg.Model(
        bar(given["length"], given["height"]),
        {"body": problems.rubber(law, given["bulk"], given["density"]), "z1": sheet},
        [tg.Fixed("x0")],
        [tg.Pressure("z0", given["pressure"]), tg.Traction("x1", (given["pull"], 0, 0)), tg.Gravity((0, 0, -1))],
    )


def relaxed(values: Values) -> tg.Model:
    """The bar of rubber that has relaxed."""
    model = bent({})
    material = replace(
        model.materials["body"], viscoelasticity=Prony(g=(values["g"],), tau=(1.0,), moduli="instantaneous")
    )
    return replace(model, materials={**model.materials, "body": material})


def wound(values: Values) -> tg.Model:
    """A quarter of a tube under pressure, wound with threads that are spread over its surface."""
    given = {"diameter": 0.2 * mm, "spacing": 2 * mm, "angle": 1.1, "E": 200 * MPA, **values}
    mesh = meshes.tube_sector(5 * mm, 7 * mm, 3 * mm, (2, 3, 1), kind=HEXAHEDRON)
    thread = tg.Material(name="thread", law=tg.laws.Hooke(E=given["E"], nu=0.3))
    winding = tg.Winding(angle_from_axis=given["angle"], spacing=given["spacing"], hand="both", axis=(0, 0, 1))
    fibers = tg.Fibers(face="outside", material=thread, diameter=given["diameter"], winding=winding)
    return tg.Model(
        mesh, {"body": problems.rubber(problems.YEOH)}, [tg.Fixed("z0", "z")], [tg.Pressure("cavity", 20 * kPa)],
        reinforcements=[fibers],
    )  # fmt: skip


def pressed(values: Values) -> tg.Model:
    """A block that stands under a plate, which comes down by 1 mm without friction."""
    given = {"C10": 0.12 * MPA, "height": 5.0, **values}
    plate = contact_cases.pushed(Plane(point=(0, 0, 5.2 * mm), normal=(0, 0, -1)), (0, 0, -1.2))
    mesh = contact_cases.block((2, 2, 1), (10, 10, given["height"]))
    return contact_cases.standing(mesh, plate, law=tg.laws.NeoHooke(C10=given["C10"]))


def ball(values: Values, around: int = 1, through: int = 2) -> tg.Model:
    """One eighth of a thick sphere."""
    given = {"C10": 0.12 * MPA, "inner": 10 * mm, "outer": 15 * mm, **values}
    mesh = meshes.sphere_octant(given["inner"], given["outer"], around, through)
    return problems.one_material(mesh, tg.laws.NeoHooke(C10=given["C10"]))


def turned(values: Values) -> tg.Model:
    """A tube with caps on an axisymmetric mesh: rings of nodes move alike."""
    tube = tg.actuators.ExtendingCylinder(length=30 * mm, wall=values["wall"])
    mesh = tg.mesh(tube.build(), cells="axisymmetric", size=4 * mm)
    materials = dict.fromkeys(mesh.regions, problems.rubber(tg.Yeoh(C10=values["C10"], C20=0.02 * MPA)))
    return tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", 20 * kPa)])


def in_tetrahedra(geometry: Geometry, size: float, pressure: float, C10: float = 0.11 * MPA) -> tg.Model:
    """A part of one rubber under pressure, of tetrahedra."""
    mesh = tg.mesh(geometry, size=size, cells="tetrahedra")
    materials = dict.fromkeys(mesh.regions, problems.rubber(tg.Yeoh(C10=C10, C20=0.02 * MPA)))
    return tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", pressure)])


def finger(values: Values) -> tg.Model:
    """Half of a fast PneuNet of one chamber, of two bodies."""
    return in_tetrahedra(tg.FastPneuNet(chambers=1, length=20 * mm, **values).build(), 8 * mm, 10 * kPa)


def stopped(values: Values) -> tg.Model:
    """The finger with its tip held by a gauge."""
    return tg.setups.blocked_force(finger(values), hold="xyz", direction="-z")


def tube(values: Values) -> tg.Model:
    """A quarter of a tube with caps."""
    return in_tetrahedra(tg.actuators.ExtendingCylinder(**values).build(), 8 * mm, 20 * kPa)


def rounded(values: Values) -> tg.Model:
    """A quarter of a closed box with rounded edges, drawn by the functions of the CAD kernel."""
    wall, fillet, length = values["wall"] / mm, values["fillet"] / mm, 20
    a = 6 - wall
    outer, inner = Box(Pnt(0, -6, -6), Pnt(length, 6, 6)), Box(Pnt(3, -a, -a), Pnt(length - 3, a, a))
    outer, inner = outer.MakeFillet(outer.edges, fillet + wall), inner.MakeFillet(inner.edges, fillet)
    quarter = Box(Pnt(2, 0, 0), Pnt(length, 6, 6))
    inner.faces.name, outer.faces.name, quarter.faces.name = "cavity", "outside", "outside"
    quarter.faces.Min((1, 0, 0)).name, quarter.faces.Min((0, 1, 0)).name = "fixed", "symmetry_y"
    quarter.faces.Min((0, 0, 1)).name = "symmetry_z"
    outer.faces.Max((1, 0, 0)).name = "tip"
    shape = (outer - inner) * quarter
    shape.solids.name = "body"
    return in_tetrahedra(drawn(shape, values["wall"]), 3 * mm, 10 * kPa)


def drawn(shape, wall: float) -> Geometry:
    """A part drawn by the functions of the CAD kernel, whose solids and faces have names."""
    return Geometry(
        name="drawn part", smallest_wall=wall, cavity_volumes={}, solid_volume=shape.mass * 1e-9,
        regions=tuple(str(solid.name) for solid in shape.solids),
        faces=tuple(sorted({str(face.name) for face in shape.faces})), shape=shape,
    )  # fmt: skip


def ball_in_tetrahedra(values: Values) -> tg.Model:
    """The eighth of a thick sphere of tetrahedra."""
    inner, outer = (Sphere(Pnt(0, 0, 0), values[name] / mm) for name in ("inner", "outer"))
    eighth = Box(Pnt(0, 0, 0), Pnt(20, 20, 20))
    inner.faces.name, outer.faces.name = "cavity", "outside"
    for number, axis in enumerate("xyz"):
        eighth.faces.Min(tuple(np.eye(3)[number])).name = f"symmetry_{axis}"
    shape = eighth * (outer - inner)
    shape.solids.name = "body"
    mesh = tg.mesh(drawn(shape, values["outer"] - values["inner"]), size=1.5 * mm, cells="tetrahedra")
    return problems.one_material(mesh, tg.laws.NeoHooke(C10=values["C10"]))


VOLUME = tg.cavity_volume
FORCE, BLOCKED = (find_measure(name) for name in ("plate_force", "blocked_force"))
GIVEN = {"C10": 0.11 * MPA, "C20": 0.02 * MPA, "bulk": 2 * MPA, "density": 1070.0}

CASES = {
    "constants of the material": Case(bent, GIVEN, (RISE, STRESS, REACTION)),
    "loads": Case(bent, {"pressure": 0.5 * kPa, "pull": 2 * kPa}, (RISE, STRETCH, REACTION)),
    "a sheet": Case(bent, {"thickness": 0.1 * mm, "E": 1 * MPA}, (RISE, STRESS)),
    "dimensions": Case(bent, {"length": 30 * mm, "height": 4 * mm}, (RISE, STRETCH, STRESS)),
    "a winding": Case(
        wound, {"diameter": 0.2 * mm, "spacing": 2 * mm, "angle": 1.1, "E": 200 * MPA}, (VOLUME, STRESS)
    ),
    "rubber that has relaxed": Case(relaxed, {"g": 0.3}, (RISE, STRESS)),
    "contact": Case(pressed, {"C10": 0.12 * MPA, "height": 5.0}, (FORCE,), lambda values: tg.Static(max_step=0.25)),
    "an axisymmetric mesh": Case(turned, {"C10": 0.11 * MPA, "wall": 2 * mm}, (VOLUME, tg.tip_displacement)),
    "a given volume": Case(
        ball, {"C10": 0.12 * MPA, "inner": 10 * mm, "injected": 3e-6}, ("pressure", STRESS),
        lambda values: tg.VolumeControl(volume=values["injected"], **FEW),
    ),
    "an amount of gas": Case(
        ball, {"C10": 0.12 * MPA, "outer": 15 * mm, "ratio": 2.0}, ("pressure", VOLUME),
        lambda values: tg.GasMass(mass_ratio=values["ratio"], **FEW),
    ),
    "tetrahedra, a finger": Case(
        finger, {"side_wall": 2 * mm, "height": 15 * mm, "base": 2 * mm}, (tg.bending_angle, VOLUME)
    ),
    "tetrahedra, the tip held": Case(stopped, {"top_wall": 2 * mm, "width": 20 * mm}, (BLOCKED,)),
    "tetrahedra, a tube": Case(
        tube, {"wall": 2 * mm, "inner_radius": 5 * mm, "length": 25 * mm}, (VOLUME, tg.tip_displacement)
    ),
    "tetrahedra, fillets": Case(
        rounded, {"wall": 2 * mm, "fillet": 1.5 * mm}, (VOLUME, tg.tip_displacement), changes=NEAR
    ),
}  # fmt: skip
