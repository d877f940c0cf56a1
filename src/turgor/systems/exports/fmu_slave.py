"""Slave: what runs inside a functional mock-up unit."""

import json
import re
from pathlib import Path
from typing import Any
from xml.etree.ElementTree import SubElement

import numpy as np

from turgor.core.solvers.load import load
from turgor.foundation.errors import TurgorError
from turgor.reduced.states.following import Moving, Stepping
from turgor.studies.runs.optional_parts import needed
from turgor.systems.control.forces import ContactForce
from turgor.systems.control.outputs import Angle, Points, Shape, Tip
from turgor.systems.learning.function import function
from turgor.systems.learning.outputs import Coordinates, Volumes

#: Files in the folder of the unit, and outputs by the names that stand there.
MODEL, OPTIONS = "model.reduced", "options.json"
KINDS: dict[str, Any] = {
    each.__name__: each for each in (Tip, Points, Shape, Angle, ContactForce, Volumes, Coordinates)
}  # fmt: skip


def slave_of(name: str, folder: Path) -> Any:
    """Make the class of a unit, of what its folder holds."""
    fmi = needed("pythonfmu", "a functional mock-up unit", "fmu")
    base: Any = fmi.Fmi2Slave
    error_status = needed("pythonfmu.enums", "a functional mock-up unit", "fmu").Fmi2Status.error
    reduced = load(folder / MODEL)
    options = json.loads((folder / OPTIONS).read_text(encoding="utf-8"))
    outputs = [KINDS[each.pop("kind")](**each) for each in options["outputs"]]
    made = function(reduced, outputs)
    moving = None if options["moving"] is None else Moving(**options["moving"])

    class Slave(base):  # type: ignore[misc]
        author, description = "turgor", repr(reduced)

        def __init__(self, **given: Any) -> None:
            super().__init__(**given)
            self.inputs = np.clip(0.0, reduced.inputs.low, reduced.inputs.high)
            self.values = np.zeros(len(made.names) + 1)
            self.stepping: Stepping | None = None
            for place, key in enumerate(reduced.inputs.keys):
                text = f"{reduced.inputs.low[place]:g} to {reduced.inputs.high[place]:g}, SI unit"
                self._add(key, self.inputs, place, fmi.Fmi2Causality.input, text)
            for place, output in enumerate((*made.names, "estimate")):
                self._add(output, self.values, place, fmi.Fmi2Causality.output, "SI unit")

        def _add(self, key: str, values: Any, place: int, causality: Any, text: str) -> None:
            def setter(value: float) -> None:
                values[place] = value

            self.register_variable(
                fmi.Real(
                    re.sub(r"\.(\d)$", r"[\1]", key), getter=lambda: float(values[place]), setter=setter,
                    causality=causality, description=text,
                ),
                nested=False,
            )  # fmt: skip

        def exit_initialization_mode(self) -> None:
            reduced.inputs.check(self.inputs)
            self.stepping = Stepping(reduced, self.inputs.copy(), moving)
            self._show(reduced.at(self.inputs.copy()))

        def do_step(self, current_time: float, step_size: float) -> bool:
            try:
                reduced.inputs.check(self.inputs)
                assert self.stepping is not None  # initialization comes first
                self._show(self.stepping.step(self.inputs.copy(), step_size))
            except TurgorError as error:
                self.log(f"at {current_time:g} s: {error}", error_status, "logStatusError")
                return False
            return True

        def to_xml(self, *given: Any) -> Any:
            root = super().to_xml(*given)
            initial = SubElement(root.find("ModelStructure"), "InitialUnknowns")  # pythonfmu leaves them out
            for each in root.find("ModelStructure/Outputs"):
                SubElement(initial, each.tag, each.attrib)
            return root

        def _show(self, state: Any) -> None:
            self.values[:] = [*made.of_state(state)[0], state.estimate]

    Slave.__name__ = Slave.__qualname__ = name
    return Slave
