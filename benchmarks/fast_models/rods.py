"""Speed of Cosserat rods against what is asked for: python benchmarks/fast_models/rods.py.

Exit code 1 where a limit is passed or a tip is wrong. Times are CPU seconds, the least of ten runs after the first.
"""

import sys
from collections.abc import Callable
from time import process_time

import numpy as np
from turgor.loads import Gravity
from turgor.obstacles import Plane
from turgor.rods import PlateForce, Rod, RodModel, RodSection, RodSolution, dynamic, natural_frequencies, static

SECTION = RodSection.from_moduli(EA=1e6, GA=1e6, EI=1.0, GJ=1.0, mass_per_length=1.0)
#: Tip of the inextensible elastica under P L²/EI = 4 and 10, by elliptic integrals.
ELASTICA = {4.0: (0.671059, 0.669964), 10.0: (0.445004, 0.810609)}


def elastica(force: float, elements: int) -> Callable[[], RodSolution]:
    rod = Rod(section=SECTION, length=1.0, elements=elements)
    model = RodModel(rods=[rod], loads=[PlateForce(force=(0, 0, force))])
    return lambda: static(model)


def error(force: float, solution: RodSolution) -> float:
    return float(np.linalg.norm(solution.tip[-1, [0, 2]] - ELASTICA[force]))


def least(work: Callable[[], object]) -> float:
    work()
    times = []
    for _ in range(10):
        began = process_time()
        work()
        times.append(process_time() - began)
    return min(times)


def main() -> int:
    rod, table = Rod(section=SECTION, length=1.0), Plane(point=(0, 0, -0.2), normal=(0, 0, 1))
    still = static(RodModel(rods=[rod], loads=[PlateForce(force=(0, 2.0, 3.0))])).states[-1]
    free = RodModel(rods=[rod])
    resting = RodModel(rods=[rod], loads=[Gravity(acceleration=5.0)], planes=[table])
    rows: tuple[tuple[str, float, Callable[[], object]], ...] = (
        ("static, P L²/EI = 4, 8 elements", 0.02, elastica(4.0, 8)),
        ("static, P L²/EI = 10, 8 elements", 0.02, elastica(10.0, 8)),
        ("static, P L²/EI = 10, 16 elements", 0.04, elastica(10.0, 16)),
        ("static, tip on a plane, 16 elements", 0.05, lambda: static(resting)),
        ("100 steps in time, 16 elements", 2.0, lambda: dynamic(free, duration=1.0, step=0.01, start=still)),
        ("six natural frequencies, 16 elements", 0.05, lambda: natural_frequencies(free)),
    )
    bad = 0
    for force, elements in ((4.0, 8), (10.0, 8), (10.0, 16)):
        off = error(force, elastica(force, elements)())
        bad += off > 1e-4
        print(f"P L²/EI = {force:g}, {elements} elements: tip off by {off:.1e} of the length (limit 1e-4)")
    for text, limit, work in rows:
        took = least(work)
        bad += took > limit
        print(f"{text}: {1e3 * took:.1f} ms (limit {1e3 * limit:g} ms){' TOO SLOW' if took > limit else ''}")
    return int(bad > 0)


if __name__ == "__main__":
    sys.exit(main())
