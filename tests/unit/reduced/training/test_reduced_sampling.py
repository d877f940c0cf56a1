"""Least squares without negative weights on fewer rows, which are combined at random."""

import numpy as np
import pytest

from turgor.reduced.settings import SAMPLING
from turgor.reduced.training.sampling import choose, combined


@pytest.fixture
def forces() -> np.ndarray:
    """Forces of 80 groups in many trials: few smooth fields, as in an actuator, and a little of their own."""
    random = np.random.default_rng(1)
    fields = 0.7 + random.standard_normal((20_000, 12))
    return fields @ random.uniform(0, 1, (12, 80)) + 1e-4 * random.standard_normal((20_000, 80))


def test_fewer_rows_keep_the_sizes_of_combinations(forces: np.ndarray) -> None:
    columns = np.random.default_rng(2).standard_normal((80, 5))
    fewer, right = combined(forces, forces.sum(axis=1), SAMPLING.rows)
    assert len(fewer) == len(right) == SAMPLING.rows
    sizes = np.linalg.norm(forces @ columns, axis=0)
    assert np.linalg.norm(fewer @ columns, axis=0) == pytest.approx(sizes, rel=0.1)
    assert fewer.sum(axis=1) == pytest.approx(right)


def test_choice_on_fewer_rows_holds_on_all(forces: np.ndarray) -> None:
    total = forces.sum(axis=1)
    chosen = choose(forces, total, 1e-3, 60)
    assert len(chosen.which) < 30
    left = np.linalg.norm(forces[:, chosen.which] @ chosen.factors - total)
    assert left < 1.2e-3 * np.linalg.norm(total)
