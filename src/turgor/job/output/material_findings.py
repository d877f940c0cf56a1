"""Findings about the materials of a run: doubtful constants, and laws used beyond their tests."""

from collections.abc import Iterable

import numpy as np

from turgor.engine.fields import cell_fields
from turgor.finding import Finding, Severity
from turgor.materials.fitting.checks import check_stretch_range
from turgor.materials.library.doubts import doubts_of
from turgor.materials.material import Material
from turgor.model.drive import kinks
from turgor.model.model import Model
from turgor.results.fields.percentiles import volume_percentile
from turgor.solvers.solution import Solution


def constants_in_doubt(model: Model) -> tuple[Finding, ...]:
    """Return the warnings about constants of the materials of a model (M04 to M07), each once."""
    materials: list[Material] = [*model.region_materials.values(), *(m.material for m in model.membranes.values())]
    return _each_once(
        finding for material in materials for finding in doubts_of(material) if finding.severity is not Severity.NOTE
    )


def laws_beyond_their_tests(solution: Solution) -> tuple[Finding, ...]:
    """Return M01 for every region in which more than 1 % of the volume is stretched beyond the tests of its law.

    Single points do not count, because the stretch at sharp edges grows with mesh refinement. The check uses the last
    state, the extrema of the pressure, and the state with the largest displacement.
    """
    model, turns = solution.model, kinks(solution.model)
    largest = dict.fromkeys(model.region_materials, 1.0)
    farthest = max(solution.states, key=lambda state: float(np.abs(state.displacement).max()))
    looked_at = (*(s for s in solution.states if s.load_factor in turns), farthest, solution.states[-1])
    for state in {id(state): state for state in looked_at}.values():
        cells = cell_fields(model, state.displacement, state.mean_stress)
        for name in largest:
            largest[name] = max(largest[name], volume_percentile(cells, cells.stretch, model.mesh.regions[name]))
    return _each_once(
        finding
        for name, material in model.region_materials.items()
        for finding in check_stretch_range(material, (1.0, largest[name]))
    )


def _each_once(findings: Iterable[Finding]) -> tuple[Finding, ...]:
    return tuple(dict.fromkeys(findings))
