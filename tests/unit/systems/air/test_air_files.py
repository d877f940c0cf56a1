"""Files of networks and `turgor air`: what they make, and what is refused with its key and line."""

import json
import re
from pathlib import Path

import numpy as np
import pytest

import turgor as tg
from refused import any_states, refused
from turgor.cli.app import main
from turgor.systems.air.file.tables import PARTS, part_keys, part_types
from turgor.systems.air.file.values import PASSAGES

EXAMPLE = Path(__file__).parents[4] / "examples" / "air_finger.toml"
TEXT = EXAMPLE.read_text("utf-8")


def changed(old, new, tmp_path):
    """A file in which a piece of the example is another."""
    assert old in TEXT
    path = tmp_path / "net.toml"
    path.write_text(TEXT.replace(old, new, 1), encoding="utf-8")
    return path


def test_the_example_is_read():
    given = tg.air.read_air(EXAMPLE)
    assert given.name == "air_finger"
    assert list(given.network.nodes) == ["supply", "outlet", "actuator"]
    valve = given.network.parts["valve"]
    assert valve.on_delay == pytest.approx(0.008)
    assert valve.passage.conductance == pytest.approx(0.3e-8)
    assert given.performance == {"pressure": 20e3, "chamber": "actuator", "valve": "valve"}
    other = tg.air.read_air(EXAMPLE, {"nodes.supply.pressure": "150 kPa", "temperature": "30 °C"})
    assert other.network.nodes["supply"].pressure == 150e3
    assert other.network.temperature == pytest.approx(303.15)


@pytest.mark.parametrize(
    ("old", "new", "facts"),
    [
        ('pressure = "100 kPa"', "pressure = 100", ("net.toml:9", "nodes.supply.pressure", "kPa")),
        ('pressure = "100 kPa"', 'pressure = "-102 kPa"', ("net.toml:7", "supply", "-101.325")),
        ('to = "outlet"', 'to = "outlt"', ("parts.valve", "outlt", "'outlet'")),
        ('type = "tube"', 'type = "tub"', ("parts.tube.type", "'tube'")),
        ('length = "1 m"', 'lenght = "1 m"', ("parts.tube.lenght", "'length'")),
        ('length = "1 m"', "", ("parts.tube.length", "'1.5 mm'")),
        ('length = "1 m"', 'length = "1 kPa"', ("parts.tube.length", "1 kPa")),
        ('diameter = "2 mm"', 'diameter = "-2 mm"', ("parts.tube.diameter",)),
        ('conductance = "0.3 dm³/(s bar)"', "", ("parts.valve.conductance", "'diameter'")),
        ("critical_ratio = 0.3", "critical_ratio = 1.3", ("parts.valve.critical_ratio", "1.3")),
        ("critical_ratio = 0.3", "discharge = 0.3", ("parts.valve.discharge",)),
        ('"0.2 s", 1]', '"0.2", 1]', ("parts.valve.command", "0.2")),
        ('[["0 s", 0], ["0.2 s", 1],', '{ duty = 0.5 } #', ("parts.valve.command", "'frequency'")),
        ('duration = "2 s"', "", ("duration", "'2 s'")),
        ('duration = "2 s"', 'duration = "2 s"\nfluid_name = 1', ("fluid_name", "'fluid'")),
        ('fluid = "air"', 'fluid = "watr"', ("fluid", "'water'")),
        ('fluid = "air"', 'fluid = "water"', ("valve", "conductance")),
        ('fluid = "air"', 'fluid = "air"\nair = 0.1', ("fluid", "'air'")),
        ('type = "junction"', 'type = "junction"\nvolume = "0 mL"', ("nodes.outlet.volume", "0")),
        ('["5 kPa", "19.5 mL"]', '["5 kPa", "17.5 mL"]', ("nodes.actuator.points",)),
        ("points = [", 'volume = "1 mL"\npoints = [', ("nodes.actuator.points",)),
        ('[performance]\npressure = "20 kPa"', '[performance]\nvalve = "tap"', ("performance.pressure",)),
        ('[performance]\n', '[performance]\nvalve = "valv"\n', ("performance.valve", "'valve'")),
        ("on_delay", "on_dely", ("parts.valve.on_dely", "'on_delay'")),
        ("[[\"0 s\", 0], [\"0.2 s\", 1], [\"0.26 s\", 0], [\"1.2 s\", -1]]", "0", ("supply",)),
    ],
)  # fmt: skip
def test_mistakes_are_refused_at_their_key(old, new, facts, tmp_path):
    with refused(*facts):
        tg.air.read_air(changed(old, new, tmp_path))


def test_all_mistakes_are_listed_at_once(tmp_path):
    path = changed('pressure = "100 kPa"', 'pressure = "1 m"', tmp_path)
    path.write_text(path.read_text("utf-8").replace('length = "1 m"', 'length = "1"'), encoding="utf-8")
    with pytest.raises(tg.TurgorError) as caught:
        tg.air.read_air(path)
    assert len(caught.value.problems) == 2
    assert any_states(caught.value.problems, ("parts.tube.length",))


def test_every_part_can_stand_in_a_file(tmp_path):
    """A part that a file cannot state is noticed here."""
    assert {*part_types()} == {*PARTS, *PASSAGES}
    text = """
duration = "0.1 s"
fluid = "nitrogen"
ambient = "100 kPa"
nodes.source = { type = "supply", pressure = { mean = "100 kPa", amplitude = "5 kPa", frequency = "5 Hz" } }
nodes.tank = { type = "chamber", volume = "50 mL", process = "adiabatic", heat = "10 mW/K", pressure = "5 kPa" }
nodes.barrel = { type = "syringe", volume = [["0 s", "20 mL"], ["0.05 s", "15 mL"]] }
nodes.far = { type = "junction", volume = "1 mL" }
"""
    ways = {"conductance": '"0.1 dm³/(s bar)"', "diameter": '"1 mm"', "length": '"0.5 m"', "command": "1",
            "flow": '"5 mL/min"', "pressure": '"20 kPa"', "rise": '["0 kPa", "20 kPa"]',
            "volume_flow": '["20 mL/s", "0 mL/s"]', "segments": "2"}  # fmt: skip
    for kind in part_types():
        keys = {name: key for name, key in part_keys(kind).items() if key.needed and name not in ("from", "to")}
        if "conductance" in keys and "diameter" in keys:
            del keys["diameter"]
        body = {**{name: ways[name] for name in keys}, "from": '"source"', "to": '"tank"'}
        if kind == "flow_source":
            body["volume_flow"] = '"10 mL/s"'
        text += f'\n[parts.{kind}_1]\ntype = "{kind}"\n' + "".join(f"{key} = {value}\n" for key, value in body.items())
    text += '\n[parts.out]\ntype = "orifice"\nfrom = "barrel"\nto = "far"\ndiameter = "0.5 mm"\n'
    path = tmp_path / "all.toml"
    path.write_text(text, encoding="utf-8")
    given = tg.air.read_air(path)
    run = tg.air.simulate(given.network, given.duration, times=[0.0, 0.1])
    assert run.balance() < 1e-9
    assert run.pressure("barrel")[-1] > 5e3


def test_tables_come_from_files(tmp_path):
    table = tmp_path / "response.csv"
    table.write_text("pressure_kPa,cavity_volume_mL\n0,18\n10,21\n25,30\n", encoding="utf-8")
    start, end = TEXT.index("points = ["), TEXT.index("]\n\n[parts.valve]")
    path = tmp_path / "net.toml"
    path.write_text(TEXT[:start] + 'table = "response.csv"' + TEXT[end + 1 :], encoding="utf-8")
    curve = tg.air.read_air(path).network.nodes["actuator"].volume
    assert curve.volume_at(10e3) == pytest.approx(21e-6)
    path.write_text(path.read_text("utf-8").replace("response.csv", "respons.csv"), encoding="utf-8")
    with refused("nodes.actuator.table", "'response.csv'"):
        tg.air.read_air(path)


def test_the_command_writes_table_and_plot(tmp_path, monkeypatch, capsys):
    monkeypatch.chdir(tmp_path)
    assert main(["air", str(EXAMPLE), "--set", "samples=50", "--json"]) == 0
    result = json.loads(capsys.readouterr().out)["result"]
    assert result["performance"]["limiting"] == "tube"
    assert result["balance"] < 1e-9
    response = tg.files.read_response("air_finger-air/air.csv")
    assert len(response) == 51
    assert response["pressure_actuator"].max() > 20e3
    assert (tmp_path / "air_finger-air" / "air.png").stat().st_size > 10_000
    assert main(["air", str(EXAMPLE)]) == 1
    assert "air_finger-air" in capsys.readouterr().err
    assert main(["air", str(tmp_path / "fingr.toml")]) == 1
    assert "fingr.toml" in capsys.readouterr().err


def test_performance_agrees_with_a_closed_form():
    """A rigid vessel fills choked and then subsonic; twice the valve halves both times."""
    supply, ambient, b, c = 300e3, 101_325.0, 0.3, 1e-9
    network = tg.air.driven(18e-6, supply, tg.air.Restriction(conductance=c, critical_ratio=b))
    result = tg.air.performance(network, 100e3)
    absolute, scale = supply + ambient, c * 100e3 / 18e-6
    first = (b * absolute - ambient) / (scale * absolute)
    fill = first + (1 - b) / scale * np.arcsin(((100e3 + ambient) / absolute - b) / (1 - b))
    assert result.fill_time == pytest.approx(fill, rel=1e-5)
    assert result.wider[0].fill_time == pytest.approx(fill / 2, rel=1e-5)
    assert result.volume == pytest.approx(18e-6 * 100e3 / 100e3, rel=1e-3)
    assert result.energy == pytest.approx(18e-6 * 100e3 * np.log(absolute / ambient), rel=1e-3)
    assert result.stored == 0.0
    assert result.limiting.part == "valve"
    assert 0.1 / (fill + result.vent_time) < result.bandwidth < 2 / (fill + result.vent_time)
    with refused("actuator", "400"):
        tg.air.performance(network, 400e3)
    with refused("tap", "valve"):
        tg.air.performance(network, 50e3, valve="tap")
    assert re.search(r"bandwidth .* Hz", result.text)
