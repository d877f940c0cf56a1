"""Code: problems of a file by their lines."""

from typing import Any

from starlette.requests import Request

from turgor.studio.answers import Studio, route


async def _problems(studio: Studio, request: Request) -> Any:
    return await studio.worker.do("code.problems_of", studio.workspace.job(request.path_params["name"]))


CODE = [route("/api/jobs/{name}/problems", _problems)]
