"""Commands of other packages: found, refused where they cannot be imported, without cost for other commands."""

import json
from importlib.metadata import EntryPoint

import pytest
import typer

from refused import states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.cli.start import extensions
from turgor.cli.start.commands import command_line


def greet(name: str) -> None:
    """Greet somebody."""
    typer.echo(f"good day, {name}")


group = typer.Typer()
group.command("greet")(greet)
group.command("welcome")(greet)


@pytest.fixture
def install(monkeypatch):
    """Pretend that packages with some entry points are installed."""

    def pretend(**values):
        points = [EntryPoint(name=name, value=value, group=extensions.GROUP) for name, value in values.items()]
        monkeypatch.setattr(extensions, "entry_points", lambda *, group: points if group == extensions.GROUP else [])

    return pretend


@pytest.mark.parametrize(("what", "arguments"), [("greet", ["hello", "Ada"]), ("group", ["hello", "greet", "Ada"])])
def test_a_command_and_a_group_are_found(install, capsys, what, arguments):
    install(hello=f"test_extensions:{what}")
    assert main(arguments) == DONE
    assert capsys.readouterr().out == "good day, Ada\n"
    assert main(["--help"]) == DONE
    assert "hello" in capsys.readouterr().out


@pytest.mark.parametrize("arguments", [[], ["run", "7.4-5", "--processes", "2"], ["--help"]])
def test_a_known_package_that_is_missing_is_named(install, capsys, arguments):
    install()
    assert main(["guidelines", *arguments]) == BAD_INPUT
    printed = capsys.readouterr()
    assert printed.out == ""
    assert states(printed.err, "turgor guidelines", "pip install turgor-guidelines")
    assert main(["--help"]) == DONE
    assert "guidelines" not in capsys.readouterr().out


def test_a_missing_package_is_an_error_for_programs(install, capsys):
    install()
    assert main(["guidelines", "list", "--json"]) == BAD_INPUT
    assert "pip install turgor-guidelines" in json.loads(capsys.readouterr().out)["error"]["message"]


def test_one_that_cannot_be_imported_leaves_the_others(install, capsys):
    install(broken="there_is_no_such_module:command", hello="test_extensions:greet")
    assert main(["hello", "Ada"]) == DONE
    assert main(["broken"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "'there_is_no_such_module:command'")


def test_no_package_replaces_a_command_of_turgor(install):
    install(run="test_extensions:greet")
    commands = command_line().registered_commands
    assert [command.name for command in commands].count("run") == 1
    assert all(command.callback is not greet for command in commands)


def test_the_packages_are_not_looked_through_for_a_command_of_turgor(monkeypatch):
    def fail(**_):
        raise AssertionError("the entry points were read")

    monkeypatch.setattr(extensions, "entry_points", fail)
    assert main(["run", "--help"]) == DONE
