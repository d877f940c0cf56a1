"""Checks before a solve: rigid motions left free, everything fixed, cavities without a pressure."""

from collections.abc import Iterable, Sequence

import numpy as np
from numpy.typing import NDArray

from turgor.core.engine.algebra.boundary import PrescribedComponents, prescribed_components
from turgor.core.engine.points.bearing_term import stopped
from turgor.core.engine.points.point_unknowns import Carrier, with_carrier_points
from turgor.core.engine.ties import with_equations
from turgor.core.meshing.bodies.bodies import Body, find_bodies
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.surface import corner_keys, outer_triangles
from turgor.core.model.loads.channel import closed_cavities
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed
from turgor.foundation.errors import CheckError
from turgor.foundation.finding import Finding, Severity
from turgor.units import kPa

#: Face at which motion is measured.
TIP = "tip"


def check_supports(model: Model, inertia: bool = False) -> None:
    """Refuse a model whose supports leave a rigid motion or the mean stress of one of its bodies free (B01).

    With ``inertia`` rigid motions may be free: a body that flies has an acceleration, if no equilibrium.
    """
    supports = with_equations(prescribed_components(model), model)
    surface = np.unique(outer_triangles(model.mesh))
    bodies = joined(find_bodies(model.mesh), supports.carriers)
    for group in _tied(bodies, supports):
        free = 0 if inertia else 6 * len(group) - _fixed_motions(model, supports, group)
        if free and len(bodies) == 1:
            raise CheckError(
                f"the supports leave {free} of 6 rigid motions free (B01); fix a face, {_faces_to_hold(group[0])}."
                f"{_contact_does_not_hold(model, 1)}"
            )
        if free:
            named, several = " and ".join(map(_named, group)), len(group) > 1
            raise CheckError(
                f"the supports leave {free} of {6 * len(group)} rigid motions of the bod{'ies' if several else 'y'} "
                f"{named} free (B01); fix one of {'their' if several else 'its'} faces, {_faces_to_hold(group[0])}."
                f"{_contact_does_not_hold(model, len(bodies))}"
            )
        for body in group:
            _check_mean_stress(model, supports, body, surface)


def _check_mean_stress(model: Model, supports: PrescribedComponents, body: Body, surface: NDArray[np.int64]) -> None:
    materials = [model.region_materials[name] for name in body.regions]
    whole = supports.mask[np.intersect1d(surface, body.nodes)].all()
    if whole and all(material.incompressible for material in materials):
        raise CheckError(
            "the supports prescribe the whole surface of an incompressible body (B01), which leaves its mean "
            "stress undetermined; leave a direction of one face free or give the material a bulk_modulus."
        )


def free_motions(model: Model) -> int:
    """Count the rigid motions of all bodies that supports leave free.

    Parameters
    ----------
    model : Model

    Returns
    -------
    int
    """
    supports = with_equations(prescribed_components(model), model)
    groups = _tied(joined(find_bodies(model.mesh), supports.carriers), supports)
    return sum(6 * len(group) - _fixed_motions(model, supports, group) for group in groups)


def _tied(bodies: Sequence[Body], supports: PrescribedComponents) -> tuple[tuple[Body, ...], ...]:
    """Bodies in groups, with those together whose nodes follow each other; they may still move apart otherwise."""
    followers, leaders = supports.ties.followers // 3, supports.ties.leaders // 3
    groups: list[tuple[Body, ...]] = []
    for body in bodies:
        apart: list[tuple[Body, ...]] = []
        group: tuple[Body, ...] = (body,)
        for each in groups:
            other = np.concatenate([one.nodes for one in each])
            one, two = (np.isin(followers, body.nodes), np.isin(leaders, body.nodes))
            if (one & np.isin(leaders, other)).any() or (two & np.isin(followers, other)).any():
                group = (*each, *group)
            else:
                apart.append(each)
        groups = [*apart, group]
    return tuple(groups)


def joined(bodies: Sequence[Body], carriers: Sequence[Carrier]) -> tuple[Body, ...]:
    """Put bodies together that a rigid plate joins: a reference point whose face has nodes of several.

    Parameters
    ----------
    bodies : sequence of Body
    carriers : sequence of Carrier

    Returns
    -------
    tuple of Body
    """
    out = list(bodies)
    for each in carriers:
        parts = [body for body in out if np.isin(each.nodes, body.nodes).any()]
        if each.rigid and len(parts) > 1:
            whole = Body(
                cells=np.concatenate([body.cells for body in parts]),
                nodes=np.unique(np.concatenate([body.nodes for body in parts])),
                regions=tuple(name for body in parts for name in body.regions),
                faces=tuple(name for body in parts for name in body.faces),
            )
            out = [body for body in out if body not in parts] + [whole]
    return tuple(out)


def _fixed_motions(model: Model, supports: PrescribedComponents, group: tuple[Body, ...]) -> int:
    """Number of the six rigid motions of each of some bodies that their supports prevent."""
    tied, still = supports.ties, supports.mask.ravel().copy()
    still[tied.followers] = False
    of = [[each for each in supports.carriers if np.isin(each.nodes, body.nodes).any()] for body in group]
    carriers = list({each.node: each for own in of for each in own}.values())
    nodes = np.concatenate([*(body.nodes for body in group), *(each.node + np.arange(4) for each in carriers)])
    mask = np.zeros_like(supports.mask)
    mask[nodes] = still.reshape(-1, 3)[nodes]
    for each in carriers:
        mask[each.node] |= np.array(each.point.stiffness) > 0
        mask[each.arrows] |= each.point.rotational_spring > 0
    # a rigid face moves along with its point; the nodes of a plane section or of equations may part
    followers = np.unique(
        tied.followers[np.isin(tied.followers // 3, nodes) & (tied.leaders < 3 * len(model.mesh.points))]
    )
    beds = [bed for body in group for bed in _beds(model, body)]
    count = mask.sum() + len(followers) + sum(each.bearing is not None for each in carriers) + len(beds)
    if not count:
        return 0
    motions = []
    for body, own in zip(group, of, strict=True):
        moves = np.zeros((len(mask), 1), dtype=bool)
        moves[np.concatenate([body.nodes, *(each.node + np.arange(each.count) for each in own)])] = True
        arms, goes = _arms(model, supports, body)
        for axis in range(3):
            for motion in (goes[:, None] * np.eye(3)[axis], np.cross(np.eye(3)[axis], arms)):
                motion = np.where(moves, motion, 0.0)
                local = supports.frames.to_local(motion).ravel()
                parted = (local - tied.fill(local))[followers]
                stops = [stopped(each, motion) for each in carriers]
                stops += [np.einsum("ki,ki->k", along, motion[at]) for at, along in beds]
                motions.append(np.concatenate([local[mask.ravel()], parted, *stops]))
    return int(np.linalg.matrix_rank(np.array(motions), tol=1e-6 * max(1.0, np.sqrt(count))))


def _beds(model: Model, body: Body) -> list[tuple[NDArray[np.int64], NDArray[np.float64]]]:
    """Nodes of a body on springs, and unit vectors along which the springs resist."""
    beds = []
    for support in model.supports:
        if not any(support.bedding) or not np.isin(support.nodes(model.mesh), body.nodes).all():
            continue
        corners = model.mesh.face(support.place)[:, :3]
        edges = np.diff(model.mesh.points[corners], axis=1)
        normals = np.cross(edges[:, 0], edges[:, 1])
        frames = np.linalg.svd(normals[:, None])[2]  # the normal first, then two vectors across it
        kinds = [frames[:, k] for k, stiff in enumerate((support.bedding[0], *[support.bedding[1]] * 2)) if stiff]
        beds += [(corners[:, k], along) for k in range(3) for along in kinds]
    return beds


def _arms(model: Model, supports: PrescribedComponents, body: Body) -> tuple[NDArray[np.float64], NDArray[np.float64]]:
    """Arms (n + e, 3) of all nodes in a rotation about the center of a body, over its size, and in a translation."""
    points = with_carrier_points(model.mesh.points, supports.carriers) - model.mesh.points[body.nodes].mean(axis=0)
    size = float(np.abs(points[body.nodes]).max())
    arms, goes = points / size, np.ones(len(points))
    for each in supports.carriers:
        arms[each.arrows], goes[each.arrows] = each.radius / size * np.eye(3), 0.0
    return arms, goes


def _named(body: Body) -> str:
    return " and ".join(f"'{region}'" for region in body.regions)


def _faces_to_hold(body: Body) -> str:
    """Faces that a body can be fixed at, one that is meant for it first."""
    faces = [name for name in body.faces if not name.startswith(("cavity", "symmetry_", "cyclic_"))]
    if not faces:
        return "which has no name yet"
    best = next((name for name in faces if name.startswith("fixed")), faces[0])
    return f"for example '{best}'; its faces are {', '.join(faces)}"


def _contact_does_not_hold(model: Model, bodies: int) -> str:
    """Say that contact is no support, where there is any."""
    obstacles = [f"'{obstacle.name}'" for obstacle in model.contact.obstacles]
    others = ["other bodies"] if bodies > 1 else []
    if not obstacles and not others:
        return ""
    return (
        f" Contact with {', '.join(obstacles + others)} does not count: it pushes only while it touches, "
        "and a body that it alone should hold has no equilibrium before that; "
        "the procedures stabilized and dynamic let it find one."
    )


def everything_fixed(model: Model) -> tuple[Finding, ...]:
    """Say where the whole surface outside the cavities is fixed, so that nothing can move (B09)."""
    mesh = model.mesh
    fixed = {name for name in mesh.faces for each in model.supports if each == Fixed(name, "xyz")}
    inner = (*mesh.cavities, *mesh.cut_faces) if len(mesh.cells) else ()  # both sides of a film are its surface
    outside = corner_keys(outer_triangles(mesh), len(mesh.points))
    free = outside[~np.isin(outside, _sides(mesh, (*inner, *fixed)))]
    if not fixed or len(free):
        return ()
    return (
        Finding(
            code="B09",
            severity=Severity.ERROR,
            message=f"The supports hold the whole surface ({', '.join(sorted(fixed))}): the actuator cannot move.",
            advice="Hold the face at which the actuator is clamped, for example fixed, and leave the others free.",
        ),
    )


def fixed_cavities(model: Model) -> tuple[Finding, ...]:
    """Say which cavities are fixed all over, so that the pressure in them moves nothing (B27)."""
    mask = prescribed_components(model).mask
    return tuple(
        Finding(
            code="B27",
            severity=Severity.WARNING,
            message=f"The supports hold the whole surface of '{name}': pressure in it moves nothing.",
            advice="Hold the face at which the actuator is clamped, for example fixed, and leave the cavity free.",
        )
        for name in model.mesh.cavities
        if mask[model.mesh.face_nodes(name)].all()
    )


def fixed_tip(model: Model) -> tuple[Finding, ...]:
    """Say that the tip is what holds the actuator, so that its own measures are zero throughout (B28)."""
    faces = {getattr(each, "face", "") for each in model.supports} - {*model.mesh.cut_faces}
    if faces != {TIP} or Fixed(TIP, "xyz") not in model.supports:
        return ()
    others = [name for name in model.mesh.faces if name not in (TIP, *model.mesh.cavities, *model.mesh.cut_faces)]
    base = "fixed" if "fixed" in others else "the other end"
    return (
        Finding(
            code="B28",
            severity=Severity.WARNING,
            message="Only 'tip' is fixed, the face at which motion is measured: its displacement is 0 throughout.",
            advice=f"Clamp {base} instead; or read the measures of a face that moves.",
        ),
    )


def added_pressures(model: Model) -> tuple[Finding, ...]:
    """Say on which faces several pressures act, which add up (L10)."""
    given: dict[str, list[str]] = {}
    for load in model.pressures:
        given.setdefault(load.face, []).append(f"{load.pressure / kPa:g} kPa")
    return tuple(
        Finding(
            code="L10",
            severity=Severity.WARNING,
            message=f"{len(values)} pressures act on '{face}' ({', '.join(values)}): they add up.",
            advice="State one pressure for each cavity, with a history where it changes on the way.",
        )
        for face, values in given.items()
        if len(values) > 1
    )


def _sides(mesh: Mesh, faces: Iterable[str]) -> NDArray[np.int64]:
    """Keys of the sides of some faces."""
    keys = [corner_keys(mesh.faces[name], len(mesh.points)) for name in faces if len(mesh.faces[name])]
    return np.concatenate([np.zeros(0, dtype=np.int64), *keys])


def unloaded_cavities(model: Model) -> tuple[Finding, ...]:
    """Say which cavities have no pressure of their own, nor a channel, while others have one (B03)."""
    loaded = {load.face for load in model.pressures}
    closed = closed_cavities(model.loads)
    empty = [name for name in model.mesh.cavities if name not in (*loaded, *closed)]
    if not empty or len(empty) == len(model.mesh.cavities):
        return ()
    return (
        Finding(
            code="B03",
            severity=Severity.NOTE,
            message=f"No pressure is stated for {', '.join(empty)}: it stays open to the air, at 0 kPa.",
            advice=f"Give it one under [loads.{empty[0]}] if it should have any.",
        ),
    )
