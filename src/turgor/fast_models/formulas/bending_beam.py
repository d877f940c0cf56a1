"""Euler–Bernoulli bender: the moment of the pressure on the ends of a straight cavity over the bending stiffness."""

from collections.abc import Iterable, Mapping
from dataclasses import dataclass

import numpy as np
from numpy.typing import ArrayLike

from turgor.core.geometry.actuators.eccentric_bender import EccentricBender
from turgor.core.geometry.actuators.fiber_reinforced_bender import FiberReinforcedBender
from turgor.core.geometry.actuators.rectangular_bender import RectangularBender
from turgor.core.geometry.actuators.semicircular_bender import SemicircularBender
from turgor.core.geometry.actuators.two_material_bender import TwoMaterialBender
from turgor.core.geometry.parts.layout import Layout
from turgor.core.geometry.shapes.sections import Outline
from turgor.core.materials.material import Material
from turgor.fast_models.formulas.formula import Formula, not_so_simple, path_of, poisson_ratio, strained, young_modulus
from turgor.foundation.errors import TurgorError
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

#: A straight bender with one chamber.
Bender = RectangularBender | SemicircularBender | FiberReinforcedBender | EccentricBender | TwoMaterialBender
LAYER = "strain_limiting_layer"

_NODES, _WEIGHTS = np.polynomial.legendre.leggauss(20)

EULER_BERNOULLI = Formula(
    name="euler_bernoulli",
    title="Bending of a beam whose ends the pressure pushes; wrong for unreinforced rubber, and says so.",
    families=(
        "RectangularBender",
        "SemicircularBender",
        "FiberReinforcedBender",
        "EccentricBender",
        "TwoMaterialBender",
    ),
    assumptions=(
        "Strains are small, and the rubber is linear with the modulus that it has at rest.",
        "Sections stay plane and keep their shape, and the pressure acts on the ends of the cavity only.",
        "A strain-limiting layer does not change its length, and bends freely.",
        "Walls do not resist across: stresses around the cavity neither come from the pressure nor change the length.",
    ),
    source=Source(
        text="beam theory as Xavier, Fleming and Yong 2021, section 1.1, describe it",
        detail="that it fails for incompressible sections is derived here",
    ),
)


def euler_bernoulli(actuator: Bender, material: Material | Mapping[str, Material], pressure: ArrayLike) -> Response:
    """Bend a beam by the moment of the pressure on the ends of its cavity; F02 says where this is wrong.

    Assumptions: Strains are small, and the rubber is linear with the modulus that it has at rest. Sections stay plane
    and keep their shape, and the pressure acts on the ends of the cavity only. A strain-limiting layer does not change
    its length, and bends freely. Walls do not resist across: stresses around the cavity neither come from the pressure
    nor change the length.

    θ = P S L / (E I) with the first moment S of the cavity and the moment E I of the walls, both about the neutral
    line: the layer, or the center of the walls where there is none.

    The last assumption never holds for a bare wall. The pressure on the sides of the cavity stretches the walls around
    it, which shortens them along the axis. For any section without fibers, of one Poisson's ratio, the moment of these
    stresses is 2 ν P S, so that to first order θ = (1 − 2 ν) P S L / (E I): nothing, for an incompressible rubber.
    Its bending begins with P². The column ``first_order_bending_angle`` has this angle.

    Parameters
    ----------
    actuator : RectangularBender, SemicircularBender, FiberReinforcedBender, EccentricBender or TwoMaterialBender
    material : Material, or mapping of str to Material
        One for all regions, or one for each by its name.
    pressure : float or (n,) array [Pa]
        The largest pressure, or several.

    Returns
    -------
    Response
        ``pressure``, ``bending_angle``, ``first_order_bending_angle`` (without fibers).

    Raises
    ------
    TurgorError
        If a region has no material.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> rubber = Material(name="test rubber", law=NeoHooke(C10=0.12e6))
    >>> bent = euler_bernoulli(EccentricBender(), rubber, [10e3])
    >>> bent["bending_angle_deg"].round(2), bent["first_order_bending_angle_deg"], bent.findings[0].code
    (array([3.72]), array([0.]), 'F02')
    """
    EULER_BERNOULLI.check_family(actuator)
    pressures = path_of("pressure", pressure)
    section = section_of(actuator, material)
    length = actuator.length - 2 * actuator.end_wall
    angle = pressures * section.first_moment / section.stiffness * length
    columns = [Column("pressure", "kPa", pressures), Column("bending_angle", "deg", angle)]
    wound = isinstance(actuator, FiberReinforcedBender)
    if not wound:
        share = max(1 - 2 * nu for nu in section.poisson)
        columns.append(Column("first_order_bending_angle", "deg", share * angle))
    strain = float(np.abs(angle).max()) / length * section.farthest
    used = {each.name: each for each in ([material] if isinstance(material, Material) else material.values())}
    findings = [None if wound else _unreinforced(section), *(not_so_simple(each) for each in used.values())]
    return EULER_BERNOULLI.response(columns, [*findings, strained(strain, "the wall farthest from the neutral line")])


@dataclass(frozen=True, slots=True)
class Section:
    """Numbers of a section about its neutral line.

    Parameters
    ----------
    neutral : float [m]
        Height of the neutral line.
    first_moment : float [m³]
        ∫ (z − neutral) dA over the cavity.
    stiffness : float [N m²]
        Σ E ∫ (z − neutral)² dA over the walls.
    farthest : float [m]
        Largest distance of the wall from the neutral line.
    poisson : tuple of float
        Poisson's ratios of the walls.
    """

    neutral: float
    first_moment: float
    stiffness: float
    farthest: float
    poisson: tuple[float, ...]


def section_of(actuator: Bender, material: Material | Mapping[str, Material]) -> Section:
    """Return the section of a straight bender about its neutral line."""
    layout: Layout = actuator._layout
    stiff = np.zeros(3)
    poisson, heights = [], []
    for piece in layout.pieces:
        if piece.name == LAYER:
            continue
        of = _material(material, piece.name)
        chambers = [_within(part.outline, piece.outline) for part in layout.air]
        holes = chambers if piece.hole is None else [piece.hole]
        moments = area_moments(piece.outline) - _sum(hole for hole in holes if hole is not None)
        stiff += young_modulus(of) * moments
        poisson.append(poisson_ratio(of))
        heights += [z for _, z in piece.outline.corners]
    void = _sum(part.outline for part in layout.air)
    sheet = [piece.outline for piece in layout.pieces if piece.name == LAYER]
    level = layout.layer if not isinstance(actuator, TwoMaterialBender) else None  # there it is where materials meet
    neutral = sheet[0].centroid[1] if sheet else level if level is not None else stiff[1] / stiff[0]
    return Section(
        neutral=float(neutral),
        first_moment=float(void[1] - neutral * void[0]),
        stiffness=float(stiff[2] - 2 * neutral * stiff[1] + neutral**2 * stiff[0]),
        farthest=max(abs(float(z - neutral)) for z in heights),
        poisson=tuple(poisson),
    )


def _sum(outlines: Iterable[Outline]) -> np.ndarray:
    return np.sum([np.zeros(3), *(area_moments(outline) for outline in outlines)], axis=0)


def area_moments(outline: Outline) -> np.ndarray:
    """Return ∫ dA, ∫ z dA and ∫ z² dA of an outline, from Green's theorem, (3,) [m², m³, m⁴].

    Examples
    --------
    >>> from turgor.core.geometry.shapes.sections import disc
    >>> area_moments(disc(2.0)) / np.pi
    array([4., 0., 4.])
    """
    starts = np.array([complex(*start) for start, _, _ in outline.edges])[:, None]
    ends = np.array([complex(*end) for _, end, _ in outline.edges])[:, None]
    arcs = np.array(outline.arcs)[:, None]
    t = (_NODES + 1) / 2
    turned = np.exp(1j * arcs * t)
    bent = arcs != 0
    spokes = (ends - starts) / np.where(bent, np.exp(1j * arcs) - 1, 1.0)  # from the center of an arc to its start
    points = np.where(bent, starts + spokes * (turned - 1), starts + t * (ends - starts))
    slopes = np.where(bent, 1j * arcs * spokes * turned, ends - starts)
    y, z, dz = points.real, points.imag, slopes.imag
    total = np.array([float((y * z**n * dz).sum(axis=0) @ _WEIGHTS) / 2 for n in range(3)])
    return np.where(np.abs(total) < 1e-15 * np.abs(total).max(), 0.0, total)


def _within(hole: Outline, outline: Outline) -> Outline | None:
    """Part of a hole between the lowest and the highest line of an outline; None where they do not meet."""
    low, high = _heights(outline)
    least, most = _heights(hole)
    if most <= low or least >= high:
        return None
    hole = hole.cut_z(low) if least < low else hole
    return hole.below_z(high) if most > high else hole


def _heights(outline: Outline) -> tuple[float, float]:
    """Lowest and highest corner; the families put corners at the poles of their arcs."""
    heights = [z for _, z in outline.corners]
    return min(heights), max(heights)


def _material(material: Material | Mapping[str, Material], region: str) -> Material:
    if isinstance(material, Material):
        return material
    if region not in material:
        raise TurgorError(f"region '{region}' has no material; given are {', '.join(sorted(material)) or 'none'}.")
    return material[region]


def _unreinforced(section: Section) -> Finding | None:
    """F02: nothing carries the stress around the cavity."""
    share = max(1 - 2 * nu for nu in section.poisson)
    if share > 0.99:
        return None
    begins = "the bending begins with the square of the pressure" if share < 1e-3 else "the first slope is that share"
    return Finding(
        code="F02",
        severity=Severity.WARNING,
        message="Euler–Bernoulli takes the pressure on the ends of the cavity alone; that on its sides takes away "
        f"{100 * (1 - share):.4g} % of the moment of a section without fibers (twice Poisson's ratio), so that "
        f"{begins}.",
        advice="Use finite elements, or fibers around the cavity, which carry that stress.",
    )
