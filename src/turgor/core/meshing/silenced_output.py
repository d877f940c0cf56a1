"""Suppress what compiled code writes to the terminal; the CAD kernel and the mesh generator share this."""

from turgor.core.geometry.silenced_output import captured_output as captured_output
