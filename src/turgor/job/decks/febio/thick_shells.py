"""Shells of a .feb file without solids below them: they become solid cells of their thickness.

FEBio's shells have the displacements of a front face, which are those of its nodes, and of a back face (Hou et al.
2018, https://doi.org/10.1115/1.4041043). A solid cell with nodes on both has the same degrees of freedom.
"""

from collections import Counter
from collections.abc import Mapping
from dataclasses import replace

import numpy as np
from numpy.typing import NDArray

from turgor.foundation.errors import TurgorError
from turgor.job.decks.febio.elements import Element
from turgor.job.decks.febio.meshes import FebMesh

Array = NDArray[np.float64]

#: Types of shells by their number of nodes, with the solid cells that they become.
SOLID_TYPES = {3: "penta6", 4: "hex8", 6: "penta15", 8: "hex20"}

#: Least cosine between the normal of a shell and the mean one at its corner: sharper folds have no thickness there.
LEAST_COSINE = 0.3


def thicken_shells(mesh: FebMesh, thickness: Mapping[str, float], rigid: list[str]) -> None:
    """Make solid cells of the shells that share no node with solid ones.

    Parameters
    ----------
    mesh : FebMesh
        Gets nodes on the back faces, in ``backs``, and solid cells in the place of those shells.
    thickness : mapping of str to float
        Thickness of each part of shells that has one; the others stay as they are.
    rigid : list of str
        Rigid parts, which are left out.

    Raises
    ------
    TurgorError
        If they branch or fold so sharply that they have no back.
    """
    solid = mesh.nodes_in(part for part in mesh.parts if mesh.solids[part] and part not in rigid)
    parts = [part for part in mesh.parts if not mesh.solids[part] and part not in rigid and thickness.get(part, 0) > 0]
    parts = [part for part in parts if not solid & mesh.nodes_in([part])]
    if not parts:
        return
    try:
        _check_branches(mesh, parts)
        vectors = _vectors(mesh, parts, thickness)
    except TurgorError as error:
        mesh.owners[f"part {parts[0]}"].fail(str(error))
    last = max(mesh.points)
    mesh.backs.update({node: last + k for k, node in enumerate(vectors, start=1)})
    for node, vector in vectors.items():
        mesh.points[mesh.backs[node]] = tuple((np.array(mesh.points[node]) - vector).tolist())
    for part in parts:
        _make_solid(mesh, part)


def _check_branches(mesh: FebMesh, parts: list[str]) -> None:
    """Refuse edges at which more than two shells meet: their back faces would cross."""
    edges = Counter[frozenset[int]]()
    for part in parts:
        count = mesh.corners[part]
        for nodes in mesh.parts[part].values():
            edges.update(frozenset((nodes[k], nodes[(k + 1) % count])) for k in range(count))
    crowded = [sorted(edge) for edge, count in edges.items() if count > 2]
    if crowded:
        first, second = min(crowded)
        raise TurgorError(
            f"more than two shells meet at the edge of the nodes {first} and {second}, or lie on another."
        )


def _vectors(mesh: FebMesh, parts: list[str], thickness: Mapping[str, float]) -> dict[int, Array]:
    """From the back to the front at each node: the mean of those of its shells, which are normal to them."""
    every: dict[int, list[Array]] = {}
    for part in parts:
        count = mesh.corners[part]
        for nodes in mesh.parts[part].values():
            normals = [thickness[part] * each for each in _normals(mesh, nodes[:count])]
            mids = [(normals[k] + normals[(k + 1) % count]) / 2 for k in range(len(nodes) - count)]
            for node, vector in zip(nodes, [*normals, *mids], strict=True):
                every.setdefault(node, []).append(vector)
    means = {node: np.mean(vectors, axis=0) for node, vectors in every.items()}
    for node, vectors in every.items():
        mean = means[node]
        if min(each @ mean for each in vectors) < LEAST_COSINE * max(map(np.linalg.norm, vectors)) ** 2:
            raise TurgorError(f"its shells fold too sharply at node {node}, or some are turned over there.")
    return means


def _normals(mesh: FebMesh, corners: list[int]) -> list[Array]:
    """Unit normals of one shell at its corners."""
    points = np.array([mesh.points[node] for node in corners])
    normals = np.cross(np.roll(points, -1, axis=0) - points, np.roll(points, 1, axis=0) - points)
    lengths = np.linalg.norm(normals, axis=1)
    if not lengths.min() > 0:
        raise TurgorError(f"the shell of the nodes {', '.join(map(str, corners))} has a corner without an angle.")
    return list(normals / lengths[:, None])


def _make_solid(mesh: FebMesh, part: str) -> None:
    """Put solid cells in the place of the shells of a part."""
    count, own = mesh.corners[part], mesh.owners[f"part {part}"]
    width = 0
    for number, nodes in mesh.parts[part].items():
        backs, width = [mesh.backs[node] for node in nodes], len(nodes)
        cell = [*backs[:count], *nodes[:count], *backs[count:], *nodes[count:]]
        if width > count:
            cell += [_middle(mesh, back, node) for back, node in zip(backs[:count], nodes[:count], strict=True)]
        mesh.parts[part][number] = cell
    mesh.owners[f"part {part}"] = replace(own, given={**own.given, "type": SOLID_TYPES[width]})
    mesh.solids[part], mesh.corners[part] = True, 2 * count


def _middle(mesh: FebMesh, back: int, front: int) -> int:
    """Number of the node between a front and a back."""
    if back not in mesh.middles:
        number = max(mesh.points) + 1
        mesh.points[number] = tuple(((np.array(mesh.points[back]) + mesh.points[front]) / 2).tolist())
        mesh.middles[back] = number
    return mesh.middles[back]


def stated_thickness(root: Element, domain: Element, part: str) -> float:
    """Thickness of the shells of a part: of the domain, or one for all in ``<MeshData>``; 0 where it varies."""
    if domain.word("shell_thickness") and domain.number("shell_thickness"):
        return domain.number("shell_thickness")
    values = {
        value
        for section in root.all("MeshData")
        for data in section.all("ElementData")
        if "shell thickness" in (data.given.get("type"), data.given.get("var")) and data.given.get("elem_set") == part
        for each in data.all("e")
        for value in each.numbers()
    }
    return values.pop() if len(values) == 1 else 0.0
