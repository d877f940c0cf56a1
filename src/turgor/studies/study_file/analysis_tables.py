"""``[sensitivity]`` and ``[surrogate]`` of a study file: how the runs of its sweep are analyzed."""

from pydantic import Field

from turgor.job.text.quantities import Table


class SensitivityTable(Table):
    """``[sensitivity]``: which factors of the sweep matter.

    Keys
    ----
    method : str
        ``"anova"`` for a factorial, ``"sobol"`` for samples (by a surrogate), or ``"auto"``.
    measures : list of str
        All that vary by default.
    at : str
        Where measures are read: ``"pressure=40 kPa"``; by default as in ``[sweep]``.
    fixed : table
        Factors that do not vary, with their values, for ``"sobol"``.
    spread : table
        Factors that are normal within their range, such as ``{ wall = "1.2 mm +- 0.1 mm" }``, for ``"sobol"``.
    samples : int
        Points of ``"sobol"``, a power of two.
    """

    method: str = "auto"
    measures: list[str] = Field(default_factory=list)
    at: str = ""
    fixed: dict[str, str] = Field(default_factory=dict)
    spread: dict[str, str] = Field(default_factory=dict)
    samples: int = 1024


class SurrogateTable(Table):
    """``[surrogate]``: the fast function that is fitted to the sweep.

    Keys
    ----
    measures : list of str
        All that vary by default.
    at : str
        Where measures are read: ``"pressure=40 kPa"``; by default as in ``[sweep]``.
    along : str
        A column that becomes an input, such as ``"pressure"``: the surrogate then gives whole curves.
    """

    measures: list[str] = Field(default_factory=list)
    at: str = ""
    along: str = ""
