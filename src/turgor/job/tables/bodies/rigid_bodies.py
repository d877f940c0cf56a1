"""What is rigid among the bodies of a job: their reference points, plates that join bodies, and what fills them."""

from collections.abc import Mapping
from typing import Any

import numpy as np

from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.bodies.assembly import JOINT, SURFACE, Assembly
from turgor.core.meshing.quality.cell_quality import cell_volumes
from turgor.core.model.points import ReferencePoint
from turgor.core.solvers.checks.plausibility.of_materials import RIGID_BODY
from turgor.foundation.source import Source
from turgor.job.tables.bodies.settings import FILLING
from turgor.job.tables.points import Rig


def rigs_of(actuator: Any, points: Mapping[str, Rig]) -> dict[str, Rig]:
    """Return the reference points of a job, with those of its rigid bodies and of plates that join bodies.

    A point of the job at the same face comes first: it may add a force, a support or a mass.

    Parameters
    ----------
    actuator : Actuator or None
    points : mapping of str to Rig
        Those that the job file states.

    Returns
    -------
    dict of str to Rig
    """
    if not isinstance(actuator, Assembly):
        return dict(points)
    tied = {rig.point.face for rig in points.values()}
    own = {name: f"{SURFACE}_{name}" for name in actuator.rigid}
    own |= {f"plate_{name}": f"{JOINT}_{name}" for name in actuator.joints}
    return {n: Rig(point=ReferencePoint(n, face)) for n, face in own.items() if face not in tied} | dict(points)


def rigid_materials(actuator: Any, geometry: Geometry | None) -> dict[str, Material]:
    """Return the materials within rigid bodies by their regions; their density gives the bodies their masses.

    Nothing deforms there, because the surface is rigid; the law says how contact presses back.

    Parameters
    ----------
    actuator : Actuator or None
    geometry : Geometry or None

    Returns
    -------
    dict of str to Material
    """
    if not isinstance(actuator, Assembly) or geometry is None:
        return {}
    mesh = geometry.shape.mesh
    out: dict[str, Material] = {}
    for name, mass in actuator.rigid.items():
        regions = [full for full in geometry.shape.bodies[name].values() if full in mesh.regions]
        rows = np.concatenate([mesh.regions[full] for full in regions])
        nodes = np.unique(mesh.cells[rows])
        cuts = sum(bool(np.isin(mesh.face_nodes(plane), nodes).any()) for plane in mesh.symmetry_faces)
        volume = 2**cuts * float(cell_volumes(mesh)[rows].sum())
        filling = Material(
            name=RIGID_BODY,
            law=NeoHooke(C10=FILLING.modulus / 2),
            bulk_modulus=FILLING.bulk_ratio * FILLING.modulus,
            density=mass / volume,
            source=Source(text="chosen by turgor for the inside of a rigid body, which does not deform"),
        )
        out |= dict.fromkeys(regions, filling)
    return out
