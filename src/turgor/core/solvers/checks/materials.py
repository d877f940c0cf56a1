"""Findings about the materials of a model: doubtful constants, unstable laws, laws beyond their tests, tearing."""

from collections.abc import Iterable, Sequence

from turgor.core.engine.fields import cell_fields
from turgor.core.engine.percentiles import volume_percentile
from turgor.core.materials.fitting.checks import check_stretch_range
from turgor.core.materials.library.doubts import doubts_of
from turgor.core.model.model import Model
from turgor.core.solvers.checks.distinct import distinct, regions_and_sheets
from turgor.core.solvers.checks.distortion import telling_states
from turgor.core.solvers.checks.tearing.findings import tearing_findings
from turgor.core.solvers.solution import State
from turgor.foundation.finding import Finding, Severity


def constants_in_doubt(model: Model) -> tuple[Finding, ...]:
    """Return the warnings about constants of the materials of a model (M04 to M07), each once.

    Doubts of the library travel with its materials; a law that is stated is checked for its stability too (M06).
    """
    return _each_once(
        finding
        for material in distinct(regions_and_sheets(model))
        for finding in doubts_of(material)
        if finding.severity is not Severity.NOTE
    )


def rubber_findings(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Return the findings about the materials along a path: laws beyond their tests, tearing, and life.

    Parameters
    ----------
    model : Model
    states : sequence of State
    """
    return (*laws_beyond_their_tests(model, states), *tearing_findings(states))


def laws_beyond_their_tests(model: Model, states: Sequence[State]) -> tuple[Finding, ...]:
    """Return M01 for every material of which more than 1 % of a region is stretched beyond the tests of its law.

    Single points do not count, because the stretch at sharp edges grows with mesh refinement. The check uses the last
    state, the extrema of the pressure, and the state with the largest displacement.
    """
    tested = {name: each for name, each in model.region_materials.items() if each.stretch_range is not None}
    if not states or not tested:
        return ()
    largest = dict.fromkeys((id(material) for material in tested.values()), 1.0)
    for state in telling_states(model, states):
        cells = cell_fields(state.model, state.displacement, state.mean_stress, None, state.load_factor)
        for name, material in tested.items():
            here = volume_percentile(cells, cells.stretch, model.mesh.regions[name])
            largest[id(material)] = max(largest[id(material)], here)
    return _each_once(
        finding
        for material in tested.values()
        for finding in check_stretch_range(material, (1.0, largest[id(material)]))
    )


def _each_once(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    return tuple(dict.fromkeys(findings))
