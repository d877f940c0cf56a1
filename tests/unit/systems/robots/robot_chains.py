"""Chains that several tests share."""

from functools import cache

import numpy as np
from reduced_cases import reduced

from turgor.core.engine.runtime import EngineOptions
from turgor.systems.robots.chains.chain import Chain
from turgor.systems.robots.chains.chain_of import FittedChain, chain_of


@cache
def fitted() -> FittedChain:
    """The finger of two chambers as a chain."""
    return chain_of(reduced(), options=EngineOptions(threads=1))


def spatial(gravity=(0.0, 0.0, -9.81)) -> Chain:
    """Three links that turn about two axes and slide, with two pressures."""
    rng = np.random.default_rng(0)
    n = 3
    limits = np.tile([[-1, 1], [-1, 1], [-0.01, 0.01]], (n, 1))
    springs = np.tile([[0.02, 0.01, 0.05], [0.03, -0.01, 0.04], [300.0, 0.0, 0.0]], (n, 1))
    gains = np.tile([[2e-7, 1e-7, 8e-6], [-1e-7, 2e-7, 9e-6]], n)
    return Chain(
        base=np.array([0.0, 0.0, 0.002]), pivots=np.array([[0.01, 0, 0.002], [0.02, 0, 0], [0.02, 0.001, 0]]),
        end=np.array([0.01, 0, 0.001]),
        kinds=(1, 2, 0), springs=springs, gains=gains, growth=np.array([2e6, 1e6]),
        masses=0.002 * rng.uniform(1, 2, n), centers=np.tile([0.01, 0.0, 0.001], (n, 1)),
        inertias=np.full((n, 3), 2e-7), gravity=np.array(gravity), limits=limits,
        capsules=np.tile([0.003, 0, 0, 0.015, 0, 0, 0.004], (n, 1)), names=("cavity_1.pressure", "cavity_2.pressure"),
        high=np.array([3e4, 3e4]), low=np.zeros(2),
    )  # fmt: skip


X = np.tile([0.3, -0.2, 0.001], 3)
