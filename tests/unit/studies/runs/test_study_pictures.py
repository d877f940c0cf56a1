"""Pictures of studies: the kind follows the number of factors, and mesh errors that hide an effect are told."""

import numpy as np
from matplotlib.figure import Figure

import turgor as tg
from refused import refused
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source

AT = ("pressure", 5e3)


def angle(wall: float, chambers: int = 4, gap: float = 1e-3, rubber: str = "soft", error: float = 0.0) -> Response:
    """An angle that falls with the wall by 1° from 1 to 2 mm, and is no function of the gap."""
    if wall > 3e-3 and chambers > 4:
        raise TurgorError("walls overlap.")
    pressure = np.array([0.0, 5e3, 10e3])
    bent = pressure / 5e3 * (3e-3 - wall) * chambers / 4 * np.deg2rad(1) / 1e-3 * (2.0 if rubber == "soft" else 1.0)
    columns = [Column("pressure", "kPa", pressure), Column("bending_angle", "deg", bent)]
    columns += [Column("bending_angle_mesh_error", "deg", np.full(3, np.deg2rad(error)))] if error else []
    return Response(columns=tuple(columns), source=Source(text="a rule"))


def drawn(**levels) -> Figure:
    figure = tg.studies.study_picture(tg.sweep(angle, {"error": 0.1}, **levels), "bending_angle", AT)
    figure.canvas.draw()
    return figure


WALLS = [1e-3, 2e-3, 4e-3]


def test_the_kind_follows_the_factors():
    curves, effect = drawn(wall=WALLS).axes
    assert curves.get_xlabel() == "pressure [kPa]"
    assert effect.get_ylabel() == "bending angle at 5 kPa [°]"
    effects, heat = drawn(wall=WALLS, chambers=[4, 6]).axes
    assert [each.get_text() for each in effects.get_legend().get_texts()] == ["4", "6"]
    assert [each.get_text() for each in heat.texts].count("failed") == 1
    assert len(drawn(wall=WALLS, chambers=[4, 6], gap=[1e-3, 2e-3]).axes) == 2
    (many,) = drawn(wall=WALLS, chambers=[4, 6], gap=[1e-3, 2e-3], rubber=["soft", "stiff"]).axes
    assert len(many.patches) == 24
    assert "rubber" in [each.get_text() for each in many.texts]


def test_designs_off_a_grid_have_parallel_coordinates():
    factors = [tg.studies.Factor(name="wall", low=1e-3, high=2e-3, unit="mm"),
               tg.studies.Factor(name="gap", low=1e-3, high=2e-3, unit="mm")]  # fmt: skip
    study = tg.sweep(angle, None, tg.studies.latin_hypercube(factors, 5))
    (axes,) = tg.studies.study_picture(study, "bending_angle").axes
    assert [each.get_text() for each in axes.texts if "[" in each.get_text()] == [
        "wall [mm]", "gap [mm]", "bending angle [°]",
    ]  # fmt: skip
    with refused("2 factors", "full grid"):
        tg.studies.map_picture(study, "bending_angle")


def test_effects_within_mesh_errors_are_told():
    """From 1 to 2 mm the angle falls by 2°: mesh errors of 0.9° each do not hide it, those of 1.1° do."""
    seen = tg.sweep(angle, {"error": 0.9}, wall=[1e-3, 2e-3])
    assert tg.studies.hidden_by_mesh(seen, "bending_angle", AT) == ()
    hidden = tg.sweep(angle, {"error": 1.1}, wall=[1e-3, 2e-3])
    (sentence,) = tg.studies.hidden_by_mesh(hidden, "bending_angle", AT)
    assert sentence.startswith("bending angle at 5 kPa: mesh errors hide 1 of 1 differences between neighboring levels")
    assert "such as 2° from 0.001 to 0.002 against mesh errors of 2.2°" in sentence
    axes = tg.studies.study_picture(hidden, "bending_angle", AT).axes[1]
    assert [each.get_text() for each in axes.get_legend().get_texts()] == ["difference within the mesh error"]
    assert tg.studies.study_picture(seen, "bending_angle", AT).axes[1].get_legend() is None


def test_without_mesh_errors_nothing_is_hidden():
    study = tg.sweep(angle, wall=WALLS, gap=[1e-3, 2e-3])
    assert tg.studies.hidden_by_mesh(study, "bending_angle") == ()


def test_a_study_whose_runs_all_failed():
    study = tg.sweep(angle, {"chambers": 6}, wall=[4e-3, 5e-3])
    with refused("2 runs", "walls overlap"):
        tg.studies.study_picture(study, "bending_angle")
