"""Draw docs/images/blocked-force.svg: force of the tip against pressure, the plate at three distances.

Run it after a change of the contact: ``python docs/blocked_force_picture.py``, about a minute.
"""

from pathlib import Path

import matplotlib
from matplotlib.figure import Figure

import turgor as tg
from turgor.units import kPa, mm

FIGURE = Path(__file__).parent / "images" / "blocked-force.svg"
DISTANCES = (0 * mm, 2 * mm, 4 * mm)
PRESSURE = 20 * kPa


def question():
    """The finger of ``examples/blocked_force.py``."""
    finger = tg.FastPneuNet(chambers=3, length=36 * mm, wall=1.5 * mm, channel_wall=1.5 * mm)
    rubber = tg.from_library("elastosil-m4601", record="yeoh-mosadegh-2014")
    stiff = tg.from_library("smooth-sil-950", record="neo-hooke-polygerinos-2020")
    return tg.Model(
        tg.mesh(finger.build(), size=5 * mm),
        materials={"body": rubber, "base": stiff},
        supports=[tg.Fixed("fixed")],
        loads=[tg.Pressure("cavity", PRESSURE)],
    )


def main():
    model = question()
    figure = Figure(figsize=(6.4, 3.8), layout="constrained", facecolor="white")
    axes = figure.add_subplot()
    for distance, color in zip(DISTANCES, tg.pictures.COLORS, strict=False):
        solution = tg.solve(tg.setups.blocked_force(model, distance=distance, direction="-z"))
        response = tg.measure(solution, tg.measures.blocked_force)
        label = f"plate {distance / mm:g} mm below the tip"
        tg.pictures.plot_response(axes, response, "pressure", "blocked_force", color=color, label=label)
        print(label, response.find("blocked_force").in_unit[-1])
    axes.legend(frameon=False)
    with matplotlib.rc_context({"svg.hashsalt": "turgor"}):
        figure.savefig(FIGURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
