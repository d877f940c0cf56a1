"""Simple solids of rubber, such as the object that a gripper holds."""

from dataclasses import dataclass
from math import pi

from turgor.core.geometry import occ
from turgor.core.geometry.cad_unit import METERS_PER_CAD_UNIT
from turgor.core.geometry.extrusion import PlaneName, Sweep, layers_of
from turgor.core.geometry.geometry import Geometry, check_volume
from turgor.core.geometry.names import cavity_names
from turgor.core.geometry.parts.films import film_geometry
from turgor.core.geometry.rules import check_length
from turgor.core.geometry.shapes.film_shape import FilmShape, Patch
from turgor.core.geometry.shapes.sections import Outline, disc, prism, rectangle
from turgor.core.geometry.shapes.solids import Range, face_names, name_plane, name_rest, region_names, volume
from turgor.foundation.errors import TurgorError
from turgor.units import m, mm


@dataclass(frozen=True, slots=True, kw_only=True)
class RoundBar:
    """A round bar of rubber along x, centered at the origin.

    `turgor.bodies.placed` moves its mesh to its place.

    Parameters
    ----------
    radius : float [m]
    length : float [m]
    mirrors : str
        Mirror planes at which it is cut, any of ``"x"``, ``"y"`` and ``"z"``: the part with positive coordinates
        stays, and its cut faces are ``symmetry_x`` and so on.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> RoundBar(radius=5e-3, length=30e-3, mirrors="x").build().faces
    ('ends', 'outside', 'symmetry_x')
    """

    radius: float = 10 * mm
    length: float = 40 * mm
    mirrors: str = ""

    def __post_init__(self) -> None:
        check_length("radius", self.radius, high=0.5 * m)
        check_length("length", self.length, high=2 * m)
        _check_mirrors(self.mirrors)

    @property
    def solid_volume(self) -> float:
        """Volume of the modeled part [m³]."""
        return _volume(disc(self.radius), self.length, self.mirrors)

    def build(self) -> Geometry:
        """Build the solid and name it.

        Returns
        -------
        Geometry
            Region ``body``; faces ``ends``, ``outside`` and those of the mirror planes.
        """
        return _built("round bar", disc(self.radius), self.length, self.mirrors, min(2 * self.radius, self.length))


@dataclass(frozen=True, slots=True, kw_only=True)
class Block:
    """A block of rubber, centered at the origin.

    `turgor.bodies.placed` moves its mesh to its place.

    Parameters
    ----------
    length : float [m]
        Size along x.
    width : float [m]
        Size along y.
    height : float [m]
        Size along z.
    mirrors : str
        Mirror planes at which it is cut, as in `RoundBar`.

    Raises
    ------
    TurgorError
        If a dimension is out of range; the message states the field, its value in mm and the range.

    Examples
    --------
    >>> round(Block(length=30e-3, width=20e-3, height=10e-3, mirrors="yz").solid_volume * 1e9, 6)  # mm³
    1500.0
    """

    length: float = 20 * mm
    width: float = 20 * mm
    height: float = 20 * mm
    mirrors: str = ""

    def __post_init__(self) -> None:
        for name in ("length", "width", "height"):
            check_length(name, getattr(self, name), high=2 * m)
        _check_mirrors(self.mirrors)

    @property
    def solid_volume(self) -> float:
        """Volume of the modeled part [m³]."""
        return _volume(self._section, self.length, self.mirrors)

    def build(self) -> Geometry:
        """Build the solid and name it.

        Returns
        -------
        Geometry
            Region ``body``; faces ``ends`` (across x), ``outside`` and those of the mirror planes.
        """
        return _built("block", self._section, self.length, self.mirrors, min(self.length, self.width, self.height))

    @property
    def _section(self) -> Outline:
        return rectangle((-self.width / 2, self.width / 2), (-self.height / 2, self.height / 2))


@dataclass(frozen=True, slots=True, kw_only=True)
class Ball:
    """A ball, centered at the origin.

    `turgor.bodies.placed` moves its mesh to its place.

    Parameters
    ----------
    radius : float [m]

    Raises
    ------
    TurgorError
        If the radius is out of range.

    Examples
    --------
    >>> Ball(radius=5e-3).build().faces
    ('outside',)
    """

    radius: float = 10 * mm

    def __post_init__(self) -> None:
        check_length("radius", self.radius, high=0.5 * m)

    @property
    def solid_volume(self) -> float:
        """Volume [m³]."""
        return 4 / 3 * pi * self.radius**3

    def build(self) -> Geometry:
        """Build the solid and name it.

        Returns
        -------
        Geometry
            Region ``body``; face ``outside``.
        """
        shape = occ.Sphere(occ.Pnt(0, 0, 0), self.radius / METERS_PER_CAD_UNIT)
        shape.mat("body")
        for face in shape.faces:
            face.name = "outside"
        check_volume("solid", volume(shape), self.solid_volume)
        return Geometry(
            name="ball",
            smallest_wall=2 * self.radius,
            cavity_volumes={},
            solid_volume=self.solid_volume,
            regions=("body",),
            faces=("outside",),
            shape=shape,
        )


def _check_mirrors(mirrors: str) -> None:
    if not isinstance(mirrors, str) or not set(mirrors) <= set("xyz") or len(set(mirrors)) < len(mirrors):
        raise TurgorError(f"mirrors is {mirrors!r}; allowed are the letters x, y and z, each once.")


def _cut(section: Outline, mirrors: str) -> Outline:
    section = section.cut_y() if "y" in mirrors else section
    return section.cut_z() if "z" in mirrors else section


def _along(length: float, mirrors: str) -> Range:
    return (0.0 if "x" in mirrors else -length / 2, length / 2)


def _volume(section: Outline, length: float, mirrors: str) -> float:
    start, end = _along(length, mirrors)
    return _cut(section, mirrors).area * (end - start)


def _built(title: str, section: Outline, length: float, mirrors: str, smallest: float) -> Geometry:
    """Sweep a section along x and name the faces."""
    along, section = _along(length, mirrors), _cut(section, mirrors)
    ends = (length / 2,) if "x" in mirrors else along
    planes = [PlaneName(name="ends", axis=0, position=end) for end in ends]
    planes += [PlaneName(name=f"symmetry_{letter}", axis="xyz".index(letter), position=0.0) for letter in mirrors]
    shape = prism(section, along)
    shape.mat("body")
    for face in shape.faces:
        face.name = ""
    for plane in planes:
        name_plane(shape, plane.axis, plane.position, plane.name)
    name_rest(shape, "outside")
    solid_volume = section.area * (along[1] - along[0])
    check_volume("solid", volume(shape), solid_volume)
    share = {0: "", 1: ", half", 2: ", quarter", 3: ", eighth"}[len(mirrors)]
    return Geometry(
        name=f"{title}{share}",
        smallest_wall=smallest,
        cavity_volumes={},
        solid_volume=solid_volume,
        regions=region_names(shape),
        faces=face_names(shape),
        shape=shape,
        _sweep=Sweep(layers=layers_of([("body", section, along)]), names=tuple(planes)),
    )


@dataclass(frozen=True, slots=True, kw_only=True)
class Film:
    """A film without a solid, of patches that share edges: an airbag, a balloon, the skin of a beam.

    Patches are joined where their edges coincide, also where one lies on the other, as the two films of a flat pouch
    do. Edges in a mirror plane are not joined.

    Parameters
    ----------
    patches : tuple of Patch
        Pieces between four edges. Their faces and the names of their edges are the faces of the body; a pressed face
        is called ``cavity``, and edges in a mirror plane ``symmetry_x``, ``symmetry_y`` or ``symmetry_z``.
    name : str
        Title, for reports.

    Examples
    --------
    >>> from turgor.core.geometry.shapes.film_shape import Patch
    >>> corners = ((0, 0, 0), (0, 0.1, 0), (0.1, 0.1, 0), (0.1, 0, 0))
    >>> Film(patches=(Patch(corners=corners, faces=("cavity",), edges=("", "fixed", "", "")),)).build().faces
    ('cavity', 'fixed')
    """

    patches: tuple[Patch, ...]
    name: str = "film"

    def build(self) -> Geometry:
        """Name its parts.

        Returns
        -------
        Geometry
        """
        faces = {name for patch in self.patches for name in patch.faces}
        low, high = FilmShape(patches=self.patches).bounding_box
        extent = max(b - a for a, b in zip(low, high, strict=True)) * METERS_PER_CAD_UNIT
        return film_geometry(self.name, self.patches, extent, dict.fromkeys(cavity_names(faces), 0.0))
