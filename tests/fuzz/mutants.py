"""Mutants of files for the fuzzers: the same seed makes the same mutant, on every machine."""

import random
import re
from collections.abc import Iterator
from typing import Any

#: Values that no key expects, or that few do.
JUNK: tuple[Any, ...] = (
    0, -1, 7, 10**30, 1e300, -0.0, float("nan"), float("inf"), True, "", " ", "x", "1 mm", "-3 mm", "1e9 mm", "5 kPa",
    "1e400 kPa", "nan mm", "60 °", "1,5 mm", "1 mm mm", "mm", "9 kp", "cavity", "tip", "../..", "a" * 3000, "\u0000",
    [], [[]], [0], ["x"], [1, 2, 3], ["1 mm", "2 mm", "3 mm"], [[0, 0], [1, 1]], {}, {"x": 1}, {"type": "x"}, {"": {}},
)  # fmt: skip

#: Numbers that upset geometry.
NUMBERS = ("0.", "-1.", "1.E300", "1.E-300", "1.E10", "NAN", "7.3", "-0.", "1e-9")


def check_sentence(error: Exception) -> None:
    """Complain about an error that does not end like a sentence, or that nobody reads to its end."""
    said = str(error).strip()
    assert said.endswith((".", "?", ")", "'")), said[-300:]
    assert max(map(len, said.split("\n"))) < 2000, "a line of more than 2000 characters"
    assert "Traceback" not in said


def places(value: Any, path: tuple[Any, ...] = ()) -> Iterator[tuple[Any, ...]]:
    """Every place in nested tables and lists."""
    entries = value.items() if isinstance(value, dict) else enumerate(value) if isinstance(value, list) else ()
    for key, entry in entries:
        yield (*path, key)
        yield from places(entry, (*path, key))


def changed_table(table: dict[str, Any], chance: random.Random) -> None:
    """Change one entry of nested tables: its value, unit, type or key, or take it away."""
    path = chance.choice(list(places(table)))
    holder: Any = table
    for key in path[:-1]:
        holder = holder[key]
    key, old = path[-1], holder[path[-1]]
    kind = chance.randrange(6)
    if kind == 0:
        holder[key] = chance.choice(JUNK)
    elif kind == 1 and isinstance(old, str):
        holder[key] = changed_text(old, chance)
    elif kind == 2 and isinstance(holder, dict):
        holder[changed_text(str(key), chance)] = holder.pop(key)
    elif kind == 3:
        del holder[key]
    elif kind == 4:
        holder[key] = [old] if chance.random() < 0.5 else {"value": old}
    else:
        number = old if isinstance(old, str) else str(old)
        factor = chance.choice((0, -1, 1e-3, 1e3, 1e9, 0.5))
        holder[key] = re.sub(r"\d+(\.\d+)?", lambda m: f"{float(m[0]) * factor:g}", number, count=1)


def changed_text(text: str, chance: random.Random) -> str:
    """Change a few characters, or cut a piece out."""
    for _ in range(chance.choice((1, 1, 2, 8))):
        a = chance.randrange(len(text) + 1)
        b = min(len(text), a + chance.choice((0, 1, 1, 3, 40)))
        text = text[:a] + "".join(chance.choices(' \n\t"=[]{}.,-+eE019azé#', k=chance.choice((0, 1, 1, 4)))) + text[b:]
    return text


def changed_lines(text: str, chance: random.Random) -> str:
    """Change numbers, references and lines of a file for programs, such as STEP or .inp."""
    for _ in range(chance.choice((1, 1, 2, 4))):
        lines = text.split("\n")
        i, j = chance.randrange(len(lines)), chance.randrange(len(lines))
        kind = chance.randrange(6)
        if kind == 0:
            del lines[i]
        elif kind == 1:
            lines[i] = _replaced(lines[i], r"(?<=[(,])#\d+", chance.choice(re.findall(r"#\d+", text) or ["#1"]), chance)
        elif kind == 2:
            lines[i] = _replaced(lines[i], r"-?\d+\.\d*(?:[eE][-+]?\d+)?", chance.choice(NUMBERS), chance)
        elif kind == 3:
            lines[i] = changed_text(lines[i], chance)
        elif kind == 4:
            lines[i] = _replaced(lines[i], r"-?\b\d+\b", chance.choice(("0", "-1", "999999999", "3", "12")), chance)
        else:
            lines[i], lines[j] = lines[j], lines[i]
        text = "\n".join(lines)
    return text


def changed_bytes(content: bytes, chance: random.Random) -> bytes:
    """Change, cut out or repeat some bytes."""
    out = bytearray(content)
    for _ in range(chance.choice((1, 1, 2, 8))):
        a = chance.randrange(len(out) + 1)
        b = min(len(out), a + chance.choice((0, 1, 4, 50, 400)))
        out[a:b] = chance.choice((b"", bytes(chance.randrange(256) for _ in range(b - a)), bytes(out[a:b]) * 2))
    return bytes(out)


def _replaced(line: str, pattern: str, by: str, chance: random.Random) -> str:
    results = list(re.finditer(pattern, line))
    if not results:
        return line
    at = chance.choice(results)
    return line[: at.start()] + by + line[at.end() :]
