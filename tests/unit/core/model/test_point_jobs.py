"""Reference points in a job file: read, refused with a sentence, written into the lock file, and solved."""

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.job.output.lock import lock_text
from turgor.job.prepare import prepare
from turgor.job.read import read_job

TEXT = """\
[actuator]
type = "fast_pneunet"
chambers = 1
length = "10 mm"

[mesh]
size = "5 mm"
cells = "hexahedra"

[materials]
body = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }
base = { law = "neo_hooke", C10 = "0.1 MPa", density = "1070 kg/m³" }
"""

FULL = """\
[points.plate]
face = "tip"
at = ["12 mm", 0, "5 mm"]
coupling = "averaging"
mass = "5 g"
center = ["13 mm", 0, "5 mm"]
inertia = ["2 kg mm²", "1 kg mm²", "1 kg mm²"]
spring = "2 N/m"
rotational_spring = "3 N mm/rad"
force = [0, 0, "-20 mN"]
moment = [0, "0.2 N mm", 0]
hangs = "1 g"
follower = true
history = [[0, 0], [0.5, 1], [1, 1]]
"""


def read(tmp_path, more):
    file = tmp_path / "finger.toml"
    file.write_text(TEXT + more, encoding="utf-8")
    return read_job(file)


@pytest.mark.parametrize(
    "more",
    [
        FULL,
        '[points.plate]\nface = "tip"\nprescribed = "xz"\ndisplacement = [0, 0, "1 mm"]\n'
        'rotation = "20 deg"\naxis = "+y"\n',
        '[points.plate]\nface = "tip"\nprescribed = "x"\nhinge = "y"\nforce = [0, 0, "1 mN"]\n',
        '[points.plate]\nface = "tip"\nhinge = [1, 1, 0]\nspring = ["2 N/m", 0, "1 N/m"]\nforce = [0, 0, "1 mN"]\n',
        '[points.plate]\nface = "tip"\nrotation = "20 deg"\ntilts = true\n',
        '[points.plate]\nface = "tip"\nprescribed = "z"\ndisplacement = [0, 0, "1 mm"]\n'
        "history = [[0, 0], [0.5, 1], [1, 0]]\n",
    ],
)
def test_points_are_read_and_come_back(tmp_path, more):
    job = read(tmp_path, more)
    assert list(job.points) == ["plate"]
    assert len(job.all_supports) == 2 + len(job.points["plate"].holds)
    lock = tmp_path / "job.lock.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(lock) == job


def test_the_keys_are_those_of_the_model(tmp_path):
    rig = read(tmp_path, FULL).points["plate"]
    assert rig.point.at == pytest.approx((12e-3, 0, 5e-3))
    assert rig.point.inertia == pytest.approx((2e-6, 1e-6, 1e-6))
    assert rig.point.rotational_spring == pytest.approx(3e-3)
    force, moment, hanging = rig.loads
    assert (force.vector, force.follower) == (pytest.approx((0, 0, -0.02)), True)
    assert moment.vector == pytest.approx((0, 2e-4, 0))
    assert hanging.force == pytest.approx((0, 0, -1e-3 * 9.80665))
    turned = read(tmp_path, '[points.plate]\nface = "tip"\nrotation = "20 deg"\naxis = "+y"\n').points["plate"]
    assert turned.holds[0].angle == pytest.approx(np.deg2rad(20))
    assert turned.holds[0].axis == (0, 1, 0)
    fallen = read(tmp_path, '[loads]\ngravity = "+x"\n[points.plate]\nface = "tip"\nhangs = "1 g"\n').points["plate"]
    assert fallen.loads[0].force == pytest.approx((1e-3 * 9.80665, 0, 0))


@pytest.mark.parametrize(
    ("more", "facts"),
    [
        ('face = "tpi"\nmass = "1 g"', ("finger.toml:16: points.plate.face:", "'tpi'", "'tip'")),
        ('face = "tip"\ncuopling = "rigid"', ("finger.toml:17: points.plate.cuopling:", "'cuopling'", "'coupling'")),
        ('face = "tip"\ncoupling = "rigd"', ("finger.toml:15: points.plate:", "'plate'", "'rigd'", "'rigid'")),
        ('face = "tip"\nmoment = [0, "2 N", 0]', ("finger.toml:17: points.plate.moment:", "'2 N'", "force", "moment")),
        (
            'face = "tip"\nmoment = ["2 N mm", 0, 0]',
            ("finger.toml:15: points.plate:", "moment", "actuator.symmetric = false"),
        ),
        (
            'face = "tip"\ndisplacement = [0, 0, "1 mm"]',
            ("finger.toml:15: points.plate:", "displacement", "prescribed = 'z'"),
        ),
        ('face = "tip"\nprescribed = "xw"', ("finger.toml:17: points.plate.prescribed:", "'xw'", "x, y and z")),
        ('face = "tip"\nrotation = "1 deg"\nhinge = "y"', ("finger.toml:15: points.plate:", "rotation", "hinge")),
        ('face = "tip"\nhinge = "w"', ("finger.toml:17: points.plate.hinge:", "'w'", "+x, +y, +z, -x, -y, -z")),
        (
            'face = "tip"\nforce = [0, 0, "1 mN"]\ntilts = true',
            ("finger.toml:15: points.plate:", "tilts", "no rotation"),
        ),
        (
            'face = "tip"\nmass = "1 g"\nspring = ["1 N", 0, 0]',
            ("finger.toml:18: points.plate.spring:", "'1 N'", "spring stiffness"),
        ),
    ],
)
def test_what_cannot_be_is_refused(tmp_path, more, facts):
    with refused(*facts):
        read(tmp_path, f'[loads]\npressure = "1 kPa"\n[points.plate]\n{more}\n')


def test_a_point_needs_a_name_of_its_own(tmp_path):
    with refused("finger.toml:13: points.outside:", "'outside'"):
        read(tmp_path, '[points.outside]\nface = "tip"\nhangs = "1 g"\n')


def test_a_weight_is_what_the_support_carries(tmp_path):
    model, _ = prepare(read(tmp_path, '[points.plate]\nface = "tip"\nhangs = "1 g"\n'))
    solution = tg.solve(model)
    response = tg.measure(solution)
    assert response.column("reaction")[-1] == pytest.approx(1e-3 * 9.80665, rel=1e-5)
    assert response.column("plate_displacement_z")[-1] < -5e-6
    assert response.column("plate_rotation_x")[-1] == pytest.approx(0.0, abs=1e-12)


def test_a_history_moves_the_point_there_and_back(tmp_path):
    model, _ = prepare(
        read(
            tmp_path,
            '[points.plate]\nface = "tip"\nprescribed = "z"\ndisplacement = [0, 0, "-1 mm"]\n'
            "history = [[0, 0], [0.5, 1], [1, 0]]\n",
        )
    )
    response = tg.measure(tg.solve(model))
    moved = response.column("plate_displacement_z")
    assert moved.min() == pytest.approx(-1e-3)
    assert moved[-1] == pytest.approx(0.0, abs=1e-12)


def test_concentrated_forces_are_read_and_come_back(tmp_path):
    job = read(
        tmp_path,
        '[[loads.point_forces]]\nat = ["5 mm", 0, "15 mm"]\nforce = [0, 0, "-20 mN"]\n'
        "history = [[0, 0], [0.5, 1], [1, 1]]\n"
        '[[loads.line_forces]]\nfaces = ["tip", "outside"]\nforce_per_length = [0, 0, "-2 N/m"]\n',
    )
    line, point = job.loads
    assert (point.at, point.vector) == (pytest.approx((5e-3, 0, 15e-3)), pytest.approx((0, 0, -0.02)))
    assert (line.faces, line.vector) == (("tip", "outside"), (0, 0, -2.0))
    lock = tmp_path / "job.lock.toml"
    lock.write_text(lock_text(job, {}), encoding="utf-8")
    assert read_job(lock) == job


@pytest.mark.parametrize(
    ("more", "facts"),
    [
        (
            '[[loads.line_forces]]\nfaces = ["tpi", "outside"]\nforce_per_length = [0, 0, "-2 N/m"]',
            ("loads.line_forces", "'tpi'", "'tip'"),
        ),
        (
            '[[loads.line_forces]]\nfaces = ["tip", "outside"]\nforce_per_length = [0, 0, "-2 N"]',
            ("loads.line_forces.force_per_length", "'-2 N'"),
        ),
        (
            '[[loads.point_forces]]\nat = ["5 mm", 0, 0]\nfroce = [0, 0, "-2 N"]',
            ("loads.point_forces.froce", "'froce'", "'force'"),
        ),
    ],
)
def test_concentrated_forces_that_cannot_be_are_refused(tmp_path, more, facts):
    with refused("finger.toml:13", *facts):
        read(tmp_path, f"{more}\n")
