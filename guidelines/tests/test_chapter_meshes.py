"""Guidelines on meshes: judges that come out both ways; families that exist."""

import numpy as np
import pytest

import turgor as tg
from turgor.studies import Computed
from turgor.units import deg, kPa
from turgor_guidelines.catalog import chosen
from turgor_guidelines.convergence import element_kinds, remeshing
from turgor_guidelines.guideline import Verdict


def made(**columns) -> Computed:
    units = {"pressure": "kPa", "bending_angle": "deg"}
    of = tuple(tg.experiments.Column(name, units.get(name, ""), np.array(values)) for name, values in columns.items())
    return Computed(response=tg.Response(columns=of, source=tg.laws.Source(text="made up")))


@pytest.mark.parametrize("rule", chosen(()), ids=lambda rule: rule.key)
def test_guidelines_are_about_families_that_exist(rule):
    assert set(rule.families) <= set(tg.jobs.ACTUATORS)
    assert len(set(rule.families)) == len(rule.families)


def inflated(error: float, steps: int = 4) -> Computed:
    """Motion that is off by more and more, to a relative error in the last of four steps."""
    share = np.linspace(0, 1, 5)[: steps + 1]
    return made(pressure=40 * kPa * share, motion=share * (1 + error * share), largest_stretch=1 + 2 * share)


def test_remeshing_comes_out_both_ways():
    def judged(*errors, steps=4):
        names = [f"cells of {size:g} mm" for size in (*remeshing.SIZES, remeshing.FINEST)]
        results = dict(zip(names, [inflated(error, steps) for error in (*errors, 0.0)], strict=True))
        return remeshing.judge(results, target=40.0)

    assert judged(0.1, 0.05, 0.03).verdict is Verdict.CONFIRMED
    assert judged(0.1, 0.05, 0.001).verdict is Verdict.CONDITIONAL
    fine = judged(0.005, 0.002, 0.001)
    assert fine.verdict is Verdict.NOT_REPRODUCED
    assert "every path reached its end" in fine.finding
    stopped = judged(0.005, 0.002, 0.001, steps=3)
    assert stopped.verdict is Verdict.CONFIRMED
    assert "4 of 4 paths stopped early" in stopped.finding


def test_kinds_of_cells_come_out_both_ways():
    def found(hexahedra, tetrahedra):
        """Errors, distortion and lost volume by kind; unknowns rise as the cells get smaller."""
        runs = {}
        for kind, (factor, worst, lost) in (("hexahedra", hexahedra), ("tetrahedra", tetrahedra)):
            for size in element_kinds.SIZES[kind]:
                off = 0.0 if size == element_kinds.SIZES[kind][-1] else factor * size
                columns = {"bending_angle": [10 * deg * (1 + off)], "unknowns": [1e4 / size]}
                runs[f"{kind} of {size:g} mm"] = made(**columns, worst_cell=[worst], lost_volume=[lost])
        return runs

    better, worse = (0.001, 0.8, 1e-4), (0.01, 0.3, 1e-3)
    assert element_kinds.judge(found(better, worse)).verdict is Verdict.CONFIRMED
    other = element_kinds.judge(found(worse, better))
    assert other.verdict is Verdict.NOT_REPRODUCED
    assert "in 0 of 4 sizes" in other.conditions
    mixed = found(better, (0.01, 0.9, 1e-3))
    assert element_kinds.judge(mixed).verdict is Verdict.CONDITIONAL
    off = made(bending_angle=[11 * deg], unknowns=[1e4], worst_cell=[0.9], lost_volume=[1e-3])
    apart = mixed | {"tetrahedra of 1 mm": off}
    assert element_kinds.judge(apart).verdict is Verdict.NOT_JUDGED
