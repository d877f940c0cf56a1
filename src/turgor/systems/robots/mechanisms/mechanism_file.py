"""Files of a mechanism: arms of reduced models and rods, their pressures, and an object, in TOML."""

from collections.abc import Mapping
from dataclasses import dataclass, fields
from pathlib import Path
from types import MappingProxyType
from typing import Any

from turgor.core.engine.runtime import EngineOptions
from turgor.core.model.obstacles.rigid_shape import RigidShape, dimension_of
from turgor.foundation.errors import TurgorError, near_file, unknown
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.tables.obstacles import SHAPES
from turgor.job.text.overrides import changed
from turgor.reduced.states.reduced import Reduced
from turgor.systems.robots.chains.chain_of import FittedChain, chain_of
from turgor.systems.robots.chains.chain_of_rod import RodChain
from turgor.systems.robots.mechanisms.mechanism import DOWN, Arm, Mechanism, Segment
from turgor.systems.robots.mechanisms.rod_segment import rod_chain
from turgor.systems.robots.mechanisms.values import checked_keys, quantity, table, vector

#: Keys of each table.
TOP = ("name", "gravity", "contact_stiffness", "object", "arms")
ARM, SEGMENT = ("position", "turn", "segments"), ("file", "rod", "pressures", "roll", "links")


@dataclass(frozen=True, eq=False)
class MechanismFile:
    """What a file of a mechanism says.

    Parameters
    ----------
    name : str
    mechanism : Mechanism
    errors : mapping of str to str
        What is known of the errors of the chain of each file, and of each rod by its place.
    """

    name: str
    mechanism: Mechanism
    errors: Mapping[str, str]


def read_mechanism(path: str | Path, changes: Mapping[str, Any] = MappingProxyType({})) -> MechanismFile:
    """Read a file of a mechanism; chains are made of its reduced models and rods.

    Parameters
    ----------
    path : str or Path
    changes : mapping of str to value
        Values that replace or join those of the file, by dotted key.

    Returns
    -------
    MechanismFile

    Raises
    ------
    TurgorError
        If anything in the file is wrong: key, value and what is allowed.
    """
    path = Path(path)
    if not path.exists():
        there = sorted(each.name for each in path.parent.glob("*.toml")) if path.parent.is_dir() else []
        raise TurgorError(f"there is no file '{path}'{near_file(path, there)}")
    content = changed(read_toml(read_text(path), str(path)), {}, changes)
    checked_keys(content, TOP, "the file")
    arms = content.get("arms")
    if not isinstance(arms, Mapping) or not arms:
        raise TurgorError(f"'{path}' has no table [arms.NAME]; one at least is needed.")
    chains = _Chains(path.parent)
    made = [_arm(name, table(given, f"arms.{name}"), chains) for name, given in arms.items()]
    gravity = content.get("gravity", True)
    if not isinstance(gravity, bool):
        raise TurgorError(f"gravity is {gravity!r}; allowed is true, downward along z, or false.")
    stiffness = quantity(content.get("contact_stiffness", "500 N/m"), "spring stiffness", "contact_stiffness")
    mechanism = Mechanism(
        arms=made, object=_object(content), gravity=DOWN if gravity else (0.0, 0.0, 0.0), contact_stiffness=stiffness
    )
    return MechanismFile(str(content.get("name", path.stem)), mechanism, chains.texts)


class _Chains:
    """Chains of reduced models, each made once, and of rods."""

    def __init__(self, folder: Path) -> None:
        self.folder, self.texts = folder, dict[str, str]()
        self._made: dict[tuple[str, int | None], FittedChain] = {}

    def of(self, given: Mapping[str, Any], pressures: Mapping[str, float], where: str) -> "FittedChain | RodChain":
        """Chain of a segment: of a file next to the file of the mechanism, or of a rod."""
        links = given.get("links")
        if links is not None and type(links) is not int:
            raise TurgorError(f"{where}.links is {links!r}; a whole number is needed.")
        if "rod" in given and "file" not in given:
            rod = rod_chain(table(given["rod"], f"{where}.rod"), links, pressures, f"{where}.rod")
            self.texts[where] = rod.text
            return rod
        name = given.get("file")
        if "rod" in given:
            raise TurgorError(f"{where} has both file and rod; one of them is allowed.")
        if not isinstance(name, str):
            raise TurgorError(f"{where}.file is missing; the name of a file of `turgor reduce`, or a rod, is needed.")
        if (name, links) not in self._made:
            made = chain_of(Reduced.load(self.folder / name), links, options=EngineOptions())
            self._made[name, links], self.texts[name] = made, made.text
        return self._made[name, links]


def _arm(name: str, given: Mapping[str, Any], chains: _Chains) -> Arm:
    where = f"arms.{name}"
    checked_keys(given, ARM, where)
    segments = given.get("segments")
    if not isinstance(segments, list) or not segments:
        raise TurgorError(f"{where} has no [[{where}.segments]]; one at least is needed.")
    made = [_segment(table(each, where), f"{where}.segments[{k}]", chains) for k, each in enumerate(segments, start=1)]
    return Arm(
        segments=made, name=name, position=vector(given, "position", "length", where),
        turn=vector(given, "turn", "angle", where),
    )  # fmt: skip


def _segment(given: Mapping[str, Any], where: str, chains: _Chains) -> Segment:
    checked_keys(given, SEGMENT, where)
    pressures = {
        key: quantity(value, "pressure", f"{where}.pressures.{key}")
        for key, value in _flat(table(given.get("pressures", {}), f"{where}.pressures")).items()
    }
    roll = quantity(given.get("roll", "0 deg"), "angle", f"{where}.roll")
    segment = Segment(chain=chains.of(given, pressures, where).chain, pressures=pressures, roll=roll)
    try:
        segment.values  # noqa: B018  an error names the place now
    except TurgorError as error:
        raise TurgorError(f"{where}.pressures: {error}") from None
    return segment


def _object(content: Mapping[str, Any]) -> RigidShape | None:
    if "object" not in content:
        return None
    given = dict(table(content["object"], "object"))
    name = given.pop("shape", None)
    if name not in SHAPES:
        raise unknown("object.shape", str(name), SHAPES)
    kind: Any = SHAPES[name]
    checked_keys(given, tuple(field.name for field in fields(kind)), "object")
    for field in fields(kind):
        if field.name in given and not isinstance(given[field.name], list):
            given[field.name] = quantity(given[field.name], dimension_of(field), f"object.{field.name}")
    try:
        shape: RigidShape = kind(**given)
    except TypeError:
        needed = ", ".join(field.name for field in fields(kind))
        raise TurgorError(f"object: a {name} has the keys {needed}; one is missing.") from None
    return shape


def _flat(given: Mapping[str, Any], before: str = "") -> dict[str, Any]:
    """Values by dotted keys."""
    out: dict[str, Any] = {}
    for key, value in given.items():
        out |= _flat(value, f"{before}{key}.") if isinstance(value, Mapping) else {f"{before}{key}": value}
    return out
