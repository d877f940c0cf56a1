"""The table of plausible ranges: one row for each quantity, with its range, the source of the range, and advice.

``docs/findings.md`` shows the same rows, and a test compares them.
"""

from dataclasses import dataclass
from math import inf

from turgor.core.solvers.checks.plausibility import of_loads, of_materials, of_shapes
from turgor.core.solvers.checks.plausibility.question import Reader, shown
from turgor.foundation.finding import Severity


@dataclass(frozen=True, slots=True, kw_only=True)
class Row:
    """The range of one quantity.

    Parameters
    ----------
    code : str
        Code of the finding.
    quantity : str
        What it is, as the subject of a sentence: "the density is".
    low, high : float [SI]
        Ends of the range; infinite where it is open.
    unit : str
        SI unit; empty for numbers.
    source : str
        Where the range comes from.
    advice : str
        What to look at.
    read : callable
        ``read(question)`` yields the magnitudes.
    severity : Severity
        A warning, because a user may know better; an error where nothing beyond the range is possible.
    """

    code: str
    quantity: str
    low: float = -inf
    high: float = inf
    unit: str = ""
    source: str
    advice: str
    read: Reader
    severity: Severity = Severity.WARNING

    def holds(self, value: float) -> bool:
        """Whether a value lies in the range; ends belong to it, up to round-off."""
        slack = 1e-9 * abs(value)
        return self.low - slack <= value <= self.high + slack

    @property
    def range_text(self) -> str:
        """The range in words, as the documents show it."""
        if self.low == -inf:
            return f"at most {shown(self.high, self.unit)}"
        if self.high == inf:
            return f"at least {shown(self.low, self.unit)}"
        return f"{shown(self.low, self.unit)} to {shown(self.high, self.unit)}"


#: The paper whose tables the ranges come from.
REVIEW = "Xavier et al. 2021"

ROWS: tuple[Row, ...] = (
    Row(
        code="P01", quantity="initial shear modulus of a rubber", low=3e3, high=of_materials.STIFFEST_RUBBER, unit="Pa",
        source="10 kPa the softest record of the library, 15 MPa at Shore 95 A by Gent 1958",
        advice="Check the unit of the coefficients: MPa are 1000 kPa.",
        read=of_materials.rubber_modulus,
    ),
    Row(
        code="P01", quantity="initial shear modulus of a stiff part", low=of_materials.STIFFEST_RUBBER, high=200e9,
        unit="Pa", source="paper to tungsten, 161 GPa; steel has 80 GPa", advice="Check the unit of Young's modulus.",
        read=of_materials.stiff_modulus,
    ),
    Row(
        code="P01", quantity="Poisson's ratio of a rubber", low=0.44, high=0.5,
        source=f"0.48 to 0.5 in {REVIEW}, table 2",
        advice="Leave bulk_modulus out for rubber that keeps its volume; only foams are as compressible as this.",
        read=of_materials.poisson_ratio,
    ),
    Row(
        code="P01", quantity="locking stretch in uniaxial tension", low=1.5,
        source=f"elastomers bear strains over 500 %, {REVIEW}",
        advice="Check Jm or locking_stretch: the law is infinitely stiff beyond that stretch.",
        read=of_materials.locking_stretch,
    ),
    Row(
        code="P01", quantity="density of a rubber", low=500.0, high=3000.0, unit="kg/m³",
        source="Elastosil 1130 kg/m³ in the library",
        advice="Check its unit: 1.07 g/cm³ are 1070 kg/m³.", read=of_materials.rubber_density,
    ),
    Row(
        code="P01", quantity="density of a stiff part, sheet or thread", low=100.0, high=20e3, unit="kg/m³",
        source="paper 750, Kevlar 1440 kg/m³ in the library; steel 7850, tungsten 19300 kg/m³",
        advice="Check its unit: 1.44 g/cm³ are 1440 kg/m³.", read=of_materials.stiff_density,
    ),
    Row(
        code="P01", quantity="Young's modulus of a sheet or thread", low=1e5, high=500e9, unit="Pa",
        source=f"{REVIEW}, table 3; carbon fibers", advice="Check its unit.", read=of_materials.sheet_modulus,
    ),
    Row(
        code="L08", quantity="gauge pressure", low=-101.325e3, unit="Pa", source="vacuum",
        advice="Ask for less suction; gauge pressure counts from the pressure of the air around.",
        read=of_loads.lowest_pressure, severity=Severity.ERROR,
    ),
    Row(
        code="P02", quantity="gauge pressure", high=2e6, unit="Pa", source="air supplies end at about 1 MPa",
        advice="Check its unit: most soft actuators work at 5 to 500 kPa.", read=of_loads.largest_pressure,
    ),
    Row(
        code="P02", quantity="ratio of pressure to Young's modulus × wall / size", low=1e-4, high=0.5,
        source="0.001 to 0.03 in the examples; a neo-Hookean balloon holds 0.14",
        advice="Check the units of pressure, moduli and lengths: far above the range no actuator holds, far below it "
        "none moves.",
        read=of_loads.pressure_over_stiffness,
    ),
    Row(
        code="P02", quantity="acceleration", low=0.1, high=100.0, unit="m/s²", source="9.8 on Earth, 1.6 on the Moon",
        advice="Check its unit.", read=of_loads.acceleration,
    ),
    Row(
        code="P02", quantity="ratio of injected volume to cavity", low=1e-4, high=50.0,
        source="a sphere of twice the radius takes 7", advice="Check its unit: 1 mL is 1e-6 m³.",
        read=of_loads.injected_size,
    ),
    Row(
        code="L08", quantity="ratio of injected volume to cavity", low=-1.0, source="an empty cavity",
        advice="Draw off less than the cavity holds.", read=of_loads.injected_share, severity=Severity.ERROR,
    ),
    Row(
        code="P03", quantity="longest side", low=1e-3, high=5.0, unit="m", source="a rule of this project",
        advice="Check the unit of the dimensions, or of the file.", read=of_shapes.longest_side,
    ),
    Row(
        code="P03", quantity="mean wall", low=50e-6, high=0.1, unit="m", source="a rule of this project",
        advice="Check the unit of the dimensions, or of the file.", read=of_shapes.mean_wall,
    ),
    Row(
        code="P03", quantity="thickness of a sheet", low=1e-6, high=5e-3, unit="m", source="foils to plates",
        advice="Check its unit; a thicker layer is a region of its own.", read=of_shapes.sheet_thickness,
    ),
    Row(
        code="P03", quantity="diameter of a thread", low=5e-6, high=3e-3, unit="m", source="filaments to cords",
        advice="Check its unit.", read=of_shapes.thread_diameter,
    ),
    Row(
        code="P04", quantity="turns of a thread", low=0.01, high=1000.0,
        source="100 mm of thread of 0.1 mm, side by side",
        advice="State the turns of one thread over the whole face; spacing or starts say how many threads there are.",
        read=of_shapes.turns,
    ),
    Row(
        code="P05", quantity="distance of an obstacle over the longest side", high=2.0,
        source="actuators rarely stretch to twice their length",
        advice="Check its place and the unit: the actuator will not reach it.", read=of_shapes.obstacle_distance,
    ),
    Row(
        code="P06", quantity="number of iterations", low=4, high=1000, source="Newton's method takes 3 to 8",
        advice="Leave it at 15; with too few no step converges.", read=of_shapes.iterations,
    ),
    Row(
        code="P06", quantity="relative residual", low=1e-10, high=1e-3, source="from round-off to the error of a mesh",
        advice="Leave it at 1e-6.", read=of_shapes.tolerance,
    ),
)  # fmt: skip
