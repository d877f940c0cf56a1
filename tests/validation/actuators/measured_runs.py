"""Every computation of docs/measured-actuators.md, by the name under which the page asks for it."""

from typing import Any

import cantilever
import inflated
from bender import bends, pushes

from turgor.study.runs import Run

#: Highest pressure [kPa], and how far beyond a limit point the cavity may grow, of the whole curves and of variations.
WHOLE_CURVE, VARIED = (46.0, 8.0), (46.0, 1.2)
CHAMBERS = (5, 7)
#: What differs from `bender.STATED`, in words, with the group it belongs to.
VARIATIONS: dict[str, tuple[str, dict[str, Any]]] = {
    "as stated": ("", {}),
    "mesh: cells of 4.5 mm": ("mesh", {"size_mm": 4.5}),
    "film: stiffness / 10": ("film", {"modulus_MPa": 410.0}),
    "film: stiffness / 100": ("film", {"modulus_MPa": 41.0}),
    "film: stiffness / 1000": ("film", {"modulus_MPa": 4.1}),
    "film: stiffness × 10": ("film", {"modulus_MPa": 41000.0}),
    "film: bends as a plate of 0.5 mm": ("film", {"form": "shell"}),
    "film: a plate of 0.1 mm": ("film", {"form": "shell", "thickness_mm": 0.1}),
    "film: none, 0.5 mm of rubber": ("film", {"form": "none"}),
    "film: under 1 mm of rubber": ("film", {"floor_mm": 1.0}),
    "law: neo-Hooke": ("law", {"law": "neo-hooke"}),
    "law: Gent": ("law", {"law": "gent"}),
    "law: Arruda-Boyce": ("law", {"law": "arruda-boyce"}),
    "law: Ogden, two terms": ("law", {"law": "ogden-2"}),
    "law: Yeoh, tests up to stretch 2": ("law", {"upto": 2.0}),
    "law: neo-Hooke, tests up to stretch 2": ("law", {"law": "neo-hooke", "upto": 2.0}),
    "law: Yeoh, dumb-bell from 50 mm": ("law", {"zero": "grips"}),
    "law: Yeoh, all stresses × 0.9": ("law", {"factor": 0.9}),
    "clamp: 5 mm held all around": ("clamp", {"clamp_mm": 5.0}),
    "weight: hanging, tip down": ("weight", {"gravity": [1.0, 0.0, 0.0]}),
    "weight: lying, film down": ("weight", {"gravity": [0.0, 0.0, -1.0]}),
    "weight: lying, film up": ("weight", {"gravity": [0.0, 0.0, 1.0]}),
    "walls: 6.7 mm": ("walls", {"wall_mm": 6.7}),
}
#: Of the blocked force.
BLOCKED: dict[str, tuple[str, dict[str, Any]]] = {
    "as stated": ("", {}),
    "mesh: cells of 4.5 mm": ("mesh", {"size_mm": 4.5}),
    "law: Yeoh, dumb-bell from 50 mm": ("law", {"zero": "grips"}),
    "law: Yeoh, all stresses × 0.9": ("law", {"factor": 0.9}),
    "law: Gent": ("law", {"law": "gent"}),
    "clamp: end face only": ("clamp", {"clamp_mm": 0.0}),
    "film: stiffness / 100": ("film", {"modulus_MPa": 41.0}),
    "contact: friction 0.5": ("contact", {"friction": 0.5}),
    "contact: plate 2 mm below": ("contact", {"plate_mm": 2.0}),
}


def free(chambers: int, name: str, reach: tuple[float, float] = VARIED) -> Run:
    """Free bending with one thing varied."""
    values = {"chambers": chambers, "top_kPa": reach[0], "past": reach[1], "how": VARIATIONS[name][1]}
    return Run(name=f"free c{chambers}, {name}", function=bends, values=values)


def blocked(chambers: int, name: str) -> Run:
    """Blocked force with one thing varied."""
    values = {"chambers": chambers, "top_kPa": 50.0, "how": BLOCKED[name][1]}
    return Run(name=f"blocked c{chambers}, {name}", function=pushes, values=values)


#: Of the plain membrane at the middle weight, by Campbell's own law.
MEMBRANE_VARIED: dict[str, dict[str, Any]] = {
    "cells of 1.5 mm": {"size_mm": 1.5},
    "thickness 1.9 mm": {"thickness_mm": 1.9},
    "plate of 23.4 mm, 2 mm less": {"plate_mm": 23.4},
    "the stage of 1 kg counts too": {"weight": 24.525 + 9.81},
}
BLIND_LAWS = ("authors", "neo-hooke", "yeoh", "gent", "ogden-2")


def membrane_runs() -> list[Run]:
    """All runs of the membranes; the calibrated ones come with the factor that `calibrated` found."""
    plain = [lifted("membrane_01", weight, law) for law in BLIND_LAWS for weight in inflated.WEIGHTS]
    rings = [lifted("membrane_02", weight, "authors") for weight in inflated.WEIGHTS]
    varied = [lifted("membrane_01", law="authors", **{"weight": inflated.WEIGHTS[1], **how}) for how in MEMBRANE_VARIED.values()]
    return [*plain, *rings, *varied, FACTOR]


FACTOR = Run(name="factor of the membranes", function=inflated.calibrated, values={"law": "authors"})


def calibrated_membranes(factor: float) -> list[Run]:
    """The membranes with all stresses scaled."""
    which = [("membrane_01", weight) for weight in inflated.WEIGHTS] + [("membrane_02", each) for each in inflated.WEIGHTS]
    return [lifted(membrane, weight, "authors", factor=factor) for membrane, weight in which]


def lifted(membrane: str, weight: float, law: str, **how: Any) -> Run:
    """A membrane."""
    values = {"membrane": membrane, "weight": weight, "law": law, **how}
    said = ", ".join(f"{key} {value}" for key, value in how.items())
    return Run(name=f"{membrane} {weight} N {law} {said}", function=inflated.lifts, values=values)
