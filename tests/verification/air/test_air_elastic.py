"""Elastic chambers in networks against algebra, a stiff equation of their own, and finite elements.

Problems: the plunger of a syringe pushes gas, or water, into a thick neo-Hookean sphere; a flow fills two spheres
that a laminar tube connects, so that the viscous flow decides their sequence (Vasios et al. 2019, doi
10.1089/soro.2018.0149); a sphere of finite elements receives an amount of gas, or a volume.
Exact: (Vₛ + V)(p₀ + P(V)) is constant, with P = μ (g(λ_b) − g(λ_a)), g = 2/λ + 1/(2 λ⁴); the two masses integrated as
equations for the two volumes; `GasMass` and `VolumeControl` of the same mesh.
Tolerance: 1e-6, that of the integration. Against finite elements 1e-4: a spline through 24 states is the table.
"""

from dataclasses import replace

import numpy as np
import pytest
from scipy.integrate import solve_ivp
from scipy.optimize import brentq

import meshes
import turgor as tg
from turgor.units import mL, mm

AMBIENT, T = 101_325.0, 293.15
RT = tg.air.AIR.gas_constant * T
INNER, OUTER, MU = 10 * mm, 14 * mm, 60e3


def pressure_of(volume, mu=MU):
    """Gauge pressure in a thick neo-Hookean sphere, and its derivative by the volume."""
    rest = 4 / 3 * np.pi * INNER**3
    cube = volume / rest
    inner, outer = cube ** (1 / 3), (1 + (cube - 1) * (INNER / OUTER) ** 3) ** (1 / 3)
    pressure = mu * (2 / outer + 0.5 / outer**4 - 2 / inner - 0.5 / inner**4)
    by_inner = (2 / inner**2 + 2 / inner**5) / (3 * inner**2)
    by_outer = (2 / outer**2 + 2 / outer**5) * (INNER / OUTER) ** 3 / (3 * outer**2)
    return pressure, mu * (by_inner - by_outer) / rest


REST = 4 / 3 * np.pi * INNER**3


def sphere(mu=MU):
    volumes = np.linspace(0.9, 12.0, 1200) * REST
    return tg.air.VolumeCurve(pressure_of(volumes, mu)[0], volumes)


def plunger(fluid, empties=15 * mL):
    barrel = tg.air.Signal((0.0, 1.0), (20 * mL, 20 * mL - empties), lines=True)
    return tg.air.Network(
        nodes={"syringe": tg.air.syringe(barrel), "sphere": tg.air.Chamber(sphere())},
        parts={"hole": tg.air.Connection("syringe", "sphere", tg.air.Orifice(diameter=2 * mm))},
        fluid=fluid,
    )


def test_syringe_of_air(record_verification):
    run = tg.air.simulate(plunger(tg.air.AIR), 3.0, tolerance=1e-9)
    amount = AMBIENT * (20 * mL + REST)
    volume = brentq(lambda v: (5 * mL + v) * (AMBIENT + pressure_of(v)[0]) - amount, REST, 8 * REST, xtol=1e-18)
    exact = pressure_of(volume)[0]
    got = run.pressure("sphere")[-1]
    record_verification("syringe of air on a sphere: pressure [Pa]", "exact", exact, got, "1e-6")
    assert got == pytest.approx(exact, rel=1e-6)
    assert run.volume("sphere")[-1] == pytest.approx(volume, rel=1e-6)
    assert run.volume("syringe")[-1] == pytest.approx(5 * mL)


def test_syringe_of_water(record_verification):
    """The water is so stiff that the sphere receives what the plunger gives, but for 1e-4 of it."""
    run = tg.air.simulate(plunger(tg.air.WATER), 3.0)
    exact = pressure_of(REST + 15 * mL)[0]
    got = run.pressure("sphere")[-1]
    record_verification("syringe of water on a sphere: pressure [Pa]", "exact, rigid water", exact, got, "1e-4")
    assert got == pytest.approx(exact, rel=1e-4)
    foam = tg.air.Liquid(name="foam", reference_density=998.2, bulk_modulus=2.18e9, viscosity=1e-3, air=0.05)
    run = tg.air.simulate(plunger(foam), 3.0, tolerance=1e-9)

    def mass(v):
        absolute = AMBIENT + pressure_of(v)[0]
        return foam.density(absolute, T) * (5 * mL + v) - foam.density(AMBIENT, T) * (20 * mL + REST)

    volume = brentq(mass, REST, 8 * REST, xtol=1e-18)
    assert run.pressure("sphere")[-1] == pytest.approx(pressure_of(volume)[0], rel=1e-6)
    assert volume < REST + 14.9 * mL
    assert run.balance() < 1e-9


def test_two_spheres_fill_in_sequence(record_verification):
    """The second sphere is softer, yet the first one balloons, for the tube lets little through."""
    tube, flow = tg.air.Tubing(diameter=0.3 * mm, length=0.5), 20 * mL
    network = tg.air.Network(
        nodes={"first": tg.air.Chamber(sphere()), "second": tg.air.Chamber(sphere(0.7 * MU))},
        parts={
            "source": tg.air.FlowSource("ambient", "first", tg.air.Signal((0.0, 2.0), (flow, 0.0))),
            "tube": tg.air.Connection("first", "second", tube),
        },
    )
    time = np.linspace(0.0, 20.0, 201)
    run = tg.air.simulate(network, 20.0, times=time, tolerance=1e-10)
    dead, inflow = tube.volume / 2, flow * tg.air.AIR.reference_density * RT
    factor = np.pi * tube.diameter**4 / (256 * tg.air.AIR.viscosity * tube.length)

    def rates(t, v):
        (p1, k1), (p2, k2) = pressure_of(v[0]), pressure_of(v[1], 0.7 * MU)
        p1, p2 = p1 + AMBIENT, p2 + AMBIENT
        through = factor * (p1**2 - p2**2)
        return [
            ((inflow if t <= 2.0 else 0.0) - through) / (p1 + k1 * (v[0] + dead)),
            through / (p2 + k2 * (v[1] + dead)),
        ]

    how = {"method": "Radau", "rtol": 1e-11, "atol": 1e-18}
    pump = solve_ivp(rates, (0.0, 2.0), [REST, REST], t_eval=time[time <= 2.0], **how)
    rest = solve_ivp(lambda t, v: rates(3.0, v), (2.0, 20.0), pump.y[:, -1], t_eval=time[time >= 2.0], **how)
    exact = np.concatenate([pump.y, rest.y[:, 1:]], axis=1)
    for name, values in zip(("first", "second"), exact, strict=True):
        error = np.abs(run.volume(name) / values - 1).max()
        record_verification(f"two spheres and a tube: error of the volume of the {name}", "exact", 0.0, error, "1e-6")
        assert error < 1e-6
    assert run.volume("first")[20] > 1.5 * run.volume("second")[20]
    assert run.balance() < 1e-9


@pytest.fixture(scope="module")
def elements():
    """A thick sphere of finite elements and the table of its chamber."""
    material = tg.Material(name="rubber", law=tg.laws.NeoHooke(C10=0.12e6))
    model = tg.Model(meshes.sphere_octant(10e-3, 15e-3, 1, 2), {"body": material}, [], [tg.Pressure("cavity", 60e3)])
    at = tuple(np.linspace(1 / 24, 1.0, 24))
    options = tg.EngineOptions(threads=1)
    path = tg.solve(model, tg.Static(first_step=1 / 24, at=at), options=options, progress=False)
    return replace(model, loads=()), tg.air.VolumeCurve.of_response(tg.measure(path, tg.cavity_volume)), options


def test_steady_state_is_that_of_finite_elements(record_verification, elements):
    model, curve, options = elements
    rest = curve.volume_at(0.0)
    sealed = tg.solve(model, tg.GasMass(mass_ratio=1.6), options=options, progress=False).states[-1]
    pushed = tg.solve(model, tg.VolumeControl(volume=0.5 * mL), options=options, progress=False).states[-1]
    added = 0.6 * AMBIENT * rest / RT / tg.air.AIR.reference_density
    water = 0.5 * mL * tg.air.WATER.density(AMBIENT + pushed.pressures["cavity"], T) / tg.air.WATER.reference_density
    cases = {"GasMass": (tg.air.AIR, added, sealed), "VolumeControl": (tg.air.WATER, water, pushed)}
    for name, (fluid, volume, state) in cases.items():
        network = tg.air.Network(
            nodes={"sphere": tg.air.Chamber(curve)},
            parts={"source": tg.air.FlowSource("ambient", "sphere", volume)},
            fluid=fluid,
        )
        got = tg.air.simulate(network, 1.0, tolerance=1e-9).pressure("sphere")[-1]
        exact = state.pressures["cavity"]
        record_verification(f"sphere of finite elements, {name}: pressure [Pa]", "finite elements", exact, got, "1e-4")
        assert got == pytest.approx(exact, rel=1e-4)


def test_energy_of_an_insulated_sphere(record_verification):
    """What flows in brings c_p T: it is in the gas and in the work on the walls."""
    gas = tg.air.AIR
    network = tg.air.driven(sphere(), 40e3, tg.air.Restriction(conductance=1e-10), process="adiabatic")
    run = tg.air.simulate(network, 1.0, times=np.linspace(0.0, 1.0, 4001), tolerance=1e-9)
    p, v = run.pressure("actuator") + AMBIENT, run.volume("actuator")
    brought = gas.heat_capacity * T * (run.mass("actuator")[-1] - run.mass("actuator")[0])
    got = (p[-1] * v[-1] - p[0] * v[0]) / (gas.heat_ratio - 1) + np.trapezoid(p, v)
    record_verification("insulated sphere: energy in gas and walls [J]", "exact", brought, got, "1e-6")
    assert got == pytest.approx(brought, rel=1e-6)
    assert run.temperature("actuator").max() > 300.0
