"""Plots: what is drawn are the columns in their units, and nothing is left behind."""

import sys

import numpy as np
import pytest
from matplotlib.figure import Figure

from turgor.errors import TurgorError
from turgor.response import Column, Response
from turgor.results.plots.response_plots import plot_response, response_figure, response_svg, write_plot
from turgor.source import Source
from turgor.units import deg, kPa

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
    assert (axes.get_xlabel(), axes.get_ylabel()) == ("pressure [kPa]", "bending angle [deg]")


def test_unknown_column_names_the_near_match():
    with pytest.raises(TurgorError, match=r"unknown column 'angel'.*Known: bending_angle, pressure"):
        plot_response(Figure().add_subplot(), response(PRESSURE, ANGLE), "pressure", "angel")


def test_figure_shows_what_is_there_against_the_drive():
    figure = response_figure(response(Column("load_factor", "", [0, 0.4, 1]), PRESSURE, ANGLE, STRESS), "finger")
    labels = [(a.get_xlabel(), a.get_ylabel()) for a in figure.axes]
    assert labels == [
        ("pressure [kPa]", "bending angle [deg]"),
        ("pressure [kPa]", "maximum von Mises stress [kPa]"),
    ]


def test_own_measures_alone_are_shown():
    figure = response_figure(response(Column("load_factor", "", [0, 0.4, 1]), OWN))
    assert [(a.get_xlabel(), a.get_ylabel()) for a in figure.axes] == [("load factor", "rise [mm]")]


def test_drive_alone_is_refused():
    with pytest.raises(TurgorError, match="holds load_factor, pressure only"):
        response_figure(response(Column("load_factor", "", [0, 0.4, 1]), PRESSURE))


def test_files(tmp_path):
    for name in ("r.png", "r.svg"):
        write_plot(tmp_path / name, response(PRESSURE, ANGLE))
    assert (tmp_path / "r.png").read_bytes()[:4] == b"\x89PNG"
    assert "<svg" in (tmp_path / "r.svg").read_text()
    with pytest.raises(TurgorError, match=r"ends in '.pdf'; allowed is .png or .svg"):
        write_plot(tmp_path / "r.pdf", response(PRESSURE, ANGLE))


def test_svg_is_reproducible_and_pyplot_stays_out():
    assert response_svg(response(PRESSURE, ANGLE)) == response_svg(response(PRESSURE, ANGLE))
    assert "matplotlib.pyplot" not in sys.modules or not sys.modules["matplotlib.pyplot"].get_fignums()
