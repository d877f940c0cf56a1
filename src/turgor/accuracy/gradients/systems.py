"""Systems: the equations of models at which several states of a path are differentiated, made once."""

from collections.abc import Callable
from dataclasses import dataclass, field
from typing import Any, TypeVar

from turgor.core.engine.algebra.tangent import Tangent
from turgor.core.engine.runtime import FEW_UNKNOWNS, EngineOptions
from turgor.core.engine.system import System
from turgor.core.model.model import Model

#: What equations belong to: a model, and what is requested of it.
Key = tuple[int, object]

Value = TypeVar("Value")


@dataclass(slots=True, eq=False)
class Systems:
    """Equations by the model that they are of. Small ones take longer to set up than to solve.

    Those of a larger mesh are not cached, because they take much memory and save little time.
    """

    _known: dict[Key, tuple[Model, Any]] = field(default_factory=dict)

    def of(self, model: Model, controlled: tuple[str, ...]) -> System:
        """Return the equations of a model whose states are differentiated.

        Parameters
        ----------
        model : Model
        controlled : tuple of str
            Cavities whose pressure is unknown.

        Returns
        -------
        System
        """
        return self._cached(model, controlled, lambda: System(model, controlled))

    def tangent_of(self, model: Model, system: System, options: EngineOptions) -> Tangent:
        """Return the tangent of such equations, analyzed for what touches now.

        Parameters
        ----------
        model : Model
        system : System
            Of the model.
        options : EngineOptions

        Returns
        -------
        Tangent
        """
        what = system.controlled, options.linear_solver, options.threads
        tangent = self._cached(model, what, lambda: Tangent(system, options.linear_solver, options.threads))
        tangent.use_double()  # a solution in single precision takes two or three refinements, every answer five of them
        return tangent

    def near(self, model: Model, contact_model: Model, touching: bool, like: System) -> System:
        """Return the equations of a model at a nearby value of a number.

        Parameters
        ----------
        model : Model
        contact_model : Model
            The same with what may touch at the state.
        touching : bool
            Whether anything touches there.
        like : System
            That has their scales.

        Returns
        -------
        System
        """
        return self._cached(model, (id(like), touching), lambda: System(contact_model, like.controlled, like=like))

    def _cached(self, model: Model, what: object, make: Callable[[], Value]) -> Value:
        key = id(model), what
        if key in self._known:
            cached: Value = self._known[key][1]
            return cached
        value = make()
        if model.mesh.unknown_count <= FEW_UNKNOWNS:
            self._known[key] = model, value  # with the model, whose id would else be given to another one
        return value
