"""Speed of fitting on measured data, against what is asked for: python benchmarks/core/fitting.py.

Exit code 1 where a limit is passed. The first call of each law compiles its derivatives, which is counted, too, except
where a line says otherwise.
"""

import sys
from collections.abc import Callable
from pathlib import Path
from time import perf_counter

import numpy as np

from turgor.core.materials.experiments.material_test import MaterialTest
from turgor.core.materials.experiments.read_tests import read_test
from turgor.core.materials.experiments.test_edits import crop, thin
from turgor.core.materials.fitting.fit_laws import fit
from turgor.core.materials.fitting.ranking import rank
from turgor.core.materials.laws.homogeneous import nominal_stress, uniaxial
from turgor.core.materials.laws.laws import Ogden

DATA = Path(__file__).parents[2] / "tests" / "validation" / "data"
LAWS = ("neo-hooke", "mooney-rivlin", "yeoh", "ogden-3", "gent")


def silicone(file: Path) -> MaterialTest:
    return thin(crop(read_test(file, mode="uniaxial"), 1.0, 4.0))


def seconds(work: Callable[[], object]) -> float:
    began = perf_counter()
    work()
    return perf_counter() - began


def main() -> int:
    files = sorted((DATA / "marechal-2020-silicones" / "raw").glob("*.csv"))
    folder = DATA / "treloar-1944-rubber"
    treloar = [read_test(folder / f"{mode}.csv") for mode in ("uniaxial", "equibiaxial", "pure_shear")]
    whole = read_test(files[0], mode="uniaxial")
    law = Ogden(mu=(0.63e6, 0.0012e6, -0.01e6), alpha=(1.3, 5.0, -2.0))
    grid = np.linspace(1.0, 7.0, 100_000)
    fit("yeoh", treloar[0])  # SymPy starts here, once
    rows = (
        (f"Yeoh on all {len(whole.stretch)} points of '{files[0].stem}', warm", 0.1, lambda: fit("yeoh", whole)),
        ("Ogden-3 on Treloar's three tests, 20 starts", 3.0, lambda: fit("ogden-3", treloar)),
        (
            f"{len(files)} silicones x {len(LAWS)} laws, reading included",
            60.0,
            lambda: [rank(LAWS, silicone(file), stretch=(1.0, 4.0)) for file in files],
        ),
        ("100,000 points of a curve of Ogden-3", 1.0, lambda: nominal_stress(law, uniaxial(grid))),
    )
    slow = 0
    for text, limit, work in rows:
        took = seconds(work)
        slow += took > limit
        print(f"{text}: {took:.3f} s (limit {limit:g} s){' TOO SLOW' if took > limit else ''}")
    return int(slow > 0)


if __name__ == "__main__":
    sys.exit(main())
