"""question_of: the model that a procedure follows."""

from turgor.model.model import Model
from turgor.solvers.procedures.static import Static


def question_of(model: Model, procedure: object) -> Model:
    """Return the model that a procedure follows: what was asked, with what the procedure adds to it.

    Parameters
    ----------
    model : Model
    procedure : Procedure
        `BlockedForce` and `Grasp` add a plate, a hold or a path of the object; the others add nothing.

    Returns
    -------
    Model
    """
    return procedure.amended(model) if isinstance(procedure, Static) else model
