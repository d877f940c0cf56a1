"""Every computation of docs/measured-actuators.md, by the name under which the page asks for it."""

from typing import Any

import inflated
from bender import bends
from bender_rig import STIFF, fitted_spring, holds, rests

from turgor.studies.runs.run import Run

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
#: Actuators whose blocked force was measured: chambers and wall [mm]; the first two are those of the free bending.
PRESSED = {"5 chambers": (5, 7.0), "7 chambers": (7, 7.0), "5 chambers, walls of 10 mm": (5, 10.0)}
#: Laws of the blocked force: the blind one, and the one that meets the free bending.
PRESSED_BY: dict[str, dict[str, Any]] = {"Yeoh": {}, "dumb-bell alone": {"tests": "dumb-bell"}}
#: The second of them, and the actuator whose force at one pressure is fitted.
MEETS, FITTED = "dumb-bell alone", "5 chambers, walls of 10 mm"
#: Highest pressure of a blocked force [kPa]: beyond it chambers balloon.
PRESSED_TO = 36.0
#: Plates below the tip, of the actuators of the free bending.
PLATES: dict[str, dict[str, Any]] = {"level with the film": {}, "5 mm below": {"plate_mm": 5.0}}
#: Variations of 7 chambers by the law that meets the free bending: how many times the fitted spring, and the rest.
HELD: dict[str, tuple[float, dict[str, Any]]] = {
    "as stated": (1.0, {}),
    "spring × 2": (2.0, {}),
    "spring / 2": (0.5, {}),
    "law: Yeoh, both tests": (1.0, {"tests": "both"}),
    "mesh: cells of 2.5 mm": (1.0, {"size_mm": 2.5}),
    "film: stiffness / 100": (1.0, {"modulus_MPa": 41.0}),
    "film: a plate of 0.1 mm": (1.0, {"form": "shell", "thickness_mm": 0.1}),
    "clamp: end face only": (1.0, {"clamp_mm": 0.0}),
}
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
    result = [free(5, name) for name in VARIATIONS] + [free(7, name) for name in BLIND_BENDERS[7]]
    return [*result, whole()]


def blocked_runs() -> list[Run]:
    """All runs of the blocked force but those on fitted springs."""
    plates = [plate(chambers, name) for chambers in CHAMBERS for name in PLATES]
    blind = [held(name, "Yeoh", spring) for name in PRESSED for spring in (0.0, STIFF)]
    return [*plates, *blind, *(spring(name, law) for name in PRESSED for law in PRESSED_BY)]


def fitted_runs(springs: dict[str, float]) -> list[Run]:
    """All runs on the springs that were fitted with each law to the actuator with walls of 10 mm."""
    results = [held(name, law, springs[law]) for name in PRESSED for law in PRESSED_BY]
    return [*results, *(held_varied(name, springs[MEETS]) for name in HELD)]


def plate(chambers: int, name: str) -> Run:
    """The tip before a plate."""
    values = {"chambers": chambers, "top_kPa": PRESSED_TO, "how": PLATES[name]}
    return Run(name=f"plate c{chambers}, {name}", function=rests, values=values)


def held(name: str, law: str, spring: float) -> Run:
    """The tip of an actuator on a spring [N m/rad]."""
    chambers, wall = PRESSED[name]
    how = {"wall_mm": wall, **PRESSED_BY[law]}
    values = {"chambers": chambers, "top_kPa": PRESSED_TO, "spring": spring, "how": how}
    return Run(name=f"held {name}, {law}, {spring:g} N m/rad", function=holds, values=values)


def held_varied(name: str, spring: float) -> Run:
    """The tip of 7 chambers on the fitted spring with one thing varied."""
    times, how = HELD[name]
    values = {"chambers": 7, "top_kPa": PRESSED_TO, "spring": times * spring, "how": {**PRESSED_BY[MEETS], **how}}
    return Run(name=f"held 7 chambers, {name}", function=holds, values=values)


def spring(name: str, law: str) -> Run:
    """The spring with which an actuator makes its measured force at one pressure."""
    chambers, wall = PRESSED[name]
    values = {"chambers": chambers, "wall_mm": wall, "how": PRESSED_BY[law]}
    return Run(name=f"spring of {name}, {law}", function=fitted_spring, values=values)


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
