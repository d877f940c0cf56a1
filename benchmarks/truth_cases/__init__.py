"""The truth set: loaded actuators whose measures are known to a few parts in a thousand."""

from truth_cases.pneunets import CASES as PNEUNETS
from truth_cases.round import CASES as ROUND
from truth_cases.wound import CASES as WOUND

CASES = (*PNEUNETS, *WOUND, *ROUND)
