"""Reading of a CAD file as a geometry with named regions and faces."""

from collections.abc import Mapping, Sequence
from dataclasses import replace
from pathlib import Path

from turgor.core.geometry.cad.cavities import Hollow
from turgor.core.geometry.cad.files import check_file, reading
from turgor.core.geometry.cad.naming import STANDARD, Naming, name_faces
from turgor.core.geometry.cad.part import Part, load_part
from turgor.core.geometry.cad.placing.orientation import placing_finding, rotation_along_x
from turgor.core.geometry.cad.placing.rotate_part import turned_naming, turned_part
from turgor.core.geometry.cad.selectors import ByName, Selector
from turgor.core.geometry.cad.split import SplitPlane
from turgor.core.geometry.cad.surface.shape import SurfaceShape
from turgor.core.geometry.cad.symmetry.cut import modeled_part
from turgor.core.geometry.cad.symmetry.modeled_share import Modeled
from turgor.core.geometry.cad.symmetry.requested import NONE, WHOLE, RequestedSymmetry
from turgor.core.geometry.cad.walls import smallest_wall
from turgor.core.geometry.child_process import in_child
from turgor.core.geometry.directions import FileAxes, rotation_to
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.packing import packed
from turgor.foundation.errors import TurgorError
from turgor.units import mm

#: Least volume of a part, as a share of the cube of its extent: a sheet of a thousandth of its length has 1e-3.
LEAST_VOLUME = 1e-9


def read_cad(
    path: str | Path,
    *,
    unit: str | float | None = None,
    faces: Mapping[str, Selector] | None = None,
    regions: Mapping[str, Selector] | None = None,
    split: SplitPlane | None = None,
    symmetry: str | RequestedSymmetry = NONE,
    axes: FileAxes | None = None,
) -> Geometry:
    """Read a STEP, BREP or STL file as a geometry.

    The CAD kernel reads the file in a child process, because a damaged file may crash it. Bodies that touch are joined.
    Closed voids and pockets with one opening become cavities: one is named ``cavity``, several are ``cavity_1``,
    ``cavity_2``, …. `name_faces` says how the other faces get their names.

    Parameters
    ----------
    path : str or Path
        The file.
    unit : str or float, optional
        Unit of its numbers, such as ``"mm"``, or its length in meters; by default what a STEP file states, and
        millimeters for the others.
    faces : mapping of str to Selector, optional
        Names for faces, each face once. If one of them is a cavity, no others are found.
    regions : mapping of str to Selector, optional
        Names for bodies. The others keep their name in the file, or are ``body``, ``body_1``, ….
    split : SplitPlane, optional
        Plane that cuts off the bottom as a region of its own.
    symmetry : str or RequestedSymmetry
        ``"none"`` for the whole part; ``"automatic"`` to cut it at every mirror plane across x, y or z that it has, or
        to a wedge where that is smaller; the normals of the planes to use, such as ``"y"`` or ``"yz"``, of which the
        side toward positive coordinates is kept; or ``"wedge"`` for one of n equal sectors, ``"wedge 6"`` with n.
    axes : tuple of three str or (3,) floats, optional
        Directions in the file of our x (from the fixed end to the tip), y (across) and z (up), such as
        ``("z", "x", "y")``; all selectors and the split are then in our axes. By default a part whose plane face
        ``fixed`` and whose ``tip`` show that it does not lie along x is turned until it does, with the strain-limiting
        layer, the base or the thicker wall below (D08); selectors and the split stay in the axes of the file.

    Returns
    -------
    Geometry
        Its ``findings`` name cavities that could end in several places, holes that are no cavities, and missing names.

    Raises
    ------
    TurgorError
        If the file has no closed solid, its bodies overlap or do not touch, a selector finds nothing, a plane of
        symmetry is none, or the CAD kernel dies.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3, symmetric=False).build()
    >>> with TemporaryDirectory() as folder:
    ...     finger.shape.WriteStep(str(Path(folder) / "finger.step"))
    ...     part = read_cad(Path(folder) / "finger.step")
    >>> part.faces
    ('cavity', 'fixed', 'outside', 'strain_limiting_layer', 'tip')
    >>> round(part.cavity_volume * 1e9, 6)
    2098.0
    """
    check_file(path, unit)
    _check_names("face", faces or {})
    _check_names("region", regions or {})
    requested = symmetry if isinstance(symmetry, RequestedSymmetry) else RequestedSymmetry(symmetry)
    requested = replace(requested, broken=dict(requested.broken), broken_turns=dict(requested.broken_turns))
    named = dict(faces or {}), dict(regions or {})
    if axes is not None:
        rotation_to(axes)  # refuses what are none
    return in_child(reading(path), read_here, Path(path), unit, *named, split, requested, axes)


def read_here(
    path: Path,
    unit: str | float | None = None,
    faces: Mapping[str, Selector] | None = None,
    regions: Mapping[str, Selector] | None = None,
    split: SplitPlane | None = None,
    symmetry: RequestedSymmetry = WHOLE,
    axes: FileAxes | None = None,
) -> Geometry:
    """Read a CAD file as `read_cad`, but in this process, which the CAD kernel may crash.

    What other processes do with the shape is done here first: it is packed, made again and triangulated.
    """
    part = load_part(path, unit, regions or {}, split, axes)
    interface = split.interface if split is not None else None
    naming = name_faces(part, faces or {}, interface)
    if axes is None:
        part, naming = _along_x(part, naming, faces or {})
    modeled = modeled_part(part, naming.names, symmetry)
    if modeled.wedge is not None:
        naming = _of_wedge(modeled, naming)
    elif modeled.part is not part:
        naming = _named_again(modeled.part, modeled.names, naming, interface)
    naming = replace(naming, findings=(*naming.findings, *modeled.findings))
    wall = smallest_wall((part if modeled.wedge is not None else modeled.part).facets)
    geometry = replace(_geometry(Path(path), modeled.part, naming, wall), wedge=modeled.wedge)
    if not geometry.solid_volume > LEAST_VOLUME * geometry.extent**3:
        raise TurgorError(
            f"'{path}' encloses no volume ({geometry.solid_volume / mm**3:.3g} mm³): its surface is flat or crosses "
            "itself; export it again."
        )
    if isinstance(part.shape, SurfaceShape):
        return geometry
    again = packed(geometry._cad).shape()
    again.MakeTriangulation()
    if not (again.bounding_box and all(face.mass >= 0 for face in again.faces)):
        raise TurgorError(f"'{path}' has faces of negative area: its edges are damaged; export it again.")
    return geometry


def _along_x(part: Part, naming: Naming, faces: Mapping[str, Selector]) -> tuple[Part, Naming]:
    """A part that lies along x, with its names; what was done is a finding."""
    rotation, clear = rotation_along_x(part, naming.names)
    if rotation is not None:
        finding = placing_finding(part, rotation)
        given = {*faces, *(item.name for item in part.items)}
        part = turned_part(part, rotation)
        naming = turned_naming(part, naming, given)
        return part, replace(naming, findings=(*naming.findings, finding))
    return part, naming if clear else replace(naming, findings=(*naming.findings, placing_finding(part, None)))


def _geometry(path: Path, part: Part, naming: Naming, wall: float) -> Geometry:
    """Write the names into the shape and return it as a geometry with a smallest wall [CAD units]."""
    shape, solids = part.shape, [part.shape]
    if isinstance(shape, SurfaceShape):
        shape = shape.named(naming.names)
    else:
        solids = list(shape.solids)
        for face, face_name in zip(part.faces, naming.names, strict=True):
            face.name = face_name
    return Geometry(
        name=path.stem,
        smallest_wall=wall * mm,
        cavity_volumes={name: hollow.volume * mm**3 for name, hollow in naming.cavities.items()},
        solid_volume=sum(float(solid.mass) for solid in solids) * mm**3,
        regions=tuple(dict.fromkeys(part.regions)),
        faces=tuple(sorted(set(naming.names))),
        findings=(*part.file.findings, *naming.findings),
        file=str(path),
        shape=shape,
    )


def _of_wedge(modeled: Modeled, whole: Naming) -> Naming:
    """Names of the faces of a sector, whose cavities have their share of those of the whole."""
    assert modeled.wedge is not None
    volumes: dict[str, Hollow] = {}
    for name, hollow in whole.cavities.items():
        together = modeled.renamed.get(name, name)
        before = volumes[together].volume if together in volumes else 0.0
        volumes[together] = replace(hollow, volume=before + hollow.volume / modeled.wedge.fold)
    return replace(whole, names=modeled.names, cavities=volumes)


def _named_again(part: Part, names: Sequence[str], whole: Naming, interface: str | None) -> Naming:
    """Name the faces of a part that was cut as those of the whole, and measure the cavities of what is left."""
    inner = part.between
    between = {name for name, within in zip(names, inner, strict=True) if within}
    own = set(names) - {"outside", *STANDARD} - between
    naming = name_faces(part, {name: ByName(name) for name in sorted(own)}, interface)
    same_names = tuple(old if within else new for old, new, within in zip(names, naming.names, inner, strict=True))
    return replace(naming, names=same_names, findings=whole.findings)


def _check_names(what: str, names: Mapping[str, Selector]) -> None:
    """Raise an error for an empty name."""
    for name in names:
        if not isinstance(name, str) or not name.strip():
            raise TurgorError(f"{what} name is {name!r}; a text such as 'fixed' is needed.")
