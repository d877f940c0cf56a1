"""Formulas that SymPy has derived, cached on disk as data: deriving them takes most of a second in every process.

A formula is a list of arithmetic operations, one after the other. An entry of the cache holds their names and operands
as text; nothing in it is executed. Its key is what was derived from what: the files of all laws, the law, and what was
requested. So a change of any law derives again. Laws from outside of the package are derived in every process, since
their files may call others that are not known here.
"""

import ast
import inspect
import json
import operator
from collections.abc import Callable, Mapping, Sequence
from contextlib import suppress
from dataclasses import dataclass, field
from types import MappingProxyType
from typing import Any

import numpy as np

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.cached_values import Cache, sources

#: Operations of a formula by the name that a file gives them.
OPERATIONS: Mapping[str, Callable[..., Any]] = MappingProxyType(
    {
        "Add": operator.add, "Sub": operator.sub, "Mult": operator.mul, "Div": operator.truediv, "Pow": operator.pow,
        "USub": operator.neg, "log": np.log, "exp": np.exp, "sqrt": np.sqrt,
    }
)  # fmt: skip

#: Operations with one operand.
UNARY = frozenset({"USub", "log", "exp", "sqrt"})

#: Most operations of a formula; the longest of the laws here has some hundred.
MOST_OPERATIONS = 100_000

#: The formulas that were derived before.
FORMULAS = Cache("laws", 20e6)


@dataclass(frozen=True, slots=True)
class Formulas:
    """Results that follow from inputs by arithmetic operations.

    Values are numbered: first the inputs, then the constants, then the results of the operations in order.

    Parameters
    ----------
    inputs : int
        Number of inputs.
    constants : tuple of float or int
    operations : tuple of (str, int) or (str, int, int)
        Name of each operation and the numbers of its operands.
    results : tuple of int
        Numbers of the values to return.

    Examples
    --------
    >>> Formulas(2, (3,), (("Sub", 0, 2), ("Mult", 1, 3)), (4, 3))(5.0, 2.0)
    [4.0, 2.0]
    """

    inputs: int
    constants: tuple[float | int, ...]
    operations: tuple[tuple[Any, ...], ...]
    results: tuple[int, ...]
    _done: tuple[tuple[int, ...], ...] = field(init=False, repr=False, compare=False, default=())

    def __post_init__(self) -> None:
        known = self.inputs + len(self.constants)
        if not 0 <= self.inputs < MOST_OPERATIONS or len(self.operations) > MOST_OPERATIONS:
            raise TurgorError(
                f"a formula has {self.inputs} inputs and {len(self.operations)} operations; allowed are "
                f"{MOST_OPERATIONS} at most."
            )
        for name, *operands in self.operations:
            if len(operands) != (1 if name in UNARY else 2) or name not in OPERATIONS:
                raise TurgorError(f"a formula has no operation '{name}' with {len(operands)} operands.")
            if not all(type(each) is int and 0 <= each < known for each in operands):
                raise TurgorError(f"operands {operands} of a formula are not among its {known} values.")
            known += 1
        if not all(type(each) is int and 0 <= each < known for each in self.results):
            raise TurgorError(f"results {self.results} of a formula are not among its {known} values.")
        if not all(type(each) in (int, float) for each in self.constants):
            raise TurgorError("constants of a formula are numbers.")
        object.__setattr__(self, "_done", _last_uses(self.operations, self.results))

    def __call__(self, *inputs: Any) -> list[Any]:
        """Return the results for inputs, which are numbers or arrays; a value is dropped after its last use."""
        values: list[Any] = [*inputs, *self.constants]
        for number, (name, *operands) in enumerate(self.operations):
            values.append(OPERATIONS[name](*(values[each] for each in operands)))
            for each in self._done[number]:
                values[each] = None
        return [values[each] for each in self.results]

    @property
    def text(self) -> str:
        """The formula as JSON."""
        return json.dumps([self.inputs, self.constants, self.operations, self.results])

    @staticmethod
    def read(text: str) -> "Formulas":
        """Read `text`; a `ValueError` if it is no formula."""
        try:
            inputs, constants, operations, results = json.loads(text)
            return Formulas(inputs, tuple(constants), tuple(map(tuple, operations)), tuple(results))
        except (TypeError, RecursionError) as error:
            raise ValueError(f"this is no formula: {error}.") from None


def _last_uses(operations: Sequence[tuple[Any, ...]], results: Sequence[int]) -> tuple[tuple[int, ...], ...]:
    """Values that no later operation needs, for each operation."""
    last = {each: number for number, (_, *operands) in enumerate(operations) for each in operands}
    done: list[list[int]] = [[] for _ in operations]
    for value, number in last.items():
        if value not in results:
            done[number].append(value)
    return tuple(map(tuple, done))


def cached_formulas(law_type: type, requested: object, derive: Callable[[], Callable[..., Any]]) -> Callable[..., Any]:
    """Return the formulas that ``derive`` makes, from disk where they were derived before.

    Parameters
    ----------
    law_type : type
        The law.
    requested : object
        What else decides the formulas; its text is compared.
    derive : callable
        Makes a function with ``sympy.lambdify``, for NumPy.

    Returns
    -------
    callable
        `Formulas`, or what SymPy made for a law from outside of the package.
    """
    if not law_type.__module__.startswith(f"{__package__}."):
        return derive()
    key = sources(__package__), f"{law_type.__module__}.{law_type.__qualname__}", repr(requested)
    text = FORMULAS.get(*key)
    if isinstance(text, str):
        with suppress(ValueError):  # an entry that others have changed
            return Formulas.read(text)
    formulas = formulas_of(derive())
    FORMULAS.put(formulas.text, *key)
    return formulas


def formulas_of(function: Callable[..., Any]) -> Formulas:
    """Return what a function of ``sympy.lambdify`` computes.

    Raises
    ------
    TurgorError
        If it does anything but arithmetic.
    """
    (definition,) = ast.parse(inspect.getsource(function)).body
    assert isinstance(definition, ast.FunctionDef)
    reader = _Reader({argument.arg: k for k, argument in enumerate(definition.args.args)})
    *lines, last = definition.body
    for line in lines:
        assert isinstance(line, ast.Assign)
        assert isinstance(line.targets[0], ast.Name)
        reader.names[line.targets[0].id] = reader.read(line.value)
    assert isinstance(last, ast.Return)
    assert isinstance(last.value, ast.List)
    return reader.formulas([reader.read(each) for each in last.value.elts])


class _Reader:
    """Turns expressions into operations; constants are numbered last and moved before the operations at the end."""

    def __init__(self, names: dict[str, int]) -> None:
        self.names: dict[str, Any] = dict(names)
        self.inputs = len(names)
        self.constants: list[float | int] = []
        self.operations: list[tuple[Any, ...]] = []

    def read(self, node: ast.expr) -> Any:
        """Return the place of the value of an expression: an input, a constant or the result of an operation."""
        if isinstance(node, ast.Name) and node.id in self.names:
            return self.names[node.id]
        if isinstance(node, ast.Constant) and type(node.value) in (int, float):
            self.constants.append(node.value)  # type: ignore[arg-type]
            return ("constant", len(self.constants) - 1)
        if isinstance(node, ast.BinOp):
            return self._operation(type(node.op).__name__, node.left, node.right)
        if isinstance(node, ast.UnaryOp):
            return self._operation(type(node.op).__name__, node.operand)
        if isinstance(node, ast.Call) and isinstance(node.func, ast.Name) and not node.keywords:
            return self._operation(node.func.id, *node.args)
        raise TurgorError(f"the energy of a law leads to '{ast.unparse(node)}', which is no arithmetic known here.")

    def _operation(self, name: str, *operands: ast.expr) -> tuple[str, int]:
        if name not in OPERATIONS:
            raise TurgorError(f"the energy of a law uses '{name}'; known are {', '.join(OPERATIONS)}.")
        self.operations.append((name, *(self.read(each) for each in operands)))
        return ("operation", len(self.operations) - 1)

    def formulas(self, results: list[Any]) -> Formulas:
        """Return the formulas with all values numbered."""
        first = {"constant": self.inputs, "operation": self.inputs + len(self.constants)}

        def number(place: Any) -> int:
            return place if isinstance(place, int) else first[place[0]] + int(place[1])

        operations = tuple((name, *map(number, operands)) for name, *operands in self.operations)
        return Formulas(self.inputs, tuple(self.constants), operations, tuple(map(number, results)))
