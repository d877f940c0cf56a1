"""Parts of a model as they may be given: the plain forms of materials and supports."""

from collections.abc import Iterable, Mapping
from dataclasses import replace
from typing import Any

from turgor.core.materials.library.accepted_forms import as_material
from turgor.core.meshing.mesh import Mesh
from turgor.core.model.places import NodesAt
from turgor.core.model.sheets import Sheet
from turgor.core.model.supports import Fixed, Support
from turgor.foundation.given import several


def given_supports(supports: object) -> tuple[Support, ...]:
    """Return supports; the name of a face stands for one that holds it, and one alone for a list of one.

    Examples
    --------
    >>> given_supports("fixed")
    (Fixed(face='fixed', directions='xyz'),)
    """
    if isinstance(supports, str):
        supports = [supports]
    if isinstance(supports, Iterable):
        supports = [Fixed(each) if isinstance(each, str) else each for each in supports]
    return several(supports, Support, "supports", "supports are needed, such as Fixed('fixed'), or names of faces")


def at_node_sets(acting: Iterable[Any], mesh: Mesh) -> tuple[Any, ...]:
    """Return supports or loads in which the names of node sets of a mesh became places."""

    def placed(each: Any) -> Any:
        named = each.face if each.at_places else None
        if not isinstance(named, str) or named in mesh.faces or named not in mesh.node_sets:
            return each
        return replace(each, face=NodesAt(named, node_set=named))

    return tuple(placed(each) for each in acting)


def given_materials(materials: object, mesh: Mesh) -> dict[str, Any]:
    """Return the material of each region and the sheets on faces; one material alone is that of all regions."""
    if not isinstance(materials, Mapping):
        return dict.fromkeys(mesh.regions, as_material(materials, "materials", "rubber"))
    return {
        name: value if isinstance(value, Sheet) else as_material(value, f"materials.{name}", str(name))
        for name, value in materials.items()
    }
