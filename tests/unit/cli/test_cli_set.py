"""``--set`` changes values of a job on every command that takes one."""

from pathlib import Path

import pytest
import typer.main

from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.cli.start.commands import command_line

FINGER = str(Path(__file__).parents[3] / "examples" / "actuators" / "slow_pneunet.toml")
COMMANDS = typer.main.get_command(command_line()).commands
WITH_JOB = [name for name, command in COMMANDS.items() if any(each.name == "job" for each in command.params)]


def test_commands_that_take_a_job():
    assert {"run", "check", "mesh", "export", "modes", "convergence"} <= set(WITH_JOB)


@pytest.mark.parametrize("name", WITH_JOB)
def test_every_command_that_takes_a_job_has_the_option(name, capsys, tmp_path, tmp_path_factory, monkeypatch):
    rig = tmp_path_factory.mktemp("rig") / "rig.csv"
    rig.write_text("Pressure (kPa);Bending angle (deg)\n0;0\n5;3\n", encoding="utf-8")
    monkeypatch.chdir(tmp_path)
    more = {"export": ["--step"], "calibrate": [str(rig), "--free", "actuator.wall"]}.get(name, [])
    assert main([name, FINGER, *more, "--set", "mesh.siz=2 mm"]) == BAD_INPUT
    said = capsys.readouterr().err
    assert states(said, "--set: mesh.siz:", "'siz'", "'size'")
    assert list(tmp_path.iterdir()) == []


def test_a_changed_mesh_is_meshed(capsys):
    unknowns = []
    for size in ("6 mm", "5 mm"):
        assert main(["check", FINGER, "--set", f"mesh.size={size}", "--set", "actuator.chambers=2"]) == DONE
        unknowns.append(int(capsys.readouterr().out.split(" cells, ")[1].split()[0]))
    assert unknowns[0] < unknowns[1]
