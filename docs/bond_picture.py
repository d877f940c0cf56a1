"""Picture of docs/howto/tearing.md: `python docs/bond_picture.py` writes docs/images/bond_peel.png, in two minutes."""

from pathlib import Path

from PIL import Image

import turgor as tg

FILE = Path(__file__).parent / "images" / "bond_peel.png"
WIDTH = 900


def main() -> None:
    """Draw the seam of the example after it has opened."""
    job = tg.jobs.read_job(Path(__file__).parents[1] / "examples" / "bond_peel.toml", {"procedure.volume": "1.8 mL"})
    model, _ = tg.jobs.prepare(job)
    last = tg.solve(model, job.procedure).states[-1]
    tg.picture(last, FILE, color_by="bond_damage")
    picture = Image.open(FILE).convert("RGB")
    picture.thumbnail((WIDTH, WIDTH))
    picture.quantize(256, dither=Image.Dither.NONE).save(FILE, optimize=True)


if __name__ == "__main__":
    main()
