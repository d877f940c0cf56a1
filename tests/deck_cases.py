"""Decks for tests: a block of two bricks, with keywords of a test in the places where decks have them."""

from pathlib import Path

NODES = """\
*NODE, NSET=ALL
1, 0., 0., 0.
2, 10., 0., 0.
3, 10., 10., 0.
4, 0., 10., 0.
5, 0., 0., 10.
6, 10., 0., 10.
7, 10., 10., 10.
8, 0., 10., 10.
9, 0., 0., 20.
10, 10., 0., 20.
11, 10., 10., 20.
12, 0., 10., 20.
"""

CELLS = """\
*ELEMENT, TYPE=C3D8, ELSET=BLOCK
1, 1,2,3,4,5,6,7,8
2, 5,6,7,8,9,10,11,12
*NSET, NSET=BOTTOM
1,2,3,4
*NSET, NSET=TOP
9,10,11,12
*NSET, NSET=X0
1,4,5,8,9,12
*NSET, NSET=Y0
1,2,5,6,9,10
*SURFACE, NAME=LID, TYPE=ELEMENT
2, S2
"""

RUBBER = "*HYPERELASTIC, NEO HOOKE\n0.1, 0.4\n"

FIXED = "*BOUNDARY\nBOTTOM, 1, 3\n"

PULL = "*DSLOAD\nLID, P, -0.03\n"


def step(lines: str, period: float = 1.0, parameters: str = "") -> str:
    """A static step with loads."""
    return f"*STEP, NLGEOM{parameters}\n*STATIC\n0.1, {period}\n{lines}*NODE PRINT, NSET=ALL\nU\n*END STEP\n"


def deck(folder: Path, *, material: str = RUBBER, model: str = FIXED, steps: str = step(PULL), mesh: str = "") -> Path:
    """Write a deck of the block, of one material."""
    file = folder / "block.inp"
    section = f"*MATERIAL, NAME=SOFT\n{material}*SOLID SECTION, ELSET=BLOCK, MATERIAL=SOFT\n"
    file.write_text(f"*HEADING\na block\n{mesh or NODES + CELLS}{section}{model}{steps}", encoding="utf-8")
    return file
