"""The moving pictures of the gallery, each from a run of an example job: `make gallery` renews them (some minutes).

A run is made coarse, and its steps equal, so that the pictures are evenly spaced in pressure. They play forwards and
backwards.
"""

import argparse
from pathlib import Path
from tempfile import TemporaryDirectory

from PIL import Image

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

#: Pictures of one movement, their width in pixels as drawn and as shown, and the time that each is shown [ms].
STEPS, DRAWN, WIDTH, SHOWN = 10, 800, 420, 90

#: Rows of pixels that a picture has for its title and its legend.
TITLE, LEGEND = 90, 140


def movement(name: str) -> list[Image.Image]:
    """Solve the job of a family, and draw its states from the same place, without title and legend."""
    steps = {f"procedure.{key}": 1 / STEPS for key in ("first_step", "max_step")}
    job = tg.jobs.read_job(tg.jobs.example_job(name), {**MOVING[name], **steps})
    model, _ = tg.jobs.prepare(job)
    states = tg.solve(model, job.procedure).states
    view = tg.pictures.shared_view([states[0], states[-1]], DRAWN)
    frames = []
    with TemporaryDirectory() as folder:
        for state in states:
            tg.pictures.write_picture(Path(folder) / "state.png", state, view)
            picture = Image.open(Path(folder) / "state.png").convert("RGB")
            frames.append(picture.crop((0, TITLE, picture.width, picture.height - LEGEND)))
    return frames


def save(path: Path, frames: list[Image.Image]) -> None:
    """Write pictures that move there and back; they hang from their upper edge, where the fixed end is."""
    width, height = (max(frame.size[axis] for frame in frames) for axis in (0, 1))
    there = []
    for frame in frames:
        whole = Image.new("RGB", (width, height), "white")
        whole.paste(frame)
        there.append(whole.resize((WIDTH, round(height * WIDTH / width)), Image.Resampling.LANCZOS))
    first, *rest = [*there, *there[-2:0:-1]]
    first.save(path, save_all=True, append_images=rest, duration=SHOWN, loop=0, quality=65, method=5)


def main() -> None:
    """Write the pictures that are asked for."""
    parser = argparse.ArgumentParser(description="Write docs/images/gallery.")
    parser.add_argument("names", nargs="*", default=list(MOVING), help="families, by default all of the gallery")
    PICTURES.mkdir(exist_ok=True)
    for name in parser.parse_args().names:
        save(PICTURES / f"{name}.webp", movement(name))


if __name__ == "__main__":
    main()
