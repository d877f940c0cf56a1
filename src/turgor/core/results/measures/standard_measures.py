"""Measures of shape and force that most parts have, and those that a run reads where none is requested."""

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.boundary import radial_normals
from turgor.core.engine.algebra.node_frames import across_fixed
from turgor.core.engine.faces import surfaces
from turgor.core.engine.points.foundation_term import foundation_force
from turgor.core.meshing.bodies.named import named_bodies
from turgor.core.meshing.quality.proximity import smallest_gap as smallest_gap_between
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.measures.cavities import enclosed_volume
from turgor.core.results.measures.field_measures import (
    as_column,
    maximum_principal_stretch,
    maximum_von_mises,
    principal_stretch_p99,
    von_mises_p99,
)
from turgor.core.results.measures.measure import Measure
from turgor.core.results.measures.point_measures import fixed_points_force
from turgor.core.results.measures.rotations import face_rotation, twist
from turgor.foundation.errors import TurgorError, unknown

Array = NDArray[np.float64]


def heading(at: StateFields, face: str, points: Array) -> float:
    """Return the direction of a face's vector area in the x-z plane [rad], counted from +x towards −z.

    Parameters
    ----------
    at : StateFields
    face : str
    points : (n, 3) array [m]
        Nodes, at rest or moved.

    Raises
    ------
    TurgorError
        If the vector area does not lie in that plane.
    """
    area = at.facts.of_whole(surfaces.vector_area(points, at.mesh.face(face)))
    if not np.hypot(area[0], area[2]) > 1e-6 * surfaces.area(at.mesh.points, at.mesh.face(face)):
        raise TurgorError(
            f"face '{face}' has no normal in the x-z plane, the plane of bending; turn the part so that it lies along "
            "x, with the axes of its file, or list other measures (measures under [output])."
        )
    return float(np.arctan2(-area[2], area[0]))


def _bending_angle(at: StateFields) -> float:
    turned = [heading(at, face, at.points) - heading(at, face, at.mesh.points) for face in ("tip", "fixed")]
    angle = turned[0] - turned[1]
    return float(np.arctan2(np.sin(angle), np.cos(angle)))


def _tip_vector(at: StateFields) -> Array:
    """Mean displacement of the face ``tip`` of the whole actuator, weighted by reference area, (3,) [m]."""
    weights = surfaces.nodal_weights(at.mesh.points, at.mesh.face("tip"))
    return at.facts.of_whole(weights @ at.displacement / weights.sum())


def _twist_angle(at: StateFields) -> float:
    if at.mesh.symmetry_faces:
        return 0.0  # the mirror image turns the other way
    return twist(face_rotation(at, "fixed").T @ face_rotation(at, "tip"))


def _cavity_volume(at: StateFields) -> float:
    if not at.mesh.cavities:
        raise unknown("face", "cavity", at.mesh.faces)
    return enclosed_volume(at, at.mesh.cavities)


def _reaction(at: StateFields) -> float:
    return float(np.linalg.norm(support_force(at)))


def support_force(at: StateFields) -> Array:
    """Return the force of the supports Fixed, Radial, Roller and Foundation on the whole actuator, (3,) [N].

    Parameters
    ----------
    at : StateFields
    """
    fixed = np.zeros(at.mesh.points.shape, dtype=bool)
    for support in at.model.supports:
        directions = support.prescribed[1]
        if directions and not support.moves and support.place not in at.model.points:
            nodes = support.nodes(at.mesh)
            for direction in directions:
                fixed[nodes, "xyz".index(direction)] = True
    nodes, across = across_fixed(*radial_normals(at.model, moved=False), fixed)
    supported = fixed.any() or len(nodes) or any(any(support.bedding) for support in at.model.supports)
    if not supported and not at.model.points and not named_bodies(at.mesh):  # which may be loose
        raise TurgorError("the model has no support Fixed, Radial, Roller or Foundation whose force could be summed.")
    force = np.where(fixed, at.state.nodal_force, 0.0)
    np.add.at(force, nodes, np.einsum("ki,ki->k", across, at.state.nodal_force[nodes])[:, None] * across)
    total = force.sum(axis=0) + foundation_force(at.model, at.displacement)
    return np.asarray(at.facts.of_whole(at.mesh.symmetry_factor * total) + fixed_points_force(at))


def volume_of(cavity: str) -> Measure:
    """Make the measure of the volume of one cavity, by the name of its face.

    Examples
    --------
    >>> volume_of("cavity_1").name
    'cavity_1_volume'
    """
    return Measure(
        name=f"{as_column(cavity)}_volume", unit="mL", function=lambda at: enclosed_volume(at, [cavity]),
        definition=f"current volume enclosed by the face {cavity}, whole actuator",
    )  # fmt: skip


bending_angle = Measure(
    name="bending_angle", unit="deg", function=_bending_angle, unwrap=True, faces=("fixed", "tip"),
    definition="rotation of the face tip (its vector area) against the face fixed in the x-z plane, "
    "positive towards the base",
)  # fmt: skip
tip_displacement = Measure(
    name="tip_displacement", unit="mm", function=lambda at: float(np.linalg.norm(_tip_vector(at))), faces=("tip",),
    definition="magnitude of the mean displacement of the face tip",
)  # fmt: skip
tip_displacement_x = Measure(
    name="tip_displacement_x", unit="mm", function=lambda at: float(_tip_vector(at)[0]),
    definition="mean displacement of the face tip along x",
)  # fmt: skip
tip_displacement_y = Measure(
    name="tip_displacement_y", unit="mm", function=lambda at: float(_tip_vector(at)[1]),
    definition="mean displacement of the face tip along y",
)  # fmt: skip
tip_displacement_z = Measure(
    name="tip_displacement_z", unit="mm", function=lambda at: float(_tip_vector(at)[2]),
    definition="mean displacement of the face tip along z",
)  # fmt: skip
twist_angle = Measure(
    name="twist_angle", unit="deg", function=_twist_angle, unwrap=True,
    definition="rotation of the face tip against the face fixed about its own normal, positive counterclockwise "
    "seen from the tip; zero where a mirror plane forbids it",
)  # fmt: skip
cavity_volume = Measure(
    name="cavity_volume", unit="mL", function=_cavity_volume, faces=("cavity",),
    definition="current volume enclosed by the faces cavity*, whole actuator",
)  # fmt: skip
reaction = Measure(
    name="reaction", unit="N", function=_reaction,
    definition="magnitude of the sum of all forces at the supports Fixed, Radial and Roller, whole actuator; zero "
    "where only the pressure of a closed cavity acts, since that pushes on itself",
)  # fmt: skip
smallest_gap = Measure(
    name="smallest_gap", unit="mm",
    function=lambda at: float(smallest_gap_between(at.facts.walls, at.displacement)),
    definition="smallest distance between outer walls that face each other; negative once they have passed through",
)  # fmt: skip
#: What a run writes unless other measures are requested.
STANDARD_MEASURES: tuple[Measure, ...] = (
    bending_angle, tip_displacement, cavity_volume, principal_stretch_p99, maximum_principal_stretch, von_mises_p99,
    maximum_von_mises, reaction,
)  # fmt: skip
