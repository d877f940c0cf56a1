"""The last results are found by the content of the arguments: of equal arrays, and of no others."""

import numpy as np
import rslab
import scipy.sparse as sp

from turgor.core.engine.algebra.linear import Rslab
from turgor.core.engine.algebra.pattern import build_pattern
from turgor.core.engine.algebra.result_cache import last_results


def counted(count):
    asked = []

    @last_results(count)
    def total(array, factor=1.0):
        asked.append(factor)
        return [array.sum() * factor]

    return asked, total


def test_equal_content_is_found_again():
    asked, total = counted(2)
    first = total(np.arange(4), factor=2.0)
    assert total(np.arange(4), factor=2.0) is first
    assert len(asked) == 1


def test_other_values_types_shapes_and_words_are_computed():
    asked, total = counted(10)
    array = np.arange(4)
    for other in (array, array + 1, array.view(np.uint64), array.reshape(2, 2), (array[:2], array[2:])[1]):
        total(other)
    total(array, factor=2.0)
    total(array, 2.0)
    assert len(asked) == 7


def test_the_oldest_results_are_forgotten():
    asked, total = counted(2)
    for size in (1, 2, 1, 3, 1, 2):  # 2 is forgotten when 3 comes
        total(np.ones(size))
    assert len(asked) == 4


def test_solvers_of_equal_patterns_share_one_analysis_and_nothing_else(monkeypatch):
    analyze, calls = rslab.analyze, []
    monkeypatch.setattr(rslab, "analyze", lambda *given, **named: calls.append(1) or analyze(*given, **named))
    chain = np.array([[k, k + 1, k + 7] for k in range(40)])
    one, two = (Rslab(build_pattern(chain, 47), 1) for _ in range(2))
    assert len(calls) == 1
    pattern, right = build_pattern(chain, 47), np.linspace(1, 2, 47)
    rng = np.random.default_rng(3)
    values = [rng.random(len(pattern.indices)) + 20.0 * (scale + 1) * _diagonal(pattern) for scale in range(2)]
    one.factor(values[0], False)
    two.factor(values[1], False)
    for solver, data in zip((one, two), values, strict=True):
        np.testing.assert_allclose(sp.csc_matrix(pattern.full(data)) @ solver.solve(right), right, rtol=1e-9)


def _diagonal(pattern):
    mask = np.zeros(len(pattern.indices))
    mask[pattern.diagonal] = 1.0
    return mask
