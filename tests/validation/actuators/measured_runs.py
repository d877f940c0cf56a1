"""Every computation of docs/measured-actuators.md, by the name under which the page asks for it."""

from typing import Any

import inflated
from bender import bends, pushes

from turgor.study.runs import Run

#: Highest pressure [kPa], and how far beyond a limit point the cavity may grow, of the whole curves and of variations.
WHOLE_CURVE, VARIED = (46.0, 8.0), (46.0, 1.2)
CHAMBERS = (5, 7)
#: Where gravity points: the film lies at the bottom, or at the top of an actuator that is turned over.
DOWN, UP = [0.0, 0.0, -1.0], [0.0, 0.0, 1.0]
#: What differs from `bender.STATED`, in words, with the group it belongs to.
VARIATIONS: dict[str, tuple[str, dict[str, Any]]] = {
    "as stated": ("", {}),
    "mesh: cells of 2.5 mm": ("mesh", {"size_mm": 2.5}),
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
    "law: Ogden, two terms": ("law", {"law": "ogden-2"}),
    "law: Yeoh, tests up to stretch 2": ("law", {"upto": 2.0}),
    "law: Yeoh, dumb-bell from 50 mm": ("law", {"zero": "grips"}),
    "law: Yeoh, dumb-bell alone": ("law", {"tests": "dumb-bell"}),
    "clamp: 5 mm held all around": ("clamp", {"clamp_mm": 5.0}),
    "weight: hanging, tip down": ("weight", {"gravity": [1.0, 0.0, 0.0]}),
    "weight: lying, film down": ("weight", {"gravity": DOWN}),
    "contact: lying on a table, film down": ("contact", {"gravity": DOWN, "table": "film"}),
    "contact: lying on a table, film up": ("contact", {"gravity": UP, "table": "top"}),
    "contact: walls may touch each other": ("contact", {"touches_itself": True}),
    "walls: 6.7 mm": ("walls", {"wall_mm": 6.7}),
}
#: Of the blocked force.
BLOCKED: dict[str, dict[str, Any]] = {
    "as stated": {},
    "mesh: cells of 2.5 mm": {"size_mm": 2.5},
    "film: stiffness / 100": {"modulus_MPa": 41.0},
    "law: Yeoh, dumb-bell alone": {"tests": "dumb-bell"},
    "clamp: end face only": {"clamp_mm": 0.0},
    "contact: friction of 0.3 on the plate": {"friction": 0.3},
    "contact: plate 5 mm below": {"plate_mm": 5.0},
    "contact: plate 5 mm below, law: dumb-bell alone": {"plate_mm": 5.0, "tests": "dumb-bell"},
    "weight: towards the plate": {"gravity": DOWN},
    "weight: towards the plate, 2 mm below": {"gravity": DOWN, "plate_mm": 2.0},
    "weight: towards the plate, 5 mm below": {"gravity": DOWN, "plate_mm": 5.0},
    "weight: towards the plate, 10 mm below": {"gravity": DOWN, "plate_mm": 10.0},
}
#: Tells what the cell would show at rest.
HEAVY = "weight: towards the plate"
#: Variations of the blocked force, by the number of chambers.
BLOCKED_OF = {5: tuple(BLOCKED), 7: ("as stated", HEAVY, f"{HEAVY}, 5 mm below", f"{HEAVY}, 10 mm below")}
#: Blind laws that are drawn for each actuator.
ALONE = "law: Yeoh, dumb-bell alone"
BLIND_BENDERS = {5: ("as stated", "law: Gent", "law: Ogden, two terms", ALONE), 7: ("as stated", ALONE)}
#: What ends earlier than `VARIED`, because the rest of its path takes many minutes.
SHORTER = {(7, ALONE): (36.0, 1.2)}


def free(chambers: int, name: str) -> Run:
    """Free bending with one thing varied."""
    reach = SHORTER.get((chambers, name), VARIED)
    values = {"chambers": chambers, "top_kPa": reach[0], "past": reach[1], "how": VARIATIONS[name][1]}
    return Run(name=f"free c{chambers}, {name}", function=bends, values=values)


def whole() -> Run:
    """The curve of 5 chambers as stated, far beyond the limit point, with a picture of its end."""
    values = {"chambers": 5, "top_kPa": WHOLE_CURVE[0], "past": WHOLE_CURVE[1], "how": {"picture": True}}
    return Run(name="free c5, whole", function=bends, values=values)


def bender_runs() -> list[Run]:
    """All runs of the bending actuators."""
    found = [free(5, name) for name in VARIATIONS] + [free(7, name) for name in BLIND_BENDERS[7]]
    return [*found, *(blocked(chambers, name) for chambers in CHAMBERS for name in BLOCKED_OF[chambers]), whole()]


def blocked(chambers: int, name: str) -> Run:
    """Blocked force with one thing varied."""
    top = 50.0 if name == "as stated" else 38.0
    values = {"chambers": chambers, "top_kPa": top, "how": BLOCKED[name]}
    return Run(name=f"blocked c{chambers}, {name}", function=pushes, values=values)


#: Of the plain membrane at the middle weight, by the law of the authors of the data.
MEMBRANE_VARIED: dict[str, dict[str, Any]] = {
    "cells of 1.5 mm": {"size_mm": 1.5},
    "thickness 1.9 mm": {"thickness_mm": 1.9},
    "the stage of 1 kg counts too": {"weight": 24.525 + 9.81},
}
BLIND_LAWS = ("authors", "yeoh")
MIDDLE = inflated.WEIGHTS[1]
FACTOR = Run(name="factor of the membranes", function=inflated.calibrated, values={"law": "authors"})


def membrane_runs() -> list[Run]:
    """All runs of the membranes but the calibrated ones."""
    plain = [lifted("membrane_01", weight, law) for law in BLIND_LAWS for weight in inflated.WEIGHTS]
    plain.append(lifted("membrane_01", MIDDLE, "ogden-2"))
    rings = [lifted("membrane_02", weight, "authors") for weight in inflated.WEIGHTS]
    return [*plain, *rings, *(membrane_varied(name) for name in MEMBRANE_VARIED), FACTOR]


def membrane_varied(name: str) -> Run:
    """The plain membrane at the middle weight with one thing varied."""
    values = {"membrane": "membrane_01", "weight": MIDDLE, "law": "authors", **MEMBRANE_VARIED[name]}
    return Run(name=f"plain membrane, {name}", function=inflated.lifts, values=values)


def calibrated_membranes(factor: float) -> list[Run]:
    """The membranes with all stresses scaled."""
    both = ("membrane_01", "membrane_02")
    return [lifted(each, weight, "authors", factor=factor) for each in both for weight in inflated.WEIGHTS]


def lifted(membrane: str, weight: float, law: str, **how: Any) -> Run:
    """A membrane."""
    values = {"membrane": membrane, "weight": weight, "law": law, **how}
    said = ", ".join(f"{key} {value}" for key, value in how.items())
    return Run(name=f"{membrane} {weight} N {law} {said}", function=inflated.lifts, values=values)
