"""Shells of a .feb file without solids: they bend as plates and are clamped, or on a hinge, as FEBio's are.

Problems: a strip of shells of second order, 40 mm long, 4 mm wide and 1 mm thick, clamped at one end (the front and the
back of its shells are fixed) and loaded by a small force at its tip; the same strip on hinges at both ends (the front
alone is fixed), with a small load of its mass.
Exact: F L³ / (3 E I) + 6 F L / (5 G A) for a beam with Poisson's ratio 0; 5 q L⁴ / (384 E I) + 6 q L² / (40 G A) for
the middle of one on hinges, of which one slides.
Tolerance: 0.5 %, cells of second order that bend and shear, ten along the strip.
"""

import numpy as np
import pytest

import problems
import turgor as tg
from febio_cases import feb
from turgor.job.meshes import mesh_of
from turgor.job.prepare import model_of

L, B, H, E = 40.0, 4.0, 1.0, 1.0
I, A, G = B * H**3 / 12, B * H, E / 2
COUNT = 10
PAPER = f'<material id="1" name="PAPER" type="neo-Hookean"><density>1</density><E>{E}</E><v>0</v></material>'
DOMAIN = f'<ShellDomain name="STRIP" mat="PAPER"><shell_thickness>{H}</shell_thickness></ShellDomain>'


def strip(folder, boundary, loads):
    """A strip along x of eight-node shells, whose front is at z = 0."""
    number = {}
    for i in range(2 * COUNT + 1):
        for j in range(3):
            if i % 2 == 0 or j != 1:
                number[i, j] = len(number) + 1
    points = "".join(
        f'<node id="{n}">{i * L / 2 / COUNT},{j * B / 2},0</node>' for (i, j), n in number.items()
    )  # fmt: skip
    around = ((0, 0), (2, 0), (2, 2), (0, 2), (1, 0), (2, 1), (1, 2), (0, 1))
    cells = "".join(
        f'<elem id="{k + 1}">{",".join(str(number[2 * k + i, j]) for i, j in around)}</elem>' for k in range(COUNT)
    )
    ends = {"LEFT": 0, "RIGHT": 2 * COUNT}
    sets = "".join(
        f'<NodeSet name="{name}">{number[i, 0]},{number[i, 1]},{number[i, 2]}</NodeSet>' for name, i in ends.items()
    )
    sets += f'<NodeSet name="CORNER">{number[2 * COUNT, 0]},{number[2 * COUNT, 2]}</NodeSet>'
    sets += f'<NodeSet name="MIDDLE">{number[2 * COUNT, 1]}</NodeSet>'
    mesh = f'<Elements type="quad8" name="STRIP">{cells}</Elements>{sets}'
    file = feb(folder, material=PAPER, mesh=mesh, points=points, domains=DOMAIN, boundary=boundary, loads=loads)
    job = tg.jobs.read_job(tg.files.import_deck(file, units="mm, N, MPa").write(folder))
    model = model_of(job, mesh_of(job, job.geometry()))
    state = problems.solve(model, job.procedure).states[-1]
    return model.mesh.points * 1e3, state.displacement[:, 2] * 1e3


def fixed(nodes, front="", back=""):
    rows = [("zero displacement", front, ""), ("zero shell displacement", back, "s")]
    return "".join(
        f'<bc node_set="{nodes}" type="{kind}">{"".join(f"<{s}{x}_dof>1</{s}{x}_dof>" for x in axes)}</bc>'
        for kind, axes, s in rows
        if axes
    )


def test_clamped_strip(tmp_path, record_verification):
    force = 1e-6
    loads = "".join(
        f'<nodal_load node_set="{nodes}" type="nodal_force"><value lc="1">0,0,{share * force}</value></nodal_load>'
        for nodes, share in (("CORNER", 1 / 6), ("MIDDLE", 4 / 6))
    )
    points, lift = strip(tmp_path, fixed("LEFT", "xyz", "xyz"), loads)
    expected = force * L**3 / (3 * E * I) + 6 * force * L / (5 * G * A)
    got = float(lift[points[:, 0] > L - 1e-6].mean())
    assert got == pytest.approx(expected, rel=5e-3)
    assert points[:, 2].min() == pytest.approx(-H)  # its nodes are the front, the back lies against the normal
    record_verification(
        claim="deflection of a clamped strip of shells of a .feb file", source="Timoshenko's beam", expected=expected,
        got=got, tolerance="0.5 %",
    )  # fmt: skip


def test_strip_on_hinges(tmp_path, record_verification):
    g = 1e-7
    loads = f'<body_load type="const"><z lc="1">{-g}</z></body_load>'
    points, lift = strip(tmp_path, fixed("LEFT", "xyz") + fixed("RIGHT", "yz"), loads)
    q = g * A
    expected = 5 * q * L**4 / (384 * E * I) + 6 * q * L**2 / (40 * G * A)
    got = float(lift[np.abs(points[:, 0] - L / 2) < 1e-6].mean())
    assert got == pytest.approx(expected, rel=5e-3)
    record_verification(
        claim="deflection of a strip of shells of a .feb file on hinges", source="Timoshenko's beam",
        expected=expected, got=got, tolerance="0.5 %",
    )  # fmt: skip
