"""Write docs/guidelines.md and its figures from the runs of `turgor guidelines run`.

Call it as ``python docs/guidelines_page.py FOLDER``, with the folder that was given as ``--output``; `make guidelines`
runs all guidelines and calls it.
"""

import sys
from pathlib import Path

from PIL import Image

from turgor_guidelines.catalog import chosen
from turgor_guidelines.judge import judged
from turgor_guidelines.page import write_markdown

DOCS = Path(__file__).parent

HEAD = """# Guidelines, run and judged

The design guidelines of Xavier, Fleming and Yong (2021),
[doi 10.1002/aisy.202000187](https://doi.org/10.1002/aisy.202000187), sections 7.0 to 7.4, and claims of its sections 5,
6.2 and 8.1. Each was computed with the quick setting of `turgor guidelines run`; ± is the estimated mesh error. A
verdict holds for the actuators, rubbers and pressures that are named, no further. The page is written by
`make guidelines`; [how to run one yourself](howto/guidelines.md).

"""


def reduced(file: Path) -> None:
    """Write a picture with a palette of 128 colors, which takes a third of the space."""
    with Image.open(file) as picture:
        small = picture.convert("RGB").quantize(128)
    small.save(file, optimize=True)


def main(folder: Path) -> None:
    """Judge all guidelines and write the page."""
    found = tuple(judged(each, folder / "runs") for each in chosen(()))
    page = write_markdown(found, DOCS, "images/guidelines")
    for file in sorted((DOCS / "images" / "guidelines").glob("*.png")):
        reduced(file)
    page.write_text(HEAD + page.read_text(encoding="utf-8"), encoding="utf-8")
    seconds = sum(study.seconds for each in found for study in each.studies)
    print(f"{page}: {len(found)} guidelines, {seconds / 60:.0f} CPU minutes")


if __name__ == "__main__":
    main(Path(sys.argv[1]))
