"""Networks: bad ones are refused with the name of what is wrong; tables, histories and responses."""

from types import SimpleNamespace

import numpy as np
import pytest

import turgor as tg
from refused import refused
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.units import kPa, mL, mm

C = tg.air.Restriction(conductance=0.5e-8)
TANK, SUPPLY = tg.air.Chamber(10 * mL), tg.air.Supply(50 * kPa)
WAY = tg.air.Connection("supply", "tank", C)


def network(nodes=None, parts=None, **more):
    return tg.air.Network(nodes=nodes or {"supply": SUPPLY, "tank": TANK}, parts=parts or {"way": WAY}, **more)


@pytest.mark.parametrize(
    ("make", "facts"),
    [
        (lambda: network(parts={"way": tg.air.Connection("supply", "tnak", C)}), ("way", "tnak", "'tank'")),
        (lambda: network(parts={"way": tg.air.Connection("tank", "tank", C)}), ("way", "tank")),
        (lambda: network({"supply": SUPPLY, "tank": tg.air.Supply(-102 * kPa)}), ("chamber",)),
        (lambda: network({"supply": tg.air.Supply(-102 * kPa), "tank": TANK}), ("supply", "-102", "-101.325")),
        (lambda: network({"supply": SUPPLY, "tank": tg.air.Chamber(1e-6, -2e5)}), ("tank", "-200", "-101.325")),
        (lambda: network({"supply": SUPPLY, "tank": tg.air.junction()}), ("tank", "volume", "way")),
        (lambda: network({"supply": SUPPLY, "tank": TANK, "lone": TANK}), ("lone",)),
        (lambda: network({"supply": SUPPLY, "tank": TANK, "lone": SUPPLY}), ("lone", "supply")),
        (lambda: network(parts={"v": tg.air.OnOffValve("supply", "tank", C, 0.0)}), ("supply", "valve")),
        (lambda: network(parts={"tank": WAY}), ("tank",)),
        (lambda: network(ambient=0.0), ("ambient", "0")),
        (lambda: network(temperature=-1.0), ("temperature", "-1")),
        (lambda: tg.air.Chamber(-1e-6), ("volume", "-1e-06")),
        (lambda: tg.air.Chamber(1e-6, process="isotherml"), ("isotherml", "'isothermal'")),
        (lambda: tg.air.Chamber(1e-6, process=3.0), ("process", "3")),
        (lambda: tg.air.Tubing(diameter=0.0, length=1.0), ("diameter", "0")),
        (lambda: tg.air.Restriction(conductance=1e-9, critical_ratio=1.2), ("critical_ratio", "1.2")),
        (lambda: tg.air.Signal((0.0, 0.0), (1.0, 2.0)), ("0",)),
        (lambda: tg.air.Pwm(10.0, 1.5), ("duty", "1.5")),
        (lambda: tg.air.VolumeCurve([0.0, 1.0], [2.0, 1.0]), ("volumes",)),
    ],
)
def test_bad_networks_get_a_sentence(make, facts):
    with refused(*facts):
        make()


def test_a_chamber_that_would_snap_is_refused():
    """The pressure falls so fast that less gas is in the larger chamber."""
    curve = tg.air.VolumeCurve([0.0, 80e3, 5e3, 90e3], np.array([10.0, 11.0, 12.0, 14.0]) * mL)
    with refused("tank", "snap", "mL"):
        tg.air.simulate(network({"supply": SUPPLY, "tank": tg.air.Chamber(curve)}), 1.0)


def test_leaving_a_table_is_an_error():
    curve = tg.air.VolumeCurve(np.linspace(0.0, 30e3, 5), np.linspace(10.0, 12.0, 5) * mL)
    with refused("tank", "0 to 30 kPa", error=tg.TurgorError):
        tg.air.simulate(network({"supply": SUPPLY, "tank": tg.air.Chamber(curve)}), 1.0)


def test_requests_out_of_range_are_refused():
    for more, facts in (
        ({"until": -1.0}, ("until", "-1")),
        ({"tolerance": 1.0}, ("tolerance", "1")),
        ({"method": "RK"}, ("RK", "LSODA")),
        ({"times": [0.0, 3.0]}, ("3", "1")),
        ({"times": [1.0, 0.5]}, ("times",)),
    ):
        with refused(*facts):
            tg.air.simulate(network(), **({"until": 1.0} | more))


def test_a_history_reads_every_quantity():
    run = tg.air.simulate(network(), 0.2, times=np.linspace(0.0, 0.2, 11))
    assert run.mass("tank")[-1] - run.mass("tank")[0] == pytest.approx(-run.received("supply")[-1])
    assert run.temperature("tank") == pytest.approx(293.15)
    response = run.response("test")
    assert response.names == ("time", "pressure_supply", "pressure_tank", "flow_way")
    assert response["pressure_tank_kPa"][-1] == pytest.approx(50.0, abs=0.1)
    assert response["flow_way_L/min"][0] > 1.0
    with refused("tnak", "'tank'"):
        run.pressure("tnak")
    with refused("wy", "'way'"):
        run.flow("wy")


def test_a_junction_has_half_of_its_tubes():
    tube = tg.air.Tubing(diameter=2 * mm, length=1.0)
    parts = {"way": tg.air.Connection("supply", "mid", C), "tube": tg.air.Connection("mid", "tank", tube)}
    net = network({"supply": SUPPLY, "mid": tg.air.junction(), "tank": TANK}, parts)
    assert net.dead_volumes()["mid"] == pytest.approx(tube.volume / 2)
    run = tg.air.simulate(net, 1.0)
    assert run.mass("mid")[0] == pytest.approx(tg.air.AIR.density(101_325.0, 293.15) * tube.volume / 2)
    assert run.pressure("tank")[-1] == pytest.approx(50e3, rel=1e-3)


def test_curves_come_from_many_sources():
    material = tg.Material(name="rubber", law=tg.laws.Yeoh(C10=20e3, C20=2e3))
    formula = tg.formulas.thick_sphere(
        tg.formulas.HollowSphere(inner_radius=10e-3, wall=4e-3), material, inner_stretch=np.linspace(1.0, 1.5, 30)
    )
    curve = tg.air.VolumeCurve.of_response(formula)
    assert curve.volume_at(0.0) == pytest.approx(4 / 3 * np.pi * 1e-6)
    function = tg.air.VolumeCurve.of_function(lambda p: 1e-5 * np.exp(p / 1e5), -1e4, 5e4)
    assert function.volume_at(3e4) == pytest.approx(1e-5 * np.exp(0.3), rel=1e-8)
    work = function.work(1.2e-5, 1e5) - function.work(1.1e-5, 1e5)
    v = np.linspace(1.1e-5, 1.2e-5, 2001)
    assert work == pytest.approx(np.trapezoid(1e5 * np.log(v / 1e-5) + 1e5, v), rel=1e-7)
    with refused("60", "50 kPa"):
        function.volume_at(6e4)


def test_plungers_that_repeat_stay_in_balance():
    """An adiabatic barrel that is pushed and pulled back has its first temperature again."""
    barrel = tg.air.Chamber(tg.air.Rigid(tg.air.Signal((0.0, 0.5, 1.0), (20 * mL, 10 * mL, 20 * mL), lines=True)),
                            process="adiabatic")  # fmt: skip
    tank = tg.air.Chamber(1e-12)
    parts = {"hole": tg.air.Connection("barrel", "tank", C)}
    net = tg.air.Network(nodes={"barrel": barrel, "tank": tank}, parts=parts)
    run = tg.air.simulate(net, 1.0, times=[0.0, 0.5, 1.0], tolerance=1e-9)
    assert run.temperature("barrel") == pytest.approx(np.array([1.0, 2**0.4, 1.0]) * 293.15, rel=1e-4)


def test_the_shape_follows_from_the_table():
    """The angle of the response at each volume; the last state is that of the supply's pressure."""
    volumes, pressures = np.linspace(10.0, 12.0, 6) * mL, np.linspace(0.0, 60e3, 6)
    columns = (
        Column("pressure", "kPa", pressures),
        Column("bending_angle", "deg", np.linspace(0.0, 1.2, 6)),
        Column("cavity_volume", "mL", volumes),
    )
    curve = tg.air.VolumeCurve.of_response(Response(columns=columns, source=Source(text="a test")))
    run = tg.air.simulate(network({"supply": SUPPLY, "tank": tg.air.Chamber(curve)}), 0.5)
    assert run.measure("tank", "bending_angle")[-1] == pytest.approx(1.0, rel=1e-3)
    response = run.response()
    assert response["bending_angle_tank_deg"][-1] == pytest.approx(np.rad2deg(1.0), rel=1e-3)
    assert len(run.plot().axes) == 4
    with refused("twst", "pressure"):
        run.measure("tank", "twst")
    with refused("supply"):
        run.measure("supply", "bending_angle")


class Stub:
    """Volumes as a reduced model gives them: two cavities that press each other, or both under one pressure."""

    def __init__(self, keys):
        n = len(keys)
        self.faces = ("cavity_1", "cavity_2")
        self.inputs = SimpleNamespace(keys=keys, low=np.full(n, -1e3), high=np.full(n, 20e3))
        drives = np.eye(2) if n == 2 else np.ones((2, 1))
        self.equations = SimpleNamespace(pressures=np.column_stack([np.zeros(2), drives]))

    def at(self, values, start=None):
        p = np.broadcast_to(values, 2)
        return SimpleNamespace(
            volumes={"cavity_1": 1e-5 + 1e-10 * p[0] - 1e-11 * p[1], "cavity_2": 2e-5 + 1e-10 * p[1]}
        )

    def solve_all(self, table):
        return [self.at(np.array([value])) for value in table]


def test_reduced_models_become_tables():
    curve = tg.air.VolumeCurve.of_reduced(Stub(["p"]))
    assert curve.volume_at(10e3) == pytest.approx(3e-5 + 1.9e-10 * 10e3)
    table = tg.air.Coupled.of_reduced(Stub(["a", "b"]), points=5)
    volumes, slopes = table.at(np.array([5e3, 7e3]))
    assert volumes == pytest.approx([1e-5 + 5e-7 - 7e-8, 2e-5 + 7e-7])
    assert slopes == pytest.approx(np.array([[1e-10, -1e-11], [0.0, 1e-10]]), abs=1e-16)
