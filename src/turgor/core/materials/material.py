"""Material: a law with its bulk response, density, fitted range and source."""

from collections.abc import Iterable
from dataclasses import dataclass, field
from math import inf
from typing import TYPE_CHECKING, get_args

from turgor.core.materials.crack_growth import CrackGrowth
from turgor.core.materials.history.bergstrom_boyce import BergstromBoyce
from turgor.core.materials.history.permanent_set import PermanentSet
from turgor.core.materials.history.softening import Mullins
from turgor.core.materials.history.viscoelastic import Prony
from turgor.core.materials.laws.laws import FiberLaw, FoamLaw, Hooke, Law
from turgor.core.materials.orientation import Orientation
from turgor.core.materials.strength import Strength
from turgor.foundation.display import Shown
from turgor.foundation.errors import TurgorError
from turgor.foundation.given import Quantity, number, one, shown
from turgor.foundation.source import Source

#: Classes of rubbers' laws.
LAW_KINDS = get_args(Law)

#: What only isotropic rubbers have.
_HISTORY = "viscoelasticity, stress_softening and permanent_set"

UNSTATED = Source(text="stated in the script")


@dataclass(frozen=True, slots=True, kw_only=True)
class Material(Shown):
    """A law, how it resists a change of volume, its density, the range it was fitted in, and where it came from.

    Parameters
    ----------
    name : str
        What the material is called in reports.
    law : Law or Hooke
        The strain energy function with its coefficients.
    bulk_modulus : float [Pa]
        Initial bulk modulus κ; infinite (the default) means fully incompressible. Ignored for `Hooke`. The law of a
        foam, such as `Hyperfoam`, has its own, which is stated here.
    density : float or None [kg/m³]
        Mass per reference volume; needed for gravity only.
    expansion : float or None [1/K]
        Linear thermal expansion, when known; a `Temperature` of a body takes it by default.
    stretch_range : (float, float) or None [-]
        Smallest and largest stretch of the tests that the law was fitted to, when known.
    source : Source
        Where the coefficients came from.
    viscoelasticity : Prony, BergstromBoyce or None
        How the isochoric stress relaxes, linearly or not; by default not at all.
    stress_softening : Mullins or None
        How the rubber softens below its largest stretch so far; by default not at all.
    permanent_set : PermanentSet or None
        How much longer the rubber stays after it was stretched; by default not at all.
    bending_stiffness : float or None [N m]
        Moment per width and curvature of a sheet that bends more easily than a plate, such as a woven fabric; by
        default a sheet bends like a plate of its thickness. For `Hooke` only.
    strength : Strength or None
        What it bears until it breaks or tears, when known; findings compare the computed stretches with it.
    crack_growth : CrackGrowth or None
        How fast cracks grow in it from cycle to cycle, when known; for rubbers only.
    orientation : Orientation or None
        Directions of a law with fibers, such as `HolzapfelGasserOgden` or `Orthotropic`, which needs one.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import NeoHooke
    >>> Material(name="test rubber", law=NeoHooke(C10=0.12e6)).incompressible
    True
    >>> Material(name="test rubber", law=NeoHooke(C10=0.12e6), density=1070.0)
    Material('test rubber', NeoHooke(C10=120000.0) [SI], incompressible, 1070 kg/m³)
    """

    name: str
    law: Law | FiberLaw | Hooke
    bulk_modulus: float = inf
    density: float | None = None
    expansion: float | None = None
    stretch_range: tuple[float, float] | None = None
    source: Source = field(default=UNSTATED)
    viscoelasticity: Prony | BergstromBoyce | None = None
    stress_softening: Mullins | None = None
    permanent_set: PermanentSet | None = None
    bending_stiffness: float | None = None
    strength: Strength | None = None
    crack_growth: CrackGrowth | None = None
    orientation: Orientation | None = None

    if TYPE_CHECKING:

        def __init__(
            self,
            *,
            name: str,
            law: Law | FiberLaw | Hooke,
            bulk_modulus: Quantity = inf,
            density: Quantity | None = None,
            expansion: Quantity | None = None,
            bending_stiffness: Quantity | None = None,
            stretch_range: tuple[float, float] | None = None,
            source: Source = UNSTATED,
            viscoelasticity: Prony | BergstromBoyce | None = None,
            stress_softening: Mullins | None = None,
            permanent_set: PermanentSet | None = None,
            strength: Strength | None = None,
            crack_growth: CrackGrowth | None = None,
            orientation: Orientation | None = None,
        ) -> None: ...

    def __post_init__(self) -> None:
        subject = f"material '{self.name}'"
        one(
            self.law,
            (*LAW_KINDS, FiberLaw, Hooke),
            f"{subject}: law",
            "a law is needed, such as Yeoh(C10=0.11e6, C20=0.02e6)",
        )
        given = self.law.bulk_modulus if isinstance(self.law, FoamLaw) else self.bulk_modulus
        bulk = number(given, f"{subject}: bulk_modulus", "pressure", finite=False)
        object.__setattr__(self, "bulk_modulus", bulk)
        if self.density is not None:
            object.__setattr__(self, "density", number(self.density, f"{subject}: density", "density"))
        if self.expansion is not None:
            object.__setattr__(self, "expansion", number(self.expansion, f"{subject}: expansion", "expansion"))
        if not self.bulk_modulus > 0:
            raise TurgorError(f"material '{self.name}': bulk_modulus is {self.bulk_modulus:g} Pa; it must be positive.")
        if self.density is not None and not self.density > 0:
            raise TurgorError(f"material '{self.name}': density is {self.density:g} kg/m³; it must be positive.")
        if isinstance(self.law, Hooke) and (self.remembers or self.crack_growth):
            raise TurgorError(f"material '{self.name}' is linear elastic; {_HISTORY} and crack_growth are for rubbers.")
        self._check_orientation()
        if self.is_foam and self.remembers:
            raise TurgorError(
                f"material '{self.name}' is a foam ({type(self.law).__name__}); {_HISTORY} are for rubbers that keep "
                "their volume."
            )
        if self.prony and self.permanent_set:
            raise TurgorError(
                f"material '{self.name}' has a Prony series and a permanent_set; take BergstromBoyce with the set, or "
                "leave one out."
            )
        if self.stretch_range is not None:
            object.__setattr__(self, "stretch_range", _range(self.stretch_range, f"{subject}: stretch_range"))
        if self.bending_stiffness is not None:
            bending = number(self.bending_stiffness, f"{subject}: bending_stiffness", "bending stiffness")
            object.__setattr__(self, "bending_stiffness", bending)
            self._check_bending(bending)

    def _check_orientation(self) -> None:
        name, law = type(self.law).__name__, self.law
        if not isinstance(law, FiberLaw):
            if self.orientation is not None:
                raise TurgorError(f"material '{self.name}': {name} has no directions; leave the orientation out.")
            return
        one(
            self.orientation,
            Orientation,
            f"material '{self.name}': orientation",
            f"{name} needs one, such as Orientation(along=(1, 0, 0), across=(0, 1, 0))",
        )
        assert self.orientation is not None
        law.families(self.orientation.angle)  # a law may have no fibers at an angle
        if self.remembers:
            raise TurgorError(f"material '{self.name}' has directions ({name}); {_HISTORY} are for isotropic rubbers.")

    def _check_bending(self, value: float) -> None:
        if not isinstance(self.law, Hooke):
            raise TurgorError(f"material '{self.name}' is no sheet; a bending_stiffness is for the law Hooke.")
        if not 0 < value < inf:
            raise TurgorError(f"material '{self.name}': bending_stiffness is {value:g} N m; it must be positive.")

    def __repr__(self) -> str:
        parts = [f"'{self.name}'", f"{self.law!r} [SI]"]
        if not isinstance(self.law, Hooke):
            parts.append("incompressible" if self.incompressible else f"bulk modulus {self.bulk_modulus:.4g} Pa")
        parts += [f"bending stiffness {self.bending_stiffness:.4g} N m"] if self.bending_stiffness is not None else []
        parts += [f"{self.density:g} kg/m³"] if self.density is not None else []
        if self.stretch_range is not None:
            parts.append(f"fitted to stretches {self.stretch_range[0]:.4g} to {self.stretch_range[1]:.4g}")
        parts += ["oriented"] if self.orientation else []
        parts += ["relaxes"] if self.viscoelasticity else []
        parts += ["softens"] if self.stress_softening else []
        parts += ["sets"] if self.permanent_set else []
        return f"Material({', '.join(parts)})"

    @property
    def prony(self) -> Prony | None:
        """The Prony series of a rubber that relaxes linearly."""
        return self.viscoelasticity if isinstance(self.viscoelasticity, Prony) else None

    @property
    def flowing_network(self) -> BergstromBoyce | None:
        """The second network of a rubber that flows with a power of its stress."""
        return self.viscoelasticity if isinstance(self.viscoelasticity, BergstromBoyce) else None

    @property
    def remembers(self) -> bool:
        """Whether the response depends on the history."""
        return any(each is not None for each in (self.viscoelasticity, self.stress_softening, self.permanent_set))

    @property
    def is_foam(self) -> bool:
        """Whether the law has the change of volume in its energy."""
        return isinstance(self.law, FoamLaw)

    @property
    def has_fibers(self) -> bool:
        """Whether the law has directions."""
        return isinstance(self.law, FiberLaw)

    @property
    def incompressible(self) -> bool:
        """Whether the material keeps its volume exactly."""
        return self.bulk_modulus == inf


def _range(given: object, what: str) -> tuple[float, float]:
    """Return two stretches that were given, the smaller one first."""
    needed = f"{what} is {shown(given)}; two stretches above 0 are needed, the smaller one first"
    if isinstance(given, str) or not isinstance(given, Iterable) or len(bounds := list(given)) != 2:
        raise TurgorError(f"{needed}.")
    low, high = (number(each, what) for each in bounds)
    if not 0 < low <= high:
        raise TurgorError(f"{needed}.")
    return low, high
