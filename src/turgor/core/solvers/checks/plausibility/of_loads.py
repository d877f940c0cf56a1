"""Magnitudes of loads: pressures, also against the stiffness of the walls, gravity, injected volumes."""

from collections.abc import Iterator, Mapping

from turgor.core.engine.chamber_volumes import cavity_volume
from turgor.core.engine.faces.surfaces import area
from turgor.core.materials.laws.laws import Hooke
from turgor.core.model.drive import extremes, pressures_at
from turgor.core.model.loads import Gravity
from turgor.core.solvers.checks.plausibility.of_materials import RIGID, has_rubber
from turgor.core.solvers.checks.plausibility.of_shapes import region_volume
from turgor.core.solvers.checks.plausibility.question import Magnitude, Question, shown
from turgor.units import mL


def largest_pressure(question: Question) -> Iterator[Magnitude]:
    """Largest size of the pressure on every face along its history [Pa]."""
    for face, values in _pressures(question).items():
        yield Magnitude(f"Pressure on '{face}'", max(map(abs, values)))


def lowest_pressure(question: Question) -> Iterator[Magnitude]:
    """Lowest pressure on every face along its history [Pa], gauge."""
    for face, values in _pressures(question).items():
        yield Magnitude(f"Pressure on '{face}'", min(values))


def pressure_over_stiffness(question: Question) -> Iterator[Magnitude]:
    """Pressure × volume of the pressed cavities over Young's modulus × volume of the rubber [-].

    For a thin wall it is a third to a half of pressure × radius over modulus × thickness.
    """
    model, stiffness = question.model, _stiffness(question)
    pressed = {face: max(map(abs, values)) for face, values in _pressures(question).items()}
    cavities = {face: p for face, p in pressed.items() if p and face in model.mesh.cavities}
    if not cavities or not stiffness or not has_rubber(question):
        return  # the range is that of rubber: a bellows of metal moves little
    work = sum(p * abs(cavity_volume(model.mesh, face)) for face, p in cavities.items())
    face, pressure = max(cavities.items(), key=lambda each: each[1])
    # in a thick wall the pressure alone counts, however small the cavity
    yield Magnitude(
        f"Pressure in '{face}', {shown(pressure, 'Pa')}",
        max(work, pressure * region_volume(model.mesh) / 10) / stiffness,
    )


def acceleration(question: Question) -> Iterator[Magnitude]:
    """Acceleration of gravity [m/s²]."""
    for load in question.model.loads:
        if isinstance(load, Gravity):
            yield Magnitude("Gravity", abs(load.acceleration))


def injected_share(question: Question) -> Iterator[Magnitude]:
    """Volume to be injected over that of the cavity at rest, where one is stated for each cavity [-]."""
    requested, mesh = question.procedure.requested, question.model.mesh
    if requested is None or question.procedure.drive_unit != "mL":
        return
    volumes = requested if isinstance(requested, Mapping) else {"cavity": requested}
    for face, volume in volumes.items():
        rest = abs(cavity_volume(mesh, face)) if face in mesh.cavities else 0.0
        if rest > 0 and volume:  # a cavity that is sealed keeps its volume
            yield Magnitude(f"Volume of {volume / mL:.4g} mL for '{face}'", volume / rest)


def injected_size(question: Question) -> Iterator[Magnitude]:
    """Size of the injected volume, over that of the cavity at rest [-]."""
    return (Magnitude(each.where, abs(each.value)) for each in injected_share(question))


def _pressures(question: Question) -> dict[str, list[float]]:
    """The pressures on every pressed face at all load factors that matter."""
    model = question.model
    faces = {load.face for load in model.pressures}
    acting = [pressures_at(model, factor) for factor in extremes(model)]
    return {face: [0.0, *(each[face] for each in acting)] for face in sorted(faces)}


def _stiffness(question: Question) -> float:
    """Young's modulus times volume of the rubber that gives way, or of films alone, of the whole actuator [J]."""
    mesh, materials = question.model.mesh, question.model.region_materials
    if not materials:
        total = 0.0
        for name, sheet in question.model.membranes.items():
            assert isinstance(sheet.material.law, Hooke)
            total += sheet.material.law.E * sheet.thickness * float(area(mesh.points, mesh.face(name)))
        return total * mesh.symmetry_factor
    softest = min(material.law.shear_modulus for material in materials.values())
    return sum(
        3 * material.law.shear_modulus * region_volume(mesh, name)
        for name, material in materials.items()
        if material.law.shear_modulus < RIGID * softest
    )
