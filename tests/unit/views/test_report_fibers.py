"""What the report says of fibers, of sheets that resist bending and of radial supports."""

import results_cases

import turgor as tg
from turgor.core.model.fibers import Fibers, Winding
from turgor.core.model.supports import Radial
from turgor.units import deg, mm
from turgor.views.report import describe


def test_fibers_sheets_and_radial_supports_in_words():
    mesh = results_cases.body()
    kevlar = tg.from_library("kevlar-fiber")
    paper = tg.from_library("paper", record="hooke-yang-2020")
    (face, *_) = (name for name in mesh.faces if name not in ("fixed", "tip"))
    winding = Winding(angle_from_axis=60 * deg, spacing=2 * mm, hand="both")
    braid = Fibers(face=face, material=kevlar, diameter=0.1778 * mm, winding=winding)
    rods = Fibers(
        face=face,
        material=kevlar,
        diameter=1 * mm,
        winding=Winding(turns=3, starts=2),
        compression=0.5,
        form="discrete",
    )
    sheet = tg.Shell(paper, 0.5 * mm)
    regions = dict.fromkeys(mesh.regions, results_cases.RUBBER)
    model = tg.Model(mesh, regions | {face: sheet}, [Radial(face)], [], reinforcements=[braid, rods])
    *_, shell, first, second = describe.materials(model)
    words = face.replace("_", " ")
    assert shell.where == f"{words} (shell)"
    assert (first.where, first.name) == (f"{words} (smeared fibers)", "Kevlar fiber")
    assert first.values == [
        ("coefficients", "E = 31.067 GPa, nu = 0.36"),
        ("diameter", "0.1778 mm"),
        ("angle from axis", "60°"),
        ("spacing", "2 mm"),
        ("helix", "both hands"),
    ]
    assert second.values[1:] == [
        ("diameter", "1 mm"),
        ("turns", "3"),
        ("starts", "2"),
        ("helix", "right-handed"),
        ("in compression", "50 % of the stiffness"),
    ]
    assert "Connolly" in first.source
    assert describe.supports(model)[0] == f"{face} does not move radially, around the axis (1.0, 0.0, 0.0)."
