"""Report: one page that needs no other file, holds every fact, and escapes what it is given."""

import re
from html.parser import HTMLParser

import numpy as np
import pytest
import results_cases as cases

from refused import refused
from turgor.core.materials.laws.laws import Hooke, NeoHooke, Yeoh
from turgor.core.materials.material import Material
from turgor.core.meshing.quality.cell_quality import quality
from turgor.core.model.loads import BodyForce, Gravity, Pressure, Traction
from turgor.core.model.model import Model
from turgor.core.model.sheets import Membrane
from turgor.core.model.supports import Displacement, Fixed
from turgor.core.results.measures.measures import find_measure, measure
from turgor.core.results.measures.standard_measures import bending_angle
from turgor.core.solvers.solution import Status
from turgor.foundation.finding import Finding, Severity
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.views.plots.response_plots import write_plot
from turgor.views.report import describe
from turgor.views.report.page import Picture, Report, write_report
from turgor.views.viewer.settings import VIEWER


class Page(HTMLParser):
    """Text, links and nesting of a page."""

    VOID = frozenset({"meta", "img", "br", "link", "hr", "input"})

    def __init__(self, html):
        super().__init__()
        self.open, self.links, self.words, self.unbalanced = [], [], [], []
        self.feed(html)

    def handle_starttag(self, tag, attrs):
        if tag not in self.VOID:
            self.open.append(tag)
        self.links += [value for name, value in attrs if name in ("src", "href", "xlink:href")]

    def handle_startendtag(self, tag, attrs):
        self.links += [value for name, value in attrs if name in ("src", "href", "xlink:href")]

    def handle_endtag(self, tag):
        if self.open[-1:] == [tag]:
            self.open.pop()
        else:
            self.unbalanced.append(tag)

    def handle_data(self, data):
        if self.open[-1:] not in (["style"], ["script"]):
            self.words.append(data)

    @property
    def text(self):
        return " ".join(" ".join(self.words).split())


@pytest.fixture(scope="module")
def png(tmp_path_factory):
    path = tmp_path_factory.mktemp("report") / "p.png"
    columns = (Column("pressure", "kPa", [0, 1]), Column("rise", "mm", [0, 1]))
    write_plot(path, Response(columns=columns, source=Source(text="a test")))
    return path.read_bytes()


@pytest.fixture(scope="module")
def solution():
    model = cases.model(cases.body(half=True), pressure=50e3)
    path = [cases.state(model, cases.bent(1.5 * f), f) for f in (0.0, 0.4, 1.0)]
    return cases.solution(path, Status.LIMIT_POINT)


def page(tmp_path, **values):
    write_report(tmp_path / "r.html", Report(**values))
    return Page((tmp_path / "r.html").read_text(encoding="utf-8"))


def test_page_holds_every_fact_and_no_request(tmp_path, solution, png):
    findings = (
        Finding(code="B02", severity=Severity.ERROR, message="Walls met at 7 kPa.", advice="Stay below."),
        Finding(code="M04", severity=Severity.WARNING, message="Doubtful record.", advice="Fit your own."),
    )
    shown = page(
        tmp_path, title="Finger", solution=solution, response=measure(solution), findings=findings,
        dimensions={"wall": "1 mm", "gap": "2 mm", "chambers": "11"}, quality=quality(solution.model.mesh),
        pictures=(Picture(caption="Undeformed.", png=png),), versions={"numpy": "2.0", "threads": 2},
        repeat="turgor run job.lock.toml", files={"response.csv": "all states"}, created="2026-11-21",
    )  # fmt: skip
    for fact in (
        "Finger", "limit point", "Reached 50 kPa.", "B02 error", "Walls met at 7 kPa. Stay below.", "M04 warning",
        "50 kPa pressure", "85.94° bending angle", "wall 1 mm", "Undeformed.", "Gauge pressure 50 kPa on cavity",
        "fixed does not move in x, y, z.", "symmetry_y is a mirror plane.", "ten-node tetrahedra (half, mirrored)",
        "coefficients C10 = 0.12 MPa", "Neo-Hookean law W = C10", "infinite: fully incompressible",
        "source stated in the script", "2 attempted steps", "2 steps accepted, 0 cut back, 8 iterations",
        "numpy 2.0", "threads 2", "turgor run job.lock.toml", "response.csv all states", "on 2026-11-21",
        "rotation of the face tip", "worst Jacobian ratio 1.00",
    ):  # fmt: skip
        assert fact in shown.text, fact
    assert shown.links
    assert all(link.startswith(("data:", "#")) for link in shown.links)
    raw = (tmp_path / "r.html").read_text()
    assert not re.search(r"url\((?!#)|@import|<script[^>]*src", raw)
    assert (shown.open, shown.unbalanced) == ([], [])


def test_headlines_are_percentiles_and_say_so(tmp_path, solution):
    """The maximum at a point stands in the table, with its definition; the headline has the regions beside it."""
    response = measure(solution)
    shown = page(tmp_path, title="T", solution=solution, response=response)
    whole, body, base = (
        f"{response.find(name).in_unit[-1]:.4g} kPa"
        for name in ("von_mises_p99", "body_von_mises_p99", "base_von_mises_p99")
    )
    assert f"{whole} von Mises stress (99 % of volume); base {base}, body {body}" in shown.text
    assert f"{response.find('maximum_von_mises').in_unit[-1]:.4g} kPa maximum" not in shown.text
    assert "Stress and stretch are what 99 % of the volume stay below" in shown.text
    assert "body von Mises stress (99 % of volume) von Mises stress that 99 % of the volume of the region" in shown.text
    assert "grows without limit at sharp edges" in shown.text
    pointwise = measure(solution, bending_angle, find_measure("maximum_von_mises"))
    shown = page(tmp_path, title="T", solution=solution, response=pointwise)
    assert "kPa maximum von Mises stress" in shown.text
    assert "Stress and stretch are what" not in shown.text


def test_no_page_says_converged(tmp_path, solution):
    ended = cases.solution(list(solution.states), Status.CONVERGED)
    shown = page(tmp_path, title="T", solution=ended, response=measure(ended))
    assert "solved to the end Reached 50 kPa." in shown.text
    assert "converged" not in shown.text


def test_page_without_extras(tmp_path, solution):
    shown = page(tmp_path, title="Bare", solution=solution, response=measure(solution))
    assert "No check noticed anything." in shown.text
    assert "How to repeat" not in shown.text


@pytest.mark.parametrize(
    ("status", "severity", "good"),
    [
        (Status.CONVERGED, Severity.WARNING, True),
        (Status.CONVERGED, Severity.ERROR, False),
        (Status.STOPPED, Severity.NOTE, False),
    ],
)
def test_status_is_green_only_if_nothing_invalidates_the_result(tmp_path, solution, status, severity, good):
    ended = cases.solution(list(solution.states), status)
    finding = Finding(code="B02", severity=severity, message="m", advice="a")
    page(tmp_path, title="T", solution=ended, response=measure(ended), findings=(finding,))
    assert ('class="status good"' in (tmp_path / "r.html").read_text()) is good


def test_texts_are_escaped(tmp_path, solution):
    shown = page(tmp_path, title="<b>& bold", solution=solution, response=measure(solution), repeat="a < b && c")
    assert "<b>& bold" in shown.text
    assert "a < b && c" in shown.text


def test_long_response_is_thinned_and_says_so(tmp_path, solution):
    values = np.linspace(0, 1, 101)
    columns = (Column("load_factor", "", values), Column("rise", "mm", 1e-3 * values))
    long = Response(columns=columns, source=Source(text="a test"))
    shown = page(tmp_path, title="Long", solution=solution, response=long)
    assert re.search(r"8\d of 101 states are left out", shown.text)
    assert "1.000 1.000" in shown.text  # the last state stays


def test_pictures_keep_one_scale(tmp_path, solution, png):
    tall = png[:16] + (500).to_bytes(4, "big") + (1000).to_bytes(4, "big") + png[24:]
    pictures = (Picture(caption="a", png=png), Picture(caption="b", png=tall))
    write_report(
        tmp_path / "r.html", Report(title="T", solution=solution, response=measure(solution), pictures=pictures)
    )
    assert re.findall(r'<img width="(\d+)"', (tmp_path / "r.html").read_text()) == [str(VIEWER.height // 2)] * 2
    with refused("picture 'c'", "PNG"):
        page(tmp_path, title="T", solution=solution, response=measure(solution),
             pictures=(Picture(caption="c", png=b"GIF89a"),))  # fmt: skip


def test_loads_and_supports_in_words():
    mesh = cases.body()
    rubber = Material(name="r", law=NeoHooke(C10=1e5), density=1000.0)
    model = Model(
        mesh, {"body": rubber, "base": rubber},
        [Fixed("fixed", "xz"), Displacement("tip", lambda X, f: 0 * X, "y"), Displacement("*", lambda X, f: 0 * X)],
        [Pressure("cavity", 5e3), Traction("tip", (1e3, 0.0, -2e3)), Gravity(), BodyForce(lambda X: 0 * X)],
    )  # fmt: skip
    assert describe.loads(model) == [
        "Gauge pressure 5 kPa on cavity, following the surface.", "Traction (1, 0, -2) kPa on tip, fixed in direction.",
        "Gravity 9.80665 m/s² along (0, 0, -1).", "Force per volume, given as a function of position.",
    ]  # fmt: skip
    assert describe.supports(model) == [
        "fixed does not move in x, z.",
        "tip moved in y.",
        "The whole surface moved in x, y, z.",
    ]
    assert describe.loads(Model(mesh, {"body": rubber, "base": rubber}, [], [])) == ["None."]


def test_equal_materials_share_one_text_and_units_are_stated():
    mesh = cases.body()
    source = Source(text="A paper", doubts=("read off a figure",))

    def rubber():
        return Material(name="rubber", law=Yeoh(C10=4e3, C20=2e4), bulk_modulus=2e9, density=1100.0,
                        stretch_range=(1.0, 3.0), source=source)  # fmt: skip

    paper = Membrane(Material(name="paper", law=Hooke(E=6.5e9, nu=0.2)), 1e-4)
    model = Model(mesh, {"body": rubber(), "base": rubber(), "tip": paper}, [], [])
    first, second = describe.materials(model)
    assert (first.where, second.where) == ("body, base", "tip (membrane)")
    assert ("coefficients", "C10 = 4 kPa, C20 = 0.02 MPa, C30 = 0") in first.values
    assert ("bulk modulus", "2 GPa") in first.values
    assert ("fitted to stretches", "1 to 3") in first.values
    assert first.doubts == ("read off a figure",)
    assert second.values == [("coefficients", "E = 6.5 GPa, nu = 0.2"), ("thickness", "0.1 mm")]
