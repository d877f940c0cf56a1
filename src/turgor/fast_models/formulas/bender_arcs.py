"""Constant curvature for actuators: lengths of parallel chambers to an arc and back, and the tip of a bender."""

from math import atan2, cos, hypot, pi, sin, sqrt

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.geometry.actuators.parallel_bellows import ParallelBellows
from turgor.core.geometry.actuators.three_extenders import ThreeExtenders
from turgor.core.materials.laws.energies.neo_hooke import NeoHooke
from turgor.core.materials.material import Material
from turgor.fast_models.formulas.arcs import Arc, pose
from turgor.fast_models.formulas.bending_beam import EULER_BERNOULLI, Bender, section_of
from turgor.fast_models.formulas.formula import Formula
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: Parallel chambers at the corners of a triangle.
Parallel = ThreeExtenders | ParallelBellows

CONSTANT_CURVATURE = Formula(
    name="constant_curvature",
    title="Where the tip of a bender goes, from its bending angle.",
    families=EULER_BERNOULLI.families,
    assumptions=(
        "The curvature is the same everywhere along the cavity, and the end walls stay straight.",
        "The strain-limiting layer, or without one the center of the walls, keeps its length.",
        "Weight and contact do not bend the actuator.",
    ),
    source=Source(text="Webster and Jones 2010, Int. J. Robot. Res. 29, 1661", detail="constant curvature kinematics"),
)


def constant_curvature(actuator: Bender, response: Response) -> Response:
    """Find where the tip of a bender goes, from its bending angle: constant curvature between straight ends.

    Assumptions: The curvature is the same everywhere along the cavity, and the end walls stay straight. The
    strain-limiting layer, or without one the center of the walls, keeps its length. Weight and contact do not bend the
    actuator.

    Parameters
    ----------
    actuator : RectangularBender, SemicircularBender, FiberReinforcedBender, EccentricBender or TwoMaterialBender
    response : Response
        With a ``bending_angle``, from finite elements, a formula or an experiment. Where it has
        ``tip_displacement_x`` and ``tip_displacement_z`` too, the largest distance from these decides on F11.

    Returns
    -------
    Response
        The columns before ``bending_angle``, this angle, ``tip_displacement_x``, ``tip_displacement_z`` (mean of the
        face ``tip``, as of finite elements) and ``curvature``.

    Examples
    --------
    >>> from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender
    >>> angle = Response(columns=(Column("bending_angle", "deg", [0.0, pi / 2]),), source=Source(text="a protractor"))
    >>> constant_curvature(SemicircularBender(), angle)["tip_displacement_z_mm"].round(2)
    array([  0.  , -66.45])
    """
    CONSTANT_CURVATURE.check_family(actuator)
    angles = response.column("bending_angle")
    neutral = section_of(actuator, Material(name="any rubber", law=NeoHooke(C10=1.0))).neutral
    end, length = actuator.end_wall, actuator.length - 2 * actuator.end_wall
    above = _tip_height(actuator) - neutral
    moved = np.array([_moved(float(angle), length, end, above) for angle in angles]).reshape(-1, 2)
    columns = list(response.columns[: response.names.index("bending_angle")])
    columns += [
        response.find("bending_angle"),
        Column("tip_displacement_x", "mm", moved[:, 0]),
        Column("tip_displacement_z", "mm", moved[:, 1]),
        Column("curvature", "1/m", angles / length),
    ]
    return CONSTANT_CURVATURE.response(columns, [_off(response, moved, actuator.length)])


def arc_of_lengths(actuator: Parallel, lengths: ArrayLike) -> Arc:
    """Return the arc of an actuator with three parallel chambers from their lengths: actuator to configuration.

    A chamber at the place (y, z) has the length l (1 − κ (y cos φ + z sin φ)): a longer one lies on the outer side.

    Parameters
    ----------
    actuator : ThreeExtenders or ParallelBellows
        Its chambers lie at the corners of a triangle, the first at +z.
    lengths : (3,) array [m]

    Raises
    ------
    TurgorError
        If there are not three positive lengths.

    Examples
    --------
    >>> arc = arc_of_lengths(ParallelBellows(), [30e-3, 28e-3, 28e-3])  # the first, on top, is longer: it bends down
    >>> round(arc.plane / pi, 12), round(arc.length * 1e3, 6)
    (-0.5, 28.666667)
    """
    given = np.asarray(lengths, dtype=np.float64)
    if given.shape != (3,) or not (given > 0).all():
        raise TurgorError(f"lengths is {lengths!r}; the positive lengths of three chambers are needed.")
    places = _places(actuator)
    mean, across, up = np.linalg.solve(np.column_stack([np.ones(3), -places]), given).tolist()
    bent = hypot(across, up)
    return Arc(curvature=bent / mean, plane=atan2(up, across) if bent > 1e-15 * mean else 0.0, length=mean)


def lengths_of_arc(actuator: Parallel, arc: Arc) -> Array:
    """Return the lengths of three parallel chambers of an arc: configuration to actuator, (3,) [m].

    Examples
    --------
    >>> lengths_of_arc(ParallelBellows(), arc_of_lengths(ParallelBellows(), [30e-3, 28e-3, 29e-3])).round(9).tolist()
    [0.03, 0.028, 0.029]
    """
    direction = np.array([cos(arc.plane), sin(arc.plane)])
    return np.asarray(arc.length * (1 - arc.curvature * _places(actuator) @ direction))


def _places(actuator: Parallel) -> Array:
    """Axes of the chambers in the plane (y, z), (3, 2) [m]."""
    if not isinstance(actuator, Parallel):
        raise TurgorError(f"{type(actuator).__name__} has no three parallel chambers; ThreeExtenders has.")
    angles = 2 * pi * np.arange(3) / 3
    return actuator.side / sqrt(3) * np.stack([-np.sin(angles), np.cos(angles)], axis=1)


def _tip_height(actuator: Bender) -> float:
    """Height of the middle of the face ``tip`` [m]."""
    area = moment = 0.0
    for piece in actuator._layout.pieces:
        for outline, sign in ((piece.outline, 1.0), (piece.hole, -1.0)):
            if outline is not None:
                area += sign * outline.area
                moment += sign * outline.area * outline.centroid[1]
    return moment / area


def _moved(angle: float, length: float, end: float, above: float) -> tuple[float, float]:
    """Displacement (x, z) of the middle of the tip [m]; a positive angle bends down."""
    frame = pose(Arc(curvature=angle / length, plane=-pi / 2, length=length))
    tip = frame[:3, :3] @ np.array([end, 0.0, above]) + frame[:3, 3]
    return float(tip[0] - length - end), float(tip[2] - above)


def _off(response: Response, moved: Array, length: float) -> Finding | None:
    """F11: the tip is elsewhere."""
    if not {"tip_displacement_x", "tip_displacement_z"} <= set(response.names):
        return None
    known = np.stack([response.column(f"tip_displacement_{axis}") for axis in "xz"], axis=1)
    off = float(np.hypot(*(moved - known).T).max()) / length
    if off < 0.02:
        return None
    return Finding(
        code="F11",
        severity=Severity.WARNING,
        message=f"The tip is up to {100 * off:.3g} % of the length away from where constant curvature puts it.",
        advice="The actuator lengthens or does not bend evenly (weight, ends, contact): use a rod or finite elements.",
    )
