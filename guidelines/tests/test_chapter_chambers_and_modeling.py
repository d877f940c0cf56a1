"""Guidelines on chambers, convergence and modeling: their runs, and judges that come out both ways."""

import numpy as np
import pytest

import turgor as tg
from turgor.studies import Computed
from turgor.units import deg, kPa, mm
from turgor_guidelines.catalog import CHAPTERS, chosen
from turgor_guidelines.guideline import Verdict
from turgor_guidelines.judging import change, differs, line_of, verdict_of
from turgor_guidelines.modeling import gravity, softer_rubber, uniaxial_tests
from turgor_guidelines.multi_chamber import factors, linearity, more_chambers, slow_and_fast, thick_walls
from turgor_guidelines.multi_chamber.pneunets import actuator_of, at_angle, pneunet
from turgor_guidelines.omnidirectional import chamber_shapes
from turgor_guidelines.omnidirectional.chambers import area_of
from turgor_guidelines.omnidirectional.shapes import AREA, SHAPES, given_for
from turgor_guidelines.values import MESH_ERROR, Value

SECTIONS = ("5", "6.2", "7.3", "7.4", "8.1")
STUDIES = [(each.key, study) for each in chosen(SECTIONS) for study in each.studies]


def made(**columns) -> Computed:
    """What a run found, from columns in SI."""
    units = {"pressure": "kPa", "bending_angle": "deg", "bulge": "mm", "cavity_volume": "mL", "blocked_force": "N"}
    made_of = tuple(
        tg.experiments.Column(name, units.get(name, ""), np.array(values)) for name, values in columns.items()
    )
    return Computed(response=tg.Response(columns=made_of, source=tg.laws.Source(text="made up")))


def bent(angle: float, pressure: float = 30.0, bend: float = 1.0) -> Computed:
    """A bender that reaches an angle [deg] at a pressure [kPa], in a straight line where ``bend`` is 1."""
    share = np.linspace(0, 1, 21)
    angles = angle * deg * share**bend
    return made(
        pressure=pressure * kPa * share, bending_angle=angles, bulge=bend * mm * share, cavity_volume=1e-6 * share
    )


@pytest.mark.parametrize("setting", ["quick", "full"])
def test_names_of_runs_are_unique_in_every_study(setting):
    assert len(STUDIES) > 20
    for key, study in STUDIES:
        names = [run.name for run in study.runs(setting)]
        assert len(set(names)) == len(names) > 1, key


def test_quick_runs_are_no_more_than_full_ones():
    for key, study in STUDIES:
        assert len(study.runs("quick")) <= len(study.runs("full")), key


def test_a_chapter_for_convergence():
    assert "convergence" in CHAPTERS
    assert next(each.key for each in chosen(["6.2"])) == "6.2-1"


def test_verdicts_from_comparisons():
    assert verdict_of([True, True]) is Verdict.CONFIRMED
    assert verdict_of(iter([False, True])) is Verdict.CONDITIONAL
    assert verdict_of([False]) is Verdict.NOT_REPRODUCED


def test_changes_and_differences():
    assert change(Value(1.2), Value(1.0)) == pytest.approx(0.2)
    assert differs(Value(1.2, 0.1), Value(1.0, 0.05))
    assert not differs(Value(1.2, 0.1), Value(1.0, 0.15))
    assert line_of([1, 2], [Value(1.0, 0.1), Value(2.0, 0.2)]).error == [0.1, 0.2]


def test_pressure_at_an_angle_has_the_mesh_error_of_the_angle():
    response = bent(20).response
    error = tg.experiments.Column(f"bending_angle{MESH_ERROR}", "deg", 0.1 * response.column("bending_angle"))
    known = tg.Response(columns=(*response.columns, error), source=response.source)
    value = at_angle(known, "pressure", 10)
    assert (value.number, value.error) == pytest.approx((15, 1.5))
    assert np.isnan(at_angle(response, "pressure", 25).number)


def test_air_that_is_let_in_counts_from_rest():
    volume = made(bending_angle=[0, 0.2], cavity_volume=[5e-6, 7e-6]).response
    assert at_angle(volume, "cavity_volume", 0.1 / deg, less_rest=True).number == pytest.approx(1)


def test_a_slow_pneunet_fills_the_gaps():
    slow, fast = (actuator_of(pneunet(3, {}, family)) for family in ("SlowPneuNet", "FastPneuNet"))
    assert slow.wall == pytest.approx(2 * fast.wall + fast.gap)
    assert slow.length == fast.length


@pytest.mark.parametrize("shape", SHAPES.values())
def test_chambers_of_every_shape_have_the_same_area(shape):
    assert area_of(given_for(shape)) == pytest.approx(AREA, rel=1e-3)


def test_linearity_comes_out_both_ways():
    straight, curved = bent(10), bent(10, bend=2.0)
    names = list(linearity.PRESSURES)
    assert linearity.judge(dict(zip(names, (straight, straight, curved), strict=True))).verdict is Verdict.CONFIRMED
    assert linearity.judge(dict(zip(names, (curved, curved, straight), strict=True))).verdict is Verdict.NOT_REPRODUCED


def test_more_chambers_come_out_both_ways():
    more = {f"{count} chambers": bent(10 * count) for count in (1, 2, 3)}
    assert more_chambers.judge(more).verdict is Verdict.CONFIRMED
    assert (
        more_chambers.judge(dict(zip(more, list(more.values())[::-1], strict=True))).verdict is Verdict.NOT_REPRODUCED
    )


def test_the_order_of_factors_comes_out_both_ways():
    def found(bottom, wall, gap):
        sizes = {"bottom": bottom, "wall": wall, "gap": gap, factors.LONGER: 5.0}
        return {"reference": bent(10)} | {f"{name} x 1.5": bent(size) for name, size in sizes.items()}

    assert factors.judge(found(5, 7, 9)).verdict is Verdict.CONFIRMED
    other = factors.judge(found(9, 7, 12))
    assert other.verdict is Verdict.CONDITIONAL
    assert "a larger gap bends further" in other.conditions
    assert factors.judge(found(11, 12, 13)).verdict is Verdict.NOT_REPRODUCED


def _pushed(force: float) -> Computed:
    return made(pressure=[0, 30 * kPa], blocked_force=[0, force])


def test_thick_walls_come_out_both_ways():
    walls = (1.5, 2.25, 3)
    less = {f"bent, {wall:g} mm": bent(30 - wall) for wall in walls}
    less |= {f"pushing, {wall:g} mm": _pushed(5 - wall) for wall in walls}
    assert thick_walls.judge(less).verdict is Verdict.CONFIRMED
    more = {f"bent, {wall:g} mm": bent(30 + wall) for wall in walls}
    more |= {f"pushing, {wall:g} mm": _pushed(5 + wall) for wall in walls}
    assert thick_walls.judge(more).verdict is Verdict.NOT_REPRODUCED


def test_slow_and_fast_come_out_both_ways():
    def found(pressure, force):
        slow = bent(15, pressure=pressure)
        slow = made(
            pressure=slow.response.column("pressure"),
            bending_angle=slow.response.column("bending_angle"),
            cavity_volume=8 * slow.response.column("cavity_volume"),
        )
        fast = bent(15)
        return {"fast": fast, "slow": slow, "fast, pushing": _pushed(force), "slow, pushing": _pushed(1.0)}

    assert slow_and_fast.judge(found(90, 1.4)).verdict is Verdict.CONFIRMED
    far = slow_and_fast.judge(found(300, 1.4))
    assert far.verdict is Verdict.CONDITIONAL
    assert "pressure" in far.conditions


def test_which_dimension_decides_is_told():
    ratios = {"reference": 10, "height 13 mm": 3, "stiff base": 9}
    results = {}
    for name, ratio in ratios.items():
        results |= {f"{name}: fast": bent(15), f"{name}: slow": bent(15, pressure=30 * ratio)}
    near = slow_and_fast.judge_varied(results)
    assert near.verdict is Verdict.CONDITIONAL
    assert "Most decides: height 13 mm" in near.conditions
    results["height 13 mm: slow"] = bent(15, pressure=240)
    assert slow_and_fast.judge_varied(results).verdict is Verdict.NOT_REPRODUCED


def test_shapes_of_chambers_come_out_both_ways():
    def shape(angle, ballooning):
        share = np.linspace(0, 1, 7)
        columns = {"pressure": 60 * kPa * share, "bending_angle": angle * deg * share}
        return made(**columns, outside_ballooning=1 + ballooning * share)

    rest = {name: shape(1.0, 0.03) for name in SHAPES}
    as_claimed = rest | {"ring sector": shape(5.0, 0.2), "half, flat inward": shape(1.0, 0.01)}
    assert chamber_shapes.judge(as_claimed).verdict is Verdict.CONFIRMED
    other = rest | {"circular": shape(5.0, 0.001)}
    assert chamber_shapes.judge(other).verdict is Verdict.NOT_REPRODUCED


def test_softer_rubber_comes_out_both_ways():
    names = [f"{name}, {fabric}" for fabric in softer_rubber.FABRICS for name in softer_rubber.RUBBERS]
    hard = {name: bent(40, pressure=10 + k % 6) for k, name in enumerate(names)}
    assert softer_rubber.judge(hard).verdict is Verdict.CONFIRMED
    soft = {name: bent(40, pressure=20 - k % 6) for k, name in enumerate(names)}
    assert softer_rubber.judge(soft).verdict is Verdict.NOT_REPRODUCED


def test_gravity_comes_out_both_ways():
    names = [run.name for run in gravity.runs("quick")]

    def found(sag):
        return {name: made(tip_x=[0, -0.1], tip_z=[0, -sag if "with gravity" in name else 0.0]) for name in names}

    assert gravity.judge(found(0.5)).verdict is Verdict.CONFIRMED
    assert gravity.judge(found(0.01)).verdict is Verdict.NOT_REPRODUCED


def test_uniaxial_tests_come_out_both_ways():
    names = [run.name for run in uniaxial_tests.runs("quick")]

    def found(alone):
        factor = {name: 1 + (alone if name.endswith("uniaxial") else 0.0) for name in names}
        return {name: made(stretch=[1, 3], pressure=[0, 10 * kPa * factor[name]]) for name in names}

    assert uniaxial_tests.judge(found(0.2)).verdict is Verdict.CONFIRMED
    assert uniaxial_tests.judge(found(0.01)).verdict is Verdict.NOT_REPRODUCED
