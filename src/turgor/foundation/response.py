"""Response: measured columns against the drive, from finite elements, a formula or a laboratory alike."""

import csv
from collections.abc import Iterator, Mapping
from dataclasses import dataclass
from importlib import import_module
from pathlib import Path
from types import MappingProxyType
from typing import Any

import numpy as np
from numpy.typing import NDArray

from turgor import units
from turgor.foundation.display import MOST_ENTRIES, Shown, drawn_by
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.finding import Finding
from turgor.foundation.source import Source
from turgor.foundation.store.atomic_files import whole
from turgor.foundation.store.saved_objects import Saved

#: Units a column may be shown and written in, with their value in SI; the empty label is for pure numbers.
COLUMN_UNITS: Mapping[str, float] = MappingProxyType(
    {
        "": 1.0, "m": units.m, "mm": units.mm, "um": units.um, "1/m": 1.0, "rad": units.rad, "deg": units.deg,
        "Pa": units.Pa, "kPa": units.kPa, "MPa": units.MPa, "m2": 1.0, "mm2": 1e-6, "m3": 1.0,
        "L": units.L, "mL": units.mL, "N": units.N, "mN": units.mN, "Nm": 1.0, "J": 1.0, "mJ": 1e-3,
        "N/m": 1.0, "kg": units.kg, "g": units.g, "s": units.s, "ms": units.ms, "m3/s": 1.0,
        "L/min": units.L / 60, "mL/min": units.mL / 60, "K": 1.0,
    }
)  # fmt: skip

#: Units of one kind, the SI unit first; every other unit is the only one of its kind.
_KINDS = (
    ("m", "mm", "um"), ("rad", "deg"), ("Pa", "kPa", "MPa"), ("m2", "mm2"), ("m3", "L", "mL"), ("N", "mN"),
    ("J", "mJ"), ("kg", "g"), ("s", "ms"), ("m3/s", "L/min", "mL/min"),
)  # fmt: skip

#: Signs of units at an axis and in a table, where they differ from those in files.
_SIGNS: Mapping[str, str] = MappingProxyType(
    {"deg": "°", "um": "µm", "m2": "m²", "mm2": "mm²", "m3": "m³", "Nm": "N m"}
)

#: End of the name of the column that holds the estimated mesh error of another one.
MESH_ERROR = "_mesh_error"


def unit_text(unit: str) -> str:
    """Write a unit of a column as an axis shows it.

    Examples
    --------
    >>> unit_text("mm2"), unit_text("deg"), unit_text("kPa")
    ('mm²', '°', 'kPa')
    """
    return _SIGNS.get(unit, unit)


@dataclass(frozen=True, slots=True, eq=False)
class Column:
    """One named quantity along the path: `values` in SI, `in_unit` in the unit that it is shown in.

    Parameters
    ----------
    name : str
        What was measured, such as ``"bending_angle"``.
    unit : str
        The unit it is shown and written in, one of `COLUMN_UNITS`; empty for a pure number.
    values : (n,) array [SI]
        The values in SI units, whatever ``unit`` is.

    Examples
    --------
    >>> column = Column("pressure", "kPa", [0.0, 50e3])
    >>> column
    Column('pressure', 2 values, 0 to 50 kPa)
    >>> column.header, column.si_unit
    ('pressure_kPa', 'Pa')
    >>> print(column.values, column.in_unit, column.to("MPa"))
    [    0. 50000.] [ 0. 50.] [0.   0.05]
    """

    name: str
    unit: str
    values: NDArray[np.float64]

    def __post_init__(self) -> None:
        if self.unit not in COLUMN_UNITS:
            raise unknown(f"unit of column '{self.name}'", self.unit, (u for u in COLUMN_UNITS if u))
        if not self.name.replace("_", "a").isalnum():
            raise TurgorError(f"column name '{self.name}' may hold letters, digits and underscores only.")
        if split_header(self.header) != (self.name, self.unit):
            raise TurgorError(
                f"column '{self.name}' without unit would be read as '{split_header(self.header)[0]}' "
                f"in {split_header(self.header)[1]}; choose a name that does not end in a unit."
            )
        values = np.array(self.values, dtype=np.float64)
        if values.ndim != 1:
            raise TurgorError(f"column '{self.name}' has shape {values.shape}; one value per row is needed.")
        values.setflags(write=False)
        object.__setattr__(self, "values", values)

    def __repr__(self) -> str:
        return f"Column('{self.name}', {len(self.values)} values, {self.span})"

    @property
    def header(self) -> str:
        """Name and unit as they stand in the first line of a file."""
        return f"{self.name}_{self.unit}" if self.unit else self.name

    @property
    def label(self) -> str:
        """Name and unit as an axis shows them, such as ``"bending angle [°]"``."""
        return f"{self.words} [{unit_text(self.unit)}]" if self.unit else self.words

    @property
    def words(self) -> str:
        """Name in words.

        The ending ``_p99`` says what 99 % of the volume stay below: ``"von Mises stress (99 % of volume)"``.
        """
        words = self.name.replace("_", " ").replace("von mises", "von Mises stress")
        return words.replace(" p99", " (99 % of volume)")

    @property
    def in_unit(self) -> NDArray[np.float64]:
        """The values in ``unit``, (n,)."""
        return self.values / COLUMN_UNITS[self.unit]

    @property
    def span(self) -> str:
        """The range of the values with their unit, such as ``"0 to 50 kPa"``."""
        known = self.in_unit[np.isfinite(self.values)]
        return f"{known.min():.4g} to {known.max():.4g} {self.unit}".rstrip() if len(known) else "none known"

    @property
    def units(self) -> tuple[str, ...]:
        """The units that it can be given in, the SI unit first."""
        return next((kind for kind in _KINDS if self.unit in kind), (self.unit,))

    @property
    def si_unit(self) -> str:
        """The unit of ``values``; empty for a pure number."""
        return self.units[0]

    def to(self, unit: str) -> NDArray[np.float64]:
        """Return the values in another unit of the same kind, (n,).

        Parameters
        ----------
        unit : str
            One of `units`.

        Raises
        ------
        TurgorError
            If the unit measures something else.
        """
        if unit not in self.units:
            known = ", ".join(self.units) if self.unit else "none, for it is a pure number"
            raise TurgorError(f"column '{self.name}' cannot be given in '{unit}'; its units are {known}.")
        return self.values / COLUMN_UNITS[unit]


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Response(Saved, Shown):
    """Measured columns against the drive; the columns of the drive come first.

    ``response["pressure"]`` is in SI, as every number in Python: Pa. A unit behind the name gives the values in this
    unit: ``response["pressure_kPa"]``. Files, tables and plots always name the unit in which their numbers are.

    Parameters
    ----------
    columns : tuple of Column
        All of one length, names unique.
    source : Source
        Where the numbers came from: a computation, a formula, an experiment.
    status : str
        How the run that made them ended (``"converged"``, ``"limit_point"`` …); empty where none did.
    message : str
        What happened, in one sentence with its numbers.
    stages : tuple of str
        Name of the stage of each row, where procedures follow each other; CSV files do not keep it.
    findings : tuple of Finding
        Where an assumption of a formula does not hold; CSV files do not keep them. A `Solution` has its own.

    Raises
    ------
    TurgorError
        If two columns share a name or have different lengths.

    Examples
    --------
    >>> response = Response(
    ...     columns=(Column("pressure", "kPa", [0.0, 50e3]), Column("bending_angle", "deg", [0.0, 1.5])),
    ...     source=Source(text="a ruler"),
    ... )
    >>> response.names
    ('pressure', 'bending_angle')
    >>> response
    Response(2 rows: pressure 0 to 50 kPa, bending_angle 0 to 85.94 deg; from a ruler)
    >>> print(response["bending_angle"], response["bending_angle_deg"].round(1))
    [0.  1.5] [ 0.  85.9]
    >>> response.column("bending_angel")
    Traceback (most recent call last):
    turgor.TurgorError: unknown column 'bending_angel'; did you mean 'bending_angle'? ...
    """

    columns: tuple[Column, ...]
    source: Source
    status: str = ""
    message: str = ""
    stages: tuple[str, ...] = ()
    findings: tuple[Finding, ...] = ()

    def __post_init__(self) -> None:
        if not self.columns:
            raise TurgorError("a response needs at least one column.")
        for name in self.names:
            if self.names.count(name) > 1:
                raise TurgorError(f"response: two columns are called '{name}'; every name must be unique.")
        lengths = {column.name: len(column.values) for column in self.columns}
        if len(set(lengths.values())) > 1:
            shown = ", ".join(f"{name} {count}" for name, count in lengths.items())
            raise TurgorError(f"response: the columns have different lengths ({shown}).")
        if self.stages and len(self.stages) != len(self):
            raise TurgorError(f"response: {len(self.stages)} stages are named for {len(self)} rows.")

    def __repr__(self) -> str:
        listed = [f"{column.name} {column.span}" for column in self.quantities[:MOST_ENTRIES]]
        listed += [f"and {len(self.quantities) - MOST_ENTRIES} more"] if len(self.quantities) > MOST_ENTRIES else []
        ended = f"{self.status}, " if self.status else ""
        return f"Response({len(self)} rows: {', '.join(listed)}; {ended}from {self.source.text})"

    def __len__(self) -> int:
        """Count the rows."""
        return len(self.columns[0].values)

    def __iter__(self) -> Iterator[str]:
        """Go through the names of the columns, as those of a data frame."""
        return iter(self.names)

    def __contains__(self, name: object) -> bool:
        """Whether there is a column of a name."""
        return name in self.names

    def __getitem__(self, name: str) -> NDArray[np.float64]:
        """Return the values of a column, (n,): in SI by its name alone, else in the unit that follows the name.

        Raises
        ------
        TurgorError
            If there is no such column, or the unit measures something else.

        Examples
        --------
        >>> response = Response(columns=(Column("pressure", "kPa", [0.0, 50e3]),), source=Source(text="a gauge"))
        >>> print(response["pressure"], response["pressure_kPa"])
        [    0. 50000.] [ 0. 50.]
        """
        if not isinstance(name, str):
            raise TurgorError(f"a column of a response is called by its name, not by {name!r}: {', '.join(self)}.")
        plain, unit = split_header(name)
        if name in self.names or plain not in self.names:
            return self.column(name)
        return self.find(plain).to(unit)

    @property
    def names(self) -> tuple[str, ...]:
        """Names of the columns in order."""
        return tuple(column.name for column in self.columns)

    def find(self, name: str) -> Column:
        """Return a column with its unit; an unknown name fails with the near match."""
        for column in self.columns:
            if column.name == name:
                return column
        raise unknown("column", name, self.names)

    def mesh_error(self, name: str) -> NDArray[np.float64] | None:
        """Return the estimated mesh error of a column in SI units, (n,); None where none was estimated.

        It stands in a column of its own, ``bending_angle_mesh_error`` after ``bending_angle``: how far the value is
        from what finer cells would give, not negative. An unknown name fails with the near match.

        Examples
        --------
        >>> angle = Column("bending_angle", "deg", [0.0, 1.5])
        >>> error = Column("bending_angle_mesh_error", "deg", [0.0, 0.01])
        >>> print(Response(columns=(angle, error), source=Source(text="cells")).mesh_error("bending_angle"))
        [0.   0.01]
        """
        self.find(name)
        known = name + MESH_ERROR in self.names
        errors = self.column(name + MESH_ERROR) if known else np.full(1, np.nan)
        return errors if np.isfinite(errors).any() else None

    @property
    def quantities(self) -> tuple[Column, ...]:
        """The columns without those of mesh errors."""
        return tuple(column for column in self.columns if not column.name.endswith(MESH_ERROR))

    def column(self, name: str) -> NDArray[np.float64]:
        """Return the values of a column in SI units, (n,); an unknown name fails with the near match."""
        return self.find(name).values

    def to_dataframe(self, *, si: bool = False) -> Any:
        """Return the table as a pandas data frame whose columns say the unit of their numbers: ``pressure_kPa``.

        Parameters
        ----------
        si : bool
            Whether the numbers are in SI units, under names such as ``pressure_Pa``.

        Returns
        -------
        pandas.DataFrame
            A row for each state. Where procedures follow each other, a last column has the name of the stage.

        Raises
        ------
        TurgorError
            If pandas is not installed.
        """
        try:
            pandas = import_module("pandas")
        except ImportError:
            raise TurgorError(
                "to_dataframe needs pandas, which is not installed; install it with: pip install pandas"
            ) from None
        shown = {}
        for column in self.columns:
            unit = column.si_unit if si else column.unit
            shown[f"{column.name}_{unit}" if unit else column.name] = column.to(unit)
        return pandas.DataFrame(shown | ({"stage_name": list(self.stages)} if self.stages else {}))

    def plot(self, y: str | None = None, *, x: str | None = None, axes: Any = None) -> Any:
        """Plot the response, in the units that its columns name.

        Parameters
        ----------
        y : str, optional
            Name of the column to plot; by default those that a reader looks for first, each in a panel of its own.
        x : str, optional
            Name of the column to plot it against; by default what drove the actuator, such as the pressure.
        axes : matplotlib.axes.Axes, optional
            Where to draw ``y``; by default a new figure. Several responses may share axes.

        Returns
        -------
        matplotlib.figure.Figure
            The figure, which notebooks show; ``figure.savefig("response.png")`` writes it.

        Raises
        ------
        TurgorError
            If there is no such column, or ``x`` or ``axes`` is given without ``y``.

        Examples
        --------
        >>> columns = (Column("pressure", "kPa", [0.0, 50e3]), Column("bending_angle", "deg", [0.0, 1.5]))
        >>> figure = Response(columns=columns, source=Source(text="a ruler")).plot("bending_angle")
        >>> figure.axes[0].get_xlabel(), figure.axes[0].get_ylabel()
        ('pressure [kPa]', 'bending angle [°]')
        """
        return drawn_by("plot")(self, y, x, axes)

    def to_csv(self, path: str | Path) -> None:
        """Write the table as CSV: a header with units (``pressure_kPa``), then one line a row, in these units.

        Every digit is written: `turgor.files.read_response` returns the same values, to the last bit but one.
        """
        with whole(Path(path)) as part, part.open("w", newline="", encoding="utf-8") as file:
            writer = csv.writer(file, lineterminator="\n")
            writer.writerow([column.header for column in self.columns])
            factors = [COLUMN_UNITS[column.unit] for column in self.columns]
            for row in zip(*(column.values.tolist() for column in self.columns), strict=True):
                writer.writerow([_shortest(value, factor) for value, factor in zip(row, factors, strict=True)])


def split_header(header: str) -> tuple[str, str]:
    """Split ``pressure_kPa`` into name and unit; the unit is empty where the end is no known unit."""
    name, _, unit = header.rpartition("_")
    return (name, unit) if name and unit in COLUMN_UNITS and unit else (header, "")


def _shortest(value: float, factor: float) -> str:
    """Fewest digits of value / factor that read back as the same float, where such a number exists."""
    for digits in range(1, 18):
        text = f"{value / factor:.{digits}g}"
        if float(text) * factor == value:
            return text
    return repr(value / factor)
