"""Where the measured data of the validation tests are, and how they are read."""

from pathlib import Path

from turgor.core.materials.experiments.cycles import select_cycle
from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test
from turgor.core.materials.experiments.specimen import Specimen
from turgor.core.materials.experiments.test_edits import crop, remove_slack, thin
from turgor.units import N, mm

DATA = Path(__file__).parent / "data"
SILICONES = sorted((DATA / "marechal-2020-silicones" / "raw").glob("*.csv"))


def treloar() -> list[MaterialTest]:
    """Natural rubber in three modes, Treloar 1944."""
    return [
        read_test(DATA / "treloar-1944-rubber" / f"{mode}.csv") for mode in ("uniaxial", "equibiaxial", "pure_shear")
    ]


def meunier(mode: str) -> MaterialTest:
    """An unfilled silicone, Meunier et al. 2008, in tension."""
    return crop(read_test(DATA / "meunier-2008-silicone" / f"{mode}.csv"), 1.0, 3.0)


def ecoflex_planar() -> list[MaterialTest]:
    """Ecoflex 00-30 in planar tension: the last loading of four tests, taut at 0.1 N as its authors have it."""
    section = 150 * mm**2
    results = []
    for name in ("planar4A", "planar4B", "planar5A", "planar5B"):
        file = DATA / "epfl-ecoflex30-actuators" / "planar" / f"{name}.csv"
        test = read_test(file, specimen=Specimen(length=9 * mm, area=section), cyclic=True)
        results.append(remove_slack(select_cycle(test), 0.1 * N / section))
    return results


def silicone(file: Path, *, upto: float) -> MaterialTest:
    """One of the 13 silicones of Marechal et al. 2020, thinned."""
    return thin(crop(read_test(file, mode="uniaxial"), 1.0, upto))
