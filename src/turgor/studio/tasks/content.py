"""Content of a job file for the page, with what is wrong at which key."""

import json
import math
import re
from pathlib import Path
from typing import Any

from turgor.foundation.errors import TurgorError
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.tables.bodies.body_tables import ASSEMBLY, LATER
from turgor.job.tables.mesh_files import MESH_FILE
from turgor.job.text.lines import key_lines
from turgor.job.text.problems import Problems


def content_of(file: Path) -> tuple[dict[str, Any], Problems]:
    """Return the tables of a job file, and where its problems are noted.

    Raises
    ------
    TurgorError
        If the file is no TOML.
    """
    text = read_text(file)
    content = read_toml(text, file.name)
    return content, Problems(str(file), key_lines(text))


def noted(problems: Problems) -> list[dict[str, str]]:
    """Return each problem with its key and its sentence."""
    return [at_key(entry, problems.file) for _, entry in sorted(problems.entries, key=lambda each: each[0])]


def at_key(entry: str, file: str) -> dict[str, str]:
    """Return the key and the sentence of a problem.

    Examples
    --------
    >>> at_key("finger.toml:3: actuator.wall: -1 mm; allowed is 0.01 mm to 4 mm.", "finger.toml")
    {'key': 'actuator.wall', 'sentence': '-1 mm; allowed is 0.01 mm to 4 mm.'}
    """
    words = re.sub(r"\A:(\d+)", "", entry.removeprefix(file)).removeprefix(": ")
    key, _, sentence = words.partition(": ")
    return {"key": key, "sentence": sentence}


def plain(value: Any) -> Any:
    """Return a value of a TOML file in the form of JSON: dates and numbers that are none become text.

    Examples
    --------
    >>> plain({"wall": [1.5, float("nan")]})
    {'wall': [1.5, 'nan']}
    """
    if isinstance(value, dict):
        return {str(key): plain(each) for key, each in value.items()}
    if isinstance(value, list):
        return [plain(each) for each in value]
    if isinstance(value, float) and not math.isfinite(value):
        return str(value)
    return value if isinstance(value, str | int | float | bool) else str(value)


def actuator_in(content: dict[str, Any]) -> dict[str, Any]:
    """Return the table ``[actuator]`` of a job; a table ``[mesh]`` with a file stands for it, too.

    Examples
    --------
    >>> actuator_in({"mesh": {"file": "finger.msh"}})
    {'type': 'mesh_file', 'file': 'finger.msh'}
    """
    mesh = table_in(content, "mesh")
    if "bodies" in content:
        stated = {key: value for key, value in mesh.items() if key not in LATER}
        return {"type": ASSEMBLY, "bodies": table_in(content, "bodies"), "mesh": stated}
    if "actuator" not in content and "file" in mesh:
        return {"type": MESH_FILE, **mesh}
    return table_in(content, "actuator")


def table_in(content: dict[str, Any], name: str) -> dict[str, Any]:
    """Return a table of a job; raise an error where it is none."""
    table = content.get(name, {})
    if not isinstance(table, dict):
        raise TurgorError(f"'{name}' is {json.dumps(plain(table))}; a table [{name}] is needed.")
    return table
