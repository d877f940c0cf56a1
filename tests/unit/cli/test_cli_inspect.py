"""``turgor inspect`` lists what a CAD file holds, and draws it."""

from math import pi

import cad_cases as cases
import matplotlib.image
import pytest

from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.geometry.cad.inspection import inspect_cad
from turgor.units import mm


def test_bodies_faces_and_cavities_are_listed(capsys):
    assert main(["inspect", str(cases.DATA / "cup_and_plate.step")]) == DONE
    out, err = capsys.readouterr()
    assert "cup_and_plate.step: 40 x 20 x 12.5 mm (unit mm, from the file); thinnest wall 2 mm" in out
    assert "2 bodies, 18 faces, 1 cavity." in out
    lines = out.splitlines()
    (plate,) = [line.split() for line in lines if line.strip().startswith("base plate")]
    assert plate[2:4] == ["#0000ff", "2000"]
    (cavity,) = [line for line in lines if line.strip().startswith("cavity") and "open" in line]
    assert "3829.2" in cavity
    assert "7.069 mm² at (0, 0, 6.5) mm" in cavity
    assert sum(line.strip().startswith("outside") for line in lines) == 10
    assert any(line.split()[:1] == ["cavity"] and "-z" in line and "476" in line for line in lines)
    assert "D05 note: 'cup_and_plate.step' has no face named fixed or tip." in err


def test_the_picture_shows_the_cavity_in_color(tmp_path, capsys):
    picture = tmp_path / "part.png"
    assert main(["inspect", str(cases.DATA / "tube_radial_inlet.step"), "--picture", str(picture)]) == DONE
    assert f"Picture in {picture}." in capsys.readouterr().out
    pixels = matplotlib.image.imread(picture)[..., :3]
    blue = (pixels[..., 2] - pixels[..., 0] > 0.2).mean()
    red = ((pixels[..., 0] > 0.7) & (pixels[..., 1] < 0.3)).sum()
    assert blue > 0.02
    assert red > 5  # the dots at the opening
    assert (pixels > 0.99).all(axis=2).mean() > 0.3


def test_mistakes_end_with_a_sentence(tmp_path, capsys):
    assert main(["inspect", str(tmp_path / "none.step")]) == BAD_INPUT
    assert states(capsys.readouterr().err, "none.step")
    assert main(["inspect", str(cases.DATA / "cup_and_plate.step"), "--picture", "part.jpg"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "part.jpg", ".png")
    assert main(["inspect", str(cases.DATA / "cup_and_plate.step"), "--unit", "parsec"]) == BAD_INPUT
    assert "unit is 'parsec'" in capsys.readouterr().err


def test_the_inspection_says_what_is_drawn():
    result = inspect_cad(cases.DATA / "cup_and_plate.step")
    assert [side / mm for side in result.size] == pytest.approx([40, 20, 12.5], rel=1e-6)
    assert [body.region for body in result.bodies] == ["top", "base plate"]
    assert sum(face.area for face in result.faces) / mm**2 == pytest.approx(5144 + 2 * pi * 1.5 * 3 - 2 * pi * 1.5**2)
    assert all(face.triangles.shape[1:] == (3, 3) for face in result.faces)
