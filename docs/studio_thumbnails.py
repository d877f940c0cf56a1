"""Draws the small pictures of the actuator families for the studio, and lists them.

Run it with ``python docs/studio_thumbnails.py``. The pictures are cut out of those of the pages on actuators,
`docs/actuator_pages.py`. The list lets the page show the families before anything heavy is loaded.
"""

import json
from pathlib import Path

from PIL import Image, ImageChops

import turgor as tg

#: The pictures of the pages, and where the studio has its own.
FROM, TO = Path(__file__).parent / "images" / "actuators", Path(__file__).parents[1] / "src/turgor/studio/page/families"

#: Pixels of a title above a picture and of a color bar below it, which are cut off.
TITLE, BAR = 75, 125

#: Width and height of a small picture, and its colors: 8 kB each.
SIZE, COLORS = (240, 150), 48


def small(picture: Image.Image) -> Image.Image:
    """Cut title and color bar off, and what is white around the rest."""
    whole = picture.convert("RGB")
    cut = whole.crop((0, TITLE, whole.width, whole.height - BAR))
    white = Image.new("RGB", cut.size, "white")
    cut = cut.crop(ImageChops.difference(cut, white).point(lambda value: 255 if value > 60 else 0).getbbox())
    cut.thumbnail((SIZE[0] - 8, SIZE[1] - 8), Image.Resampling.LANCZOS)
    out = Image.new("RGB", SIZE, "white")
    out.paste(cut, ((SIZE[0] - cut.width) // 2, (SIZE[1] - cut.height) // 2))
    return out.quantize(COLORS, dither=Image.Dither.NONE)


def families() -> list[dict[str, str]]:
    """Name of each actuator family, and what it is."""
    return [{"name": name, "words": (kind.__doc__ or "").splitlines()[0]} for name, kind in tg.jobs.ACTUATORS.items()]


def main() -> None:
    """Write all of them."""
    TO.mkdir(exist_ok=True)
    (TO / "families.json").write_text(json.dumps(families(), indent=1, ensure_ascii=False) + "\n", encoding="utf-8")
    for file in sorted(FROM.glob("*.png")):
        if not file.stem.endswith("-cut"):
            small(Image.open(file)).save(TO / file.name, optimize=True)


if __name__ == "__main__":
    main()
