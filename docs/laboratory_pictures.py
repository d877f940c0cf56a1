"""Pictures of docs/howto/compare.md, calibrate.md, fit-a-rubber.md: `python docs/laboratory_pictures.py` writes them.

The measured curves are made up from a formula, so that what is wrong with them is known.
"""

from pathlib import Path

import numpy as np
from matplotlib.figure import Figure
from PIL import Image

import turgor as tg
from turgor.units import MPa, kPa, mm

IMAGES = Path(__file__).parent / "images"


def ball(C10: float, wall: float = 5 * mm) -> tg.Response:
    """A hollow ball of neo-Hookean rubber, up to a stretch of 1.4 inside."""
    rubber = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=C10))
    sphere = tg.formulas.HollowSphere(inner_radius=10 * mm, wall=wall)
    return tg.formulas.thick_sphere(sphere, rubber, inner_stretch=np.linspace(1.0, 1.4, 40))


def measured(true: tg.Response, seed: int = 1) -> tg.Response:
    """A cycle of a gauge that reads 1 kPa too much, with 2 % of noise, and larger values in unloading."""
    up = np.linspace(0.0, 0.9, 30) * true["pressure"].max()
    pressure, back = np.concatenate([up, up[::-1]]), np.repeat([0.0, 1.0], 30)
    volume = np.interp(pressure, true["pressure"], true["cavity_volume"])
    size = np.ptp(volume)
    volume = volume + 0.06 * size * back * np.sin(np.pi * pressure / up[-1])
    volume = volume + 0.02 * size * np.random.default_rng(seed).normal(size=len(volume))
    column = tg.experiments.Column
    columns = column("pressure", "kPa", pressure + 1 * kPa), column("cavity_volume", "mL", volume)
    return tg.Response(columns=columns, source=tg.laws.Source(text="made up"))


def fabric() -> Figure:
    """Three strips of a fabric with 2 % of noise, and the lines of the fit."""
    random, stretch, strips = np.random.default_rng(2), np.linspace(1.0, 1.02, 21), {}
    cloth = tg.laws.Woven(E=400 * MPa, E_weft=150 * MPa, G=12 * MPa, nu=0.25)
    for cut, angle in (("warp", 0.0), ("weft", np.pi / 2), ("bias", np.pi / 4)):
        stress = cloth.modulus_along(angle) * stretch * (stretch**2 - 1) / 2
        stress = stress + 0.02 * stress.max() * random.normal(size=len(stress))
        strips[cut] = tg.experiments.MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stress, name=cut)
    found = tg.experiments.fit_woven(strips, nu=0.25)
    figure = Figure(figsize=(6.0, 3.6), layout="constrained")
    axes = figure.subplots()
    for (cut, test), color in zip(found.tests, ("#0072b2", "#d55e00", "#009e73"), strict=True):
        axes.plot(stretch, test.nominal_stress / MPa, ".", color=color)
        axes.plot(stretch, found.stress(cut, stretch) / MPa, color=color, label=cut)
    axes.set_xlabel("stretch")
    axes.set_ylabel("nominal stress [MPa]")
    axes.legend(frameon=False)
    axes.spines[["top", "right"]].set_visible(False)
    return figure


def smaller(name: str) -> None:
    """Write a PNG with 64 colors, which is enough for curves."""
    with Image.open(IMAGES / name) as picture:
        small = picture.convert("RGB").quantize(64)
    small.save(IMAGES / name, optimize=True)


def main() -> None:
    """Write all pictures."""
    rig = measured(ball(0.12e6))
    compared = tg.compare(ball(0.11e6), rig, "cavity_volume")
    tg.experiments.comparison_figure(compared, "A ball").savefig(IMAGES / "compare.png", dpi=110)
    loading = tg.experiments.loading(rig)
    found = tg.studies.calibrate(
        tg.studies.Trial(measured=loading, function=ball, y="cavity_volume"),
        [tg.studies.Parameter(name="C10", start=0.2e6, unit="MPa")],
        rig=["pressure_offset"],
    )
    tg.studies.calibration_figure(found).savefig(IMAGES / "calibration.png", dpi=110)
    fabric().savefig(IMAGES / "fabric.png", dpi=110)
    for name in ("compare.png", "calibration.png", "fabric.png"):
        smaller(name)


if __name__ == "__main__":
    main()
