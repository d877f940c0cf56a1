"""Pictures of docs/howto/optimize.md: `python docs/optimization_pictures.py` writes docs/images/optimization.

That of the finger is ``before-and-after.png`` of ``turgor optimize examples/gripper_finger_study.toml``: its folder is
the argument; without it, the picture is left as it is.
"""

import runpy
import sys
from pathlib import Path
from shutil import copyfile

import numpy as np
from matplotlib.figure import Figure

import turgor as tg
from turgor.units import kPa, mm

ROOT = Path(__file__).parents[1]
FOLDER = ROOT / "docs" / "images" / "optimization"


def bellows() -> None:
    """Draw the front, and the start and the bellows between the ends under 1 kPa."""
    names = runpy.run_path(str(ROOT / "examples" / "optimized_bellows.py"))
    found = names["found"]
    tg.studies.optimization_figure(found).savefig(FOLDER / "bellows.png", dpi=110)
    ends = {"before": found.start, "after": found.best}
    shown = {}
    for name, row in ends.items():
        values = found.study.rows[row].values
        shape = tg.actuators.BellowsOfRevolution(outer_radius=16 * mm, pitch=8 * mm, **values)
        mesh = tg.mesh(shape.build(), size=1 * mm, cells="axisymmetric")
        model = tg.Model(
            mesh,
            materials={"body": names["RUBBER"]},
            supports=[tg.Fixed("fixed")],
            loads=[tg.Pressure("cavity", 1 * kPa)],
        )
        shown[f"{name}: {found.study.values_text(values)}"] = tg.solve(model)
    tg.pictures.side_by_side(shown, FOLDER / "bellows-shapes.png", width=1300)


def path() -> None:
    """Draw the center line of the bender at each pressure, before and after."""
    names = runpy.run_path(str(ROOT / "examples" / "tip_path.py"))
    found = names["found"]
    figure = Figure(figsize=(9, 2.2), layout="constrained")
    rows = {"before": found.start, "after": found.best}
    for axes, (name, number) in zip(figure.subplots(1, 2, sharey=True), rows.items(), strict=True):
        row = found.study.rows[number]
        length = row.values["length"]
        for x, z in zip(*(row.response[f"tip_displacement_{each}"] for each in "xz"), strict=True):
            curvature = 2 * z / ((length + x) ** 2 + z**2)
            along = np.linspace(0, length, 60)
            line = np.sin(curvature * along) / curvature, (1 - np.cos(curvature * along)) / curvature
            axes.plot(line[0] / mm, line[1] / mm, color="#1f5fa8", lw=1.5)
            axes.plot((length + x) / mm, z / mm, "o", color="#1f5fa8", ms=4)
        # places are displacements from the tip at rest, so that they move with the length
        places = np.array(names["PLACES"]) / mm
        axes.plot(places[:, 0] + length / mm, places[:, 1], "x", color="#d55e00", ms=9, mew=2, label="wanted")
        axes.set_title(
            f"{name}: {found.study.values_text(row.values)}; {found.reads(number)[0].short} from the path", fontsize=9
        )
        axes.set_xlabel("x [mm]")
        axes.set_aspect("equal")
        axes.set_ylim(-4, 40)
    axes.legend(frameon=False)
    figure.savefig(FOLDER / "path.png", dpi=110)


def main() -> None:
    """Write all pictures."""
    FOLDER.mkdir(exist_ok=True)
    bellows()
    path()
    if len(sys.argv) > 1:
        copyfile(Path(sys.argv[1]) / "before-and-after.png", FOLDER / "finger.png")


if __name__ == "__main__":
    main()
