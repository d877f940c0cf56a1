"""Random shapes for `estimates.py`: PneuNets, bellows and benders whose dimensions and rubbers nobody chose."""

from collections.abc import Callable
from dataclasses import asdict, dataclass
from typing import Any

import numpy as np

import turgor as tg
from turgor.core.meshing.sizing.sizes import wall_size
from turgor.foundation.errors import TurgorError
from turgor.units import kPa, mm

RUBBERS = (
    ("elastosil-m4601", "yeoh-mosadegh-2014"),
    ("dragon-skin-10", "neo-hooke-connolly-2017"),
    ("dragon-skin-30", "yeoh-chen-2018"),
    ("ecoflex-00-30", "ogden-agarwal-2016"),
    ("ecoflex-00-50", "yeoh-kulkarni-2015"),
    ("smooth-sil-950", "neo-hooke-connolly-2017"),
)
STIFF = ("smooth-sil-950", "neo-hooke-polygerinos-2020")
PAPER = ("paper", "hooke-polygerinos-2020")
#: Families in turn, so that every one of them is drawn.
FAMILIES = (
    "FastPneuNet", "BellowsOfRevolution", "RectangularBender", "SlowPneuNet", "SemicircularBender",
    "TrapezoidalPneuNet", "TwoMaterialBender",
)  # fmt: skip
#: Shapes that are deformed so far that walls meet would need contact; these are moderate.
NO_CONTACT = tg.Contact(self_contact=False)
OPTIONS = tg.EngineOptions(linear_solver="rslab", threads=1)


@dataclass(frozen=True, slots=True, kw_only=True)
class Shape:
    """A loaded actuator.

    Parameters
    ----------
    family : str
        Class of `turgor.actuators`.
    dimensions : mapping of str to float
        Its dimensions that differ from the defaults [mm], and numbers of chambers or folds.
    rubber, base : (str, str)
        Name and record of the body and of the base.
    paper : float [mm]
        Thickness of the sheet; 0 where there is none.
    moved : float [-]
        Displacement of the tip over the length that the pressure is chosen for.
    """

    family: str
    dimensions: dict[str, float]
    rubber: tuple[str, str]
    base: tuple[str, str]
    paper: float
    moved: float

    @property
    def title(self) -> str:
        """One line for the page."""
        numbers = ", ".join(f"{name.replace('_', ' ')} {value:g}" for name, value in self.dimensions.items())
        base = "" if self.base == self.rubber else f", base {self.base[0]}"
        return f"{self.family}: {numbers} mm; {self.rubber[0]}{base}{', paper' if self.paper else ''}"

    @property
    def measures(self) -> tuple[tg.measures.Measure, ...]:
        """Headline first: extension of bellows, angle of what bends."""
        first = tg.measures.tip_displacement_x if self.family.startswith("Bellows") else tg.bending_angle
        return (first, tg.tip_displacement, tg.cavity_volume, tg.measures.von_mises_p99)

    def geometry(self) -> Any:
        """The part."""
        whole = ("chambers", "folds")
        given = {name: int(value) if name in whole else value * mm for name, value in self.dimensions.items()}
        return getattr(tg.actuators, self.family)(**given).build()

    def model(self, mesh: tg.Mesh, pressure: float) -> tg.Model:
        """The question on a mesh, at a pressure [kPa]."""
        materials: dict[str, Any] = {"body": tg.from_library(self.rubber[0], record=self.rubber[1])}
        if "base" in mesh.regions:
            materials["base"] = tg.from_library(self.base[0], record=self.base[1])
        if self.paper:
            sheet = tg.from_library(PAPER[0], record=PAPER[1])
            materials["strain_limiting_layer"] = tg.Shell(sheet, thickness=self.paper * mm)
        return tg.Model(
            mesh,
            materials=materials,
            supports=[tg.Fixed("fixed")],
            loads=[tg.Pressure("cavity", pressure * kPa)],
            contact=NO_CONTACT,
        )

    def pressure(self) -> float:
        """Pressure that moves the tip as far as wanted on a coarse mesh [kPa], to two digits."""
        geometry = self.geometry()
        mesh = tg.mesh(geometry, size=wall_size(geometry), cells="tetrahedra")
        wanted = self.moved * float(np.ptp(mesh.points[:, 0]))
        stiffness = tg.from_library(self.rubber[0], record=self.rubber[1]).law.shear_modulus / kPa
        solution = tg.solve(
            self.model(mesh, stiffness),
            options=OPTIONS,
            stop=lambda state: "far enough" if tg.tip_displacement(state) > wanted else None,
            throw=False,
        )
        moved = [float(tg.tip_displacement(state)) for state in solution.states]
        factors = [state.load_factor for state in solution.states]
        share = np.interp(wanted, moved, factors) if moved[-1] > wanted else factors[-1]
        share = min(share, 0.6 * factors[-1]) if solution.status == "step_too_small" else share
        return float(f"{share * stiffness:.2g}")


def drawn(seed: int, count: int) -> list[Shape]:
    """Shapes of a seed; dimensions that make no part are drawn again."""
    random = np.random.default_rng(seed)
    shapes: list[Shape] = []
    while len(shapes) < count:
        shape = _drawn(random, FAMILIES[len(shapes) % len(FAMILIES)])
        try:
            shape.geometry()
        except TurgorError:
            continue
        shapes.append(shape)
    return shapes


def _drawn(random: np.random.Generator, family: str) -> Shape:
    dimensions = _RANGES[family](random)
    rubber = RUBBERS[random.integers(len(RUBBERS))]
    sheet = family not in ("BellowsOfRevolution", "TwoMaterialBender") and random.random() < 0.4
    stiff = family == "TwoMaterialBender" or (family != "BellowsOfRevolution" and not sheet and random.random() < 0.7)
    return Shape(
        family=family,
        dimensions={name: round(float(value), 1) for name, value in dimensions.items()},
        rubber=rubber,
        base=STIFF if stiff else rubber,
        paper=0.1 if sheet else 0.0,
        moved=round(float(random.uniform(*((0.015, 0.05) if family.endswith("Bender") else (0.06, 0.22)))), 3),
    )


def _block(random: np.random.Generator) -> dict[str, float]:
    """Outer block and the walls that all PneuNets have."""
    floor = random.uniform(1, 2)
    return {
        "width": random.uniform(12, 22), "height": random.uniform(9, 18), "side_wall": random.uniform(1.2, 2.6),
        "top_wall": random.uniform(1, 2.6), "end_wall": random.uniform(1.5, 2.5), "floor": floor,
        "base": random.uniform(1, 2), "channel_height": random.uniform(1.5, 3),
    }  # fmt: skip


def _fast(random: np.random.Generator) -> dict[str, float]:
    chambers, wall, gap = random.integers(2, 4), random.uniform(0.9, 2), random.uniform(0.8, 3)
    length = chambers * (random.uniform(2, 5) + 2 * wall + gap) + 2
    block = {"chambers": chambers, "length": length, "wall": wall, "gap": gap, **_block(random)}
    return block | {"channel_width": random.uniform(2, 4)}


def _slow(random: np.random.Generator) -> dict[str, float]:
    chambers, wall = random.integers(2, 4), random.uniform(1.2, 3.5)
    length = chambers * (random.uniform(3, 7) + wall) + 3
    block = {"chambers": chambers, "length": length, "wall": wall, **_block(random)}
    return block | {"channel_width": random.uniform(2, 4)}


def _trapezoidal(random: np.random.Generator) -> dict[str, float]:
    chambers, wall, gap = random.integers(2, 4), random.uniform(1.2, 2.2), random.uniform(0.8, 2)
    length = chambers * (random.uniform(6, 10) + 2 * wall + gap) + 2
    return {"chambers": chambers, "length": length, "wall": wall, "gap": gap, **_block(random)}


def _bellows(random: np.random.Generator) -> dict[str, float]:
    inner = random.uniform(5, 9)
    return {
        "folds": random.integers(1, 4), "inner_radius": inner, "outer_radius": inner + random.uniform(4, 8),
        "wall": random.uniform(0.8, 2), "pitch": random.uniform(7, 12), "cap": random.uniform(2, 5),
    }  # fmt: skip


def _rectangular(random: np.random.Generator) -> dict[str, float]:
    return {
        "length": random.uniform(24, 44), "width": random.uniform(10, 18), "height": random.uniform(8, 15),
        "side_wall": random.uniform(1.2, 3), "top_wall": random.uniform(1.2, 3), "floor": random.uniform(1, 2),
        "base": random.uniform(1, 2), "end_wall": random.uniform(2, 5),
    }  # fmt: skip


def _semicircular(random: np.random.Generator) -> dict[str, float]:
    return {
        "length": random.uniform(24, 44), "radius": random.uniform(6, 10), "wall": random.uniform(1.2, 3),
        "floor": random.uniform(1, 2), "base": random.uniform(1, 2), "end_wall": random.uniform(2, 5),
    }  # fmt: skip


def _two_materials(random: np.random.Generator) -> dict[str, float]:
    return {
        "length": random.uniform(24, 44), "inner_radius": random.uniform(4, 8), "wall": random.uniform(1.2, 3),
        "base_height": random.uniform(5, 10), "end_wall": random.uniform(2, 5),
    }  # fmt: skip


_RANGES: dict[str, Callable[[np.random.Generator], dict[str, float]]] = {
    "FastPneuNet": _fast, "BellowsOfRevolution": _bellows, "RectangularBender": _rectangular, "SlowPneuNet": _slow,
    "SemicircularBender": _semicircular, "TrapezoidalPneuNet": _trapezoidal, "TwoMaterialBender": _two_materials,
}  # fmt: skip


def described(shape: Shape) -> dict[str, Any]:
    """A shape as JSON stores it."""
    return asdict(shape)
