"""Time of a call of a surrogate, and of its training.

Run ``python benchmarks/studies/surrogates.py``; it takes a minute or two of one core.

A call is one point: the check of its range, mean and standard deviation; the median of 2000. Bar: below 1 ms.
"""

import os

os.environ.update(dict.fromkeys(("OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"), "1"))

from statistics import median
from time import perf_counter, process_time

import numpy as np

import turgor as tg
from turgor.units import kPa, mm

FACTORS = [
    tg.studies.Factor(name="C10", low=50 * kPa, high=100 * kPa, unit="kPa"),
    tg.studies.Factor(name="wall", low=1 * mm, high=2 * mm, unit="mm"),
    tg.studies.Factor(name="height", low=10 * mm, high=20 * mm, unit="mm"),
]

#: Rows, and input besides the factors.
CASES = ((32, ""), (128, ""), (32, "pressure"), (128, "pressure"))


def finger(C10: float, wall: float, height: float) -> tg.Response:
    """A finger that bends with pressure over stiffness."""
    pressure = np.linspace(0.0, 50 * kPa, 11)
    angle = np.arctan(pressure / C10 * (height / 15e-3) * (1.5 * mm / wall) ** 1.2)
    columns = (
        tg.experiments.Column("pressure", "kPa", pressure),
        tg.experiments.Column("bending_angle", "deg", angle),
        tg.experiments.Column("tip_displacement_z", "mm", -60 * mm * (1 - np.cos(angle))),
    )
    return tg.Response(columns=columns, source=tg.laws.Source(text="an arc"))


def called(fitted: tg.studies.Surrogate) -> tuple[float, float]:
    """Median times of `predict` (mean and standard deviation) and of `means` at one point [ms]."""
    values = {each.name: each.at(0.4) for each in fitted.factors}
    point = np.array([list(values.values())])
    times: list[list[float]] = [[], []]
    for _ in range(2000):
        for kept, function, given in ((times[0], fitted.predict, values), (times[1], fitted.means, point)):
            begun = perf_counter()
            function(given)
            kept.append(perf_counter() - begun)
    return 1e3 * median(times[0]), 1e3 * median(times[1])


def main() -> None:
    print(f"{'surrogate':40}{'points':>7}{'training, CPU s':>17}{'predict, ms':>13}{'mean only, ms':>15}{'error':>9}")
    for rows, along in CASES:
        study = tg.sweep(finger, designs=tg.studies.sobol(FACTORS, rows))
        begun = process_time()
        fitted = tg.studies.surrogate(study, along=along)
        seconds = process_time() - begun
        both, mean = called(fitted)
        name = f"{rows} rows{', along the pressure' if along else ''}"
        points = len(fitted.held_out[0].computed)
        error = 100 * max(each.share for each in fitted.held_out)
        print(f"{name:40}{points:7d}{seconds:17.1f}{both:13.3f}{mean:15.3f}{error:8.2g} %")


if __name__ == "__main__":
    main()
