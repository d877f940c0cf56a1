"""Compare the declarations of a STEP file with the shape that the CAD kernel read: damaged files lose parts."""

import re
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError

#: Entities of a STEP file (ISO 10303-42) that make a solid, a shell of one, and a face.
_ENTITIES = {
    "bodies": ("MANIFOLD_SOLID_BREP", "BREP_WITH_VOIDS", "FACETED_BREP", "FACETED_BREP_AND_BREP_WITH_VOIDS"),
    "shells": ("CLOSED_SHELL",),
    "faces": ("ADVANCED_FACE", "FACE_SURFACE"),
}


def declared(text: str) -> dict[str, int]:
    """Count the bodies, closed shells and faces that the text of a STEP file declares.

    Examples
    --------
    >>> declared("#1=MANIFOLD_SOLID_BREP('CLOSED_SHELL(',#2);#2=CLOSED_SHELL('',(#3));#3=ADVANCED_FACE('',(),#4,.T.);")
    {'bodies': 1, 'shells': 1, 'faces': 1}
    """
    without = re.sub(r"'(?:[^']|'')*'|/\*.*?\*/", "", text, flags=re.DOTALL)
    return {
        what: len(re.findall(rf"(?<![A-Z0-9_])(?:{'|'.join(names)})\s*\(", without))
        for what, names in _ENTITIES.items()
    }


def check_complete(path: Path, shape: Any) -> None:
    """Raise an error if fewer bodies, shells or faces were read than a STEP file declares.

    A part that stands several times in an assembly is declared once, so more may be read.

    Raises
    ------
    TurgorError
    """
    read = {"bodies": shape.solids, "shells": shape.shells, "faces": shape.faces}
    for what, count in declared(path.read_bytes().decode("latin-1")).items():
        there = len(list(read[what]))
        if there < count:
            raise TurgorError(
                f"'{path}' declares {count} {what}, and {there} of them can be read: the file seems damaged; export it "
                "again from the CAD program, as STEP (AP214)."
            )
