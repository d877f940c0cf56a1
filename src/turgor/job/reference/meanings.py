"""Meanings of keys, from the sections "Parameters" or "Keys" of docstrings."""

import inspect
import re
from collections.abc import Iterable
from typing import Any


def meanings(described: Any) -> dict[str, str]:
    """Read what a docstring says about each parameter.

    Parameters
    ----------
    described : class or function
        With a docstring in the form of numpydoc.

    Returns
    -------
    dict of str to str
        Text of one line by the name of the parameter, in the notation of Markdown.

    Examples
    --------
    >>> from turgor.core.model.obstacles import Sphere
    >>> meanings(Sphere)["radius"]
    'More than 0.'
    """
    texts: dict[str, str] = {}
    names: list[str] = []
    for line in _parameters(inspect.getdoc(described) or ""):
        if line and not line.startswith(" "):
            names = [name.strip() for name in line.split(":", 1)[0].split(",")]
            texts |= dict.fromkeys(names, "")
        elif line.strip():
            texts |= {name: f"{texts[name]} {line.strip()}".strip() for name in names}
    return {name: markdown(text) for name, text in texts.items()}


def markdown(text: str) -> str:
    """Turn the double backquotes of docstrings into single ones.

    Examples
    --------
    >>> markdown("see ``wall``")
    'see `wall`'
    """
    return re.sub(r"``(.+?)``", r"`\1`", text)


def meaning_of(name: str, described: Iterable[Any]) -> str:
    """Return the meaning of a key: the first that is no reference to another one; empty where there is none.

    Parameters
    ----------
    name : str
        The key.
    described : iterable of classes and functions
        Where to look; what a class inherits from comes after it.
    """
    every = [base for each in described for base in (each.__mro__ if isinstance(each, type) else (each,))]
    texts = (meanings(each).get(name, "") for each in every)
    return next((text for text in texts if text and not text.startswith("As ")), "")


def _parameters(text: str) -> list[str]:
    """Lines of the section "Parameters", or "Keys" of a table that pydantic reads."""
    match = re.search(r"(?:^|\n)(?:Parameters|Keys)\n-+\n(.*?)(?=\n\n\w[\w ]*\n-+\n|\Z)", text, re.DOTALL)
    return match[1].splitlines() if match else []
