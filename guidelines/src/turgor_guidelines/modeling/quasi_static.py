"""Claim 8.1-4: fast actuation needs a transient analysis; little damping keeps a slow one quasi-static."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor.units import kPa, mm
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting, Verdict

#: Length of the pressure's ramp over the first period of the actuator, and damping ratios of that vibration.
RAMPS, RATIOS = (0.5, 2.0, 20.0), (0.0, 0.02)

#: Length of the actuator [mm], its pressure [kPa], and the time steps of a period.
LENGTH, PRESSURE, STEPS = 100, 20, 30

#: Largest difference from the static path, over the static end, and largest kinetic over strain energy, that are
#: quasi-static; and ramps that are slow [periods].
NEAR, ENERGY, SLOW = 0.01, 0.01, 20.0


def ramp(periods: float, ratio: float) -> Computed:
    """Raise the pressure in so many periods; difference of the tip from the static path, and the energies."""
    rubber = tg.from_library("elastosil-m4601", record="neo-hooke-polygerinos-2020")
    tube = tg.rods.Tube(outer_radius=8 * mm, inner_radius=6 * mm)
    first = tg.rods.natural_frequencies(_arm(tube, rubber, 0.0), count=1).frequencies[0]
    model = _arm(tube, rubber, ratio / (np.pi * first))
    moved = tg.rods.dynamic(model, duration=periods / first, step=1 / (STEPS * first), spectral_radius=1.0).response()
    still = tg.rods.static(model, at=20).response()
    at_rest = np.interp(moved["load_factor"], still["load_factor"], still["tip_displacement"])
    strain, kinetic = moved["strain_energy"], moved["kinetic_energy"]
    late = moved["load_factor"] > 0.2  # energies are compared once there is strain
    share = np.where(late, kinetic / np.maximum(strain, 1e-12), 0.0)
    columns = (
        moved.find("load_factor"),
        tg.experiments.Column("difference", "", (moved["tip_displacement"] - at_rest) / still["tip_displacement"][-1]),
        tg.experiments.Column("energy_share", "", share),
    )
    return Computed(response=tg.Response(columns=columns, source=moved.source))


def _arm(tube: tg.rods.Tube, rubber: tg.Material, damping_time: float) -> tg.rods.RodModel:
    """A tube in hoops whose chamber lies off its axis, so that it bends."""
    plain = tg.rods.RodSection.from_geometry(tube, rubber)
    chamber = tg.rods.RodChamber(name="cavity", area=60 * mm**2, offset=(0.0, -3 * mm))
    section = tg.rods.RodSection(
        stiffness=plain.stiffness,
        mass_per_length=plain.mass_per_length,
        chambers=(chamber,),
        damping_time=damping_time,
    )
    return tg.rods.RodModel(
        rods=[tg.rods.Rod(section=section, length=LENGTH * mm)],
        loads=[tg.rods.ChamberPressure(pressure=PRESSURE * kPa)],
    )


def runs(setting: Setting) -> tuple[Run, ...]:
    """Every ramp with and without damping; rods are cheap, so both settings have all."""
    del setting
    return tuple(
        Run(name=_name(periods, ratio), function=ramp, values={"periods": periods, "ratio": ratio})
        for ratio in RATIOS
        for periods in RAMPS
    )


def _name(periods: float, ratio: float) -> str:
    return f"{periods:g} periods, damping {ratio:.0%}"


def _most(runs: Runs, ratio: float, column: str) -> list[float]:
    return [float(np.abs(runs[_name(periods, ratio)].response[column]).max()) for periods in RAMPS]


def judge(runs: Runs) -> Judgement:
    """Fast ramps leave the static path; slow ones with damping follow it, with little kinetic energy."""
    differences, energies = (
        {ratio: _most(runs, ratio, each) for ratio in RATIOS} for each in ("difference", "energy_share")
    )
    slow = [k for k, periods in enumerate(RAMPS) if periods >= SLOW]
    follows = all(differences[RATIOS[1]][k] < NEAR and energies[RATIOS[1]][k] < ENERGY for k in slow)
    leaves = differences[RATIOS[0]][0] > NEAR
    summary = "; ".join(
        f"damping {ratio:.0%}: difference {', '.join(f'{each:.2%}' for each in differences[ratio])}, kinetic over "
        f"strain energy {', '.join(f'{each:.2g}' for each in energies[ratio])}"
        for ratio in RATIOS
    )
    alone = all(differences[0.0][k] < NEAR and energies[0.0][k] < ENERGY for k in slow)
    verdict = Verdict.CONFIRMED if follows and leaves else Verdict.NOT_REPRODUCED
    if follows != leaves:
        verdict = Verdict.CONDITIONAL
    return Judgement(
        verdict=verdict,
        finding=f"Ramps of {', '.join(f'{each:g}' for each in RAMPS)} periods, largest difference from the static "
        f"path: {summary}.",
        conditions="The slow ramps follow the static path without damping, too." if alone else "",
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Largest difference and energy against the length of the ramp."""
    out = []
    for column, name in (("difference", "largest difference [%]"), ("energy_share", "kinetic over strain energy [%]")):
        lines = [
            tg.pictures.Line(x=RAMPS, y=100 * np.array(_most(runs, ratio, column)), label=f"damping {ratio:.0%}")
            for ratio in RATIOS
        ]
        out.append(tg.pictures.Panel(x="length of the ramp [periods]", y=name, lines=lines))
    return tuple(out)


GUIDELINE = Guideline(
    key="8.1-4",
    rule="Fast actuation is not quasi-static and vibrates; a small damping keeps kinetic effects low where it is slow.",
    sources=("Moseley et al. 2016", "Connolly et al. 2015"),
    families=(),
    studies=(
        GuidelineTest(
            title="Ramps of the pressure, with damping and without",
            setup=f"Cosserat rod of {LENGTH} mm, a tube of radius 8 mm, wall 2 mm, of Elastosil M4601 (neo-Hooke, 0.12 "
            f"MPa) with a chamber 3 mm off its axis, {PRESSURE} kPa in ramps of several first periods; Kelvin-Voigt "
            "damping of 2 % of the first vibration, or none.",
            expected=f"Below {NEAR:.0%} from the static path, and kinetic below {ENERGY:.0%} of strain energy, for "
            f"ramps of {SLOW:g} periods and more with damping; not for half a period without.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
