"""Response: a table of columns with units that survives a file, and says which name was meant."""

import sys

import numpy as np
import pytest
from hypothesis import given
from hypothesis import strategies as st

from refused import refused
from turgor.core.results.files.response_csv import read_response
from turgor.foundation.response import COLUMN_UNITS, Column, Response
from turgor.foundation.source import Source
from turgor.units import deg, kPa

SOURCE = Source(text="a test")


def table(**columns) -> Response:
    """Response of columns given as name=(unit, values)."""
    return Response(columns=tuple(Column(n, unit, values) for n, (unit, values) in columns.items()), source=SOURCE)


def test_columns_are_si_and_shown_in_their_unit():
    response = table(pressure=("kPa", [0, 50 * kPa]), bending_angle=("deg", [0, 90 * deg]))
    assert response.column("pressure")[1] == 50e3
    assert response.find("bending_angle").in_unit == pytest.approx([0, 90])
    assert response.find("bending_angle").label == "bending angle [°]"
    assert len(response) == 2


def test_values_cannot_be_changed():
    given_values = np.array([0.0, 1.0])
    response = table(pressure=("kPa", given_values))
    given_values[0] = 7.0
    assert response.column("pressure")[0] == 0.0
    with refused("read-only", error=ValueError):
        response.column("pressure")[0] = 1.0


def test_header_carries_units_and_numbers_are_short(tmp_path):
    path = tmp_path / "response.csv"
    table(load_factor=("", [0.1]), pressure=("kPa", [12.3e3]), tip_x=("mm", [-0.0371])).to_csv(path)
    assert path.read_text() == "load_factor,pressure_kPa,tip_x_mm\n0.1,12.3,-37.1\n"


@given(data=st.data())
def test_round_trip(data, tmp_path_factory):
    """What is read differs from what was written by the last bit at most (a number times its unit is rounded)."""
    path = tmp_path_factory.mktemp("response") / "response.csv"
    # Divided by its unit, no number may overflow or lose digits as a subnormal.
    floats = st.floats(allow_nan=False, min_value=-1e300, max_value=1e300).filter(lambda x: x == 0 or abs(x) > 1e-290)
    count = data.draw(st.integers(1, 4))
    names = st.from_regex(r"[a-z]+(_[a-z]{5,8})?", fullmatch=True)
    chosen = data.draw(st.dictionaries(names, st.sampled_from(sorted(COLUMN_UNITS)), min_size=1, max_size=4))
    columns = tuple(
        Column(name, unit, data.draw(st.lists(floats, min_size=count, max_size=count))) for name, unit in chosen.items()
    )
    written = Response(columns=columns, source=SOURCE)
    written.to_csv(path)
    read = read_response(path)
    assert read.names == written.names
    for before, after in zip(written.columns, read.columns, strict=True):
        assert after.unit == before.unit
        np.testing.assert_allclose(after.values, before.values, rtol=3e-16, atol=0)


def test_infinite_and_missing_values_survive(tmp_path):
    table(smallest_gap=("mm", [np.inf, np.nan])).to_csv(tmp_path / "r.csv")
    read = read_response(tmp_path / "r.csv").column("smallest_gap")
    assert read[0] == np.inf
    assert np.isnan(read[1])


def test_unknown_column_names_the_near_match():
    with refused("'presure'", "'pressure'"):
        table(pressure=("kPa", [0.0])).column("presure")


def test_unknown_unit_names_the_near_match():
    with refused("pressure", "'kP'", "'kPa'"):
        Column("pressure", "kP", [0.0])


def test_pure_number_may_not_look_like_a_unit():
    with refused("'tip_m'", "'tip' in m"):
        Column("tip_m", "", [0.0])


def test_names_are_words():
    with refused("'a,b'", "letters", "digits"):
        Column("a,b", "", [0.0])


def test_columns_must_fit_together():
    with refused("pressure 1", "angle 2"):
        table(pressure=("kPa", [0.0]), angle=("deg", [0.0, 1.0]))
    with refused("'pressure'", "unique"):
        Response(columns=(Column("pressure", "kPa", [0.0]), Column("pressure", "Pa", [0.0])), source=SOURCE)
    with refused("'pressure'", "(1, 2)"):
        Column("pressure", "kPa", [[0.0, 1.0]])
    with refused("response", "one column"):
        Response(columns=(), source=SOURCE)


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("pressure_kPa\n", ["no rows"]),
        ("", ["empty"]),
        ("pressure_kPa,angle_deg\n1\n", ["line 2", "1 values", "2 columns"]),
        ("pressure_kPa\n1\n\nx\n", ["line 4", "column 'pressure_kPa'", "'x'"]),
    ],
)
def test_bad_files_are_explained(tmp_path, text, facts):
    path = tmp_path / "r.csv"
    path.write_text(text)
    with refused(path.name, *facts):
        read_response(path)


def test_missing_file_names_the_near_match(tmp_path):
    (tmp_path / "response.csv").write_text("x\n1\n")
    with refused("respnse.csv", "'response.csv'"):
        read_response(tmp_path / "respnse.csv")


def test_files_of_others_are_read(tmp_path):
    """A spreadsheet's byte order mark, blank lines and spaces around names are no obstacle."""
    path = tmp_path / "lab.csv"
    path.write_bytes("\ufeffpressure_kPa, bending_angle_deg\r\n\r\n10, 90\r\n".encode())
    read = read_response(path, Source(text="our laboratory"))
    assert read.column("pressure")[0] == 10e3
    assert read.column("bending_angle")[0] == pytest.approx(np.pi / 2)
    assert str(read.source) == "our laboratory"


def test_a_name_alone_gives_si_and_a_unit_behind_it_gives_this_unit():
    response = table(pressure=("kPa", [0, 50 * kPa]), bending_angle=("deg", [0, 90 * deg]), load_factor=("", [0, 1]))
    assert response["pressure"].tolist() == [0, 50e3]
    assert response["pressure_kPa"].tolist() == [0, 50]
    assert response["pressure_MPa"].tolist() == [0, 0.05]
    assert response["bending_angle_deg"] == pytest.approx([0, 90])
    assert response["bending_angle_rad"] == pytest.approx([0, np.pi / 2])
    assert response["load_factor"].tolist() == [0, 1]
    assert list(response) == ["pressure", "bending_angle", "load_factor"]
    assert "pressure" in response
    assert "stress" not in response


@pytest.mark.parametrize(
    ("name", "facts"),
    [
        ("presure", ["column 'presure'", "'pressure'", "load_factor, pressure"]),
        ("pressure_mm", ["column 'pressure'", "'mm'", "Pa, kPa, MPa"]),
        ("load_factor_mm", ["column 'load_factor'", "'mm'", "none"]),
        (0, ["column", 0, "pressure, load_factor"]),
    ],
)
def test_a_wrong_name_or_unit_is_refused(name, facts):
    with refused(*facts):
        table(pressure=("kPa", [0]), load_factor=("", [0]))[name]


def test_a_column_says_its_unit_and_the_range_in_this_unit():
    column = Column("pressure", "kPa", [0, 50 * kPa])
    assert repr(column) == "Column('pressure', 2 values, 0 to 50 kPa)"
    assert column.si_unit == "Pa"
    assert repr(Column("bending_angle_mesh_error", "deg", [np.nan])).endswith("none known)")
    assert {unit for name in COLUMN_UNITS for unit in Column("a", name, []).units} == set(COLUMN_UNITS)


def test_data_frame_names_the_unit_of_its_numbers():
    pytest.importorskip("pandas")
    response = Response(
        columns=table(pressure=("kPa", [0, 50 * kPa]), load_factor=("", [0, 1])).columns, source=SOURCE,
        stages=("fill", "fill"),
    )  # fmt: skip
    frame = response.to_dataframe()
    assert list(frame) == ["pressure_kPa", "load_factor", "stage_name"]
    assert frame["pressure_kPa"].tolist() == [0, 50]
    assert response.to_dataframe(si=True)["pressure_Pa"].tolist() == [0, 50e3]


def test_without_pandas_the_error_says_how_to_install_it(monkeypatch):
    monkeypatch.setitem(sys.modules, "pandas", None)
    with refused("to_dataframe", "install pandas"):
        table(pressure=("kPa", [0])).to_dataframe()


def test_a_table_is_replaced_whole_or_not_at_all(tmp_path, monkeypatch):
    """A write that fails half-way leaves the table of before."""
    path = tmp_path / "response.csv"
    columns = (Column("load_factor", "", np.array([0.0, 1.0])),)
    Response(columns=columns, source=Source(text="a ruler")).to_csv(path)
    before = path.read_text(encoding="utf-8")

    def full(*_):
        raise OSError(28, "No space left on device")

    monkeypatch.setattr("turgor.foundation.response._shortest", full)
    with refused("response.csv", error=OSError):
        Response(columns=columns, source=Source(text="a ruler")).to_csv(path)
    assert path.read_text(encoding="utf-8") == before
    assert [each.name for each in tmp_path.iterdir()] == ["response.csv"]
