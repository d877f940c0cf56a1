"""Plots: what is drawn are the columns in their units, and nothing is left behind."""

import sys

import numpy as np
import pytest
from matplotlib.figure import Figure
from PIL import Image

from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import deg, kPa
from turgor.views.pictures.cad_picture import write_cad_picture
from turgor.views.pictures.mesh_picture import write_mesh_picture
from turgor.views.pictures.picture import Picture, picture
from turgor.views.pictures.state_picture import write_picture
from turgor.views.plots.convergence import write_convergence_plot
from turgor.views.plots.figures import check_ending, write_figure
from turgor.views.plots.fits import write_fit_plot
from turgor.views.plots.materials import write_material_plot
from turgor.views.plots.response_plots import plot_response, response_figure, response_svg, write_plot

PRESSURE = Column("pressure", "kPa", np.array([0, 20, 50]) * kPa)
ANGLE = Column("bending_angle", "deg", np.array([0, 30, 90]) * deg)
STRESS = Column("maximum_von_mises", "kPa", np.array([0, 10, 30]) * kPa)
OWN = Column("rise", "mm", [0, 1e-3, 2e-3])


def response(*columns):
    return Response(columns=columns, source=Source(text="a test"))


def test_axes_are_given_and_returned_with_units():
    axes = Figure().add_subplot()
    assert plot_response(axes, response(PRESSURE, ANGLE), "pressure", "bending_angle") is axes
    (line,) = axes.get_lines()
    np.testing.assert_allclose(line.get_xdata(), [0, 20, 50])
    np.testing.assert_allclose(line.get_ydata(), [0, 30, 90])
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("pressure [kPa]", "bending angle [°]")


def test_unknown_column_names_the_near_match():
    with refused("'angel'", "bending_angle, pressure"):
        plot_response(Figure().add_subplot(), response(PRESSURE, ANGLE), "pressure", "angel")


def test_figure_shows_what_is_there_against_the_drive():
    figure = response_figure(response(Column("load_factor", "", [0, 0.4, 1]), PRESSURE, ANGLE, STRESS), "finger")
    labels = [(a.get_xlabel(), a.get_ylabel()) for a in figure.axes]
    assert labels == [
        ("pressure [kPa]", "bending angle [°]"),
        ("pressure [kPa]", "maximum von Mises stress [kPa]"),
    ]


def test_own_measures_alone_are_shown():
    figure = response_figure(response(Column("load_factor", "", [0, 0.4, 1]), OWN))
    assert [(a.get_xlabel(), a.get_ylabel()) for a in figure.axes] == [("load factor", "rise [mm]")]


def test_drive_alone_is_refused():
    with refused("load_factor, pressure"):
        response_figure(response(Column("load_factor", "", [0, 0.4, 1]), PRESSURE))


def test_files(tmp_path):
    for name in ("r.png", "r.svg"):
        write_plot(tmp_path / name, response(PRESSURE, ANGLE))
    assert (tmp_path / "r.png").read_bytes()[:4] == b"\x89PNG"
    assert "<svg" in (tmp_path / "r.svg").read_text()


@pytest.mark.parametrize(
    ("name", "kind", "facts"),
    [
        ("r.pdf", "plot", ["plot", "'.pdf'", ".png or .svg"]),
        ("r", "plot", ["plot", "ending", ".png or .svg"]),
        ("r.svg", "picture", ["picture", "'.svg'", ".png"]),
        ("r", "picture", ["picture", "ending", ".png"]),
    ],
)
def test_other_endings_are_refused(tmp_path, name, kind, facts):
    with refused(tmp_path / name, *facts):
        check_ending(tmp_path / name, kind)


@pytest.mark.parametrize(
    "write",
    [
        lambda path: write_picture(path, None),
        lambda path: write_mesh_picture(path, None),
        lambda path: write_cad_picture(path, None),
        lambda path: Picture(caption="", png=b"").write(path),
        lambda path: picture(None, path),
    ],
    ids=["state", "mesh", "cad", "write", "picture"],
)
def test_the_ending_of_a_picture_is_checked_before_anything_is_drawn(tmp_path, write):
    for name in ("last", "last.svg"):
        with refused(tmp_path / name, "picture", ".png"):
            write(tmp_path / name)


@pytest.mark.parametrize(
    "write",
    [
        lambda path: write_plot(path, None),
        lambda path: write_fit_plot(path, None),
        lambda path: write_convergence_plot(path, None),
        lambda path: write_material_plot(path, "no such rubber"),
    ],
    ids=["response", "fit", "convergence", "material"],
)
def test_the_ending_of_a_plot_is_checked_before_anything_is_drawn(tmp_path, write):
    with refused(tmp_path / "plot", ".png or .svg"):
        write(tmp_path / "plot")


def test_files_name_the_program_that_made_them_and_are_reproducible(tmp_path):
    figure = response_figure(response(PRESSURE, ANGLE))
    for name in ("r.png", "r.SVG"):
        write_figure(tmp_path / name, figure)
        first = (tmp_path / name).read_bytes()
        write_figure(tmp_path / name, figure)
        assert (tmp_path / name).read_bytes() == first
        assert b"turgor" in first
        assert b"atplotlib v" not in first
    assert Image.open(tmp_path / "r.png").info["Software"] == "turgor"


def test_svg_is_reproducible_and_pyplot_stays_out():
    assert response_svg(response(PRESSURE, ANGLE)) == response_svg(response(PRESSURE, ANGLE))
    assert "matplotlib.pyplot" not in sys.modules or not sys.modules["matplotlib.pyplot"].get_fignums()
