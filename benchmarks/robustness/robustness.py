"""Hard cases: which converge to the load asked for, which stop with the right diagnosis, which go wrong.

`make robustness` runs all of them, each with a limit of CPU time, checks every end against something independent (a
closed form, a known limit pressure, the energy balance, many small steps by plain Newton's method) and writes
robustness.md.
python benchmarks/robustness/robustness.py [word ...]   runs those with one of the words in their name, and renews
                                                        their lines.
"""

import sys
from collections import Counter
from collections.abc import Mapping
from pathlib import Path

sys.path.insert(0, str(Path(__file__).parents[2]))  # so that `benchmarks` is found
from benchmarks.robustness.robustness_cases import CASES
from benchmarks.robustness.robustness_cases.case import (
    DIAGNOSED,
    GAVE_UP,
    REACHED,
    UNCHECKED,
    UNSTABLE,
    WRONG,
    Verdict,
    run,
)
from benchmarks.shared.machine import machine
from benchmarks.shared.tables import table
from turgor.core.engine.warmup.compiling import compile_kernels
from turgor.core.engine.warmup.needs import Needs

PAGE = Path(__file__).parent / "robustness.md"
HEAD = ("case", "what is hard", "end", "unknowns", "steps", "iterations", "CPU s", "check")
TEXT = (
    "# Robustness\n\n"
    "Written by `make robustness`. No setting is changed except where the difficulty is a setting (a first step of "
    "the whole load). One thread. *Wrong* is an end that the check refutes, or a stop for the wrong reason; "
    "*unstable* the load asked for on a branch that a real body leaves, as the message says; *gave up* a stop short"
    " of a load that can be reached, with a status that says no more than that; *unchecked* an end whose check took"
    " long."
)

Row = tuple[str, ...]


def row(verdict: Verdict) -> Row:
    """One line of the table."""
    numbers = (f"{verdict.unknowns:,}", str(verdict.steps), str(verdict.iterations), f"{verdict.seconds:.1f}")
    text = verdict.text.replace("|", "/").replace("\n", " ")
    return (verdict.name, verdict.hard, verdict.end, *numbers, text)


def summary(rows: Mapping[str, Row]) -> str:
    """The counts, and how they compare with the target."""
    ends = Counter(line[2] for line in rows.values())
    possible = sum(not case.stops for case in CASES if case.name in rows)
    of_these = ends[REACHED] / max(possible, 1)
    counts = ", ".join(f"{ends[end]} {end}" for end in (REACHED, DIAGNOSED, UNSTABLE, UNCHECKED, GAVE_UP, WRONG))
    return (
        f"{len(rows)} cases: {counts}. {ends[REACHED] / len(rows):.0%} of all, and {of_these:.0%} of "
        f"the {possible} whose load may be reached by the procedure asked for, converged; the target is 90 % and none "
        f"wrong. {sum(int(line[5]) for line in rows.values()):,} iterations and "
        f"{sum(float(line[6]) for line in rows.values()):.0f} CPU s in all, checks not counted."
    )


def written() -> dict[str, Row]:
    """The lines of the page, by the name of the case; none where there is no page."""
    lines = PAGE.read_text("utf-8").splitlines() if PAGE.exists() else []
    cells = (tuple(cell.strip() for cell in line.strip("|").split(" | ")) for line in lines if line.startswith("| "))
    return {line[0]: line for line in cells if len(line) == len(HEAD) and line != HEAD}


def write(rows: Mapping[str, Row]) -> None:
    """Write the page: of the cases that there are, in their order."""
    about = "\n".join(f"- {name}: {value}" for name, value in machine().items())
    known = {case.name: rows[case.name] for case in CASES if case.name in rows}
    lines = (TEXT, about, summary(known), table(HEAD, list(known.values())))
    PAGE.write_text("\n\n".join(lines) + "\n", "utf-8")


def main() -> None:
    """Run the cases that were asked for, print each as it is done, and renew their lines on the page."""
    words = sys.argv[1:]
    chosen = [case for case in CASES if not words or any(word in case.name for word in words)]
    for nodes, side in ((10, 6), (27, 9)):
        compile_kernels(None, Needs(nodes=nodes, sides=side))
    if not words:
        PAGE.unlink(missing_ok=True)
    for case in chosen:
        line = row(run(case))
        print(" | ".join(line), flush=True)
        write(written() | {case.name: line})
    if chosen:
        print(f"\n{summary({name: line for name, line in written().items() if name in {c.name for c in chosen}})}")


if __name__ == "__main__":
    main()
