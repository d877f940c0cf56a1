"""The pages on the actuator families, written from the classes themselves: `make actuators` renews pages and pictures.

Each page has the family's own words, a picture cut open, one under pressure from its example job, its dimensions with
their defaults, and that job. A test compares the pages with the classes, so they cannot fall behind.
"""

import argparse
import inspect
import re
from dataclasses import replace
from pathlib import Path
from typing import Any

import turgor as tg
from turgor_guidelines.catalog import chosen

DOCS = Path(__file__).parent
PICTURES = DOCS / "images" / "actuators"
WIDTH, COLORS = 1000, 128


def heading(name: str) -> str:
    """Write the name of a family as a title: ``"fast_pneunet"`` is ``"Fast PneuNet"``."""
    text = name.replace("_", " ").replace("pneunet", "PneuNet").replace("fiber reinforced", "fiber-reinforced")
    return text[0].upper() + text[1:]


def page(name: str, family: Any) -> str:
    """Write the page on a family."""
    built = family().build()
    keys = tg.jobs.family_table(name).keys
    return "\n".join(
        [
            f"# {heading(name)}",
            "",
            f"![{heading(name)}, cut open](../images/actuators/{name}-cut.png)",
            "",
            _words(family),
            "",
            f"![{heading(name)} under pressure](../images/actuators/{name}.png)",
            "",
            "The second picture is the end of the example job below, colored by von Mises stress; lines: at rest.",
            "",
            "## Dimensions",
            "",
            f'In a job file: `[actuator]` with `type = "{name}"`; in Python: `tg.actuators.{family.__name__}`.',
            "",
            "A range holds where the other dimensions have their defaults.",
            "",
            "| key | default | range | meaning |",
            "|---|---|---|---|",
            *(f"| `{key.name}` | `{key.default}` | {key.allowed or '–'} | {key.meaning} |" for key in keys),
            "",
            *_built(built),
            "",
            "## Example job",
            "",
            f"```{{literalinclude}} ../../{tg.jobs.example_job(name).relative_to(DOCS.parent)}",
            ":language: toml",
            "```",
            "",
            *_guidelines(name),
        ]
    )


def _guidelines(name: str) -> list[str]:
    """List the design rules that were run with a family; their verdicts stand on the page of the guidelines."""
    rules = [each for each in chosen(()) if name in each.families]
    if not rules:
        return []
    lines = [f"- [{each.key}](../guidelines.md#guideline-{each.key.replace('.', '-')}): {each.rule}" for each in rules]
    return ["## Guidelines", "", "Design rules from the literature, run and judged:", "", *lines, ""]


def overview() -> str:
    """Write the page that lists all families."""
    lines = [
        "# Actuators",
        "",
        "Every family is a class of dimensions with checked rules; `build()` makes its solids with the same names of",
        "regions and faces, so that loads, supports and measures written for one work for all. Not here? Read a",
        "[CAD file](../howto/cad.md) or a [mesh](../howto/import-mesh.md).",
        "",
        "| | family | what it is |",
        "|---|---|---|",
    ]
    for name, family in tg.jobs.ACTUATORS.items():
        picture = f"![](../images/actuators/{name}-cut.png)"
        lines.append(f"| {picture} | [{heading(name)}]({name}.md) | {_summary(family)} |")
    names = "\n".join(tg.jobs.ACTUATORS)
    return "\n".join([*lines, "", "```{toctree}", ":hidden:", "", names, "```", ""])


def _words(family: Any) -> str:
    """What a class says before its parameters."""
    return _markdown(inspect.getdoc(family) or "").split("Parameters\n----------\n", 1)[0].strip()


def _markdown(text: str) -> str:
    """Turn the double backquotes of docstrings into single ones."""
    return re.sub(r"``(.+?)``", r"`\1`", text)


def _summary(family: Any) -> str:
    return _markdown(inspect.getdoc(family) or "").split("\n\n", 1)[0].replace("\n", " ")


def _built(built: tg.Geometry) -> list[str]:
    cavities = ", ".join(f"`{name}` {volume * 1e6:.4g} mL" for name, volume in built.cavity_volumes.items())
    return [
        f"With these the modeled part has {cavities} of cavity and {built.solid_volume * 1e6:.4g} mL of solid; "
        f"{f'regions {_listed(built.regions)}' if built.regions else 'no region'}; faces {_listed(built.faces)}.",
    ]


def _listed(names: tuple[str, ...]) -> str:
    return ", ".join(f"`{name}`" for name in names)


def _cut(family: Any) -> Any:
    """The half of an actuator where it has one, so that its inside is seen."""
    try:
        return family(symmetric=True)
    except (TypeError, tg.TurgorError):  # a family without mirror plane
        return family()


def draw(name: str, family: Any) -> None:
    """Draw a family: cut open where it has a mirror plane, and at the end of its example job."""
    from PIL import Image

    made = tg.mesh(_cut(family).build())
    faces = {side.replace("symmetry_", "cut_"): triangles for side, triangles in made.faces.items()}
    tg.pictures.write_mesh_picture(PICTURES / f"{name}-cut.png", replace(made, faces=faces), heading(name), WIDTH)
    job = tg.jobs.read_job(tg.jobs.example_job(name))
    model, _ = tg.jobs.prepare(job)
    states = tg.solve(model, job.procedure).states
    view = tg.pictures.shared_view([states[0], states[-1]], WIDTH)
    tg.pictures.write_picture(PICTURES / f"{name}.png", states[-1], view, title=heading(name), ghost=states[0])
    for picture in PICTURES.glob(f"{name}*.png"):  # fewer colors: a quarter of the size, and no difference to see
        image = Image.open(picture).convert("RGB").quantize(COLORS, dither=Image.Dither.NONE)
        image.save(picture, optimize=True)


def main() -> None:
    """Write the pages, and the pictures where they are requested."""
    parser = argparse.ArgumentParser(description="Write docs/actuators.")
    parser.add_argument("--pictures", nargs="*", metavar="FAMILY", help="draw these families, all if none is named")
    chosen = parser.parse_args().pictures
    (DOCS / "actuators").mkdir(exist_ok=True)
    PICTURES.mkdir(exist_ok=True)
    (DOCS / "actuators" / "index.md").write_text(overview(), encoding="utf-8")
    for name, family in tg.jobs.ACTUATORS.items():
        (DOCS / "actuators" / f"{name}.md").write_text(page(name, family), encoding="utf-8")
        if chosen is not None and (not chosen or name in chosen):
            draw(name, family)


if __name__ == "__main__":
    main()
