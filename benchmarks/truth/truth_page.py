"""The page `docs/truth.md`: reference values, errors, and what an error costs."""

import math
from collections.abc import Mapping, Sequence
from itertools import product
from typing import Any

from benchmarks.shared.tables import table
from benchmarks.truth.truth_cases.case import ESTIMATED, STEPS, Case
from benchmarks.truth.truth_speed import compared

Store = Mapping[str, Any]
#: A measure that is shown beside those that the limits are for.
BESIDE = "tip_displacement"
ASKED, ASKED_NEAR, AGREED, NEAR = 0.02, 0.01, 0.003, 60_000
LEAST_RATIO, MOST_RATIO = 0.5, 3.0
#: Runs with up to this many times more or fewer unknowns stand for those at `NEAR`.
AS_NEAR = 2.0
KINDS = ("tetrahedra", "hexahedra")
HEAD = """# How far a mesh is from the truth

This page compares turgor's meshes with reference values. Fifteen loaded actuators have reference values that two
different discretizations confirm; every error on this page is an error against these values. *Unknowns* are degrees
of freedom. The page is written by `make truth` (`python benchmarks/truth/truth.py`).

*Third order* is an independent code in NGSolve (`benchmarks/truth/third_order.py`). It has displacements of third
order, mean stresses of second order that jump between regions, and elements that are curved to the same order.
Elements are bisected where they carry most of the error, or cut in thin layers along re-entrant edges. It shares
dimensions, material parameters and definitions of measures with turgor, and nothing of the engine. *Graded* means
turgor's hexahedra, short next to every sharp edge and up to four times as long from one element to the next.
*Refined* means turgor's default mesh, refined by `refine_to` toward an estimate of 0.1 % or up to 120,000 degrees of
freedom. Some values were copied from printed output: `origin` in `truth_runs.json` says so.

The code in NGSolve has no contact. Where walls touch, tetrahedra and hexahedra are the two discretizations; refined
tetrahedra are then refined on the path without contact, and the path with contact is followed once. The tube between
plates has an obstacle instead of self-contact: without the plates (hexahedra of 5 mm) its volume is 7.67 mL and its
tip moves by 2.300 mm, with them 6.963 mL and 2.597 mm. Hexahedra of 1.7 and 1.25 mm press on one plate with 5.090 N
and 5.097 N (of a quarter model, times two), tetrahedra of 1.4 and 1.0 mm with 5.092 N and 5.091 N. The tip of uniform
tetrahedra of 1 mm is 0.32 % below that of hexahedra; refined ones, whose small elements lie at sharp inner edges,
agree with hexahedra within 0.01 %. The PneuNet that is pressed until its walls touch is less certain: its reference
is the mean of two kinds that differ by 1.75 %. Hexahedra of 3, 1.85 and 1.5 mm give 43.54°, 43.633° and 43.906°,
tetrahedra of 2 and 1.4 mm 42.65° and 42.88°. Both kinds are uniform, and before the walls touch such meshes are 0.4 %
and 2.1 % below the reference; refined ones were not solved with contact. Do not judge a mesh by it to better than
2 %. (Forces, and angles at 1.5 mm, are printed output.)

**Sharp edges decide the error.** Inside a cavity they make stresses without bound, and there the error falls only
about in proportion to the size of the elements, whatever their order. Two series of uniform meshes share this slow
convergence, so that they may agree with each other and both be 1 % off. Therefore the reference of the PneuNets on a
stiff base is that of graded hexahedra, 0.2 mm long next to the edges. On that of three chambers, hexahedra of 3, 2,
1.5 and 1.25 mm with one element through a wall give 6.553°, 6.584°, 6.608° and 6.634°, graded ones of 0.3 and 0.2 mm
6.601° and 6.607°. Third order gives 6.551° on 2,492 elements and 6.571° on 11,779, which leads to about 6.60° if the
error is in proportion to the size of the elements. One chamber of 10 mm shows how far that is from the limit: the tip
moves by 0.12258 mm with elements of 0.2 mm and 0.12280 mm with 0.1 mm, which leads to 0.1230 mm; elements of 2.5 mm
of order three, four and five give 0.11881, 0.12055 and 0.12145 mm, which leads to 0.1229 mm. So these references are
known to about 0.3 %, although third order of the fast one is 0.5 % below.

Layers of thin elements along the edges (`layers` of a case, each layer an eighth as thick as the next one) come
nearer to that limit with fewer degrees of freedom, because elements stay long along the edge. On that chamber, third
order on elements of 2.5 mm gives 0.12241 mm with one layer and 0.12271 mm with two, on elements of 1.7 mm with one
layer 0.12255 mm: the second layer adds 0.25 %, the smaller elements 0.11 %. The slow PneuNet agrees within 0.3 % with
graded hexahedra on elements of 4 mm with one layer, with a quarter of the degrees of freedom of bisected elements,
which were 0.37 % off. On the fast one on a stiff base, elements of 3.5 mm with one layer give 6.568° with 121,369
degrees of freedom, as bisection does with 201,929. With two layers, 214,890 degrees of freedom, Newton's method found
no state: its corrections are far too long, whether it starts at rest or from the second order. That reference stays
0.54 % apart from third order. The wound bender has its reference from one layer: 7.174° and 3.2296 mm, 0.10 % apart
from hexahedra. Without a layer along the corner of its section it gave 7.136° and 3.2133 mm, 0.5 % less; bisected
elements, 37,787 degrees of freedom, gave 7.152° and 3.2165 mm (printed output, not stored).

The half-round bender gets layers along the rims of the fixed face and of the border between its rubbers too. With one
layer along these and along the re-entrant edges, third order gives 2.9650° and 1.24414 mm on elements of 3.5 mm,
2.9623° and 1.24417 mm on elements of 2.6 mm, which is the reference. Angle and volume of graded hexahedra agree
within 0.3 %; their tip is 0.49 % lower: their elements are short along the length only, not at the corners of the
section. The tip of the other meshes is within 0.3 %, but their angle is larger: 2.978° with third order on bisected
elements, 3.001° with refined tetrahedra, whose estimate is 0.24 %. The angle is that of the tip's face, whose rim
bulges, and it is sensitive: on the elements of 2.6 mm, the second order is 2.3 % above the third. Do not judge a mesh
by this angle to better than 0.5 %.

Times are CPU seconds of one thread, with meshing and solving, without compilation. Other work ran on the machine:
compare times within a row, and expect noise of more than 10 %. Fibers are smeared. Volumes are volumes of the cavity,
so their errors are small by nature; angles, displacements and twists are changes from rest. Not every run of the plan
is stored: `python benchmarks/truth/truth.py --missing` makes the others, which takes some hours of one core.
"""
TRUTH = """## Reference values

The last column is the difference of the second discretization from the first one. It is a loose bound on the error of
the reference, because the first one is the finer one. A star marks a difference above 0.3 %: that reference is less
certain than requested, and errors near that difference mean little."""
SUMMARY = """## Errors of the default mesh

The aim is 2 % at the default size and 1 % at 60,000 degrees of freedom, for angles, extensions, twists and volumes.
The table shows the largest error among these for each case. *Target* is the default mesh refined until the estimate
of the headline is 2 %, as `[mesh] target = "2 %"` does it. The last two columns take the stored run whose degrees of
freedom, in brackets, are nearest to 60,000, if it has 30,000 to 120,000. **Bold** is a miss."""
ESTIMATES = """## Estimated over true error

Every run of the sizes double, default and half has an estimated mesh error. The count includes measures whose true
error is above 0.3 %, the uncertainty of the reference; for smaller ones the ratio means little."""
CASES = """## Every mesh

`before` is the element of the version before, `formulation="continuous"`. The default size of hexahedra is longer than
that of tetrahedra. A size of twice the default is left out, or cut, where it is larger than the walls allow. The
column *estimate* is the estimated mesh error of the headline, in brackets its ratio to the true one."""


def page(cases: Sequence[Case], values: Store, runs: Store, machine: Mapping[str, str]) -> str:
    """The whole page."""
    known = [case for case in cases if case.name in values]
    about = "\n".join(f"- {name}: {value}" for name, value in machine.items())
    parts = [HEAD, about, TRUTH, truths(known, values), SUMMARY, summary(known, values, runs)]
    parts += [misses(known, values, runs), ESTIMATES, ratios(known, values, runs), compared(known, values, runs), CASES]
    parts += [f"### {case.title}\n\n{rows(case, values[case.name], runs)}" for case in known]
    return "\n\n".join(parts) + "\n"


def truths(cases: Sequence[Case], values: Store) -> str:
    """Both discretizations of every measure and their difference."""
    lines = []
    for case in cases:
        stored = values[case.name]
        first, second = stored["witnesses"]
        for each in case.measures:
            a, b = first["values"][each.name], second["values"][each.name]
            off = b / a - 1
            lines.append((
                case.title if each is case.measures[0] else "", words(each.name), f"{a:.5g} {each.unit}",
                f"{first['kind']}, {first['unknowns']:,}", f"{b:.5g}", f"{second['kind']}, {second['unknowns']:,}",
                f"{off:+.2%}" + (" *" if abs(off) > AGREED else ""),
            ))  # fmt: skip
    return table(("case", "measure", "first", "by, unknowns", "second", "by, unknowns", "difference"), lines)


def words(name: str) -> str:
    """A column as it is read."""
    return name.replace("_", " ")


def errors(case: Case, stored: Store, row: Store | None) -> dict[str, float] | None:
    """Relative errors of the measures of a run; None where there is no such run."""
    if not row or "values" not in row:
        return None
    return {each.name: row["values"][each.name] / stored["value"][each.name] - 1 for each in case.measures}


def worst(case: Case, stored: Store, row: Store | None) -> tuple[str, float] | None:
    """Measure with the largest error, and that error."""
    result = errors(case, stored, row)
    asked = {name: off for name, off in (result or {}).items() if name != BESIDE}
    return max(asked.items(), key=lambda item: abs(item[1])) if asked else None


def seconds(row: Store) -> float:
    """CPU seconds of meshing and solving."""
    return float(row["meshing"] + row["solving"])


def run_of(case: Case, runs: Store, kind: str, step: str, formulation: str = "mixed") -> Store | None:
    """A stored run."""
    result: Store | None = runs.get("|".join((case.name, kind, step, formulation)))
    return result


def cell(case: Case, stored: Store, row: Store | None, allowed: float) -> str:
    """Largest error of a run, bold where it is more than allowed."""
    result = worst(case, stored, row)
    if result is None or row is None:
        return (row or {}).get("note", "–")
    text = f"{result[1]:+.2%}"
    return f"**{text}**" if abs(result[1]) > allowed else text


def summary(cases: Sequence[Case], values: Store, runs: Store) -> str:
    """Largest errors of each case."""
    lines = []
    for case in cases:
        stored = values[case.name]
        default = run_of(case, runs, "tetrahedra", "default")
        result = worst(case, stored, default)
        lines.append((
            case.title, words(result[0]) if result else "–", cell(case, stored, default, ASKED),
            f"{default['unknowns']:,}" if default and "unknowns" in default else "–",
            cell(case, stored, run_of(case, runs, "tetrahedra", "default", "continuous"), ASKED),
            cell(case, stored, run_of(case, runs, "hexahedra", "default"), ASKED),
            near_text(case, stored, run_of(case, runs, "tetrahedra", "target"), ASKED),
            *(near_text(case, stored, nearest(case, runs, kind), ASKED_NEAR) for kind in KINDS),
        ))  # fmt: skip
    near = [f"{kind}, about 60,000" for kind in KINDS]
    head = ("case", "measure", "tetrahedra", "unknowns", "tetrahedra before", "hexahedra", "target", *near)
    return table(head, lines)


def misses(cases: Sequence[Case], values: Store, runs: Store) -> str:
    """How many cases keep what is asked."""
    lines = []
    for kind in KINDS:
        results = [worst(case, values[case.name], run_of(case, runs, kind, "default")) for case in cases]
        kept = [abs(each[1]) <= ASKED for each in results if each]
        lines.append(f"With {kind} at the default size, {sum(kept)} of {len(kept)} cases are within 2 %.")
    for kind in KINDS:
        results = [worst(case, values[case.name], nearest(case, runs, kind)) for case in cases]
        kept = [abs(each[1]) <= ASKED_NEAR for each in results if each]
        lines.append(f"With {kind} at about 60,000 unknowns, {sum(kept)} of {len(kept)} are within 1 %.")
    return " ".join(lines)


def nearest(case: Case, runs: Store, kind: str) -> Store | None:
    """The run with a kind of cells whose unknowns are nearest to 60,000; None where none is near."""
    results = [run_of(case, runs, kind, step) for step in STEPS]
    solved = [row for row in results if row and "values" in row]
    near = [row for row in solved if 1 / AS_NEAR <= row["unknowns"] / NEAR <= AS_NEAR]
    return min(near, key=lambda row: abs(math.log(row["unknowns"] / NEAR)), default=None)


def near_text(case: Case, stored: Store, row: Store | None, allowed: float) -> str:
    """Error of a run and its unknowns."""
    return f"{cell(case, stored, row, allowed)} ({row['unknowns']:,})" if row and "unknowns" in row else "–"


def ratios(cases: Sequence[Case], values: Store, runs: Store) -> str:
    """How often the estimate over the true error lies where it should, and the ratios outside."""
    inside, outside = 0, []
    for case in cases:
        for kind, step in product(KINDS, ESTIMATED):
            row = run_of(case, runs, kind, step)
            off = errors(case, values[case.name], row) or {}
            for name, estimated in (row or {}).get("estimates", {}).items():
                if abs(off[name]) <= AGREED:
                    continue
                ratio = estimated / abs(off[name] * values[case.name]["value"][name])
                inside += (good := LEAST_RATIO <= ratio <= MOST_RATIO)
                if not good:
                    outside.append(f"{case.name}, {kind}, {step}, {words(name)}: {ratio:.2f} of {off[name]:+.2%}")
    count = inside + len(outside)
    told = "\n".join(f"- {each}" for each in outside)
    return f"{inside} of {count} ratios lie between {LEAST_RATIO:g} and {MOST_RATIO:g}. Outside:\n\n{told}"


def rows(case: Case, stored: Store, runs: Store) -> str:
    """Table of all runs of a case."""
    lines = []
    for kind in KINDS:
        for formulation in ("mixed", "continuous"):
            for step in STEPS:
                row = run_of(case, runs, kind, step, formulation)
                if row:
                    name = kind + (", before" if formulation == "continuous" else "")
                    lines.append(line(case, stored, row, name, step))
    head = ("cells", "size", "[mm]", "number", "unknowns", "CPU s", *(words(each.name) for each in case.measures))
    return table((*head, "estimate"), lines)


def line(case: Case, stored: Store, row: Store, name: str, step: str) -> tuple[str, ...]:
    """One run: its size, cost and errors."""
    off = errors(case, stored, row)
    known = tuple(f"{row[each]:,.4g}" if each == "size" else f"{row[each]:,}" if each in row else "–"
                  for each in ("size", "cells", "unknowns") if each in row)  # fmt: skip
    if off is None:
        empty = ("–",) * (len(case.measures) + 1)
        return (name, step, *known, *("–",) * (3 - len(known)), row.get("note", "–"), *empty)
    results = (f"{off[each.name]:+.2%}" for each in case.measures)
    return (name, step, *known, f"{seconds(row):.1f}", *results, estimate(case, stored, row, off))


def estimate(case: Case, stored: Store, row: Store, off: Mapping[str, float]) -> str:
    """Estimated error of the first measure that has one, and its ratio to the true one."""
    for name, value in row.get("estimates", {}).items():
        share = abs(value / stored["value"][name])
        ratio = f" ({share / abs(off[name]):.1f})" if off[name] else ""
        return f"{share:.2%}{ratio}"
    return "–"
