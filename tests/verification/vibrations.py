"""The strip of V15 that vibrates: 100 mm long, 10 mm thick, plane strain, clamped at one end."""

import numpy as np

import meshes
import problems
import turgor as tg
from turgor.core.meshing.cells import HEXAHEDRON
from turgor.core.solvers.dynamics.modes import natural_frequencies
from turgor.core.solvers.procedures.dynamic import Dynamic

LENGTH, THICKNESS = 100 * problems.MM, 10 * problems.MM
DENSITY = 1070.0


def strip(counts=(6, 1, 1), loads=()):
    """The strip as a model; its neo-Hookean rubber is incompressible."""
    mesh = meshes.box((LENGTH, THICKNESS, LENGTH / counts[0]), counts, kind=HEXAHEDRON)
    materials = {"body": problems.rubber(problems.NEO_HOOKE, density=DENSITY)}
    return tg.Model(mesh, materials, [tg.Fixed("x0"), *problems.PLANE_STRAIN], loads)


def tip(model):
    """The node at the end of the middle line."""
    return meshes.node_at(model.mesh, (LENGTH, THICKNESS / 2, 0))


def plucked(model, amplitude, cycles, steps, **more):
    """First mode, frequency, and a procedure that starts it with the velocity of an amplitude [m], at even steps."""
    modes = natural_frequencies(model, count=1, options=problems.OPTIONS)
    frequency, shape = float(modes.frequencies[0]), modes.shapes[0]
    period = 1 / frequency
    procedure = Dynamic(
        duration=cycles * period,
        first_step=period / steps,
        max_step=period / steps,
        adaptive=False,
        velocity=lambda points: amplitude * 2 * np.pi * frequency * shape,
        **more,
    )
    return frequency, procedure
