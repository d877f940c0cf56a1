"""Command line: ``turgor`` and its commands, one file each; a client of the public functions."""

from turgor.cli.app import main as main
