"""Page of the guidelines: verdicts in a table, then every study with its setup, numbers and figure."""

from collections.abc import Sequence
from importlib.resources import files
from pathlib import Path

from jinja2 import Environment, StrictUndefined

import turgor as tg
from turgor_guidelines.guideline import Verdict
from turgor_guidelines.judge import Judged, JudgedStudy
from turgor_guidelines.pictures import png_of, svg_of

#: Folder of the figures next to the page, and the name of the page.
FIGURES, MARKDOWN, HTML = "figures", "guidelines.md", "guidelines.html"

#: Dots per inch of the figures that are files.
DPI = 90


def write_page(judged: Sequence[Judged], folder: Path) -> Path:
    """Write the page as one HTML file with everything in it.

    Parameters
    ----------
    judged : sequence of Judged
    folder : Path
        Where ``guidelines.html`` is written.

    Returns
    -------
    Path
        The page.
    """
    template = files("turgor_guidelines").joinpath("page.html").read_text("utf-8")
    drawn = [(each, [(study, figure_svg(study)) for study in each.studies]) for each in judged]
    counts = [(verdict, sum(each.verdict == verdict for each in judged)) for verdict in Verdict]
    pages = Environment(autoescape=True, undefined=StrictUndefined, trim_blocks=True)
    text = pages.from_string(template).render(drawn=drawn, counts=counts)
    folder.mkdir(parents=True, exist_ok=True)
    page = folder / HTML
    page.write_text(text, encoding="utf-8")
    return page


def figure_svg(study: JudgedStudy) -> str:
    """Figure of a study as SVG text.

    Parameters
    ----------
    study : JudgedStudy
        With runs that have ended.

    Returns
    -------
    str
        Empty where the study was not judged.
    """
    if study.judgement.verdict is Verdict.NOT_JUDGED:
        return ""
    return svg_of(tg.pictures.study_figure(study.study.panels(study.runs), _pictures(study)))


def write_markdown(judged: Sequence[Judged], folder: Path, figures: str = FIGURES) -> Path:
    """Write the page as Markdown, its figures as files.

    Parameters
    ----------
    judged : sequence of Judged
    folder : Path
        Where ``guidelines.md`` is written.
    figures : str
        Folder of the figures, seen from there.

    Returns
    -------
    Path
        The page.
    """
    (folder / figures).mkdir(parents=True, exist_ok=True)
    lines = ["| guideline | rule | verdict |", "| --- | --- | --- |"]
    lines += [
        f"| [{each.guideline.key}](#{_anchor(each)}) | {each.guideline.rule} | {each.verdict} |" for each in judged
    ]
    for each in judged:
        lines += ["", f"({_anchor(each)})=", f"## {each.guideline.key}: {each.verdict}", "", each.guideline.rule]
        lines += [f"*Sources: {'; '.join(each.guideline.sources)}.*"] if each.guideline.sources else []
        for number, study in enumerate(each.studies, start=1):
            lines += _section(study, folder / figures / f"{_anchor(each)}-{number}.png", figures)
    page = folder / MARKDOWN
    page.write_text("\n".join(lines) + "\n", encoding="utf-8")
    return page


def _section(study: JudgedStudy, picture: Path, figures: str) -> list[str]:
    test, judgement = study.study, study.judgement
    lines = ["", f"### {test.title}: {judgement.verdict}", "", test.setup, "", f"- Expected: {test.expected}"]
    lines += [f"- Found: {judgement.finding}"]
    lines += [f"- Conditions: {judgement.conditions}"] if judgement.conditions else []
    if judgement.verdict is not Verdict.NOT_JUDGED:
        figure = tg.pictures.study_figure(test.panels(study.runs), _pictures(study))
        picture.write_bytes(png_of(figure, dpi=DPI))
        lines += ["", f"![{test.title}]({figures}/{picture.name})"]
    return lines


def _pictures(study: JudgedStudy) -> list[tuple[str, bytes]]:
    return [(name, computed.picture) for name, computed in study.runs.items() if computed.picture]


def _anchor(judged: Judged) -> str:
    return f"guideline-{judged.guideline.key.replace('.', '-')}"
