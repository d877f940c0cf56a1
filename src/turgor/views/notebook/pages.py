"""Pages: what a notebook shows of each kind of value, short tables next to a picture."""

from itertools import groupby

from turgor.core.geometry.geometry import Geometry
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.fitting.result import Fit
from turgor.core.materials.laws.laws import Law
from turgor.core.materials.material import Material
from turgor.core.meshing.mesh import Mesh
from turgor.core.meshing.quality.cell_quality import quality
from turgor.core.model.model import Model
from turgor.core.results.measures.measures import measure
from turgor.core.results.measures.standard_measures import bending_angle, tip_displacement
from turgor.core.solvers.solution import Solution, State
from turgor.foundation.display import counted
from turgor.foundation.finding import Severity
from turgor.foundation.response import Response
from turgor.units import mL, mm
from turgor.views.notebook.markup import card, facts, image, numbers
from turgor.views.pictures.picture import caption, picture
from turgor.views.pictures.settings import FRAMING
from turgor.views.plots.figures import PlotFigure, png_of
from turgor.views.plots.fits import fit_figure, plot_test
from turgor.views.plots.law_plot import law_figure
from turgor.views.plots.response_plots import response_figure
from turgor.views.report import describe
from turgor.views.report.describe import Rows
from turgor.views.report.describe_procedure import ending
from turgor.views.report.response_table import response_table
from turgor.views.report.settings import PAGE

#: Word for each severity of a finding.
_MARKS = {Severity.NOTE: "note", Severity.WARNING: "warning", Severity.ERROR: "error"}


def material(of: Material) -> str:
    """Show a material: its curve, its coefficients, its range and its source."""
    words = describe.material([], of)
    rows: Rows = [("law", words.law), *words.values, ("source", words.source), ("doubts", "\n".join(words.doubts))]
    curve = "" if not isinstance(of.law, Law) else image(png_of(law_figure(of)), f"stress of {of.name}")
    return card(of.name, curve, facts(rows), line=type(of.law).__name__)


def geometry(of: Geometry) -> str:
    """Show a geometry: its named faces, its size and its volumes."""
    size = " × ".join(f"{(high - low) / mm:.4g}" for low, high in zip(*of.bounds, strict=True))
    rows: Rows = [
        ("size", f"{size} mm"),
        ("thinnest wall", f"{of.smallest_wall / mm:.4g} mm"),
        *((f"volume of {name}", f"{volume / mL:.4g} mL") for name, volume in of.cavity_volumes.items()),
        ("volume of the solid", f"{of.solid_volume / mL:.4g} mL"),
        ("regions", ", ".join(of.regions)),
        ("faces", ", ".join(of.faces)),
        ("findings", "\n".join(map(str, of.findings))),
    ]
    return card(of.name, image(picture(of, title="", width=PAGE.width).png, of.name), facts(rows))


def mesh(of: Mesh) -> str:
    """Show a mesh: its cells colored by their shape, and its counts."""
    rows = [*describe.mesh(of, quality(of)), ("faces", ", ".join(f"{name} {len(f):,}" for name, f in of.faces.items()))]
    findings = "\n".join(map(str, of.findings))
    return card(
        of.name,
        image(picture(of, title="", width=FRAMING.design_width).png, of.name),
        facts([*rows, ("findings", findings)]),
    )


def model(of: Model) -> str:
    """Show a model: its materials, supports, loads and contact."""
    materials: Rows = []
    for used in describe.materials(of):
        values = ", ".join(f"{name} {value}" if name != "coefficients" else value for name, value in used.values)
        materials.append((used.where, f"{used.name}: {values}"))
    rows: Rows = [
        ("mesh", of.mesh.counts),
        *materials,
        ("supports", "\n".join(describe.supports(of))),
        ("loads at load factor 1", "\n".join(describe.loads(of))),
        ("contact", "\n".join(describe.contact(of))),
    ]
    return card(f"Model of {of.mesh.name}", facts(rows))


def state(of: State) -> str:
    """Show a state: its picture, load factor, stability and contact."""
    return card(
        caption(of), image(picture(of, title="", width=FRAMING.design_width).png, caption(of)), facts(state_rows(of))
    )


def state_rows(of: State) -> Rows:
    """List what a page says of a state next to its picture: load factor, stability and contact areas."""
    rows: Rows = [("load factor", f"{of.load_factor:.4g}")]
    if of.unstable_modes is not None:
        unstable = f"unstable, {counted(of.unstable_modes, 'mode')}"
        rows.append(("equilibrium", unstable if of.unstable_modes else "stable"))
    rows += [
        (f"contact with {'itself' if name == 'self' else name}", f"{touch.area / mm**2:.4g} mm² of the modeled part")
        for name, touch in of.touches.items()
        if touch.area > 0
    ]
    return rows


def solution(of: Solution) -> str:
    """Show a solution: its ending with advice, the last state, and the path."""
    findings = "\n".join(f"{each.code} {_MARKS[each.severity]}: {each.message} {each.advice}" for each in of.findings)
    rows: Rows = [
        ("ended", f"{ending(of.status)}: {of.message}"),
        ("advice", of.advice),
        ("findings", findings),
        ("limit points", "\n".join(f"{each.kind} at load factor {each.load_factor:.4g}" for each in of.limit_points)),
        ("steps", _steps(of)),
    ]
    shown = picture(of, width=FRAMING.design_width) if of.states else None
    drawn = image(shown.png, shown.caption) if shown else ""
    return card(f"Solution of {of.model.mesh.name}", facts(rows), drawn, _path(of))


def _steps(of: Solution) -> str:
    accepted = sum(step.accepted for step in of.steps)
    spent = f", {of.timing.total:.1f} s" if of.timing.total else ""
    return f"{accepted} accepted, {len(of.steps) - accepted} cut back, {of.iterations} iterations{spent}"


def _path(of: Solution) -> str:
    """Table of the states: the drive, and displacement and angle of the tip where the mesh has a tip."""
    if not of.states:
        return ""
    known = {"tip", "fixed"} <= of.model.mesh.faces.keys()
    shown = (tip_displacement, bending_angle) if known else (tip_displacement,) if "tip" in of.model.mesh.faces else ()
    return _table(measure(of, *shown)) if shown else ""


def response(of: Response) -> str:
    """Show a response: its table, each column in the unit that its heading names, and its plot."""
    line = ", ".join(part for part in (of.status.replace("_", " "), str(of.source)) if part)
    drawn = image(png_of(response_figure(of)), "the response against its drive") if _worth_a_plot(of) else ""
    return card(f"Response, {len(of)} rows", _table(of), drawn, line=line)


def _worth_a_plot(of: Response) -> bool:
    return len(of) > 1 and len(of.quantities) > 1


def _table(of: Response) -> str:
    shown = response_table(of)
    note = f"{shown['left_out']} of {shown['count']} rows are not shown." if shown["left_out"] else ""
    return numbers(shown["labels"], shown["rows"], note)


def test(of: MaterialTest) -> str:
    """Show a test of a material: its points and its edits."""
    figure = PlotFigure(figsize=(5.0, 3.3))
    plot_test(figure.add_subplot(), of).legend(frameon=False, fontsize=8)
    rows: Rows = [
        ("stretch", f"{of.range[0]:.4g} to {of.range[1]:.4g}"),
        ("points", f"{len(of.stretch)}"),
        ("edits", "\n".join(edit.text for edit in of.edits)),
        ("source", str(of.source)),
    ]
    return card(f"Test {of.name}", image(png_of(figure), f"test {of.name}"), facts(rows), line=of.mode)


def fit(of: Fit) -> str:
    """Show a fit: the curve against its tests, the parameters with their errors, and the findings."""
    drawn = image(png_of(fit_figure([of])), f"fit of {of.spec.name}")
    by_mode = [(mode, list(each)) for mode, each in groupby(of.quality, key=lambda test: test.mode)]
    rows: Rows = [
        ("parameters", of.describe()),
        *((f"error, {mode}", ", ".join(f"{100 * one.relative:.2g} %" for one in each)) for mode, each in by_mode),
        ("range of stretch", f"{of.stretch_range[0]:.4g} to {of.stretch_range[1]:.4g}"),
        ("findings", "\n".join(map(str, of.findings))),
    ]
    return card(f"Fit of {of.spec.name}", drawn, facts(rows))
