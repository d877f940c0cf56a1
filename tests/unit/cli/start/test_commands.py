"""All commands are there, and loading them loads nothing heavy."""

import subprocess
import sys

import typer.main

from turgor.cli.start.commands import COMMANDS, command_line


def test_the_command_line_has_all_commands():
    assert set(typer.main.get_group(command_line("run")).commands) == set(COMMANDS)


def test_loading_the_commands_loads_nothing_heavy():
    script = "import sys; from turgor.cli.start.commands import command_line; command_line(); print(*sys.modules)"
    modules = subprocess.run([sys.executable, "-c", script], capture_output=True, text=True, check=True).stdout.split()
    assert set(modules) & {"numpy", "numba", "scipy", "pydantic", "netgen", "matplotlib", "sympy"} == set()


def test_the_command_ends_with_its_code():
    for module in ("turgor", "turgor.cli"):
        command = [sys.executable, "-m", module]
        assert subprocess.run([*command, "--version"], capture_output=True).returncode == 0
        assert subprocess.run([*command, "rum"], capture_output=True).returncode == 1
