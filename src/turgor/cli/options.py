"""Commands whose options are the fields of a dataclass."""

from collections.abc import Callable
from dataclasses import MISSING, fields
from inspect import Parameter, Signature
from typing import Any, TypeVar

Options = TypeVar("Options")


def command_of(options: Callable[..., Options], run: Callable[[Options], None]) -> Callable[..., None]:
    """Make a command of typer from a dataclass: each field is an argument or an option, according to its annotation.

    Parameters
    ----------
    options : type
        A dataclass whose fields are annotated with ``typer.Argument`` or ``typer.Option``.
    run : callable
        ``run(options)`` carries out the command; its docstring is the help text.

    Returns
    -------
    callable
    """

    def command(**given: Any) -> None:
        run(options(**given))

    items = fields(options)  # type: ignore[arg-type]
    defaults = [Parameter.empty if item.default is MISSING else item.default for item in items]
    command.__signature__ = Signature(  # type: ignore[attr-defined]
        [
            Parameter(item.name, Parameter.KEYWORD_ONLY, default=default, annotation=item.type)
            for item, default in zip(items, defaults, strict=True)
        ]
    )
    command.__annotations__ = {item.name: item.type for item in items}
    command.__doc__ = run.__doc__
    return command
