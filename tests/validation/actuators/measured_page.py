"""Run what docs/measured-actuators.md needs, keep it, and write the page with its pictures.

Call it as ``python tests/validation/actuators/measured_page.py FOLDER``, or `make measured`. What has ended before is
read from the folder. It also writes ``recorded_distances.csv`` beside itself, which the tests compare with.
"""

import csv
import sys
from pathlib import Path

TESTS = Path(__file__).parents[2]
SHARED = ("validation/actuators", "", "validation", "verification")
sys.path[:0] = [str(TESTS / each) for each in SHARED]

import cantilever  # noqa: E402
import page_benders  # noqa: E402
import page_blocked  # noqa: E402
import page_cantilever  # noqa: E402
import page_membranes  # noqa: E402
from bender_data import TURN, from_zero, measured_free, pressure_at  # noqa: E402
from measured_runs import (  # noqa: E402
    FACTOR,
    bender_runs,
    blocked_runs,
    calibrated_membranes,
    fitted_runs,
    free,
    membrane_runs,
)
from page_parts import DOCS, RECORDED, Page, lines_of, percent, text  # noqa: E402

from turgor.studies import Ended, Run, run_all  # noqa: E402


def main(folder: Path) -> None:
    """Run and write."""
    ended = _run([*cantilever.runs(), *bender_runs(), *blocked_runs(), *membrane_runs()], folder)
    page = Page(ended=ended)
    page = Page(ended=ended, factor=bender_factor(page))
    scale = float(page.of(FACTOR).column("factor")[0])
    ended |= _run([*calibrated_membranes(scale), *fitted_runs(page_blocked.springs(page))], folder)
    write(page)


def _run(runs: list[Run], folder: Path) -> dict[str, Ended]:
    return run_all(runs, folder, progress=_told)


def _told(each: Ended) -> None:
    if not each.again:
        sys.stdout.write(f"{each.run.name}: {each.problem or each.result.response.message or 'ended'}\n")
        sys.stdout.flush()


def bender_factor(page: Page) -> float:
    """Factor of all stresses with which 5 chambers bend by 15° at the measured pressure.

    With a film that hardly stretches and no weight, the pressures of a path are proportional to the stresses.
    """
    data = measured_free(5)
    aim = pressure_at(data["pressure"], data["angle"], TURN[5])
    return round(aim / pressure_at(*from_zero(page.of(free(5, "as stated"))), TURN[5]), 3)


def write(page: Page) -> None:
    """Write the page and the recorded distances."""
    parts = [page_cantilever.part(page), page_membranes.part(page)]
    parts.append(text("benders").format(factor=page.factor, **page_benders.part(page)))
    parts.append(text("blocked").format(**page_blocked.part(page)))
    seconds = sum(each.result.seconds for each in page.ended.values() if each.result)
    summary = lines_of(
        ["what", "model", "distance (RMS, of the range)"], [[a, b, percent(c)] for a, b, c in page.distances]
    )
    page_text = text("head").format(summary=summary) + "".join(parts) + text("tail").format(minutes=seconds / 60)
    (DOCS / "measured-actuators.md").write_text(page_text, encoding="utf-8")
    with RECORDED.open("w", encoding="utf-8", newline="") as file:
        rows = csv.writer(file, lineterminator="\n")
        rows.writerow(["what", "model", "distance"])
        rows.writerows([a, b, f"{c:.4f}"] for a, b, c in page.distances)
    sys.stdout.write(f"{len(page.distances)} distances, {seconds / 60:.0f} CPU minutes\n")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
