"""Draw docs/images/formulas.svg: a bare tube and a braided muscle by formula and by finite elements.

Run it after a change of these: ``python docs/formulas_picture.py``, about a minute.
"""

from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

import turgor as tg
from turgor.units import deg, kPa, mm

FIGURE = Path(__file__).parent / "images" / "formulas.svg"
RUBBER = "neo-hooke-polygerinos-2020"


def solved(part, pressure, mesh, materials, fibers=()):
    """Finite elements: pressure [kPa] and extension [mm]."""
    model = tg.Model(mesh, materials, [tg.Fixed("fixed")], [tg.Pressure("cavity", pressure)], reinforcements=fibers)
    response = tg.measure(tg.solve(model), tg.measures.tip_displacement_x)
    return response["pressure_kPa"], response["tip_displacement_x_mm"]


def tube(rubber):
    part = tg.actuators.ExtendingCylinder()
    mesh = tg.mesh(part.build(), size=2 * mm, cells="axisymmetric")
    formula = tg.formulas.thick_tube(part, rubber, 40 * kPa)
    return solved(part, 40 * kPa, mesh, {"body": rubber}), formula


def muscle(rubber):
    part = tg.actuators.ContractingTube()
    winding = tg.Winding(angle_from_axis=30 * deg, spacing=2 * mm, hand="both")
    kevlar = tg.from_library("kevlar-fiber")
    braid = tg.Fibers(face="outside", material=kevlar, diameter=0.1778 * mm, winding=winding)
    ends = tg.from_library("smooth-sil-950", record=RUBBER)
    mesh = tg.mesh(part.build(), size=3 * mm, cells="hexahedra")
    formula = tg.formulas.wound_tube(part, rubber, braid, 40 * kPa)
    return solved(part, 40 * kPa, mesh, {"body": rubber, "cap": ends}, [braid]), formula


def main():
    rubber = tg.from_library("elastosil-m4601", record=RUBBER)
    figure = Figure(figsize=(7.6, 3.4), layout="constrained", facecolor="white")
    for axes, (title, case) in zip(
        figure.subplots(1, 2), (("bare tube", tube), ("braided muscle", muscle)), strict=True
    ):
        (pressure, moved), formula = case(rubber)
        axes.plot(
            formula["pressure_kPa"],
            formula["tip_displacement_x_mm"],
            color=tg.pictures.COLORS[0],
            label="formula, no ends",
        )
        axes.plot(pressure, moved, "o", color=tg.pictures.COLORS[1], label="finite elements")
        axes.set(title=title, xlabel="pressure [kPa]", ylabel="extension [mm]")
        axes.legend(frameon=False)
        there = np.interp(pressure[-1], formula["pressure_kPa"], formula["tip_displacement_x_mm"])
        print(f"{title}, {pressure[-1]:g} kPa: finite elements {moved[-1]:.3f} mm, formula {there:.3f} mm", flush=True)
    with matplotlib.rc_context({"svg.hashsalt": "turgor"}):
        figure.savefig(FIGURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
