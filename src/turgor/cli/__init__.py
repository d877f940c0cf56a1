"""Command line: ``turgor`` and its commands, one file each; they call the public functions."""

from turgor.cli.app import command as command
from turgor.cli.app import main as main
