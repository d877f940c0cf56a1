"""The JSON document that ``--json`` prints."""

import json
from collections.abc import Iterable, Mapping
from dataclasses import fields, is_dataclass
from math import isfinite
from pathlib import Path
from typing import TYPE_CHECKING, Any

from turgor import __version__

if TYPE_CHECKING:
    from turgor.foundation.finding import Finding


def document(code: int, result: object, findings: "Iterable[Finding]", error: str) -> str:
    """Write the document of a command.

    Parameters
    ----------
    code : int
        Exit code.
    result : dataclass or None
        Result of the command; one of `turgor.cli.answers.results`.
    findings : iterable of Finding
    error : str
        Sentences, one in a line; empty where there is none.

    Examples
    --------
    >>> json.loads(document(1, None, (), "there is no job file 'a.toml'."))["error"]["problems"]
    ["there is no job file 'a.toml'."]
    """
    content = {
        "turgor": __version__,
        "exit_code": code,
        "error": {"message": error, "problems": error.splitlines()} if error else None,
        "findings": [plain(each) for each in findings],
        "result": plain(result),
    }
    return json.dumps(content, indent=2, ensure_ascii=False, allow_nan=False)


def plain(value: Any) -> Any:
    """Return a value as JSON has it: numbers that are not finite are null.

    Examples
    --------
    >>> plain({"a": (1.0, float("nan"))})
    {'a': [1.0, None]}
    """
    if is_dataclass(value) and not isinstance(value, type):
        return {item.name: plain(getattr(value, item.name)) for item in fields(value)}
    if isinstance(value, Mapping):
        return {str(name): plain(each) for name, each in value.items()}
    if isinstance(value, str | bool | int) or value is None:
        return str(value) if isinstance(value, str) else value
    if isinstance(value, float):
        return float(value) if isfinite(value) else None
    if isinstance(value, Path):
        return str(value)
    if hasattr(value, "tolist"):
        return plain(value.tolist())
    return [plain(each) for each in value]
