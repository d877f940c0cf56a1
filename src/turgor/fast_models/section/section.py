"""Section: the cross-section of a long actuator, and its answer to pressures, forces and moments."""

from collections.abc import Mapping, Sequence
from dataclasses import dataclass
from types import MappingProxyType
from typing import Protocol

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.runtime import use_threads
from turgor.core.geometry.cad.planes.plane_cut import PlaneCut, plane_cut
from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.fibers import Fibers
from turgor.core.model.model import Model
from turgor.core.model.sheets import Sheet
from turgor.core.model.supports import Support
from turgor.core.solvers.solution import Status
from turgor.fast_models.section.equations import Equations, Question
from turgor.fast_models.section.path import follow
from turgor.fast_models.section.section_cases import Rows, questions_of
from turgor.fast_models.section.shapes.cut import slice_of_cut
from turgor.fast_models.section.shapes.sketch import Sketch
from turgor.fast_models.section.shapes.slices import slice_of_geometry, slice_of_mesh
from turgor.fast_models.section.solution import SectionError, SectionSolution, solution_of
from turgor.foundation.display import Shown, listed
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.source import Source
from turgor.units import kPa

Array = NDArray[np.float64]

CLOSED, OPEN = "closed", "open"


class Actuator(Protocol):
    """A family: its dimensions and what builds it."""

    def build(self) -> Geometry:
        """Build the solids."""


@dataclass(frozen=True, slots=True, init=False, eq=False)
class Section(Shown):
    """The cross-section of a long actuator: uniform stretch, curvature and twist, and all the warping that they bring.

    Far from its ends every section of a long prismatic actuator is like every other: the actuator is bent to an arc or
    a helix. Then the section alone is enough. It is solved in its own unknowns, three displacements at every point and
    the four strains of the rod, without any assumption on how it warps (see the page on theory).

    Parameters
    ----------
    shape : actuator, Geometry, Mesh, Sketch or PlaneCut
        An actuator has its uniform section taken. A CAD part is cut in the middle of its length, and of a mesh of
        27-node hexahedra in layers along x the layer there is taken; `turgor.sections.cut` cuts both elsewhere.
    materials : mapping of str to Material, Shell or Membrane
        A material for every region, a shell or a membrane for any face along the actuator.
    reinforcements : sequence of Fibers
        Threads wound on faces; a section has them smeared. Angles count from the axis x.
    supports : sequence of Support
        `turgor.supports.Radial` for faces that keep their radius. Mirror planes hold by themselves.
    ends : str
        ``"closed"``: the pressures also push on the closed ends, with thrust and moments. ``"open"``: they do not, and
        the walls of the actuator bear no force of the ends.
    size : float or None [m]
        Longest edge of a cell; by default the solids get some sixty cells.

    Raises
    ------
    TurgorError
        If the actuator has no uniform section, such as a PneuNet, or a name is unknown.

    Examples
    --------
    >>> import turgor as tg
    >>> from turgor.units import kPa, mm
    >>> rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
    >>> tube = tg.sections.Sketch(areas={"body": tg.sections.disc(8 * mm), "cavity": tg.sections.disc(6 * mm)})
    >>> tg.Section(tube, {"body": rubber})
    Section(84 cells, regions: body, cavities: cavity, closed ends)
    """

    model: Model
    ends: str
    _equations: Equations

    def __init__(
        self,
        shape: "Actuator | Geometry | Mesh | Sketch | PlaneCut",
        materials: Mapping[str, Material | Sheet],
        *,
        reinforcements: Sequence[Fibers] = (),
        supports: Sequence[Support] = (),
        ends: str = CLOSED,
        size: float | None = None,
    ) -> None:
        if ends not in (CLOSED, OPEN):
            raise unknown("ends of a section", str(ends), (CLOSED, OPEN))
        mesh = _slice_of(shape, size)
        known = {**dict.fromkeys(mesh.regions), **dict.fromkeys(mesh.faces)}
        chosen = {
            name: material for name, material in materials.items() if name in known or not _elsewhere(shape, name)
        }
        model = Model(mesh, chosen, supports, [], reinforcements=reinforcements)
        object.__setattr__(self, "model", model)
        object.__setattr__(self, "ends", ends)
        with use_threads(1):
            object.__setattr__(self, "_equations", Equations(model, closed=ends == CLOSED))

    def __repr__(self) -> str:
        mesh = self.model.mesh
        cavities = f"cavities: {listed(mesh.cavities)}, {self.ends} ends" if mesh.cavities else "no cavity"
        return f"Section({len(mesh.cells)} cells, regions: {listed(mesh.regions)}, {cavities})"

    @property
    def cavities(self) -> tuple[str, ...]:
        """Names of the cavities."""
        return tuple(self._equations.cavities)

    @property
    def volume_at_rest(self) -> dict[str, float]:
        """Volume of each cavity for each length, at rest [m²]."""
        equations = self._equations
        sizes = equations.volumes(equations.rest) * equations.area
        return dict(zip(self.cavities, sizes.tolist(), strict=True))

    def solve(
        self,
        pressure: float | Sequence[float] | Array | Rows = 0.0,
        *,
        volume: Rows = MappingProxyType({}),
        prescribed: Rows = MappingProxyType({}),
        forces: Rows = MappingProxyType({}),
        throw: bool = True,
        mesh_error: bool = True,
    ) -> SectionSolution:
        """Follow the section from rest through rows of pressures or volumes, prescribed strains and forces.

        Parameters
        ----------
        pressure : float, sequence of float, or mapping of str to these [Pa], gauge
            In all cavities, or in each by its name (zero in those that are not named); one value for every row.
        volume : mapping of str to float or sequence of float [m²]
            Prescribed volume of cavities for each length at rest, by their names, whose pressure is then found: this
            passes limit points. `volume_at_rest` is where it begins.
        prescribed : mapping of str to float or sequence of float
            Prescribed strains: ``stretch`` [-], ``twist``, ``curvature_y``, ``curvature_z`` [1/m]. The others are free.
        forces : mapping of str to float or sequence of float
            ``axial_force`` [N] in the tangent of the line through the centroid of the solids, ``torque``,
            ``moment_y``, ``moment_z`` [Nm], which turn with the section; zero where not given.
        throw : bool
            Whether a path that ends early is an error.
        mesh_error : bool
            Whether the mesh error of each column is estimated: up to three states are solved again on cells that
            are cut in four.

        Returns
        -------
        SectionSolution

        Raises
        ------
        SectionError
            If no equilibrium is found beyond some point; its ``solution`` holds the rows before.
        TurgorError
            If a name is unknown, a strain has a force too, or the numbers of rows differ.
        """
        questions = questions_of(self._equations, pressure, volume, prescribed, forces)
        with use_threads(1):
            path = follow(self._equations, questions)
            outcome = (str(Status.CONVERGED), "")
            if len(path.points) < len(questions):
                outcome = (str(Status.STEP_TOO_SMALL), self._end(questions, path.reached))
            source = Source(text="section analysis", detail=repr(self))
            solution = solution_of(self._equations, path, outcome, source, mesh_error)
        if throw and outcome[1]:
            raise SectionError(outcome[1], solution)
        return solution

    def _end(self, questions: Sequence[Question], reached: float) -> str:
        """Where a path ended, and what may help."""
        row = int(reached)
        share = reached - row
        by_volume = bool(np.isfinite(questions[row].volumes).any())
        where = f"row {row}"
        if len(self.cavities) and not by_volume:
            before = questions[row - 1].pressures if row else np.zeros(len(self.cavities))
            pressures = (before + share * (questions[row].pressures - before)) * self._equations.stress
            where = f"a pressure of {pressures.max() / kPa:.4g} kPa"
        advice = (
            "ask for less, or hold a strain."
            if by_volume
            else ("ask for less, hold a strain, or give the volume of the cavity (volume=) instead of its pressure.")
        )
        return (
            f"No equilibrium of the section was found beyond {where}, {share:.0%} of the way to row {row + 1} of "
            f"{len(questions)}. The section may have reached a limit point (it balloons), or folds; {advice}"
        )


def _slice_of(shape: object, size: float | None) -> Mesh:
    """The slice of whatever has a section."""
    if isinstance(shape, Mesh):
        if size is not None:
            raise TurgorError(
                f"size is {size * 1e3:.4g} mm, but mesh '{shape.name}' brings its own cells; leave size out."
            )
        return slice_of_mesh(shape, None)
    if isinstance(shape, Sketch):
        return slice_of_geometry(shape.geometry, size)
    if isinstance(shape, PlaneCut):
        return slice_of_cut(shape, size)
    geometry = shape if isinstance(shape, Geometry) else getattr(shape, "build", lambda: None)()
    if not isinstance(geometry, Geometry):
        raise TurgorError(f"a section of {shape!r} is not possible; give an actuator, a Geometry, a Mesh or a Sketch.")
    if geometry.file:  # a CAD part does not tell how it was swept
        return slice_of_cut(plane_cut(geometry), size)
    return slice_of_geometry(geometry, size)


def _elsewhere(shape: object, name: str) -> bool:
    """Whether a name belongs to a part of the actuator that its section does not have."""
    built = shape.build() if hasattr(shape, "build") else shape
    return name in (*getattr(built, "regions", ()), *getattr(built, "faces", ()))
