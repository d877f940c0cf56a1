"""Rubber, threads and sheets that many studies share."""

from collections.abc import Sequence
from dataclasses import replace
from math import inf

import turgor as tg
from turgor.units import deg, mm

#: Distance between the rods of a fabric [mm] that gives them 650 N/mm.
FABRIC_SPACING = 1.1867


def elastosil() -> tg.Material:
    """Elastosil M4601, neo-Hookean, C10 = 0.12 MPa.

    Returns
    -------
    Material
    """
    return tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")


def law_of(material: tg.Material) -> tg.laws.Law:
    """Law of a rubber.

    Parameters
    ----------
    material : Material
        A rubber; a linear elastic one is an error.

    Returns
    -------
    law
    """
    if isinstance(material.law, tg.laws.Hooke):
        raise tg.TurgorError(f"material '{material.name}' is linear elastic; a rubber is needed.")
    if not isinstance(material.law, tg.laws.Law):
        raise tg.TurgorError(f"material '{material.name}' has directions; an isotropic rubber is needed.")
    return material.law


def fabric(face: str = "strain_limiting_layer") -> tuple[tg.Fibers, tg.Fibers]:
    """Fabric of rods along and across a flat side, 650 N/mm each as paper has, without stiffness in shear.

    Parameters
    ----------
    face : str

    Returns
    -------
    tuple of Fibers
        Those along the axis, those across.
    """
    along, across = (
        replace(threads(face, from_axis=angle, spacing=FABRIC_SPACING), compression=1.0) for angle in (0.0, 90.0)
    )
    return along, across


def threads(
    face: str | Sequence[str] = "outside",
    *,
    from_axis: float = 90.0,
    spacing: float = 2.0,
    hand: str = "right",
    above: bool | None = None,
) -> tg.Fibers:
    """Kevlar threads of 0.1778 mm, smeared over a face; they go slack in compression.

    Parameters
    ----------
    face : str or sequence of str
    from_axis : float [deg]
        Angle from the axis of the actuator; 90 are hoops.
    spacing : float [mm]
        Distance between neighbors.
    hand : str
        ``"right"``, ``"left"`` or ``"both"``.
    above : bool, optional
        Only above the axis (z > 0) or only below it.

    Returns
    -------
    Fibers
    """
    box = {True: ((-inf, -inf, 0.0), (inf, inf, inf)), False: ((-inf, -inf, -inf), (inf, inf, 0.0)), None: None}[above]
    return tg.Fibers(
        face=face if isinstance(face, str) else tuple(face),
        material=tg.from_library("kevlar-fiber"),
        diameter=0.1778 * mm,
        winding=tg.Winding(angle_from_axis=from_axis * deg, spacing=spacing * mm, hand=hand),
        within=box,
    )
