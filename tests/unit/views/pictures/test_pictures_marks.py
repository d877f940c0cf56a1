"""Marks of supports and loads: each kind is listed with its place and direction, and drawn in its color there."""

import numpy as np
import pytest
import results_cases as cases
from matplotlib.colors import to_rgb

import turgor as tg
from turgor.core.model.model import Model
from turgor.core.results.fields.state_fields import StateFields
from turgor.units import mm
from turgor.views.pictures.marks.glyphs import COLORS, draw_marks
from turgor.views.pictures.marks.listing import marks_of
from turgor.views.pictures.settings import MARKS
from turgor.views.pictures.state_picture import shared_view, state_figure

NodesAt = tg.supports.NodesAt
RIM = NodesAt("rim", edge=("tip", "outside"))
CORNER = NodesAt("corner", near=(40 * mm, 10 * mm, 12 * mm))
PLATE = tg.supports.ReferencePoint("plate", "tip", spring=(0, 0, 5.0))
WHOLE = cases.body()


def fields(supports=(), loads=(), mesh=WHOLE):
    return StateFields(
        cases.state(Model(mesh, {"body": cases.RUBBER, "base": cases.RUBBER}, list(supports), list(loads)))
    )


def listed(supports=(), loads=(), mesh=WHOLE):
    return marks_of(fields(supports, loads, mesh))


@pytest.mark.parametrize(
    ("support", "kind", "x", "directions"),
    [
        (tg.Fixed("fixed"), "fixed", 0.0, [(0, 0, 0)]),
        (tg.Fixed("tip", "xz"), "roller", 40.0, [(1, 0, 0), (0, 0, 1)]),
        (tg.Fixed(RIM, "z"), "roller", 40.0, [(0, 0, 1)]),
        (tg.supports.Roller(CORNER, (3, 0, 4)), "roller", 40.0, [(0.6, 0, 0.8)]),
        (tg.supports.Foundation("fixed", 1e6), "spring", 0.0, [(-1, 0, 0)]),
        (tg.supports.Displacement("tip", (3 * mm, 0, -4 * mm)), "moved", 40.0, [(0.6, 0, -0.8)]),
        (tg.supports.Displacement("tip", (0, 0, 0)), "fixed", 40.0, [(0, 0, 0)]),
        (tg.supports.Slide("tip", (0, 0, 2), -1 * mm), "moved", 40.0, [(0, 0, -1)]),
    ],
)  # fmt: skip
def test_supports_have_marks_where_they_act(support, kind, x, directions):
    marks = listed([support])
    assert {mark.kind for mark in marks} == {kind}
    assert all(abs(mark.place[0] - x * mm) < 1e-9 for mark in marks)
    assert np.allclose(np.unique([mark.direction for mark in marks], axis=0), np.unique(directions, axis=0))


@pytest.mark.parametrize(
    ("load", "kind", "count", "place"),
    [
        (tg.loads.Force(CORNER, (0, 0, -2)), "force", 1, (40, 10, 12)),
        (tg.loads.PointForce((20 * mm, 0, 12 * mm), (0, 0, -2)), "force", 1, (20, 0, 12)),
        (tg.loads.LineForce(("tip", "outside"), (0, 0, -2)), "force", 6, None),
        (tg.loads.Traction("tip", (0, 0, -2)), "force", 6, None),
        (tg.loads.Hanging("plate", 0.1), "force", 1, (40, 0, 6)),
        (tg.loads.Moment("plate", (0, 0, -2)), "moment", 1, (40, 0, 6)),
    ],
)
def test_loads_have_arrows_where_they_act(load, kind, count, place):
    marks = [mark for mark in listed([PLATE], [load]) if mark.kind != "spring"]
    assert [mark.kind for mark in marks] == [kind] * count
    assert all(np.allclose(mark.direction, (0, 0, -1)) for mark in marks)
    assert place is None or np.allclose(marks[0].place, np.array(place) * mm)


def test_springs_of_a_point_have_marks_along_their_axes():
    (mark,) = listed([PLATE])
    assert mark.kind == "spring"
    assert np.allclose([mark.place, mark.direction], [(40 * mm, 0, 6 * mm), (0, 0, 1)])


def test_what_returns_counts_as_moved():
    there_and_back = tg.supports.Shift((0, 0, 1 * mm), [(0, 0), (0.5, 1), (1, 0)])
    assert {mark.kind for mark in listed([tg.supports.Displacement("tip", there_and_back)])} == {"moved"}


def test_a_half_has_the_marks_of_the_whole_and_none_of_its_mirror_plane_and_pressure():
    marks = listed([tg.Fixed("fixed")], [tg.Pressure("cavity", 1e3)], cases.body(half=True))
    assert {mark.kind for mark in marks} == {"fixed"}
    assert len(marks) <= MARKS.most
    corners = {(round(mark.place[1] / mm), round(mark.place[2] / mm)) for mark in marks}
    assert corners >= {(-10, 0), (-10, 12), (10, 0), (10, 12)}


def drawn(support, load, color):
    """Pixels (k, 2) of a picture that have a color, from the upper left, its shape, and its texts."""
    at = fields([support], [load])
    view = shared_view([at], width=500)
    figure = state_figure(at, view)
    draw_marks(figure, at, view, marks_of(at))
    figure.canvas.draw()
    image = np.asarray(figure.canvas.buffer_rgba())[..., :3] / 255
    near = np.abs(image - to_rgb(color)).max(axis=2) < 0.02
    return np.argwhere(near[: -3 * 50])[:, ::-1], image.shape, [text.get_text() for text in figure.texts]


@pytest.mark.parametrize(("free", "places"), [(False, [20]), (True, [-0.8, 40.8])])
def test_a_liquid_has_a_mark_at_its_level(free, places):
    """At both ends of what stands in a pool, in the middle of what is filled; none at a level far above."""
    face, up = "outside", (0, 0, 1)
    water = [tg.loads.HydrostaticPressure(face=face, density=1000, level=h, free_surface=free) for h in ("9 mm", "1 m")]
    marks = [mark for mark in listed([tg.Fixed("fixed")], water) if mark.kind == "level"]
    assert np.allclose(sorted(mark.place[0] for mark in marks), np.array(places) * mm, atol=0.5 * mm)
    assert all(mark.place[2] == pytest.approx(9 * mm) and np.allclose(mark.direction, up) for mark in marks)
    colored, _, texts = drawn(tg.Fixed("fixed"), water[0], COLORS["level"])
    assert "level" in texts
    assert (len(colored) > 20) is free  # paler inside


def test_marks_and_a_legend_are_drawn_in_their_colors():
    places, (height, width, _), texts = drawn(tg.Fixed("fixed"), tg.loads.Force(CORNER, (0, 0, -1)), COLORS["force"])
    assert {"fixed", "force"} <= set(texts)
    assert not {"roller", "spring", "moved", "moment"} & set(texts)
    assert len(places) > 20
    assert places[:, 0].mean() > 0.8 * width
    assert places[:, 1].mean() < 0.5 * height
    green, *_ = drawn(tg.Fixed("fixed"), tg.loads.Force(CORNER, (0, 0, -1)), COLORS["fixed"])
    assert green[:, 0].min() < 0.15 * width


def test_marks_behind_the_actuator_are_paler():
    behind = NodesAt("behind", near=(0, -0, 0))
    green, *_ = drawn(tg.Fixed(behind), tg.Pressure("cavity", 1e3), COLORS["fixed"])
    assert not len(green)
