"""Materials with directions: orientations, what needs one, what mirror planes allow, jobs, and who refuses them."""

from math import pi

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.core.inp.materials import material_lines
from turgor.core.inp.write_inp import write_inp
from turgor.core.materials.laws.fiber_family import Family, elongation, family_response
from turgor.core.materials.laws.homogeneous import nominal_stress, uniaxial
from turgor.core.materials.orientation import Orientation
from turgor.core.materials.oriented import oriented_stress
from turgor.fast_models.formulas.formula import law_of, young_modulus
from turgor.fast_models.rod.sections.section import initial_moduli
from turgor.job.output.lock import lock_text
from turgor.job.read import read_job
from turgor.systems.exports.sofa_law import sofa_law
from turgor.units import mm

HGO = tg.laws.HolzapfelGasserOgden(C10=5e3, k1=2e4, k2=0.8, kappa=0.1)
PRINT = tg.laws.Orthotropic(C10=1e6, a1=0.5e6)
STRAIGHT = Orientation(along=(1, 0, 0), across=(0, 1, 0))
JOB = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "4 mm"

[materials.body]
law = "orthotropic"
C10 = "1 MPa"
a1 = "400 kPa"
orientation = { along = [1, 0, 0], across = [0, 1, 0] }

[materials.base]
law = "holzapfel_gasser_ogden"
C10 = "50 kPa"
k1 = "20 kPa"
k2 = 1.0
orientation = { along = [1, 0, 0], across = [0, 1, 0], angle = "30 deg" }

[loads]
pressure = "2 kPa"
"""


def of(law, orientation=STRAIGHT, **more):
    return tg.Material(name="part", law=law, orientation=orientation, **more)


def test_frames_are_right_handed_units():
    points = np.random.default_rng(1).uniform(-1, 1, (20, 3))
    for each in (Orientation(along=(1, 2, 3), across=(0, 1, 0)), Orientation(along=(1, 2, 3), around=(5, 5, 5))):
        frames = each.frames(points)
        assert frames @ frames.swapaxes(-1, -2) == pytest.approx(np.broadcast_to(np.eye(3), (20, 3, 3)), abs=1e-12)
        assert np.linalg.det(frames) == pytest.approx(1.0)
    arms = points - [5, 5, 5]
    assert np.einsum("ij,ij->i", frames[:, 1], arms) == pytest.approx(0.0, abs=1e-12)


@pytest.mark.parametrize(
    ("given", "facts"),
    [
        ({"along": (1, 0, 0)}, ("across", "around")),
        ({"along": (1, 0, 0), "across": (2, 0, 0)}, ("across", "parallel")),
        ({"along": (0, 0, 0), "across": (2, 0, 0)}, ("along", "length")),
        ({"along": (1, 0), "across": (2, 0, 0)}, ("along", "three numbers")),
        ({"along": (1, 0, 0), "across": (0, 1, 0), "angle": "95 deg"}, ("angle is 95°", "90°")),
    ],
)
def test_wrong_orientations_are_refused(given, facts):
    with refused(*facts):
        Orientation(**given)


def test_laws_and_orientations_go_together():
    with refused("part", "Orthotropic", "along"):
        tg.Material(name="part", law=PRINT)
    with refused("part", "Yeoh", "no directions"):
        of(tg.Yeoh(C10=1e5, C20=1e3))
    with refused("Orthotropic", "angle"):
        of(PRINT, Orientation(along=(1, 0, 0), across=(0, 1, 0), angle=0.2))
    with refused("part", "HolzapfelGasserOgden", "isotropic"):
        of(HGO, stress_softening=tg.laws.Mullins(r=1.5, m=2e4))
    with refused("kappa is 0.5", "1/3"):
        tg.laws.HolzapfelGasserOgden(C10=1e3, k1=1.0, k2=1.0, kappa=0.5)
    with refused("a2 is -1 Pa"):
        tg.laws.Orthotropic(C10=1e3, a2=-1.0)


def test_stress_and_tangent_of_a_family_belong_to_its_energy():
    rng = np.random.default_rng(3)
    F = np.eye(3) + 0.3 * rng.uniform(-1, 1, (3, 3))
    order = ((0, 0), (1, 1), (2, 2), (0, 1), (1, 2), (0, 2))
    C = np.array([(F.T @ F)[i, j] for i, j in order])
    family = Family(direction=(0.8, 0.6, 0.0), k1=3.0, k2=0.9, kappa=0.05)
    H, step = family.tensor(np.eye(3)), 1e-6
    S, D = family_response(family, H, C)
    for v in range(6):
        ahead, behind = C.copy(), C.copy()
        ahead[v] += step
        behind[v] -= step
        twice = 1.0 if v < 3 else 0.5  # a shear component stands twice in C
        slope = (family.energy(elongation(H, ahead))[0] - family.energy(elongation(H, behind))[0]) / (2 * step)
        assert S[v] == pytest.approx(2 * twice * slope, rel=1e-6)
        change = (family_response(family, H, ahead)[0] - family_response(family, H, behind)[0]) / (2 * step)
        row = [D[max(v, w) * (max(v, w) + 1) // 2 + min(v, w)] for w in range(6)]
        assert row == pytest.approx(2 * twice * change, rel=1e-5, abs=1e-6)


def test_dispersion_of_a_third_is_isotropic():
    round_, flat = tg.laws.HolzapfelGasserOgden(C10=5e3, k1=2e4, k2=0.8, kappa=1 / 3), uniaxial(1.5)
    pull = [
        oriented_stress(of(round_, Orientation(along=a, across=(0, 0, 1))), flat)[0, 0] for a in ((1, 0, 0), (1, 2, 0))
    ]
    assert pull[0] == pytest.approx(pull[1], rel=1e-12)
    I1 = 1.5**2 + 2 / 1.5 - 3
    slope = 5e3 + 2e4 * I1 / 9 * np.exp(0.8 * I1**2 / 9) * 1.0
    assert pull[0] == pytest.approx(2 * slope * (1.5**2 - 1 / 1.5), rel=1e-12)


def test_directions_must_be_their_own_mirror_image():
    mesh = tg.mesh(tg.FastPneuNet(chambers=1, length=10 * mm).build(), size=4 * mm)  # mirrored across y
    assert mesh.symmetry_faces

    def model(orientation, law=HGO):
        return tg.Model(mesh, of(law, orientation), [tg.Fixed("fixed")], [tg.Pressure("cavity", 1e3)])

    model(STRAIGHT)
    model(Orientation(along=(1, 0, 0), across=(0, 1, 0), angle="30 deg"))
    model(Orientation(along=(1, 0, 0.5), across=(0, 1, 0)))
    with refused("materials.body", "normal to y", "whole body"):
        model(Orientation(along=(1, 0.5, 0), across=(0, 0, 1)))
    with refused("normal to y"):
        model(Orientation(along=(1, 0.5, 0), across=(0, 1, 0)), PRINT)


def test_who_has_no_directions_says_so():
    part = of(PRINT)
    for call in (
        lambda: law_of(part),
        lambda: young_modulus(part),
        lambda: sofa_law(part, 2.0, 0.49),
        lambda: initial_moduli(part),
        lambda: tg.laws.curve(PRINT, "uniaxial", [1.5]),
    ):
        with refused("directions"):
            call()
    with refused("materials.b", "Orthotropic"):
        material_lines("b", part, "abaqus")
    with refused("Orthotropic"):
        nominal_stress(PRINT, uniaxial(1.5))
    with refused("Orthotropic", "fit_directions", "--directions"):
        tg.fit("orthotropic", [])


def test_abaqus_has_fibers_in_bodies(tmp_path):
    mesh = tg.mesh(tg.FastPneuNet(chambers=1, length=10 * mm).build(), size=5 * mm)
    tube = Orientation(along=(0, 0, 1), around=(1 * mm, 0, 0), angle="30 deg")
    model = tg.Model(
        mesh,
        {"body": of(HGO, tube, bulk_modulus=4e6), "base": of(HGO)},
        [tg.Fixed("fixed")],
        [tg.Pressure("cavity", 1e3)],
    )
    write_inp(model, tmp_path / "part.inp", program="abaqus")
    lines = (tmp_path / "part.inp").read_text().splitlines()
    at = lines.index("*ORIENTATION, NAME=directions_body, SYSTEM=CYLINDRICAL, LOCAL DIRECTIONS=2")
    assert lines[at - 2 : at] == [
        "*ANISOTROPIC HYPERELASTIC, HOLZAPFEL, LOCAL DIRECTIONS=2",
        "0.005, 0.5, 0.02, 0.8, 0.1",
    ]
    numbers = [[float(value) for value in line.split(",")] for line in lines[at + 1 : at + 5]]
    assert numbers[:2] == [[1, 0, 0, 1, 0, 1], [3, 0]]
    assert numbers[2:] == [pytest.approx([0, 0.5 * side, 0.75**0.5]) for side in (1, -1)]
    assert lines[at + 5] == "*SOLID SECTION, ELSET=body, MATERIAL=body, ORIENTATION=directions_body"
    with refused("materials.body", "HolzapfelGasserOgden", "CalculiX"):
        write_inp(model, tmp_path / "part.inp", program="calculix")
    with refused("materials.b", "k2 is 0"):
        material_lines("b", of(tg.laws.HolzapfelGasserOgden(C10=1e3, k1=1.0, k2=0.0)), "abaqus")


def test_a_job_states_directions_and_its_lock_repeats_them(tmp_path):
    (tmp_path / "part.toml").write_text(JOB, encoding="utf-8")
    job = read_job(tmp_path / "part.toml")
    assert job.materials["body"].law == tg.laws.Orthotropic(C10=1e6, a1=4e5)
    assert job.materials["base"].orientation.angle == pytest.approx(pi / 6)
    (tmp_path / "lock.toml").write_text(lock_text(job, {}), encoding="utf-8")
    again = read_job(tmp_path / "lock.toml")
    for name, each in job.materials.items():
        assert (again.materials[name].law, again.materials[name].orientation) == (each.law, each.orientation)
    for change, facts in (
        ((", across = [0, 1, 0] }", " }"), ("orientation", "across", "around")),
        (("across = [0, 1, 0] }", "acros = [0, 1, 0] }"), ("acros", "across")),
        (("orientation = { along = [1, 0, 0], across = [0, 1, 0] }", ""), ("orientation",)),
    ):
        (tmp_path / "part.toml").write_text(JOB.replace(*change, 1), encoding="utf-8")
        with refused(*facts):
            read_job(tmp_path / "part.toml")
