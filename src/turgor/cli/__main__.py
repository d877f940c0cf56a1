"""Runs the command line as ``python -m turgor.cli``."""

import sys

from turgor.cli.app import command

if __name__ == "__main__":
    sys.exit(command())
