"""How far cells with displacements only fall behind where rubber is nearly incompressible: a figure for the docs.

Bending angle of a short fast PneuNet, its base 20 times stiffer than its body, against pressure at a Poisson's ratio of
0.499: CalculiX with ten-node tetrahedra and with 20-node reduced hexahedra, our pure-displacement tetrahedra, our mixed
tetrahedra and hexahedra. Where CalculiX gives up, its curve ends.
Needs ccx (Debian: calculix-ccx). Writes docs/images/locking.svg and prints the table of docs/calculix.md.
"""

import os
import shutil
import subprocess
import sys
from dataclasses import replace
from pathlib import Path
from tempfile import TemporaryDirectory

import matplotlib.pyplot as plt
import numpy as np

import turgor as tg
from turgor.core.engine.faces.surfaces import vector_area
from turgor.core.inp.write_inp import write_inp
from turgor.units import MPa, deg, kPa, mm

FIGURE = Path(__file__).parents[2] / "docs" / "images" / "locking.svg"
FINGER = tg.FastPneuNet(chambers=3, length=30 * mm)
POISSON = 0.499
PRESSURE = 12 * kPa
FACTORS = (0.05, 0.25, 0.5, 1.0)

#: Mixed cells on the same mesh, for the right half of the figure.
MIXED_HEXAHEDRA, MIXED_TETRAHEDRA = "mixed hexahedra, 27 nodes", "mixed tetrahedra"
PARTNER = {
    "CalculiX C3D20R": MIXED_HEXAHEDRA,
    "displacement tetrahedra": MIXED_TETRAHEDRA,
    "CalculiX C3D10": MIXED_TETRAHEDRA,
}


def rubber(name, law):
    bulk = law.shear_modulus * 2 * (1 + POISSON) / (3 * (1 - 2 * POISSON))
    return tg.Material(name=name, law=law, bulk_modulus=bulk)


def question(mesh, formulation):
    body = rubber("body", tg.Yeoh(C10=0.05 * MPa, C20=0.001 * MPa))
    base = rubber("base", tg.laws.NeoHooke(C10=1 * MPa))
    loads = [tg.Pressure("cavity", PRESSURE)]
    return tg.Model(mesh, {"body": body, "base": base}, [tg.Fixed("fixed")], loads, formulation)


def angle(mesh, displacement):
    """Rotation of the tip in the x-z plane [rad], positive towards the base."""
    x, _, z = vector_area(mesh.points + displacement, mesh.face("tip"))
    return float(np.arctan2(-z, x))


def ours(model):
    solution = tg.solve(model, tg.Static(at=FACTORS), throw=False)
    states = [state for state in solution.states if any(abs(state.load_factor - f) < 1e-9 for f in (0.0, *FACTORS))]
    return [(state.load_factor, angle(model.mesh, state.displacement)) for state in states]


def calculix(model):
    """The path so far where ccx gives up."""
    with TemporaryDirectory() as folder:
        file = Path(folder) / "model.inp"
        write_inp(model, file, at=FACTORS)
        environment = {**os.environ, "OMP_NUM_THREADS": "1"}
        subprocess.run(["ccx", "-i", "model"], cwd=folder, env=environment, capture_output=True, check=False)
        points = [(0.0, 0.0)]
        for block in file.with_suffix(".dat").read_text().split("displacements")[1:]:
            head, *lines = block.splitlines()
            rows = np.array([line.split() for line in lines if len(line.split()) == 4], dtype=float)
            u = np.zeros_like(model.mesh.points)
            u[rows[:, 0].astype(int) - 1] = rows[:, 1:] * mm
            points.append((float(head.split()[-1]), angle(model.mesh, u)))
    return points


def with_twenty_nodes(mesh):
    """The 20-node hexahedra inside 27-node ones."""
    used = np.unique(mesh.cells[:, :20])
    number = np.full(len(mesh.points), -1)
    number[used] = np.arange(len(used))
    faces = {name: number[sides[:, :8]] for name, sides in mesh.faces.items()}
    return replace(mesh, points=mesh.points[used], cells=number[mesh.cells[:, :20]], faces=faces)


def curves():
    geometry = FINGER.build()
    tetrahedra = tg.mesh(geometry, size=4 * mm)
    hexahedra = tg.mesh(geometry, size=4 * mm, cells="hexahedra")
    twenty = with_twenty_nodes(hexahedra)
    return {
        MIXED_HEXAHEDRA: ours(question(hexahedra, "mixed")),
        MIXED_TETRAHEDRA: ours(question(tetrahedra, "mixed")),
        "CalculiX C3D20R": calculix(question(twenty, "displacement")),
        "displacement tetrahedra": ours(question(tetrahedra, "displacement")),
        "CalculiX C3D10": calculix(question(tetrahedra, "displacement")),
    }


def draw(found):
    styles = {
        MIXED_HEXAHEDRA: ("C0", "-", "o"),
        MIXED_TETRAHEDRA: ("C2", "-", "s"),
        "CalculiX C3D20R": ("C1", "--", "D"),
        "displacement tetrahedra": ("C3", "-", "^"),
        "CalculiX C3D10": ("k", ":", "x"),
    }
    figure, (left, right) = plt.subplots(1, 2, figsize=(9, 3.8), constrained_layout=True)
    for name, points in found.items():
        color, line, marker = styles[name]
        factor, bent = np.array(points).T
        left.plot(factor * PRESSURE / kPa, bent / deg, line, color=color, marker=marker, markersize=4, label=name)
        if name in PARTNER:
            share = 100 * bent[1:] / np.array(found[PARTNER[name]])[1 : len(bent), 1]
            right.plot(factor[1:] * PRESSURE / kPa, share, line, color=color, marker=marker, markersize=4)
    left.set_ylabel("bending angle [°]")
    right.set_ylabel("share of the mixed cells' on that mesh [%]")
    left.legend(fontsize=8, frameon=False)
    for ax in (left, right):
        ax.set_xlabel("pressure [kPa]")
        ax.grid(alpha=0.3)
    FIGURE.parent.mkdir(exist_ok=True)
    figure.savefig(FIGURE, metadata={"Date": None})


def main():
    if shutil.which("ccx") is None:
        sys.exit("CalculiX (ccx) is not installed; on Debian: apt install calculix-ccx")
    plt.rcParams["svg.hashsalt"] = "turgor"
    result = curves()
    for name, points in result.items():
        cells = " | ".join(f"{bent / deg:.2f}°" for _, bent in points[1:])
        print(f"| {name} | {cells} |{'' if len(points) > len(FACTORS) else ' stops'}")
    draw(result)


if __name__ == "__main__":
    main()
