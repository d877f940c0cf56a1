"""Stress and stretch by region: percentiles, and nodal values that jump where regions meet."""

import numpy as np
import pytest
import results_cases as cases

from refused import refused
from turgor.core.engine.percentiles import weighted_percentile
from turgor.core.materials.laws.laws import NeoHooke
from turgor.core.materials.material import Material
from turgor.core.meshing.exchange.read import read_mesh
from turgor.core.model.model import Model
from turgor.core.model.supports import Fixed
from turgor.core.results.fields.state_fields import StateFields
from turgor.core.results.files.vtu import write_state
from turgor.core.results.measures.field_measures import (
    maximum_principal_stretch,
    maximum_von_mises,
    principal_stretch_in,
    von_mises_in,
    von_mises_p99,
)
from turgor.core.results.measures.headlines import in_regions
from turgor.core.results.measures.measures import check_measures, find_measure, measure
from turgor.core.solvers.checks.materials import laws_beyond_their_tests
from turgor.units import kPa
from turgor.views.pictures.skin import visible_skin
from turgor.views.pictures.state_picture import shared_view
from turgor.views.plots.response_plots import response_figure

STRETCH = 1.3
STIFF = Material(name="stiff", law=NeoHooke(C10=10 * cases.RUBBER.law.C10))
#: Von Mises stress of the body in uniaxial tension, and of the base, ten times as stiff.
BODY = cases.RUBBER.law.shear_modulus * (STRETCH**2 - 1 / STRETCH)
BASE = 10 * BODY


@pytest.fixture(scope="module")
def at():
    """Uniform stretch of a body on a stiff base: the stress jumps by a factor of ten."""
    model = Model(cases.body(half=True), {"body": cases.RUBBER, "base": STIFF}, [Fixed("fixed")], [])
    return StateFields(cases.state(model, cases.stretched(STRETCH)))


def test_percentile_counts_volume_and_not_points():
    values, weights = np.array([5.0, 1.0, 9.0, 2.0]), np.array([0.3, 0.3, 0.009, 0.391])
    assert weighted_percentile(values, weights) == 5.0
    assert weighted_percentile(values, np.array([0.3, 0.3, 0.011, 0.389])) == 9.0


def test_one_spoiled_cell_is_a_maximum_and_no_headline():
    model = cases.model(cases.body(hollow=False))
    spoiled = StateFields(cases.state(model, lambda X: X * 1.0 + 2e-3 * (np.arange(len(X)) == 0)[:, None]))
    assert maximum_von_mises(spoiled) > 2 * von_mises_p99(spoiled)


def test_one_spoiled_cell_does_not_put_a_law_beyond_its_tests():
    mesh = cases.body(hollow=False)
    narrow = Material(name="narrow", law=cases.RUBBER.law, stretch_range=(0.5, 1.2))
    model = Model(mesh, dict.fromkeys(mesh.regions, narrow), [Fixed("fixed")], [])
    lonely = mesh.vertex_count + int(np.bincount(mesh.cells.ravel())[mesh.vertex_count :].argmin())  # of one cell
    spoiled = cases.state(model, lambda X: X + 1e-3 * (np.arange(len(X)) == lonely)[:, None])
    assert maximum_principal_stretch(spoiled) > 1.3
    assert laws_beyond_their_tests(model, [cases.state(model, None, 0.0), spoiled]) == ()
    (result,) = laws_beyond_their_tests(model, [spoiled, cases.state(model, cases.stretched(STRETCH))])
    assert result.message.startswith("The law of 'narrow' is used up to stretch 1.3,")


def test_percentiles_of_the_regions(at):
    assert von_mises_in("body")(at) == pytest.approx(BODY)
    assert von_mises_in("base")(at) == pytest.approx(BASE)
    assert von_mises_p99(at) == pytest.approx(BASE)  # a third of the volume
    assert principal_stretch_in("base")(at) == pytest.approx(STRETCH)
    assert find_measure("base_von_mises_p99")(at) == von_mises_in("base")(at)
    assert find_measure("body_principal_stretch_p99").unit == ""


def test_unknown_regions_and_measures_are_answered_with_the_near_match(at):
    with refused("bdy_von_mises_p99", "bdy", "body"):
        check_measures(at.model, [find_measure("bdy_von_mises_p99")])
    with refused("von_mises_p9", "von_mises_p99"):
        find_measure("von_mises_p9")


def test_a_response_has_the_regions_beside_the_solid(at):
    path = cases.solution([cases.state(at.model, None, 0.0), at.state])
    response = measure(path, von_mises_p99, find_measure("base_von_mises_p99"))
    assert response.names == ("load_factor", "von_mises_p99", "body_von_mises_p99", "base_von_mises_p99")
    assert in_regions(response, "von_mises_p99") == f"body {BODY / kPa:.4g} kPa, base {BASE / kPa:.4g} kPa"
    assert response.find("body_von_mises_p99").label == "body von Mises stress (99 % of volume) [kPa]"
    axes = response_figure(response).axes
    assert len(axes) == 1
    assert [text.get_text() for text in axes[0].get_legend().get_texts()] == ["all", "body", "base"]


def test_nodal_values_jump_between_regions(at):
    """An average over both sides would be 5.5 times the body's stress at the border."""
    region, names = at.facts.region_nodes.region, list(at.mesh.regions)
    np.testing.assert_allclose(at.von_mises[region == names.index("body")], BODY)
    np.testing.assert_allclose(at.von_mises[region == names.index("base")], BASE)


def test_each_side_of_the_skin_has_the_color_of_its_region(at):
    skin = visible_skin(at, at.von_mises)
    values = skin.values[skin.triangles]
    low = at.points[at.mesh.cells[at.mesh.region("base")]][..., 2].max()
    middle = skin.points[skin.triangles].mean(axis=1)[:, 2]
    np.testing.assert_allclose(values[middle < low - 1e-6], BASE)
    np.testing.assert_allclose(values[middle > low + 1e-6], BODY)


def test_colors_end_at_the_headline():
    bent = cases.state(cases.model(cases.body(half=True)), cases.bent(1.2))
    rest = cases.state(bent.model, None, 0.0)
    assert shared_view([rest, bent]).limit == von_mises_p99(bent)


def test_doubled_points_are_joined_when_a_file_is_read(at, tmp_path):
    write_state(tmp_path / "state.vtu", at)
    again = read_mesh(tmp_path / "state.vtu", unit="m", regions={"base": "region 0", "body": "region 1"})
    assert len(again.points) == len(at.mesh.points)
    np.testing.assert_array_equal(again.region("base"), at.mesh.region("base"))
