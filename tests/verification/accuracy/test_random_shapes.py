"""Estimated mesh errors cover the true ones on random shapes whose walls are one or two cells thick.

Problem: three shapes of seed 7 of `benchmarks/accuracy/estimates.py` on their default meshes: a trapezoidal and a slow
PneuNet on tetrahedra, a rectangular bender on hexahedra.
Reference: `benchmarks/accuracy/estimates_seed_7.json`, hexahedra that are short next to sharp edges.
Tolerance: the estimate is 1 to 3 times the true error of angle, tip and volume, and 1 to 6 times that of the 99th
percentile of stress. Scaled by the share of the error in the cells that were cut, as it was once, it missed: 0.75 for a
tip, 0.61 for a stress.
"""

import json
import sys
from pathlib import Path

import pytest

import turgor as tg

ROOT = Path(__file__).parents[3]
sys.path.append(str(ROOT))

from benchmarks.accuracy.estimate_shapes import described, drawn  # noqa: E402
from benchmarks.accuracy.estimates import FLOOR, compared, references, run  # noqa: E402

STORED = json.loads(references(7).read_text("utf-8"))


def test_a_seed_always_draws_the_shapes_whose_references_are_stored():
    for shape, stored in zip(drawn(7, len(STORED)), STORED, strict=True):
        same = json.loads(json.dumps(described(shape)))
        assert same == {name: stored[name] for name in same}


@pytest.mark.parametrize(("number", "kind"), [(5, "tetrahedra"), (9, "hexahedra"), (10, "tetrahedra")])
def test_estimate_covers_the_true_error(number, kind, record_verification):
    shape = drawn(7, number + 1)[number]
    row = run(shape, STORED[number]["pressure"], kind)
    pairs = {name: (error, estimate) for name, error, estimate in compared(STORED[number], row) if abs(error) > FLOOR}
    assert len(pairs) >= 3
    for name, (error, estimate) in pairs.items():
        most = 6 if name == tg.measures.von_mises_p99.name else 3
        record_verification(
            claim=f"random {shape.family}, {kind}: estimate over true error, {name.replace('_', ' ')}",
            source="graded hexahedra, benchmarks/accuracy/estimates.py",
            expected=1.5,
            got=estimate / abs(error),
            tolerance=f"1 to {most}",
        )
        assert 1 < estimate / abs(error) < most
