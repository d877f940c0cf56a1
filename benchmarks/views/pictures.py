"""CPU time of still pictures.

Run `python benchmarks/views/pictures.py [RUN]`; it takes about five minutes without the folder of a run.

The demo finger (examples/fast_pneunet.toml, 11,214 nodes) at its last state. Each picture is drawn
three times; the first one loads libraries, the best of the others counts.
"""

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory
from time import process_time

import turgor as tg

JOB = Path(__file__).parents[2] / "examples" / "fast_pneunet.toml"

#: What a still picture may take [CPU s].
TARGET = 2.0

PICTURES = {
    "stress, 1200 pixels": {"width": 1200},
    "stress, 1600 pixels": {"width": 1600},
    "contact, 1200 pixels": {"width": 1200, "color_by": "contact_pressure"},
    "cut away, 1200 pixels": {"width": 1200, "style": tg.pictures.Style(cut="y")},
    "transparent, 1200 pixels": {"width": 1200, "style": tg.pictures.Style(transparent=True)},
}


def seconds(solution: tg.Solution, options: dict) -> list[float]:
    """CPU time of each of three drawings, fields of the states computed anew."""
    spent = []
    with TemporaryDirectory() as folder:
        for _ in range(3):
            begun = process_time()
            tg.picture(solution, Path(folder) / "picture.png", **options)
            spent.append(process_time() - begun)
    return spent


def rows(solution: tg.Solution) -> list[tuple[str, float, float]]:
    """Each picture with the CPU seconds of the best and of the first drawing."""
    timed = ((name, seconds(solution, options)) for name, options in PICTURES.items())
    return [(name, min(others), first) for name, (first, *others) in timed]


def main() -> None:
    """Print the table."""
    parser = argparse.ArgumentParser(description=__doc__.splitlines()[0])
    parser.add_argument("run", nargs="?", help="folder of a run, or a saved solution, of the demo")
    given = parser.parse_args().run
    if given is None:
        job = tg.jobs.read_job(JOB)
        model, _ = tg.jobs.prepare(job)
        solution = tg.solve(model, job.procedure)
    else:
        solution = tg.load(given)
    print(f"{len(solution.model.mesh.points):,} nodes; target {TARGET:g} CPU s")
    for name, best, first in rows(solution):
        print(f"{name:26} {best:5.2f} CPU s (first {first:.2f})")


if __name__ == "__main__":
    main()
