"""Decks of others as jobs: the answer is that of the model they state.

Problems: a block of compressible rubber on rollers, pulled at its lid by a pressure below zero, as a deck; a model that
turgor writes as a deck and reads again, whole and as a half.
Exact: homogeneous uniaxial tension of W = C10 (Ī₁ − 3) + κ/2 (J − 1)² by solving for the stretch across; the model that
was written.
Tolerances: Newton's method for the homogeneous state; digits of the deck for the model.
"""

import numpy as np
import pytest
from scipy.optimize import fsolve
from scipy.spatial import cKDTree

import problems
import turgor as tg
from deck_cases import deck, step
from turgor.core.meshing.exchange.mesh_file import MeshFile
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of
from turgor.units import kPa, mm


def model_and_job(file, folder):
    job = tg.jobs.read_job(tg.files.import_deck(file).write(folder, force=True))
    assert isinstance(job.actuator, MeshFile)
    return model_of(job, mesh_of(job, job.geometry())), job


def test_pulled_block(tmp_path, record_verification):
    planes = "*BOUNDARY\nBOTTOM, 3\nX0, 1\nY0, 2\n"
    pull = step("*DSLOAD\nLID, P, -0.03\n", period=0.5) + step("*DSLOAD\nLID, P, -0.06\n", period=0.5)
    model, job = model_and_job(deck(tmp_path, model=planes, steps=pull), tmp_path)
    solution = problems.solve(model, job.procedure)
    C10, kappa = 0.1e6, 5e6

    def residual(stretches, tension):
        along, across = stretches
        J, I1 = along * across**2, along**2 + 2 * across**2
        deviator = 2 * C10 * J ** (-5 / 3) * (np.array([along, across]) ** 2 - I1 / 3)
        return (deviator + kappa * (J - 1) - np.array([tension, 0.0])) / C10

    for factor in (0.5, 1.0):
        (state,) = [each for each in solution.states if abs(each.load_factor - factor) < 1e-9]
        expected = fsolve(residual, (1.1, 0.95), args=(factor * 60e3,), xtol=1e-13)
        got = 1 + state.displacement[model.mesh.face_nodes("LID"), 2].mean() / 20e-3
        assert got == pytest.approx(expected[0], rel=1e-6)
    record_verification(
        claim="stretch of a block that a deck pulls in two steps", source="uniaxial neo-Hooke", expected=expected[0],
        got=float(got), tolerance="1e-6",
    )  # fmt: skip


@pytest.mark.parametrize("symmetric", [False, True])
def test_a_written_model_comes_back(tmp_path, symmetric, record_verification):
    part = tg.mesh(tg.actuators.FastPneuNet(chambers=1, length=10 * mm, symmetric=symmetric).build(), size=5 * mm)
    rubber = tg.Material(name="rubber", law=problems.YEOH, bulk_modulus=2e6, density=1100.0)
    loads = [tg.Pressure("cavity", 3 * kPa), tg.Gravity(history=[(0, 0), (0.5, 1), (1, 1)])]
    model = tg.Model(part, {"body": rubber, "base": rubber}, "fixed", loads, contact=tg.Contact(self_contact=False))
    tg.files.write_inp(model, tmp_path / "finger.inp", at=(0.5, 1.0))
    again, job = model_and_job(tmp_path / "finger.inp", tmp_path)
    assert job.geometry().cavities == ("cavity",)
    assert again.mesh.symmetry_factor == part.symmetry_factor
    ours, theirs = problems.solve(model, tg.Static(at=(0.5,))), problems.solve(again, job.procedure)
    _, rows = cKDTree(again.mesh.points).query(part.points)
    for one, other in zip(ours.states[-1:], theirs.states[-1:], strict=True):
        away = np.abs(other.displacement[rows] - one.displacement).max()
        assert away < 1e-8 * np.abs(one.displacement).max()
    tip, back = (np.abs(each.states[-1].displacement).max() / mm for each in (ours, theirs))
    record_verification(
        claim=f"largest displacement [mm] of {'half of ' * symmetric}a model that was written and read again",
        source="the model that was written", expected=float(tip), got=float(back), tolerance="1e-8",
    )  # fmt: skip
