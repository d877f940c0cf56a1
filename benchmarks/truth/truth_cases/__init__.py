"""The truth set: loaded actuators whose measures are known to a few parts in a thousand."""

from benchmarks.truth.truth_cases.pneunets import CASES as PNEUNETS
from benchmarks.truth.truth_cases.round import CASES as ROUND
from benchmarks.truth.truth_cases.wound import CASES as WOUND

CASES = (*PNEUNETS, *WOUND, *ROUND)
