"""Groups of what pairs connect, compared with SciPy's search of the graph."""

import numpy as np
import pytest
from scipy.sparse import coo_array
from scipy.sparse.csgraph import connected_components

from turgor.core.meshing.bodies.groups import groups_of


def by_scipy(count, first, second):
    graph = coo_array((np.ones(len(first)), (first, second)), shape=(count, count))
    return connected_components(graph, directed=False)[1]


@pytest.mark.parametrize("seed", range(40))
def test_random_pairs(seed):
    rng = np.random.default_rng(seed)
    count, pairs = int(rng.integers(1, 200)), int(rng.integers(0, 250))
    first, second = rng.integers(0, count, (2, pairs))
    assert groups_of(count, first, second).tolist() == by_scipy(count, first, second).tolist()


@pytest.mark.parametrize("shuffled", [False, True])
def test_a_long_chain_is_one_group(shuffled):
    order = np.random.default_rng(1).permutation(10_000) if shuffled else np.arange(10_000)
    assert (groups_of(10_000, order[:-1], order[1:]) == 0).all()


def test_nothing_and_single_things():
    none = np.zeros(0, dtype=np.int64)
    assert groups_of(0, none, none).tolist() == []
    assert groups_of(3, none, none).tolist() == [0, 1, 2]
