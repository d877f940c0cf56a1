"""Viewer: a solution in a browser or a notebook, to turn, cut and play, in one page that needs no other."""

import json
from dataclasses import dataclass, field
from html import escape
from pathlib import Path

from turgor.core.solvers.solution import Solution
from turgor.foundation.errors import TurgorError
from turgor.foundation.response import Response
from turgor.views.viewer.assets import viewer_markup_of, viewer_scripts, viewer_style
from turgor.views.viewer.scene import Scene, scene_of
from turgor.views.viewer.settings import VIEWER


@dataclass(frozen=True, slots=True, kw_only=True)
class Viewer:
    """A page that shows the path of a solution; a notebook shows it in place.

    Parameters
    ----------
    title : str
        Name of the actuator.
    scene : Scene
        What is drawn.
    """

    title: str
    scene: Scene = field(repr=False)

    def _repr_html_(self) -> str:
        """Return what a notebook shows: the page in a frame of its own."""
        return (
            f'<iframe srcdoc="{escape(self.page())}" title="{escape(self.title)}" loading="lazy" '
            f'style="width:100%;height:{VIEWER.height}px;border:0;background:#fff"></iframe>'
        )

    def page(self) -> str:
        """Return the page as HTML text."""
        notes = "".join(f"<p>{escape(note)}</p>" for note in self.scene.notes)
        style = "body{margin:8px;font:13px system-ui,sans-serif} .fallback{display:block} .live .fallback{display:none}"
        return (
            f'<!DOCTYPE html>\n<html lang="en"><head><meta charset="utf-8"><title>{escape(self.title)}</title>'
            f"<style>{viewer_style()}{style}</style></head><body>{viewer_markup(self.scene)}{notes}"
            '<p class="fallback">The viewer needs a browser with WebGL 2.</p>'
            f"<script>{viewer_scripts()}</script></body></html>\n"
        )

    def save(self, path: str | Path) -> Path:
        """Write the page as one HTML file that needs no other.

        Parameters
        ----------
        path : str or Path
            File to write; ends in ``.html``.

        Returns
        -------
        Path

        Raises
        ------
        TurgorError
            If the path has another ending.
        """
        path = Path(path)
        if path.suffix.lower() != ".html":
            raise TurgorError(f"viewer '{path}' ends in '{path.suffix}'; allowed is .html.")
        path.write_text(self.page(), encoding="utf-8")
        return path


def viewer(of: Solution, *, response: Response | None = None) -> Viewer:
    """Show a solution in a browser or a notebook, to turn, cut and play.

    The page holds the surface of the whole actuator at every state, with von Mises stress, stretch, principal stress,
    contact pressure and displacement, fibers and obstacles. It needs no network and no other file. Long paths and large
    meshes are thinned out, which the page says.

    Parameters
    ----------
    of : Solution
        The path, complete or not.
    response : Response, optional
        What was measured at every state; gives the curves next to the picture.

    Returns
    -------
    Viewer
        A notebook shows it; ``save("finger.html")`` writes it.

    Raises
    ------
    TurgorError
        If the solution has no state, or the response has other rows than the path has states.

    Examples
    --------
    >>> import turgor as tg
    >>> tg.pictures.viewer(solution, response=tg.measure(solution)).save("finger.html")  # doctest: +SKIP
    """
    return Viewer(title=of.model.mesh.name, scene=scene_of(of, response))


def viewer_markup(scene: Scene) -> str:
    """Return the element of the viewer with its data, as HTML."""
    values = json.dumps(scene.values, separators=(",", ":"), ensure_ascii=False).replace("<", "\\u003c")
    return viewer_markup_of(values)
