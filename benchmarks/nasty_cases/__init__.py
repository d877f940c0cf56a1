"""The nasty cases, in the order in which they are reported."""

from nasty_cases import actuators, loads, slender, spheres, touching
from nasty_cases.case import Case

CASES: tuple[Case, ...] = (*spheres.CASES, *slender.CASES, *actuators.CASES, *loads.CASES, *touching.CASES)
