"""The hard cases, in the order in which they are reported."""

from benchmarks.robustness.robustness_cases import actuators, loads, slender, spheres, touching
from benchmarks.robustness.robustness_cases.case import Case

CASES: tuple[Case, ...] = (*spheres.CASES, *slender.CASES, *actuators.CASES, *loads.CASES, *touching.CASES)
