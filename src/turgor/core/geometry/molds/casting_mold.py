"""The mold of an actuator, in the way that fits it."""

from dataclasses import replace
from typing import Any

from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
from turgor.core.geometry.actuators.slow_pneunet import SlowPneuNet
from turgor.core.geometry.cad.cad_file import CadFile
from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.molds.mold import Mold, MoldSettings
from turgor.core.geometry.molds.pneunet_mold import pneunet_mold
from turgor.core.geometry.molds.two_halves import two_halves


def casting_mold(actuator: Any, settings: MoldSettings | None = None) -> Mold:
    """Make a mold to cast an actuator in.

    PneuNets get a cup, a core plate, and a tray for the layer that closes their chambers. Every other part with CAD
    faces gets two halves with pins, holes to pour, and a core for each cavity that stands out of the mold through its
    opening. The halves are pulled along x, y or z from the plane with the least undercut.

    Parameters
    ----------
    actuator : actuator family, CadFile or Geometry
        What to cast; a half or quarter model is cast as a whole.
    settings : MoldSettings, optional
        Dimensions of the mold.

    Returns
    -------
    Mold
        ``cup``, ``core`` and ``tray``; or ``lower``, ``upper`` and ``core`` (``core_1``, ``core_2``, …), and how they
        open.

    Raises
    ------
    TurgorError
        If no two halves come off, a cavity has no plane opening, or the part is not of CAD faces.

    Examples
    --------
    >>> mold = casting_mold(FastPneuNet(chambers=2, length=20e-3))
    >>> {name: round(part.solid_volume * 1e9) for name, part in mold.parts.items()}  # mm³
    {'cup': 21430, 'core': 12350, 'tray': 13056}
    >>> from turgor.core.geometry.actuators.extending_cylinder import ExtendingCylinder
    >>> mold = casting_mold(ExtendingCylinder(inlet_diameter=4e-3))
    >>> list(mold.parts)
    ['lower', 'upper', 'core']
    >>> mold.notes[0]
    'The halves part at z = 0 mm and are pulled along z.'
    """
    mold = settings or MoldSettings()
    if isinstance(actuator, FastPneuNet | SlowPneuNet):
        return pneunet_mold(actuator, mold)
    if isinstance(actuator, CadFile):
        actuator = replace(actuator, symmetry="none")
    elif hasattr(actuator, "symmetric"):
        actuator = replace(actuator, symmetric=False)
    return two_halves(actuator if isinstance(actuator, Geometry) else actuator.build(), mold)
