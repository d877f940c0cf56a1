"""Differences of two responses, on curves whose differences are known."""

import numpy as np
import pytest

from refused import refused
from turgor.accuracy.laboratory.compare import compare
from turgor.accuracy.laboratory.comparison_plot import comparison_figure
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source


def made(text: str, **columns) -> Response:
    units = {"pressure": "kPa", "bending_angle": "deg", "angle": "deg", "force": "N", "bending_angle_mesh_error": "deg"}
    return Response(
        columns=tuple(Column(name, units[name], np.asarray(values, float)) for name, values in columns.items()),
        source=Source(text=text),
    )


def test_constant_offset() -> None:
    at = np.linspace(0, 10, 11)
    result = compare(
        made("run", pressure=at, bending_angle=3 * at + 1), made("test", pressure=at, bending_angle=3 * at)
    )
    assert result.rms == pytest.approx(1.0)
    assert result.largest == pytest.approx(1.0)
    assert result.relative == pytest.approx(1 / 30)


def test_shift_of_the_drive_is_found() -> None:
    fine, at = np.linspace(0, 10, 2001), np.linspace(2, 8, 60)
    result = compare(
        made("run", pressure=fine, bending_angle=np.sin(fine / 3)),
        made("test", pressure=at, bending_angle=np.sin((at + 0.7) / 3)),
    )
    assert result.shift == pytest.approx(0.7, abs=2e-3)
    assert result.rms_shifted < 0.01 * result.rms
    assert "added to the measured pressure" in result.summary()


def test_shift_leaves_most_rows_in_the_range() -> None:
    at = np.linspace(0, 10, 101)
    steep = made("test", pressure=at, bending_angle=np.where(at > 5, 50.0, 0.0))
    result = compare(made("run", pressure=at, bending_angle=np.zeros(101)), steep)
    assert abs(result.shift) <= 3.0 + 0.1


def test_rows_beyond_the_run_are_left_out_and_said() -> None:
    result = compare(
        made("run", pressure=[0, 5], bending_angle=[0, 5]),
        made("test", pressure=[0, 4, 8], bending_angle=[0, 4, 8]),
    )
    assert len(result.rows) == 2
    assert result.notes == ("1 of 3 measured rows lie beyond the computed range and are left out.",)


def test_loading_and_unloading_are_both_compared() -> None:
    result = compare(
        made("run", pressure=[0, 10], bending_angle=[0, 10]),
        made("test", pressure=[0, 10, 5, 0], bending_angle=[0, 10, 7, 1]),
    )
    np.testing.assert_allclose(result.rows[:, 2] - result.rows[:, 1], [0, 0, -2, -1], atol=1e-12)


def test_a_run_that_snaps_is_compared_before_it_does() -> None:
    result = compare(
        made("run", pressure=[0, 10, 8, 12], bending_angle=[0, 10, 40, 50]),
        made("test", pressure=[0, 9], bending_angle=[0, 9]),
    )
    assert result.rms == pytest.approx(0.0, abs=1e-12)
    assert "turns at 0.01 kPa" in result.notes[0]


def test_columns_of_other_names_are_paired_by_their_unit() -> None:
    run = made("run", pressure=[0, 1], force=[0, 1], bending_angle=[0, 1])
    result = compare(run, made("test", pressure=[0, 1], angle=[0, 1]))
    assert (result.y, result.measured_y) == ("bending_angle", "angle")
    assert "make sure that both are defined alike" in result.notes[0]
    assert compare(run, made("test", pressure=[0, 1], angle=[0, 1]), "bending_angle=angle").measured_y == "angle"


def test_bad_questions() -> None:
    run = made("run", pressure=[0, 1], bending_angle=[0, 1])
    with refused("'bending_angel'", "'bending_angle'"):
        compare(run, run, "bending_angel")
    with refused("'bending_angle'", "deg", "'force'", "N"):
        compare(run, made("test", pressure=[0, 1], force=[0, 1]), "bending_angle=force")
    with refused("bending_angle", "force"):
        compare(run, made("test", pressure=[0, 1], force=[0, 1]))
    with refused("'pressure'", "0 to 0.001 kPa", "0.002 to 0.003 kPa"):
        compare(run, made("test", pressure=[2, 3], bending_angle=[0, 1]))


def test_table_and_picture() -> None:
    run = made("run", pressure=[0, 1e3], bending_angle=[0, 1], bending_angle_mesh_error=[0, 0.1])
    result = compare(run, made("test", pressure=[0, 1e3], bending_angle=[0, 0.9]))
    table = result.to_response()
    assert table.names == (
        "pressure", "bending_angle_measured", "bending_angle_computed", "bending_angle_difference",
    )  # fmt: skip
    np.testing.assert_allclose(table["bending_angle_difference"], [0, 0.1])
    upper, lower = comparison_figure(result, "Finger").axes
    assert [each.get_text() for each in upper.get_legend().get_texts()] == ["measured: test", "computed: run"]
    assert lower.get_xlabel() == "pressure [kPa]"
