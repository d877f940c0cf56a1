"""Pages: the files of the page itself. The viewer is the one of the report."""

from collections.abc import Callable, Mapping
from functools import cache
from importlib.resources import files

from starlette.requests import Request
from starlette.responses import Response
from starlette.routing import Mount, Route
from starlette.staticfiles import StaticFiles

from turgor.views.viewer.assets import viewer_frame, viewer_scripts, viewer_style

_TYPES = {"js": "text/javascript", "css": "text/css", "html": "text/html; charset=utf-8"}


def _index(request: Request) -> Response:
    return Response((files("turgor.studio") / "page" / "index.html").read_bytes(), media_type=_TYPES["html"])


def _viewer_script(request: Request) -> Response:
    return Response(_viewer("js"), media_type=_TYPES["js"])


def _viewer_style(request: Request) -> Response:
    return Response(_viewer("css"), media_type=_TYPES["css"])


def _viewer_frame(request: Request) -> Response:
    return Response(_viewer("html"), media_type=_TYPES["html"])


_VIEWER: Mapping[str, Callable[[], str]] = {"js": viewer_scripts, "css": viewer_style, "html": viewer_frame}


@cache
def _viewer(kind: str) -> str:
    return _VIEWER[kind]()


PAGES = [
    Route("/", _index),
    Route("/viewer.js", _viewer_script),
    Route("/viewer.css", _viewer_style),
    Route("/viewer.html", _viewer_frame),
    Mount("/page", StaticFiles(packages=[("turgor.studio", "page")])),
]
