"""Picture of docs/howto/dumbbell.md: `python docs/dumbbell_picture.py` writes docs/images/dumbbell.svg, in a second."""

from importlib.resources import files
from pathlib import Path

import matplotlib
import numpy as np
from matplotlib.figure import Figure

import turgor as tg

FIGURE = Path(__file__).parent / "images" / "dumbbell.svg"
CURVE = files("turgor.core.materials.library") / "curves" / "marechal-2020" / "ecoflex-00-30.csv"


def main() -> None:
    """Draw the curve up to stretch 2.5 with the fit to all of it, and with the fit for this range."""
    whole = tg.read_test(str(CURVE), mode="uniaxial", stress_measure="nominal")
    counted = tg.experiments.count_from_zero(whole)
    first = tg.fit("yeoh", tg.experiments.thin(whole))
    second = tg.fit("yeoh", counted, stretch=(1.0, 2.5), weights="even")
    x = np.linspace(1.0, 2.5, 120)
    blank = tg.experiments.MaterialTest(mode="uniaxial", stretch=x, nominal_stress=x, name="a law")
    figure = Figure(figsize=(7.0, 3.6), layout="constrained")
    axes = figure.subplots()
    axes.plot(whole.stretch, whole.nominal_stress / 1e3, ".", color="#c9c9c9", label="as the crosshead counts")
    axes.plot(counted.stretch, counted.nominal_stress / 1e3, ".", color="#d55e00", label="counted from zero stress")
    drawn = ((first, "--", "Yeoh, all stretches up to 17"), (second, "-", "Yeoh, for stretch 1 to 2.5"))
    for fit, style, label in drawn:
        stress = blank.predicted(fit.law) / 1e3
        axes.plot(x, stress, style, color="#0072b2", label=f"{label}: C10 = {fit.values['C10'] / 1e3:.2f} kPa")
    axes.set_xlim(1.0, 2.5)
    axes.set_ylim(0.0, 45.0)
    axes.set_xlabel("stretch")
    axes.set_ylabel("nominal stress [kPa]")
    axes.legend(frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    with matplotlib.rc_context({"svg.hashsalt": "dumbbell"}):
        figure.savefig(FIGURE, metadata={"Date": None})


if __name__ == "__main__":
    main()
