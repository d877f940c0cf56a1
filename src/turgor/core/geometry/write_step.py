"""Writing of a geometry as a STEP file."""

from pathlib import Path

from turgor.core.geometry.geometry import Geometry
from turgor.core.geometry.silenced_output import captured_output
from turgor.foundation.errors import TurgorError


def write_step(geometry: Geometry, path: str | Path) -> None:
    """Write a geometry as a STEP file in millimeters; the names of its regions and faces are kept.

    Parameters
    ----------
    geometry : Geometry
        Geometry to write; a half model is written as a half.
    path : str or Path
        The file.

    Raises
    ------
    TurgorError
        If the file cannot be written.

    Examples
    --------
    >>> from tempfile import TemporaryDirectory
    >>> from turgor.core.geometry.actuators.fast_pneunet import FastPneuNet
    >>> with TemporaryDirectory() as folder:
    ...     write_step(FastPneuNet(chambers=2, length=20e-3).build(), f"{folder}/finger.step")
    ...     Path(f"{folder}/finger.step").read_text()[:12]
    'ISO-10303-21'
    """
    file = Path(path)
    if not file.parent.is_dir():
        raise TurgorError(f"'{file}' cannot be written: there is no folder '{file.parent}'.")
    with captured_output():  # the kernel reports the transfer on the terminal
        geometry._cad.WriteStep(str(file))
    if not file.is_file():
        raise TurgorError(f"'{file}' cannot be written by the CAD kernel.")
