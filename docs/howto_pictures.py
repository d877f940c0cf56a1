"""Pictures of docs/howto/pictures.md: `python docs/howto_pictures.py` writes docs/images/pictures, in some minutes."""

from pathlib import Path

from PIL import Image

import turgor as tg

FOLDER = Path(__file__).parent / "images" / "pictures"

#: The finger of the page: the example job with fewer chambers.
FINGER = {"actuator.chambers": 6, "actuator.length": "60 mm", "mesh.size": "3 mm", "loads.pressure": "20 kPa"}
WIDTH = 700


def solved(name: str, changes: dict) -> tg.Solution:
    """Solve the example job of a family with changes."""
    job = tg.jobs.read_job(tg.jobs.example_job(name), changes)
    model, _ = tg.jobs.prepare(job)
    return tg.solve(model, job.procedure)


def smaller(file: Path) -> None:
    """Write a PNG with 256 colors, which is enough for a page."""
    picture = Image.open(file).convert("RGB")
    picture.quantize(256, dither=Image.Dither.NONE).save(file, optimize=True)


def main() -> None:
    """Write all pictures."""
    FOLDER.mkdir(exist_ok=True)
    finger, thick = solved("fast_pneunet", FINGER), solved("fast_pneunet", {**FINGER, "actuator.wall": "1.4 mm"})
    tube = solved("twisting_tube", {})
    style = tg.pictures.Style
    stills = {
        "stress": {},
        "cut": {"style": style(cut="y")},
        "transparent": {"style": style(transparent=True)},
        "edges": {"style": style(edges=True), "color_by": "stretch"},
        "contact": {"color_by": "contact_pressure"},
    }
    for name, options in stills.items():
        tg.picture(finger, FOLDER / f"{name}.png", width=WIDTH, title="", **options)
    tg.picture(tube, FOLDER / "tension.png", color_by="fiber_tension", width=WIDTH, title="")
    tg.pictures.small_multiples(finger, FOLDER / "multiples.png", count=6, width=1200)
    tg.pictures.side_by_side({"wall 1 mm": finger, "wall 1.4 mm": thick}, FOLDER / "two.png", width=1000)
    for file in FOLDER.glob("*.png"):
        smaller(file)
    tg.pictures.write_motion(FOLDER / "motion.webp", finger, motion=tg.pictures.Motion(seconds=1.2, rate=12, width=420))
    angles = {
        name: tg.measure(solution, "bending_angle", mesh_error=False)
        for name, solution in {"wall 1 mm": finger, "wall 1.4 mm": thick}.items()
    }
    tg.pictures.write_curves(FOLDER / "curves.svg", angles, "bending_angle")


if __name__ == "__main__":
    main()
