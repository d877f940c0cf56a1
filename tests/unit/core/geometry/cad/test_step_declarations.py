"""A damaged STEP file that loses a body, a shell or a face is refused, not read as another part."""

import re
from pathlib import Path

import pytest

from turgor.core.geometry.cad.read import read_cad
from turgor.core.geometry.cad.step_declarations import declared
from turgor.foundation.errors import TurgorError

EXAMPLES = Path(__file__).parents[5] / "examples"


def damaged(tmp_path: Path, file: str, line: str, old: str, new: str, place: int = 0) -> Path:
    """Copy of a STEP file with one word changed in one of the lines that match a pattern."""
    lines = (EXAMPLES / file).read_text("latin-1").splitlines(keepends=True)
    number = [k for k, each in enumerate(lines) if re.search(line, each)][place]
    assert old in lines[number]
    lines[number] = lines[number].replace(old, new, 1)
    copy = tmp_path / "damaged.step"
    copy.write_text("".join(lines), "latin-1")
    return copy


@pytest.mark.parametrize(
    ("file", "line", "old", "new"),
    [
        ("cad_file.step", "AXIS2_PLACEMENT_3D", "AXIS2", "AXIS0"),
        ("cad_file.step", "MANIFOLD_SOLID_BREP", "MANIFOLD_SOLID", "MANIFOLD_SOLIT"),
        ("cad_file.step", "ADVANCED_FACE", "ADVANCED_FACE", "ADVANCED_FACT"),
        ("skew_fins.step", "BREP_WITH_VOIDS", "BREP_WITH_VOIDS", "BREP_WITH_VOIDZ"),
        ("skew_fins.step", "CLOSED_SHELL", "CLOSED_SHELL", "CLOSED_SHELT"),
    ],
)
def test_a_file_that_lost_something_is_refused(tmp_path, file, line, old, new):
    refused = []
    for place in (0, -1):
        try:
            read_cad(damaged(tmp_path, file, line, old, new, place))
        except TurgorError as error:
            refused.append(str(error))
    assert refused, "no damage was noticed"
    assert all("damaged" in text or "holds no solid" in text for text in refused)


def test_whole_files_are_read():
    for file in ("cad_file.step", "skew_fins.step"):
        assert declared((EXAMPLES / file).read_text("latin-1"))["bodies"] >= 1
        read_cad(EXAMPLES / file)
