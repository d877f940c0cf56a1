"""Several cavities, weight, volumes, gas, histories, compressible rubber."""

import turgor as tg
from benchmarks.robustness.robustness_cases import checks
from benchmarks.robustness.robustness_cases.actuators import BENDER, ELASTOSIL, LEAP, NO_CONTACT, SOFTEST, driven
from benchmarks.robustness.robustness_cases.case import KPA, MM, RUBBER, Case, Found, one

import meshes  # isort: skip  (found where robustness_cases.case says)

UP_AND_DOWN = ((0, 0), (0.5, 1), (1, 0))
TURNS = tg.actuators.BidirectionalBender(length=50 * MM)
HEAVY = tg.Material(name="Ecoflex", law=SOFTEST.law, density=1070.0)


def bar(*loads, law=RUBBER):
    """A bar of 40 mm with one void above another."""
    return lambda: one(meshes.two_cavities(), law, loads, [tg.Fixed("x0")])


def weighed(solution: tg.Solution) -> Found:
    """The support carries the weight."""
    mesh, last = solution.model.mesh, solution.states[-1]
    expected = tg.measures.total_mass(solution.model) * 9.80665 / mesh.symmetry_factor
    held = last.nodal_force[mesh.face_nodes("fixed")].sum(axis=0)
    return checks.value("force at the support", float(abs(held[2])), expected, 1e-3, " N")


def injected(volumes: dict[str, float]) -> checks.Check:
    """The cavities have taken what was injected."""

    def check(solution: tg.Solution) -> Found:
        got = {name: checks.read(solution, tg.measures.volume_of(name))[0] for name in volumes}
        off = max(abs((v[-1] - v[0]) / volumes[name] - 1) for name, v in got.items())
        return Found(off < 1e-4, f"volumes {off:.0e} off")

    return check


def same_by_pressure(solution: tg.Solution) -> Found:
    """The pressures found, as loads, bring back the same state."""
    model, last = solution.model, solution.states[-1]
    loads = [tg.Pressure(name, pressure) for name, pressure in last.pressures.items()]
    again = tg.Model(model.mesh, model.materials, model.supports, loads, contact=model.contact)
    end = tg.solve(again, options=checks.OPTIONS, throw=False)
    if not end.complete:
        return Found(False, f"the pressures as loads: {end.message}")
    off = abs(tg.cavity_volume(end.states[-1]) / tg.cavity_volume(last) - 1)
    return Found(off < 1e-4, f"the pressures as loads give the volume back to {off:.0e}")


def buckles(solution: tg.Solution) -> Found:
    """The load stopped at the share of the weight at which the path by its length has its maximum."""
    model = solution.model
    alone = tg.Model(model.mesh, model.materials, model.supports, [tg.Gravity((-1, 0, 0))], contact=NO_CONTACT)
    maxima = tg.solve(alone, tg.ArcLength(max_steps=60), options=checks.OPTIONS, throw=False).limit_points
    if not maxima:
        return Found(False, "the path by its length has no maximum")
    return checks.value("share of the weight", solution.states[-1].load_factor / 0.3, maxima[0].load_factor, 1e-3)


def hanging(direction, pressure=0.0, history=((0, 0), (0.3, 1), (1, 1))):
    """A bender of the softest row that its weight bends far, then filled."""

    def model() -> tg.Model:
        mesh = tg.mesh(tg.actuators.RectangularBender(length=80 * MM).build(), size=6 * MM)
        loads = [tg.Gravity(direction, history=list(history))]
        if pressure:
            loads.append(tg.Pressure("cavity", pressure, history=[(0, 0), (0.3, 0), (1, 1)]))
        materials = dict.fromkeys(mesh.regions, HEAVY)
        return tg.Model(mesh, materials, [tg.Fixed("fixed")], loads, contact=NO_CONTACT)

    return model


VOLUMES = {"cavity_1": 0.2e-6, "cavity_2": -0.1e-6}

CASES = (
    Case(
        name="two voids, one up and one down", hard="30 kPa and -30 kPa in one step", procedure=LEAP,
        model=bar(tg.Pressure("cavity_1", 30 * KPA), tg.Pressure("cavity_2", -30 * KPA)), check=checks.small_steps(20),
    ),
    Case(
        name="two voids up and down after each other", hard="histories with kinks, back to nothing",
        model=bar(tg.Pressure("cavity_1", 40 * KPA, ((0, 0), (0.3, 1), (0.6, -0.5), (1, 0))),
                  tg.Pressure("cavity_2", 40 * KPA, ((0, 0), (0.5, -0.5), (0.8, 1), (1, 0)))),
        check=checks.back_to_rest,
    ),
    Case(
        name="two voids by volume, in and out", hard="one is filled, one is emptied", model=bar(),
        procedure=tg.VolumeControl(volume=VOLUMES), check=checks.both(injected(VOLUMES), same_by_pressure),
    ),
    Case(
        name="bender with two chambers, up and down", hard="bends one way, then the other, back to nothing",
        model=lambda: one(
            tg.mesh(TURNS.build(), size=6 * MM), RUBBER,
            [tg.Pressure("cavity_1", 15 * KPA, ((0, 0), (0.3, 1), (0.6, 0), (1, 0))),
             tg.Pressure("cavity_2", 15 * KPA, ((0, 0), (0.3, 0), (0.6, 1), (1, 0)))],
            [tg.Fixed("fixed")],
        ),
        check=checks.back_to_rest,
    ),
    Case(
        name="three chambers at three pressures", hard="one pressed, one sucked, in one step", procedure=LEAP,
        model=driven(tg.actuators.OmnidirectionalActuator(length=30 * MM), 8, 0,
                     pressures={"cavity_1": 40, "cavity_2": -10, "cavity_3": 15}),
        check=checks.small_steps(20),
    ),
    Case(
        name="softest bender under its weight, one step", hard="falls by most of its length", procedure=LEAP,
        model=hanging((0, 0, -1), history=((0, 0), (1, 1))), check=checks.both(weighed, checks.small_steps(20)),
    ),
    Case(
        name="softest bender falls, then is filled",
        hard="weight first, then pressure", model=hanging((0, 0, -1), 800.0),
        check=checks.both(weighed, checks.small_steps(20)),
    ),
    Case(
        name="softest bender stands on its end", hard="buckles under three quarters of its weight",
        model=hanging((-1, 0, 0), 800.0), check=buckles, stops=True,
    ),
    Case(
        name="bender by volume",
        hard="three times its volume", model=driven(BENDER, 6, 0, ELASTOSIL, contact=NO_CONTACT),
        procedure=tg.VolumeControl(volume=6e-6), check=checks.both(checks.energy(), same_by_pressure),
    ),
    Case(
        name="softest bender by volume",
        hard="past its limit, a law that gives way", model=driven(BENDER, 6, 0, SOFTEST, contact=NO_CONTACT),
        procedure=tg.VolumeControl(volume=9e-6), check=checks.law_gives_way(SOFTEST.law), stops=True,
    ),
    Case(
        name="sealed bender, air around taken away",
        hard="gas law, vacuum chamber", model=driven(BENDER, 6, 0, ELASTOSIL),
        procedure=tg.GasMass(outside=20e3), check=checks.small_gas(101_325.0, 20e3),
    ),
    Case(
        name="compressible bender", hard="bulk modulus three times the shear modulus, one step", procedure=LEAP,
        model=driven(BENDER, 6, 20, tg.Material(name="foam", law=tg.laws.NeoHooke(C10=0.12e6), bulk_modulus=0.72e6)),
        check=checks.small_steps(20),
    ),
    Case(
        name="bender under vacuum", hard="walls pulled in to touch, -40 kPa", model=driven(BENDER, 6, -40, ELASTOSIL),
        check=checks.both(checks.energy(0.02), checks.not_through),
    ),
    Case(
        name="bender up and down", hard="a pressure that bends it by a quarter turn, back to nothing",
        model=lambda: one(tg.mesh(BENDER.build(), size=6 * MM), ELASTOSIL,
                          [tg.Pressure("cavity", 40 * KPA, UP_AND_DOWN)], [tg.Fixed("fixed")]),
        check=checks.back_to_rest,
    ),
)  # fmt: skip
