"""A body of revolution that is meshed in three dimensions although its meridian would do."""

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.wedge import Wedge
from turgor.core.model.checks.symmetry import same_when_turned
from turgor.core.model.fibers import DISCRETE
from turgor.core.model.model import Model
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity


def meridian_would_do(model: Model, geometry: Geometry) -> tuple[Finding, ...]:
    """Recommend an axisymmetric mesh where a CAD part, its loads and its supports are the same all around an axis.

    It is recommended and not taken, because a part that bends or buckles to the side needs its cells all around.

    Parameters
    ----------
    model : Model
    geometry : Geometry
        What its mesh was made of.

    Returns
    -------
    tuple of Finding
        G13, or nothing.
    """
    if not geometry.file or model.mesh.revolved or model.mesh.wedge is not None:
        return ()
    from turgor.core.meshing.revolved.meridian import meridian_of  # here: it loads much of what reads CAD files

    try:
        meridian = meridian_of(geometry)
    except TurgorError:
        return ()
    x, y, z = (float(value) for value in meridian.center)
    axis = "xyz"[meridian.axis]
    # any number of sectors shows whether all stays the same when it is turned
    if not _same_around(model, Wedge(axis=axis, fold=6, center=(x, y, z))):
        return ()
    return (
        Finding(
            code="G13",
            severity=Severity.NOTE,
            message=f"The part is a body of revolution about {axis}, and so are its loads and supports; its mesh has "
            f"{model.mesh.unknown_count:,} unknowns.",
            advice='cells = "axisymmetric" in [mesh] models its meridian alone, with far fewer unknowns. It cannot '
            "bend or buckle to the side.",
        ),
    )


def _same_around(model: Model, wedge: Wedge) -> bool:
    """Whether all that acts on a quarter is the same around its axis; its mirror planes refuse forces across it."""
    directions = [letters for place, letters in (each.prescribed for each in model.supports) if place]
    across = ["xyz"[i] for i in wedge.across]
    return (
        all(load.turned("xyz".index(wedge.axis)) for load in model.loads)
        and all(sum(letter in each for letter in across) != 1 for each in directions)
        and all(fibers.form != DISCRETE for fibers in model.reinforcements)
        and all(same_when_turned(obstacle, wedge) for obstacle in model.contact.obstacles)
    )
