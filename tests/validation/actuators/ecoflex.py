"""Laws of Ecoflex 00-30, fitted to the tests of Moseley et al. 2016: planar cycles and one dumb-bell, no other data."""

from dataclasses import fields, replace
from functools import cache
from typing import Any

import numpy as np
from fit_data import DATA, ecoflex_planar
from turgor.experiments import Fit, MaterialTest, Specimen, crop, remove_slack, thin

import turgor as tg
from turgor.units import N, mm

FOLDER = DATA / "epfl-ecoflex30-actuators"
SECTION, LENGTH = 15 * mm**2, 50 * mm
DENSITY = 1070.0
#: Largest stretch of the dumb-bell that is used: all of it, or as far as the planar tests go.
WHOLE, SHORT = 8.0, 2.0
LAWS = ("neo-hooke", "yeoh", "gent", "arruda-boyce", "ogden-2")


@cache
def dumbbell(zero: str) -> MaterialTest:
    """The uniaxial test up to its break. Zero length: ``"grips"``, 50 mm, or ``"authors"``, where 0.1 N is reached."""
    specimen = Specimen(length=LENGTH, area=SECTION)
    test = tg.read_test(FOLDER / "uniaxial_dumbbell_means.csv", mode="uniaxial", specimen=specimen)
    return remove_slack(test, 0.1 * N / SECTION) if zero == "authors" else test


@cache
def fitted(law: str, upto: float = WHOLE, zero: str = "authors", tests: str = "both") -> Fit:
    """A law fitted to the planar tests and the dumb-bell up to a stretch, or to the ``"dumb-bell"`` alone."""
    planar = [] if tests == "dumb-bell" else [thin(test, 40) for test in ecoflex_planar()]
    return tg.fit(law, [thin(crop(dumbbell(zero), 1.0, upto), 80), *planar])


def material(law: str, upto: float = WHOLE, zero: str = "authors", tests: str = "both") -> tg.Material:
    """The rubber of a fit."""
    return fitted(law, upto, zero, tests).named(f"Ecoflex 00-30, {law}", density=DENSITY)


def scaled(law: Any, factor: float) -> Any:
    """The law with all its stresses times a factor."""
    shapes = {"alpha", "Jm", "locking_stretch"}
    values = {each.name: getattr(law, each.name) for each in fields(law) if each.name not in shapes}
    return replace(law, **{name: factor * np.asarray(value) for name, value in values.items()})
