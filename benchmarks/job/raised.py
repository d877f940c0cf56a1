"""Decks of first-order hexahedra with mid-side nodes on their edges, so that CalculiX has cells of 20 nodes."""

import re

#: Edges of a hexahedron in the order of the mid-side nodes of ``C3D20``.
EDGES = (
    *((k, (k + 1) % 4) for k in range(4)),
    *((4 + k, 4 + (k + 1) % 4) for k in range(4)),
    *((k, k + 4) for k in range(4)),
)


def raised(text: str) -> str:
    """Return a deck with ``C3D20`` in the place of ``C3D8``; sets get the middles of edges whose ends they have."""
    blocks = _blocks(text)
    nodes = {int(row[0]): [float(x) for x in row[1:4]] for head, rows in blocks if _is(head, "NODE") for row in rows}
    middles: dict[frozenset[int], int] = {}
    first = 10 ** len(str(max(nodes)))
    for head, rows in blocks:
        for row in rows if _is(head, "ELEMENT") and "C3D8" in head.upper() else ():
            for a, b in EDGES:
                middles.setdefault(frozenset((int(row[1 + a]), int(row[1 + b]))), first + len(middles))
    loaded = {row[0].upper() for head, rows in blocks if _is(head, "CLOAD") for row in rows}
    return "\n".join(line for block in blocks for line in _written(block, nodes, middles, loaded)) + "\n"


def _written(
    block: tuple[str, list[list[str]]],
    nodes: dict[int, list[float]],
    middles: dict[frozenset[int], int],
    loaded: set[str],
) -> list[str]:
    """Lines of a keyword; sets with forces on their nodes stay as they are."""
    head, rows = block
    lines = [", ".join(row) for row in rows]
    if _is(head, "ELEMENT") and "C3D8" in head.upper():
        made = [
            "*NODE, NSET=NALL",  # the usual name of the set of all nodes in this collection
            *(f"{number}, {_halfway(*(nodes[end] for end in ends))}" for ends, number in middles.items()),
        ]
        cells = []
        for row in rows:
            new = [str(middles[frozenset((int(row[1 + a]), int(row[1 + b])))]) for a, b in EDGES]
            cells += [", ".join([*row[:9], *new[:4]]) + ",", ", ".join(new[4:])]
        return [*made, re.sub(r"C3D8\w*", "C3D20", head, flags=re.IGNORECASE), *cells]
    name = re.search(r"NSET *= *([^,\s]+)", head, flags=re.IGNORECASE)
    if _is(head, "NSET") and "GENERATE" not in head.upper() and name is not None and name[1].upper() not in loaded:
        known = {int(word) for row in rows for word in row if word.isdigit()}
        lines += [f"{number}," for ends, number in middles.items() if ends <= known]
    return [head, *lines]


def _halfway(one: list[float], other: list[float]) -> str:
    return ", ".join(f"{(x + y) / 2:.12g}" for x, y in zip(one, other, strict=True))


def _blocks(text: str) -> list[tuple[str, list[list[str]]]]:
    """Keywords with the words of their lines."""
    blocks: list[tuple[str, list[list[str]]]] = []
    for line in text.splitlines():
        if line.startswith("**") or not line.strip():
            continue
        if line.startswith("*"):
            blocks.append((line, []))
        elif blocks:
            words = [word.strip() for word in line.split(",")]
            while words and not words[-1]:
                words.pop()
            head, rows = blocks[-1]
            if _is(head, "ELEMENT") and rows and len(rows[-1]) < 9:
                rows[-1] += words
            else:
                rows.append(words)
    return blocks


def _is(head: str, name: str) -> bool:
    return head[1:].split(",")[0].strip().upper() == name
