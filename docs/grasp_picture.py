"""Picture of docs/howto/grasping.md: `python docs/grasp_picture.py` writes docs/images/grasp.png, in two minutes."""

from pathlib import Path

from PIL import Image

import turgor as tg

FILE = Path(__file__).parent / "images" / "grasp.png"
WIDTH = 700


def main() -> None:
    """Draw the hand of the example after the table has gone."""
    job = tg.jobs.read_job(Path(__file__).parents[1] / "examples" / "soft_hand.toml")
    model, _ = tg.jobs.prepare(job)
    tg.picture(tg.solve(model, job.procedure).states[-1], FILE)
    picture = Image.open(FILE).convert("RGB")
    picture.thumbnail((WIDTH, WIDTH))
    picture.quantize(256, dither=Image.Dither.NONE).save(FILE, optimize=True)


if __name__ == "__main__":
    main()
