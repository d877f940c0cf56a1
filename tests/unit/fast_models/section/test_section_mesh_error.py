"""Mesh error of sections: small cells at sharp corners, and an estimate that covers what is left."""

import json

import numpy as np
import pytest

import turgor as tg
from turgor.cli import main
from turgor.core.geometry.extrusion import Layer
from turgor.core.results.files.response_csv import read_response
from turgor.fast_models.section.shapes.corners import sharp_corners
from turgor.units import kPa, mm

RUBBER = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
OUTWARD = tg.actuators.OmnidirectionalActuator(chamber_shape="semicircular_flat_outward")


def solved(actuator, pressure, **more):
    """The section of an actuator of one rubber under a pressure in its first cavity."""
    section = tg.Section(actuator, dict.fromkeys(actuator.build().regions, RUBBER))
    return section.solve({section.cavities[0]: pressure}, **more).response


@pytest.mark.parametrize(
    ("actuator", "pressure", "converged"),
    [
        (OUTWARD, 20 * kPa, 0.04820),  # without small cells −7.4 %
        (tg.actuators.SemicircularBender(), 10 * kPa, -0.04891),  # −5.2 %
        (tg.actuators.BidirectionalBender(), 30 * kPa, 0.67105),  # −1.6 %
    ],
    ids=["half round, flat side outward", "half round", "rectangular"],
)
def test_the_default_is_within_one_percent_at_corners_and_says_so(actuator, pressure, converged):
    """Converged: cells of a hundredth of the size at the corners, the others 0.7 times as large."""
    response = solved(actuator, pressure)
    value, error = response["curvature_y"][-1], response.mesh_error("curvature_y")[-1]
    assert value == pytest.approx(converged, rel=0.011)
    assert abs(value - converged) <= error <= 4 * abs(value - converged) + 1e-3 * abs(value)


def test_smooth_sections_have_a_small_error_all_along():
    response = solved(tg.actuators.EccentricBender(), np.linspace(5, 30, 6) * kPa)
    errors = response.mesh_error("curvature_y") / response["curvature_y"]
    assert (errors > 0).all()
    assert errors.max() < 1e-3
    assert response.mesh_error("twist") is None  # zero, whatever the cells


def test_what_was_prescribed_has_no_error_and_what_holds_it_has():
    section = tg.Section(tg.actuators.RectangularBender(), {"body": RUBBER, "base": RUBBER})
    fixed = section.solve(10 * kPa, prescribed={"curvature_y": 2.0}).response
    assert fixed.mesh_error("curvature_y") is None
    assert 0 < fixed.mesh_error("moment_y")[0] < 0.02 * abs(fixed["moment_y"][0])
    start = section.volume_at_rest["cavity"]
    by_volume = section.solve(volume={"cavity": 1.05 * start}).response
    assert by_volume.mesh_error("cavity_volume_per_length") is None
    assert 0 < by_volume.mesh_error("pressure")[0] < 0.05 * by_volume["pressure"][0]


def test_a_mesh_has_an_error_too_and_it_can_be_left_out():
    actuator = tg.actuators.ExtendingCylinder(inner_radius=6 * mm, wall=2 * mm, length=60 * mm, symmetric=False)
    mesh = tg.mesh(actuator.build(), size=4 * mm, cells="hexahedra")
    section = tg.Section(mesh, {"body": RUBBER})
    assert section.solve(20 * kPa).response.mesh_error("stretch") is not None
    left_out = section.solve(20 * kPa, mesh_error=False).response
    assert [column.name for column in left_out.columns] == [column.name for column in left_out.quantities]


def test_corners_at_a_mirror_plane_are_seen_whole():
    """A square standing on its corner in a disc, halved: at the cut, each half sees half of the corner."""
    disc = tg.sections.disc(10.0).cut_y()
    square = tg.sections.polygon([(0.0, -3.0), (3.0, 0.0), (0.0, 3.0)])
    layer = Layer(start=0.0, end=1.0, fill=(("body", disc), ("cavity", square)))
    assert sorted(sharp_corners(layer, [1]).tolist()) == [[0.0, -3.0], [0.0, 3.0], [3.0, 0.0]]
    assert len(sharp_corners(Layer(start=0.0, end=1.0, fill=(("body", disc),)), [1])) == 0


def test_the_command_states_and_writes_the_error(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    (tmp_path / "finger.toml").write_text(
        '[actuator]\ntype = "semicircular_bender"\n[materials]\n'
        'body = { law = "neo_hooke", C10 = "120 kPa" }\nbase = { law = "neo_hooke", C10 = "120 kPa" }\n'
        '[loads]\npressure = "10 kPa"\n',
        encoding="utf-8",
    )
    assert main(["section", "finger.toml", "--rows", "1"]) == 0
    said = capsys.readouterr().out
    assert "Last state, ± the estimated mesh error: pressure 10 kPa, curvature y -0.0487 ± 0.0" in said
    written = read_response(tmp_path / "finger-section" / "section.csv")
    assert written.mesh_error("curvature_y")[0] > 0
    assert main(["section", "finger.toml", "--rows", "1", "--json", "--force"]) == 0
    result = json.loads(capsys.readouterr().out)["result"]
    assert "curvature_y_mesh_error" in [column["name"] for column in result["columns"]]
