"""Runs the command line as ``python -m turgor.cli``."""

from turgor.cli.app import command

if __name__ == "__main__":
    command()
