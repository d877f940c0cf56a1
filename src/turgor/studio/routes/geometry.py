"""Geometry: the shape of a job as a picture with named faces, and the forms of its tables."""

from typing import Any

from starlette.requests import Request

from turgor.studio.answers import Studio, route

#: Tables that the screen Loads has forms of, by the beginnings of their headers.
LOADS = ("[supports]", "[loads", "[contact]", "[obstacles", "[fibers", "[materials.NAME], from the library")


async def _shape(studio: Studio, request: Request) -> Any:
    modeled = "modeled" in request.query_params
    return await studio.worker.do("shapes.shape_of", studio.workspace.job(request.path_params["name"]), modeled)


async def _forms(studio: Studio, request: Request) -> Any:
    return await studio.worker.do("forms.forms_of", studio.workspace.job(request.path_params["name"]), LOADS)


async def _ready(studio: Studio, request: Request) -> Any:
    return await studio.worker.do("starting.ready")


GEOMETRY = [
    route("/api/ready", _ready),
    route("/api/jobs/{name}/shape", _shape),
    route("/api/jobs/{name}/forms", _forms),
]
