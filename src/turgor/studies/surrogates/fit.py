"""surrogate: fit a fast function to a study."""

from collections.abc import Sequence

from threadpoolctl import threadpool_limits

from turgor.studies.runs.study import Study
from turgor.studies.surrogates.fit_gaussian_process import GaussianProcessTrainer
from turgor.studies.surrogates.held_out import held_out
from turgor.studies.surrogates.surrogate import Surrogate
from turgor.studies.surrogates.training import training


def surrogate(
    study: Study,
    measures: Sequence[str] | None = None,
    *,
    at: tuple[str, float] | None = None,
    along: str = "",
) -> Surrogate:
    """Fit a surrogate to a study: a function of its factors that takes less than a millisecond.

    It is a Gaussian process for each measure. Each part of the rows is predicted from the others (cross-validation in
    at most ten parts). The errors are reported, and the standard deviations scaled until intervals hold what they
    should. Mesh errors of the study count as standard deviations of its values. Failed rows are left out and counted.

    Parameters
    ----------
    study : Study
        Its factors are numbers, or choices of up to ten; those that do not vary are left out.
    measures : sequence of str, optional
        By default all but the drive.
    at : (str, float), optional
        Column and value [SI] at which measures are read, such as ``("pressure", 50e3)``; by default the last state.
    along : str
        Column that becomes an input, such as ``"pressure"``: the surrogate then gives whole curves.

    Returns
    -------
    Surrogate

    Raises
    ------
    TurgorError
        If a choice has more than ten levels, a name is unknown, or fewer than five rows can be used.

    Examples
    --------
    >>> import numpy as np
    >>> from turgor.foundation.source import Source
    >>> from turgor.foundation.response import Column, Response
    >>> from turgor.studies.runs.sweep import sweep
    >>> def bent(wall):
    ...     columns = Column("pressure", "kPa", [0, 2e4]), Column("angle", "deg", [0, 2e-3 / wall])
    ...     return Response(columns=columns, source=Source(text="a formula"))
    >>> fitted = surrogate(sweep(bent, wall=np.linspace(1e-3, 2e-3, 9).tolist()))
    >>> round(fitted.predict({"wall": 1.43e-3})["angle"], 3)
    1.399
    >>> fitted.predict({"wall": 0.9e-3})
    Traceback (most recent call last):
    turgor.TurgorError: wall is 0.0009; the surrogate knows 0.001 to 0.002. ...
    """
    given = training(study, measures, at=at, along=along)
    trainer = GaussianProcessTrainer()
    with threadpool_limits(1):  # small matrices: further threads cost more than they bring
        model = trainer.fit(given.shares, given.targets, given.noise)
        errors = held_out(trainer, model, given.shares, given.outputs, given.noise, given.row)
    return Surrogate(
        factors=given.factors,
        held_out=errors,
        model=model,
        along=along,
        rows=len(set(given.row.tolist())),
        notes=given.notes,
        source=study.source,
    )
