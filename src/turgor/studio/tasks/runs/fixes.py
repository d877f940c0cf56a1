"""Fixes: values of keys that mend what a check has noticed, one line for each code; only those that are right."""

import re
from collections.abc import Callable, Mapping
from dataclasses import fields
from typing import Any

from turgor.core.solvers.procedures.listed import PROCEDURES
from turgor.foundation.finding import Finding

#: A label, and values by dotted keys; None removes a key.
Fix = dict[str, Any]

_PROBLEM = re.compile(r"(?:(?P<place>.*?:\d+|[^:]+): )?(?P<key>[\w.\"-]+): (?P<sentence>.+)", re.DOTALL)
_NEAR = re.compile(r"'([^']*)'[^;]*; did you mean '([^']+)'\?")
_NO_UNIT = re.compile(r"(\S+) needs a unit, for example '\S+ (.+?)'")


def _fix(label: str, values: Mapping[str, Any]) -> Fix:
    return {"label": label, "values": dict(values)}


def _always(label: str, **values: Any) -> Callable[[Finding, Mapping[str, Any]], list[Fix]]:
    named = {key.replace("__", "."): value for key, value in values.items()}
    return lambda finding, content: [_fix(label, named)]


def _size(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    stated = "size" in content.get("mesh", {})
    return [_fix("Let the quality choose the size", {"mesh.size": None})] if stated else []


def _finer(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    after = {"draft": "normal", "normal": "fine"}.get(content.get("mesh", {}).get("quality", "normal"))
    return [] if after is None else [_fix(f"Quality {after}", {"mesh.quality": after, "mesh.size": None})]


def _units(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    return [_fix(f"The file is in {unit}", {"actuator.unit": unit}) for unit in ("mm", "cm", "in")]


def _axes(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    if "not show its axis" in finding.message:
        return [_fix("Leave it as it lies", {"actuator.axes": ["x", "y", "z"]})]
    return []


def _shell(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    name = re.search(r"membrane on '(\w+)'", finding.message)
    if name is None or name[1] not in content.get("materials", {}):
        return []
    key = f"materials.{name[1]}"
    return [
        _fix("Make it a shell", {f"{key}.form": "shell", f"{key}.compression": None}),
        _fix("It wrinkles: tension only", {f"{key}.form": None, f"{key}.compression": 0}),
    ]


def _clamped(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    if "Clamp fixed" not in finding.advice:
        return []
    return [_fix("Clamp the face fixed", {"supports.tip": None, "supports.fixed": "xyz"})]


def _steps(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    step = re.search(r"procedure\.max_step = ([\d.e-]+)", finding.advice)
    if step is None:
        return []
    value = float(step[1])
    return [_fix(f"Steps of {value:g}", {"procedure.max_step": value, "procedure.first_step": value})]


def _remeshed(_finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    kind = content.get("procedure", {}).get("type", "static")
    able = kind in PROCEDURES and "remesh" in {each.name for each in fields(PROCEDURES[kind])}
    return [_fix("Cut cells where they degrade", {"procedure.remesh": True})] if able else []


#: What mends a finding, by its code.
FIXES: Mapping[str, Callable[[Finding, Mapping[str, Any]], list[Fix]]] = {
    "G01": _always("Two cells through every wall", mesh__wall_cells=2),
    "G09": _size,
    "G11": _always("Two cells through every wall", mesh__wall_cells=2),
    "G13": _always("Model the meridian", mesh__cells="axisymmetric"),
    "N02": _finer,
    "N05": _shell,
    "N06": _remeshed,
    "B02": _always("Switch self-contact on", contact__self_contact=True),
    "B28": _clamped,
    "D07": _always("Model the whole part", actuator__symmetry="none"),
    "D08": _axes,
    "L07": _steps,
    "P09": _units,
}


def fixes_of(finding: Finding, content: Mapping[str, Any]) -> list[Fix]:
    """Return what mends a finding in a job, each as a label with values by dotted keys.

    Examples
    --------
    >>> from turgor.foundation.finding import Severity
    >>> thin = Finding(code="G01", severity=Severity.WARNING, message="Thin.", advice="Refine.")
    >>> fixes_of(thin, {})
    [{'label': 'Two cells through every wall', 'values': {'mesh.wall_cells': 2}}]
    """
    return FIXES[finding.code](finding, content) if finding.code in FIXES else []


def problem_of(text: str, file: str, content: Mapping[str, Any]) -> dict[str, Any]:
    """Return a problem of a job file in parts: line, key, sentence, and the near match as a fix.

    Examples
    --------
    >>> text = "finger.toml:4: mesh.sizes: unknown key 'sizes'; did you mean 'size'? Known keys: size."
    >>> problem = problem_of(text, "finger.toml", {"mesh": {"sizes": "3 mm"}})
    >>> problem["line"], problem["key"], problem["fixes"][0]["values"]
    (4, 'mesh.sizes', {'mesh.sizes': None, 'mesh.size': '3 mm'})
    """
    match = _PROBLEM.fullmatch(text)
    if match is None:
        return {"line": None, "key": "", "sentence": text.replace(file, "the file"), "fixes": []}
    line = (match["place"] or "").rpartition(":")[2]
    known = {"line": int(line) if line.isdigit() else None, "key": match["key"], "sentence": match["sentence"]}
    fixes = [*_near(match["key"], match["sentence"], content), *_unit(match["key"], match["sentence"], content)]
    return {**known, "fixes": fixes}


def _unit(key: str, sentence: str, content: Mapping[str, Any]) -> list[Fix]:
    """The usual unit of a number that has none."""
    match, value = _NO_UNIT.match(sentence), _value(content, key)
    if match is None or isinstance(value, bool) or not isinstance(value, int | float):
        return []
    return [_fix(f"Write {value} {match[2]}", {key: f"{value} {match[2]}"})]


def _near(key: str, sentence: str, content: Mapping[str, Any]) -> list[Fix]:
    """The near match of a word that is unknown: a key of another name, or a value."""
    match = _NEAR.search(sentence)
    if match is None:
        return []
    word, near = match.groups()
    value, outer = _value(content, key), key.rpartition(".")[0]
    if value == word:
        return [_fix(f"Write {near}", {key: near})]
    whole = key if key.rpartition(".")[2] == word else f"{key}.{word}"
    value = _value(content, whole)
    if value is None:
        return []
    outer = whole.rpartition(".")[0]
    return [_fix(f"Rename to {near}", {whole: None, f"{outer}.{near}" if outer else near: value})]


def _value(content: Any, key: str) -> Any:
    """Value at a dotted key; None where there is none that can be moved."""
    for part in key.split("."):
        if not isinstance(content, Mapping) or part not in content:
            return None
        content = content[part]
    return content
