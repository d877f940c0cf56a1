"""Guidelines of 7.0, 7.1 and 7.2: their keys, the names of their runs, and judges that come out either way."""

import numpy as np
import pytest

import turgor as tg
from turgor.studies import Computed
from turgor.units import kPa
from turgor_guidelines.catalog import guidelines
from turgor_guidelines.fiber_reinforced import braids, double_wrap, single_wrap, too_dense, two_sides
from turgor_guidelines.guideline import Verdict
from turgor_guidelines.single_chamber import best_shape, layer_ratio, shapes, thin_walls, two_directions
from turgor_guidelines.values import MESH_ERROR

KEYS = [
    *(f"7.0-{k}" for k in range(1, 5)),
    *(f"7.1-{k}" for k in range(1, 9)),
    *(f"7.2-{k}" for k in range(1, 9)),
]
PRESSURES = np.linspace(0, 1, 11)


def made_up(last_pressure, error=0.0, **columns):
    """What a run would have found: columns against pressures up to the last one [kPa], or their last values."""
    pressure = PRESSURES * last_pressure * kPa
    made = [tg.experiments.Column("pressure", "kPa", pressure)]
    for name, values in columns.items():
        rest = 1.0 if name in ("stretch", "outside_ballooning", "largest_stretch") else 0.0
        values = rest + (values - rest) * PRESSURES if np.isscalar(values) else values
        unit = {"twist": "1/m", "curvature_y": "1/m", "curvature": "1/m", "blocked_moment": "Nm"}.get(name, "")
        unit = "mm" if name == "tip_displacement_x" else unit
        made.append(tg.experiments.Column(name, unit, values))
        if error:
            made.append(tg.experiments.Column(name + MESH_ERROR, unit, np.full(len(PRESSURES), error)))
    return Computed(response=tg.Response(columns=tuple(made), source=tg.laws.Source(text="made up")))


def test_all_items_are_there():
    about_chambers = "7.0-5"
    keys = [key for key in guidelines() if key.rpartition("-")[0] in ("7.0", "7.1", "7.2")]
    assert [key for key in keys if key != about_chambers] == KEYS


@pytest.mark.parametrize("key", KEYS)
def test_runs(key):
    for study in guidelines()[key].studies:
        for setting in ("quick", "full"):
            runs = study.runs(setting)
            assert len({run.name for run in runs}) == len(runs) > 1
        assert {run.key for run in study.runs("quick")} != {run.key for run in study.runs("full")}
        assert study.setup and study.expected


def helices(most_twist, longest=0.0, axial=1.001):
    """Tubes whose twist, as a parabola of the angle, is largest at an angle from the circumference."""
    results = {}
    for angle in single_wrap.QUICK:
        stretch = 1.2 - abs(angle - longest) / 500 if angle < 90 else axial
        twist = max(4e3 - (angle - most_twist) ** 2, 0.0) * 1e-2
        results[f"{angle} deg"] = made_up(62.5, stretch=stretch, outside_ballooning=1 + angle / 100, twist=-twist)
    return results


@pytest.mark.parametrize(
    ("runs", "verdict"),
    [
        (helices(30.0), Verdict.CONFIRMED),
        (helices(45.0), Verdict.NOT_REPRODUCED),
        (helices(30.0, longest=30.0), Verdict.NOT_REPRODUCED),
        (helices(30.0, axial=1.1), Verdict.NOT_REPRODUCED),
    ],
)
def test_single_wrap(runs, verdict):
    assert single_wrap.judge(runs).verdict is verdict


def test_the_angle_of_most_twist_is_found_between_the_angles():
    angles = [0.0, 20.0, 30.0, 45.0, 90.0]
    assert single_wrap.optimum(angles, [9 - (angle - 27) ** 2 / 100 for angle in angles]) == pytest.approx(27)


@pytest.mark.parametrize(("twist", "verdict"), [(1e-6, Verdict.CONFIRMED), (0.5, Verdict.NOT_REPRODUCED)])
def test_double_wrap(twist, verdict):
    names = [run.name for run in double_wrap.runs("quick")]
    results = {name: made_up(62.5, twist=1.0, stretch=1.1) for name in names}
    results["double, alike"] = made_up(62.5, twist=twist, stretch=1.1)
    assert double_wrap.judge(results).verdict is verdict


@pytest.mark.parametrize(("softest", "verdict"), [(0.0, Verdict.NOT_REPRODUCED), (0.1, Verdict.CONFIRMED)])
def test_too_dense(softest, verdict):
    """Pressures for a stretch that are all the same, or have a least value in the middle."""
    spacings = too_dense.SPACINGS
    results = {
        f"{spacing:g} mm": made_up(140.0, stretch=1.4 - softest * abs(k - 3) / 3) for k, spacing in enumerate(spacings)
    }
    assert too_dense.judge(results).verdict is verdict


@pytest.mark.parametrize(("neutral", "verdict"), [(54.74, Verdict.CONFIRMED), (52.0, Verdict.NOT_REPRODUCED)])
def test_neutral_angle(neutral, verdict):
    results = {
        run.name: made_up(62.5, stretch=1 + (run.values["from_axis"] - neutral) / 100) for run in braids.runs("quick")
    }
    assert braids.judge(results).verdict is verdict


@pytest.mark.parametrize(
    ("best", "difference", "named"),
    [
        (0.0, Verdict.CONFIRMED, Verdict.NOT_REPRODUCED),
        (35.0, Verdict.CONDITIONAL, Verdict.CONDITIONAL),
        (55.0, Verdict.NOT_REPRODUCED, Verdict.NOT_REPRODUCED),
    ],
)
def test_two_sides(best, difference, named):
    """Bending that is largest at one lower angle, and larger for hoops above."""
    results = {}
    for run in two_sides.runs("quick"):
        bend = 5 - abs(run.values["lower"] - best) / 20 + run.values["upper"] / 50
        results[run.name] = made_up(30.0, curvature_y=bend, blocked_moment=bend / 100)
    assert two_sides.judge_difference(results).verdict is difference
    assert two_sides.judge_named(results).verdict is named


def test_difference_counts_beyond_the_mesh_error_only():
    results = {
        f"wall {wall:g} mm": made_up(50.0, error=error, tip_displacement_x=1 / wall)
        for wall, error in zip(thin_walls.TUBES, [0.0] * 4 + [10.0], strict=True)
    }
    assert thin_walls.judge_tubes(results).verdict is Verdict.NOT_REPRODUCED
    results = {name: made_up(50.0, tip_displacement_x=1 / float(name.split()[1])) for name in results}
    assert thin_walls.judge_tubes(results).verdict is Verdict.CONFIRMED


@pytest.mark.parametrize(("back", "verdict"), [(True, Verdict.CONFIRMED), (False, Verdict.NOT_REPRODUCED)])
def test_two_directions(back, verdict):
    bend = PRESSURES**2 - 0.3 * PRESSURES * back
    results = {run.name: made_up(20.0, curvature_y=bend) for run in two_directions.runs("quick")}
    assert two_directions.judge(results).verdict is verdict
    assert two_directions.threshold(next(iter(results.values())).response) == pytest.approx(6.0) or not back


@pytest.mark.parametrize(("best", "verdict"), [(2.5, Verdict.CONFIRMED), (6.0, Verdict.NOT_REPRODUCED)])
def test_layer_ratio(best, verdict):
    results = {
        run.name: made_up(20.0, curvature_y=10 - abs(run.values["ratio"] - best))
        for run in layer_ratio.thickness_runs("quick")
    }
    assert layer_ratio.judge_thickness(results).verdict is verdict


@pytest.mark.parametrize(("shape", "verdict"), [(shapes.HALF, Verdict.CONFIRMED), ("square", Verdict.NOT_REPRODUCED)])
def test_best_shape(shape, verdict):
    results = {
        run.name: made_up(30.0, curvature_y=1.0 + (run.values["shape"] == shape))
        for run in best_shape.bending_runs("quick")
    }
    assert best_shape.judge_bending(results).verdict is verdict


@pytest.mark.parametrize("shape", shapes.SHAPES)
def test_shapes_have_one_chamber_area_and_one_wall(shape):
    outer, inner = shapes.outlines(shape)
    assert 2e6 * inner.area == pytest.approx(shapes.AREA)
    lowest, highest = min(z for _, z in inner.corners), max(z for _, z in inner.corners)
    assert lowest == pytest.approx(shapes.WALL * 1e-3)
    assert max(z for _, z in outer.corners) - highest == pytest.approx(shapes.WALL * 1e-3)
