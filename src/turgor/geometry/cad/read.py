"""read_cad: a CAD file as a geometry with named regions and faces."""

from collections.abc import Mapping
from pathlib import Path

from turgor.errors import TurgorError
from turgor.geometry.cad.naming import name_faces
from turgor.geometry.cad.part import load_part
from turgor.geometry.cad.selectors import Selector
from turgor.geometry.cad.split import SplitPlane
from turgor.geometry.cad.walls import smallest_wall
from turgor.geometry.geometry import Geometry
from turgor.units import mm


def read_cad(
    path: str | Path,
    *,
    unit: str | None = None,
    faces: Mapping[str, Selector] | None = None,
    regions: Mapping[str, Selector] | None = None,
    split: SplitPlane | None = None,
) -> Geometry:
    """Read a STEP, BREP or closed STL file as a geometry.

    Bodies that touch are joined. Cavities are found by themselves: closed voids, and pockets with one opening, which
    is closed for measuring and stays open in the mesh. One is named ``cavity``; several are ``cavity_1``,
    ``cavity_2``, … along x, and side by side from +z counterclockwise, seen from the tip. Faces that the file calls
    ``fixed``, ``tip``, ``cavity…``, ``symmetry_…`` or ``strain_limiting_layer`` keep these names; faces between the
    regions ``body`` and ``base`` are the ``strain_limiting_layer``, between others ``interface``; the rest is
    ``outside``.

    Parameters
    ----------
    path : str or Path
        The file.
    unit : str, optional
        Unit of its numbers, such as ``"mm"``; by default what a STEP file states, and millimeters for the others.
    faces : mapping of str to Selector, optional
        Names for faces. The faces of one name must not be those of another. Where a cavity is named here, only
        those named here are cavities.
    regions : mapping of str to Selector, optional
        Names for bodies; the others keep their name in the file, or are ``body``, ``body_1``, ….
    split : SplitPlane, optional
        A plane that cuts off the bottom as a region of its own.

    Returns
    -------
    Geometry
        ``findings`` says what was noticed: several places where a cavity could end, holes that are no cavities,
        names that are missing.

    Raises
    ------
    TurgorError
        If the file is missing or damaged, holds no solid or surfaces that do not close, is of impossible size, if
        its bodies overlap or do not touch, or if a selector finds nothing.

    Examples
    --------
    >>> from pathlib import Path
    >>> from tempfile import TemporaryDirectory
    >>> from turgor.geometry import FastPneuNet
    >>> finger = FastPneuNet(chambers=2, length=20e-3, symmetric=False).build()
    >>> with TemporaryDirectory() as folder:
    ...     finger._shape.WriteStep(str(Path(folder) / "finger.step"))
    ...     part = read_cad(Path(folder) / "finger.step")
    >>> part.faces
    ('cavity', 'fixed', 'outside', 'strain_limiting_layer', 'tip')
    >>> round(part.cavity_volume * 1e9, 6)
    2098.0
    """
    wanted, named = faces or {}, regions or {}
    for what, names in (("face", wanted), ("region", named)):
        for name in names:
            if not isinstance(name, str) or not name.strip():
                raise TurgorError(f"{what} name is {name!r}; a text such as 'fixed' is needed.")
    part = load_part(path, unit, named, split)
    naming = name_faces(part, wanted, split.interface if split is not None else None)
    for face, name in zip(part.faces, naming.names, strict=True):
        face.name = name
    return Geometry(
        name=Path(path).stem,
        smallest_wall=smallest_wall(part.facets) * mm,
        cavity_volumes={name: hollow.volume * mm**3 for name, hollow in naming.cavities.items()},
        solid_volume=sum(float(solid.mass) for solid in part.shape.solids) * mm**3,
        regions=tuple(dict.fromkeys(part.regions)),
        faces=tuple(sorted(set(naming.names))),
        findings=naming.findings,
        _shape=part.shape,
    )
