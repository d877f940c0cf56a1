"""A hollow cube, and mesh files of it written by hand: 3 x 3 x 3 cells of 10 mm with the middle one left out."""

import base64
import struct
import zlib

import numpy as np

#: The six tetrahedra of a hexahedron around its diagonal from corner 0 to corner 6, right-handed.
TETRAHEDRA = ((0, 1, 2, 6), (0, 2, 3, 6), (0, 3, 7, 6), (0, 7, 4, 6), (0, 4, 5, 6), (0, 5, 1, 6))

#: Place in VTK's order of each node in gmsh's order.
GMSH_TETRAHEDRON_10 = (0, 1, 2, 3, 4, 5, 6, 7, 9, 8)
GMSH_HEXAHEDRON_20 = (0, 1, 2, 3, 4, 5, 6, 7, 8, 11, 16, 9, 17, 10, 18, 19, 12, 15, 13, 14)


def hollow_cube(tetrahedra=False, side=10.0):
    """Points [mm], cells in VTK's order, and the cells of the lowest layer."""
    grid = np.arange(64).reshape(4, 4, 4)
    points = np.stack(np.meshgrid(*3 * [side * np.arange(4.0)], indexing="ij"), axis=-1).reshape(-1, 3)
    cells, low = [], []
    for i, j, k in np.ndindex(3, 3, 3):
        if (i, j, k) == (1, 1, 1):
            continue
        g = grid[i : i + 2, j : j + 2, k : k + 2]
        cells.append([g[0, 0, 0], g[1, 0, 0], g[1, 1, 0], g[0, 1, 0], g[0, 0, 1], g[1, 0, 1], g[1, 1, 1], g[0, 1, 1]])
        low.append(k == 0)
    cells, low = np.array(cells), np.array(low)
    if tetrahedra:
        return points, cells[:, np.array(TETRAHEDRA)].reshape(-1, 4), np.repeat(low, 6)
    return points, cells, low


def quads_at(cells, points, axis, position):
    """Sides of hexahedra on a plane, corners as they come."""
    sides = ((0, 3, 2, 1), (4, 5, 6, 7), (0, 1, 5, 4), (1, 2, 6, 5), (2, 3, 7, 6), (3, 0, 4, 7))
    results = [c[list(s)] for c in cells for s in sides if np.allclose(points[c[list(s)], axis], position)]
    return np.array(results)


def triangles_at(cells, points, axis, position):
    """Sides of tetrahedra on a plane."""
    sides = ((0, 1, 3), (1, 2, 3), (2, 0, 3), (0, 2, 1))
    results = [c[list(s)] for c in cells for s in sides if np.allclose(points[c[list(s)], axis], position)]
    return np.array(results)


def text_of(rows):
    return "\n".join(" ".join(str(value) for value in row) for row in rows)


def gmsh_2(points, blocks, names):
    """Blocks of (gmsh number, nodes, group of each cell); names of (dimension, group)."""
    elements, number = [], 0
    for kind, cells, groups in blocks:
        for cell, group in zip(cells, groups, strict=True):
            number += 1
            elements.append([number, kind, 2, group, 1, *(cell + 1)])
    lines = ["$MeshFormat", "2.2 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{dimension} {group} "{name}"' for (dimension, group), name in names.items()]
    lines += ["$EndPhysicalNames", "$Nodes", str(len(points))]
    lines += [f"{i} {x!r} {y!r} {z!r}" for i, (x, y, z) in enumerate(points.tolist(), 1)]
    lines += ["$EndNodes", "$Elements", str(len(elements)), text_of(elements), "$EndElements", ""]
    return "\n".join(lines)


def gmsh_2_binary(points, blocks, names, order="<"):
    """As `gmsh_2`, in a byte order."""
    head = "\n".join(["$PhysicalNames", str(len(names)), *(f'{d} {g} "{n}"' for (d, g), n in names.items())])
    nodes = b"".join(struct.pack(order + "i3d", i, *point) for i, point in enumerate(points.tolist(), 1))
    number, elements = 0, b""
    for kind, cells, groups in blocks:
        elements += struct.pack(order + "3i", kind, len(cells), 2)
        for cell, group in zip(cells, groups, strict=True):
            number += 1
            elements += struct.pack(f"{order}{3 + len(cell)}i", number, group, 1, *(cell + 1))
    out = b"$MeshFormat\n2.2 1 8\n" + struct.pack(order + "i", 1) + b"\n$EndMeshFormat\n" + head.encode()
    out += b"\n$EndPhysicalNames\n$Nodes\n" + f"{len(points)}\n".encode() + nodes
    return out + b"\n$EndNodes\n$Elements\n" + f"{number}\n".encode() + elements + b"\n$EndElements\n"


def gmsh_4_binary(points, blocks, names, order="<"):
    """As `gmsh_4`, in a byte order; the second half of the nodes has a parameter on a curve."""
    head = "\n".join(["$PhysicalNames", str(len(names)), *(f'{d} {g} "{n}"' for (d, g), n in names.items())])
    known = sorted({(dimension, entity) for dimension, entity, _, _ in blocks})
    entities = struct.pack(order + "4Q", *(sum(d == dimension for d, _ in known) for dimension in range(4)))
    for d, entity in known:
        groups = [entity] if (d, entity) in names else []
        entities += struct.pack(f"{order}i6dQ{len(groups)}iQ2i", entity, *6 * [0.0], len(groups), *groups, 2, 7, 8)
    half, count = len(points) // 2, len(points)
    nodes = struct.pack(order + "4Q", 2, count, 1, count)
    for start, end, dimension in ((0, half, 0), (half, count, 1)):
        nodes += struct.pack(order + "3iQ", dimension, 1, dimension, end - start)
        nodes += struct.pack(f"{order}{end - start}Q", *range(start + 1, end + 1))
        nodes += b"".join(
            struct.pack(f"{order}{3 + dimension}d", *point, *dimension * [0.5]) for point in points[start:end]
        )
    total = sum(len(cells) for *_, cells in blocks)
    elements, number = struct.pack(order + "4Q", len(blocks), total, 1, total), 0
    for d, entity, kind, cells in blocks:
        elements += struct.pack(order + "3iQ", d, entity, kind, len(cells))
        for cell in cells:
            number += 1
            elements += struct.pack(f"{order}{1 + len(cell)}Q", number, *(cell + 1))
    out = b"$MeshFormat\n4.1 1 8\n" + struct.pack(order + "i", 1) + b"\n$EndMeshFormat\n" + head.encode()
    out += b"\n$EndPhysicalNames\n$Entities\n" + entities + b"\n$EndEntities\n$Nodes\n" + nodes
    return out + b"\n$EndNodes\n$Elements\n" + elements + b"\n$EndElements\n"


def gmsh_4(points, blocks, names):
    """Blocks of (dimension, entity, gmsh number, nodes); names of (dimension, entity), group number = entity."""
    entities = sorted({(dimension, entity) for dimension, entity, _, _ in blocks})
    counts = [sum(d == dimension for d, _ in entities) for dimension in range(4)]
    lines = ["$MeshFormat", "4.1 0 8", "$EndMeshFormat", "$PhysicalNames", str(len(names))]
    lines += [f'{d} {entity} "{name}"' for (d, entity), name in names.items()]
    lines += ["$EndPhysicalNames", "$Entities", " ".join(map(str, counts))]
    for d, entity in entities:
        groups = [entity] if (d, entity) in names else []
        lines.append(" ".join(map(str, [entity, 0, 0, 0, 1, 1, 1, len(groups), *groups, 0])))
    half = len(points) // 2
    lines += ["$EndEntities", "$Nodes", f"2 {len(points)} 1 {len(points)}"]
    for start, end in ((0, half), (half, len(points))):
        lines.append(f"3 1 0 {end - start}")
        lines += [str(i + 1) for i in range(start, end)]
        lines += [f"{x!r} {y!r} {z!r}" for x, y, z in points[start:end].tolist()]
    total = sum(len(cells) for *_, cells in blocks)
    lines += ["$EndNodes", "$Elements", f"{len(blocks)} {total} 1 {total}"]
    number = 0
    for d, entity, kind, cells in blocks:
        lines.append(f"{d} {entity} {kind} {len(cells)}")
        for cell in cells:
            number += 1
            lines.append(" ".join(map(str, [number, *(cell + 1)])))
    return "\n".join([*lines, "$EndElements", ""])


def inp_nodes(points):
    return ["*NODE, NSET=all", *(f"{i}, {x!r}, {y!r}, {z!r}" for i, (x, y, z) in enumerate(points.tolist(), 1))]


def inp_cells(kind, cells, first=1, elset=None):
    head = f"*Element, type={kind}" + (f", elset={elset}" if elset else "")
    return [head, *(", ".join(map(str, [first + i, *(cell + 1)])) for i, cell in enumerate(cells))]


def vtk_legacy(points, blocks, binary=False, version=2, labels=None):
    """Blocks of (VTK number, nodes), written in their order."""
    cells = [(kind, cell) for kind, nodes in blocks for cell in nodes]
    head = f"# vtk DataFile Version {version}.0\ncube\n{'BINARY' if binary else 'ASCII'}\nDATASET UNSTRUCTURED_GRID\n"

    def array(values, kind):
        if binary:
            return np.asarray(values).astype(kind).tobytes() + b"\n"
        return (" ".join(repr(value) for value in np.asarray(values).ravel().tolist()) + "\n").encode()

    out = head.encode() + f"POINTS {len(points)} double\n".encode() + array(points, ">f8")
    if version < 5:
        table = np.concatenate([[len(cell), *cell] for _, cell in cells])
        out += f"CELLS {len(cells)} {len(table)}\n".encode() + array(table, ">i4")
    else:
        offsets = np.cumsum([0] + [len(cell) for _, cell in cells])
        nodes = np.concatenate([cell for _, cell in cells])
        out += f"CELLS {len(offsets)} {len(nodes)}\nOFFSETS vtktypeint64\n".encode() + array(offsets, ">i8")
        out += b"CONNECTIVITY vtktypeint64\n" + array(nodes, ">i8")
    out += f"CELL_TYPES {len(cells)}\n".encode() + array([kind for kind, _ in cells], ">i4")
    if labels is not None:
        out += f"CELL_DATA {len(cells)}\nSCALARS material int 1\nLOOKUP_TABLE default\n".encode()
        out += array(labels, ">i4")
    return out


def vtu(points, blocks, form="ascii", compressed=False, header="UInt32", order="LittleEndian"):
    """A .vtu file; form is ascii, base64, raw or appended-base64."""
    cells = [(kind, cell) for kind, nodes in blocks for cell in nodes]
    e = "<" if order == "LittleEndian" else ">"
    arrays = {
        "points": ("Float64", np.asarray(points, e + "f8")),
        "connectivity": ("Int64", np.concatenate([cell for _, cell in cells]).astype(e + "i8")),
        "offsets": ("Int32", np.cumsum([len(cell) for _, cell in cells]).astype(e + "i4")),
        "types": ("UInt8", np.array([kind for kind, _ in cells]).astype("u1")),
    }
    size = e + ("I" if header == "UInt32" else "Q")
    appended = b""

    def packed(values):
        data = values.tobytes()
        if not compressed:
            return struct.pack(size, len(data)) + data, b""
        parts = [zlib.compress(data[i : i + 1000]) for i in range(0, len(data), 1000)]
        numbers = [len(parts), 1000, len(data) % 1000, *map(len, parts)]
        return b"".join(struct.pack(size, n) for n in numbers), b"".join(parts)

    def element(name):
        nonlocal appended
        kind, values = arrays[name]
        start = f'<DataArray type="{kind}" Name="{name}" NumberOfComponents="{3 if name == "points" else 1}"'
        if form == "ascii":
            return f'{start} format="ascii">{" ".join(map(repr, values.ravel().tolist()))}</DataArray>'
        head, body = packed(values)
        coded = base64.b64encode(head + body) if not compressed else base64.b64encode(head) + base64.b64encode(body)
        if form == "base64":
            return f'{start} format="binary">\n  {coded.decode()}\n</DataArray>'
        offset = len(appended)
        appended += head + body if form == "raw" else coded
        return f'{start} format="appended" offset="{offset}"/>'

    compressor = ' compressor="vtkZLibDataCompressor"' if compressed else ""
    text = (
        f'<?xml version="1.0"?><VTKFile type="UnstructuredGrid" byte_order="{order}" '
        f'header_type="{header}"{compressor}>'
        f'<UnstructuredGrid><Piece NumberOfPoints="{len(points)}" NumberOfCells="{len(cells)}">'
        f"<Points>{element('points')}</Points>"
        f"<Cells>{element('connectivity')}{element('offsets')}{element('types')}</Cells>"
        "</Piece></UnstructuredGrid>"
    )
    out = text.encode()
    if appended:
        encoding = "raw" if form == "raw" else "base64"
        out += f'<AppendedData encoding="{encoding}">_'.encode() + appended + b"</AppendedData>"
    return out + b"</VTKFile>"


def centers(mesh, name):
    """Centers of the sides of a face, sorted."""
    corners = mesh.faces[name][:, : mesh.cell_type.side.corners]
    result = mesh.points[corners].mean(axis=1)
    return result[np.lexsort(np.round(result, 9).T)]


def grid(counts: tuple[int, int, int], low: tuple[float, ...], size: float) -> tuple[np.ndarray, np.ndarray]:
    """Points [mm] and hexahedra of a box of cubes."""
    nx, ny, nz = (count + 1 for count in counts)
    k, j, i = np.meshgrid(range(nz), range(ny), range(nx), indexing="ij")
    points = np.column_stack([i.ravel(), j.ravel(), k.ravel()]) * size + np.array(low)
    at = np.arange(nx * ny * nz).reshape(nz, ny, nx)
    corner = [
        at[c : nz - 1 + c, b : ny - 1 + b, a : nx - 1 + a].ravel() for c in (0, 1) for b in (0, 1) for a in (0, 1)
    ]
    return points, np.column_stack([corner[n] for n in (0, 1, 3, 2, 4, 5, 7, 6)])
