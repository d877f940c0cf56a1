"""MaterialTest: one experiment on a rubber, with its measured values and a record of every edit."""

from collections.abc import Mapping
from dataclasses import dataclass, field, replace
from typing import Any

import numpy as np
from numpy.typing import ArrayLike, NDArray

from turgor.core.materials.experiments.settings import EXPERIMENTS
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.laws.homogeneous import DEFORMATIONS, nominal_stress
from turgor.core.materials.material import UNSTATED
from turgor.foundation.display import Shown, brief
from turgor.foundation.errors import TurgorError, unknown
from turgor.foundation.source import Source

Array = NDArray[np.float64]

#: Modes of a test on a rubber; pure shear is another name for planar tension.
MODES = ("uniaxial", "equibiaxial", "planar", "simple_shear", "biaxial")

#: Arrays of a test that may be missing.
_OPTIONAL = ("stretch_2", "nominal_stress_2", "spread", "time", "crosshead")


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class Edit:
    """One change of a test, with the points that it removed.

    Parameters
    ----------
    text : str
        Description of the edit with its numbers, as a sentence.
    stretch : (n,) array [-]
        Stretch of the removed points, before the edit.
    nominal_stress : (n,) array [Pa]
        Their nominal stress.
    """

    text: str
    stretch: Array = field(default_factory=lambda: np.empty(0))
    nominal_stress: Array = field(default_factory=lambda: np.empty(0))

    __repr__ = brief


@dataclass(frozen=True, slots=True, kw_only=True, eq=False)
class MaterialTest(Shown):
    """One experiment on a rubber: mode, stretch and nominal stress, their source, and a record of every edit.

    Parameters
    ----------
    mode : str
        ``uniaxial``, ``equibiaxial``, ``planar`` (pure shear), ``simple_shear`` or ``biaxial``.
    stretch : (n,) array [-]
        Length over initial length along the first axis; the amount of shear in ``simple_shear``.
    nominal_stress : (n,) array [Pa]
        Force per initial area along the first axis; the shear stress in ``simple_shear``.
    name : str
        Name of the test in tables.
    source : Source
        Source of the data.
    stretch_2 : (n,) array [-], optional
        Stretch along the second axis, in ``biaxial`` tests only.
    nominal_stress_2 : (n,) array [Pa], optional
        Nominal stress along the second axis, in ``biaxial`` tests only.
    cauchy_difference : bool
        Whether ``nominal_stress`` is the difference of the Cauchy stresses over the stretch, (σ₁ − σ₂)/λ₁, in
        ``biaxial`` tests only.
    spread : (n,) array [Pa], optional
        Standard deviation of the replicates that were averaged.
    time : (n,) array [s], optional
        Time of every point, not decreasing; needed for relaxation, hysteresis and softening.
    crosshead : (n,) array [-], optional
        Stretch by the crosshead, where the file has a strain that was measured on the specimen besides.
    batch : str
        Batch that the specimen is of, where the file says so.
    specimen : Specimen, optional
        Dimensions of the specimen, where they are known.
    raw : MaterialTest, optional
        The test as it was read, before all edits.
    edits : tuple of Edit
        Edits since then, in order.

    Examples
    --------
    >>> test = MaterialTest(mode="uniaxial", stretch=[1.0, 1.5, 2.0], nominal_stress=[0.0, 1e5, 1.6e5], name="a strip")
    >>> test
    MaterialTest('a strip', uniaxial, 3 points, stretch 1 to 2, nominal stress 0 to 0.16 MPa)
    """

    mode: str
    stretch: Array
    nominal_stress: Array
    name: str
    source: Source = UNSTATED
    stretch_2: Array | None = None
    nominal_stress_2: Array | None = None
    cauchy_difference: bool = False
    spread: Array | None = None
    time: Array | None = None
    crosshead: Array | None = None
    batch: str = ""
    specimen: Specimen | None = None
    raw: "MaterialTest | None" = None
    edits: tuple[Edit, ...] = ()

    def __post_init__(self) -> None:
        if self.mode not in MODES:
            raise unknown("mode", self.mode, MODES)
        for key in ("stretch", "nominal_stress", *_OPTIONAL):
            if getattr(self, key) is not None:
                object.__setattr__(self, key, self._checked(key, getattr(self, key)))
        if len(self.stretch) < 2:
            raise TurgorError(f"test '{self.name}' has {_points(len(self.stretch))}; a test needs at least two.")
        if self.mode == "biaxial" and self.stretch_2 is None:
            raise TurgorError(f"test '{self.name}' is biaxial and has no stretch_2, the stretch along the second axis.")
        if self.mode != "biaxial" and self.stretch_2 is not None:
            raise TurgorError(f"test '{self.name}' is {self.mode}; stretch_2 belongs to biaxial tests only.")
        if self.nominal_stress_2 is not None and self.stretch_2 is None:
            raise TurgorError(f"test '{self.name}' is {self.mode}; nominal_stress_2 belongs to a biaxial test.")
        if self.cauchy_difference and (self.stretch_2 is None or self.nominal_stress_2 is not None):
            raise TurgorError(
                f"test '{self.name}': a difference of Cauchy stresses belongs to a biaxial test and has no "
                "nominal_stress_2."
            )

    def __repr__(self) -> str:
        low, high = self.range
        weak, strong = self.nominal_stress.min() / 1e6, self.nominal_stress.max() / 1e6
        return (
            f"MaterialTest('{self.name}', {self.mode}, {_points(len(self.stretch))}, "
            f"stretch {low:.4g} to {high:.4g}, nominal stress {weak:.4g} to {strong:.4g} MPa)"
        )

    @property
    def range(self) -> tuple[float, float]:
        """Smallest and largest stretch [-]."""
        return float(self.stretch.min()), float(self.stretch.max())

    @property
    def deformation(self) -> Array:
        """Deformation gradient of every point at constant volume; (n, 3, 3) array [-]."""
        if self.stretch_2 is not None:
            third = 1.0 / (self.stretch * self.stretch_2)
            return np.asarray(np.stack([self.stretch, self.stretch_2, third], axis=-1)[..., None] * np.eye(3))
        return DEFORMATIONS[self.mode](self.stretch)

    @property
    def measured(self) -> Array:
        """Every measured nominal stress in one row, the second axis of a biaxial test after the first [Pa]."""
        if self.nominal_stress_2 is None:
            return self.nominal_stress
        return np.concatenate([self.nominal_stress, self.nominal_stress_2])

    def predicted(self, law: Any) -> Array:
        """Return the nominal stress of a law at the points of this test, in the order of `measured` [Pa].

        Parameters
        ----------
        law : Law
            Any law of a rubber.
        """
        return self.components(nominal_stress(law, self.deformation))

    def components(self, P: Array) -> Array:
        """Return the measured components of nominal stress tensors, in the order of `measured` [Pa].

        Parameters
        ----------
        P : (n, 3, 3) array [Pa]
            Nominal stress at every point.
        """
        if self.mode == "simple_shear":
            return np.asarray(P[:, 0, 1])
        if self.cauchy_difference and self.stretch_2 is not None:
            return np.asarray(P[:, 0, 0] - P[:, 1, 1] * self.stretch_2 / self.stretch)
        if self.nominal_stress_2 is None:
            return np.asarray(P[:, 0, 0])
        return np.concatenate([P[:, 0, 0], P[:, 1, 1]])

    def first_turn(self) -> int | None:
        """Return the first point at which the stretch reverses; None if it does not.

        Examples
        --------
        >>> stretch = [1.0, 2.0, 3.0, 2.0, 1.0]
        >>> MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stretch, name="a cycle").first_turn()
        3
        """
        if self.mode == "biaxial":
            return None  # a field of points, not a path
        stretch = self.stretch if self.stretch[-1] >= self.stretch[0] else -self.stretch
        back = np.maximum.accumulate(stretch) - stretch > EXPERIMENTS.precision * np.ptp(stretch)
        return int(np.argmax(back)) if back.any() else None

    def keeping(self, keep: NDArray[np.bool_], text: str) -> "MaterialTest":
        """Return the test with some of its points; the removed ones are recorded as an edit.

        Parameters
        ----------
        keep : (n,) array of bool
            Mask of the points that stay.
        text : str
            Reason for the removal of the others; the text of the edit begins with the reason.
        """
        removed = ~keep
        if keep.sum() < 2:
            raise TurgorError(f"test '{self.name}': {text} would leave {_points(int(keep.sum()))} of {len(keep)}.")
        edit = Edit(
            text=f"{text}: {_points(int(removed.sum()))} of {len(keep)} removed.",
            stretch=self.stretch[removed],
            nominal_stress=self.nominal_stress[removed],
        )
        values = {key: None if getattr(self, key) is None else getattr(self, key)[keep] for key in _OPTIONAL}
        values |= {"stretch": self.stretch[keep], "nominal_stress": self.nominal_stress[keep]}
        return self.changed(edit, values)

    def changed(self, edit: Edit, values: Mapping[str, Any]) -> "MaterialTest":
        """Return the test with other values and one more edit; the raw test stays with it.

        Parameters
        ----------
        edit : Edit
            Record of the edit.
        values : mapping of str to array
            New values by the name of their field.
        """
        return replace(self, raw=self.raw or self, edits=(*self.edits, edit), **values)

    def _checked(self, key: str, values: ArrayLike) -> Array:
        array = np.array(values, dtype=np.float64)
        if array.ndim != 1 or (key != "stretch" and array.shape != np.shape(self.stretch)):
            shapes = f"{np.shape(values)} against stretch {np.shape(self.stretch)}"
            raise TurgorError(f"test '{self.name}': {key} has the wrong shape, {shapes}; each point needs one value.")
        if not np.isfinite(array).all():
            where = int(np.argmin(np.isfinite(array))) + 1
            raise TurgorError(f"test '{self.name}': {key} of point {where} is {array[where - 1]}; it must be a number.")
        sheared = self.mode == "simple_shear"
        if key.startswith("stretch") and not sheared and not (array > 0).all():
            where = int(np.argmin(array > 0)) + 1
            raise TurgorError(
                f"test '{self.name}': {key} of point {where} is {array[where - 1]:g}; a stretch is length over initial "
                "length, more than 0. If the column holds strain, say so in its header."
            )
        if key == "time" and (np.diff(array) < 0).any():
            where = int(np.argmax(np.diff(array) < 0)) + 1
            raise TurgorError(
                f"test '{self.name}': time runs backwards after point {where}, at {array[where - 1]:g} s."
            )
        array.flags.writeable = False
        return array


def _points(count: int) -> str:
    return "one point" if count == 1 else f"{count} points"
