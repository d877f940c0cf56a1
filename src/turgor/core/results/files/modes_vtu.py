"""Modes for ParaView: one VTU file for each mode shape, a PVD that lists them by frequency or load."""

from pathlib import Path
from xml.sax.saxutils import quoteattr

from turgor.core.results.files.vtu import grid_text
from turgor.core.results.files.vtu_xml import VtuArray
from turgor.core.solvers.buckling.buckling_modes import BucklingModes
from turgor.core.solvers.dynamics.modes import Modes


def write_modes(folder: str | Path, modes: Modes | BucklingModes, name: str = "mode") -> Path:
    """Write every mode shape as VTU, and a PVD file that lists them; its time is the frequency [Hz] or load factor.

    Point data: ``displacement`` [m] of the state that vibrates or buckles, and ``mode_shape``, whose largest vector
    is 1 long. `Warp By Vector` with the mode shape needs a factor of some millimeters.

    Parameters
    ----------
    folder : str or Path
        Folder to write into; made where it is not there.
    modes : Modes or BucklingModes
        From `natural_frequencies` or `buckling_modes`.
    name : str
        Beginning of the file names: ``mode.pvd``, ``mode_0000.vtu`` …

    Returns
    -------
    Path
        The PVD file.
    """
    folder, entries = Path(folder), []
    folder.mkdir(parents=True, exist_ok=True)
    (named, times, unit), *_ = modes.by_mode
    for number, (time, shape) in enumerate(zip(times, modes.shapes, strict=True)):
        point_data = [
            VtuArray("displacement", modes.displacement.astype("f8"), "m", ("X", "Y", "Z")),
            VtuArray("mode_shape", shape.astype("f8"), "", ("X", "Y", "Z")),
        ]
        of_mode = [VtuArray(key, values[number : number + 1].astype("f8"), unit) for key, values, unit in modes.by_mode]
        file = f"{name}_{number:04d}.vtu"
        (folder / file).write_text(grid_text(modes.model.mesh, point_data, [], of_mode), encoding="utf-8")
        entries.append(f'<DataSet timestep="{time:.12g}" part="0" file={quoteattr(file)}/>')
    lines = ['<?xml version="1.0"?>', '<VTKFile type="Collection" version="1.0" byte_order="LittleEndian">']
    text = "\n".join(
        [
            *lines,
            f"<!-- timestep is the {named.replace('_', ' ')} [{unit or '-'}] -->",
            "<Collection>",
            *entries,
            "</Collection>",
        ]
    )
    (folder / f"{name}.pvd").write_text(f"{text}\n</VTKFile>\n", encoding="utf-8")
    return folder / f"{name}.pvd"
