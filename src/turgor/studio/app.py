"""App: the server of the studio from its routes."""

import asyncio
from collections.abc import AsyncIterator
from contextlib import asynccontextmanager, suppress

from starlette.applications import Starlette
from starlette.types import ASGIApp

from turgor.studio.answers import Studio
from turgor.studio.guard import Access, Guard
from turgor.studio.routes.checks import CHECKS
from turgor.studio.routes.code import CODE
from turgor.studio.routes.events import EVENTS
from turgor.studio.routes.geometry import GEOMETRY
from turgor.studio.routes.jobs import JOBS
from turgor.studio.routes.materials import MATERIALS
from turgor.studio.routes.pages import PAGES
from turgor.studio.routes.reduced import REDUCED
from turgor.studio.routes.runs import RUNS
from turgor.studio.routes.studies import STUDIES
from turgor.studio.routes.uploads import UPLOADS
from turgor.studio.settings import STUDIO


def studio_app(studio: Studio, access: Access) -> ASGIApp:
    """Return the server as an ASGI application.

    Parameters
    ----------
    studio : Studio
        Its workspace and workers.
    access : Access
        Who may talk to it.
    """
    kinds = (GEOMETRY, UPLOADS, CODE, MATERIALS, REDUCED, JOBS, CHECKS, RUNS, STUDIES, EVENTS, PAGES)
    app = Starlette(routes=[route for kind in kinds for route in kind], lifespan=_lifespan)
    app.state.studio = studio
    return Guard(app, access)


@asynccontextmanager
async def _lifespan(app: Starlette) -> AsyncIterator[None]:
    studio: Studio = app.state.studio
    resting = asyncio.create_task(_rest(studio))
    try:
        yield
    finally:
        resting.cancel()
        with suppress(asyncio.CancelledError):
            await resting
        for worker in studio.workers:
            worker.stop()


async def _rest(studio: Studio) -> None:
    """End workers that were not used for long."""
    while True:
        await asyncio.sleep(STUDIO.idle / 10)
        for worker in studio.workers:
            worker.rest()
