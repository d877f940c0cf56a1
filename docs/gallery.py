"""The animations of the gallery, each from a run of an example job: `make gallery` renews them (some minutes).

A run is made coarse. The pictures are evenly spaced along the motion, and play forwards and backwards.
"""

import argparse
from pathlib import Path

import turgor as tg

PICTURES = Path(__file__).parent / "images" / "gallery"

#: Families, and what is changed in the example job of each.
MOVING = {
    "fast_pneunet": {
        "actuator.chambers": 4,
        "actuator.length": "40 mm",
        "mesh.size": "4 mm",
        "loads.pressure": "14 kPa",
    },
    "bellows_of_revolution": {},
    "twisting_tube": {},
}

#: Steps of a run, and how its motion is shown.
STEPS = 10
MOTION = tg.pictures.Motion(seconds=1.0, rate=12, width=420)


def solved(name: str) -> tg.Solution:
    """Solve the job of a family in equal steps."""
    steps = {f"procedure.{key}": 1 / STEPS for key in ("first_step", "max_step")}
    job = tg.jobs.read_job(tg.jobs.example_job(name), {**MOVING[name], **steps})
    model, _ = tg.jobs.prepare(job)
    return tg.solve(model, job.procedure)


def main() -> None:
    """Write the pictures that are requested."""
    parser = argparse.ArgumentParser(description="Write docs/images/gallery.")
    parser.add_argument("names", nargs="*", default=list(MOVING), help="families, by default all of the gallery")
    PICTURES.mkdir(exist_ok=True)
    for name in parser.parse_args().names:
        tg.pictures.write_motion(PICTURES / f"{name}.webp", solved(name), motion=MOTION)


if __name__ == "__main__":
    main()
