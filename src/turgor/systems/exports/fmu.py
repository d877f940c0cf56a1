"""write_fmu: a reduced model as a functional mock-up unit for co-simulation (FMI 2.0)."""

import json
import re
import sys
from collections.abc import Sequence
from dataclasses import asdict
from hashlib import sha256
from pathlib import Path
from tempfile import TemporaryDirectory

from turgor.foundation.errors import TurgorError
from turgor.reduced.states.following import Moving
from turgor.reduced.states.reduced import Reduced
from turgor.studies.runs.optional_parts import needed
from turgor.systems.control.outputs import Output, Tip
from turgor.systems.exports.fmu_slave import KINDS, MODEL, OPTIONS
from turgor.systems.learning.outputs import Volumes

SCRIPT = '''"""A reduced model of turgor."""

import ctypes
from pathlib import Path

from turgor.systems.exports.fmu_slave import slave_of

# the loader of pythonfmu 0.7 releases these globals once too often for each instance
ctypes.pythonapi.Py_IncRef(ctypes.py_object(globals()))
{name} = slave_of("{name}", Path(__file__).parent)
'''


def write_fmu(
    reduced: Reduced,
    path: str | Path,
    outputs: Sequence[Output] = (Tip(), Volumes()),
    *,
    moving: Moving | None = None,
) -> Path:
    """Write a reduced model as a functional mock-up unit for co-simulation (FMI 2.0).

    Variables are the inputs of the reduced model, by their keys, and the numbers of the outputs with ``estimate``, the
    estimated error of the displacement over the largest in training; all in SI units. After a step the outputs belong
    to the inputs that were set before it. A step is refused where an input lies outside of the trained range.

    The unit is run by the Python in which turgor is installed, with the binaries of pythonfmu for Linux and Windows on
    x86-64.

    Parameters
    ----------
    reduced : Reduced
    path : str or Path
        The ending ``.fmu`` is added. Its stem is the name of the model.
    outputs : sequence of Output
        `Tip`, `Points`, `Shape`, `Angle`, `ContactForce`, `Volumes` or `Coordinates`.
    moving : Moving, optional
        Inertia, damping and the longest time step; without, every state is an equilibrium.

    Returns
    -------
    Path

    Raises
    ------
    TurgorError
        If an output is of another kind, the model was trained without motion, or pythonfmu is not installed.
    """
    builder = needed("pythonfmu.builder", "write_fmu", "fmu").FmuBuilder
    file = Path(path)
    file = file if file.suffix == ".fmu" else file.with_name(file.name + ".fmu")
    for output in outputs:
        if type(output) not in KINDS.values():
            raise TurgorError(f"the output is {output!r}; allowed are {', '.join(KINDS)}.")
        output.of(reduced)
    if moving is not None and reduced.masses is None:
        raise TurgorError("this reduced model was trained without motion; train it with motion.")
    name = re.sub(r"\W", "_", file.stem)
    name = name if name[:1].isalpha() else f"model_{name}"
    kinds = {kind: name for name, kind in KINDS.items()}
    options = {
        "outputs": [{"kind": kinds[type(output)], **asdict(output)} for output in outputs],  # type: ignore[call-overload]
        "moving": None if moving is None else asdict(moving),
    }
    with TemporaryDirectory() as folder:
        model, listed = reduced.save(Path(folder) / MODEL), Path(folder) / OPTIONS
        listed.write_text(json.dumps(options), encoding="utf-8")
        # a name of its own: a simulator may run several units in one process, which imports each script once
        module = f"{name}_{sha256(model.read_bytes() + listed.read_bytes()).hexdigest()[:12]}"
        script = Path(folder) / f"{module}.py"
        script.write_text(SCRIPT.format(name=name), encoding="utf-8")
        known = list(sys.path)
        try:
            builder.build_FMU(script, dest=file.absolute(), project_files={model, listed})
        finally:
            sys.path[:] = known
            sys.modules.pop(module, None)
    return file
