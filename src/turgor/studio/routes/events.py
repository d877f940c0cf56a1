"""Events: the page learns what has changed in the folder, whoever has changed it."""

import asyncio

from anyio import to_thread
from starlette.routing import WebSocketRoute
from starlette.websockets import WebSocket, WebSocketDisconnect

from turgor.studio.settings import STUDIO


async def _events(socket: WebSocket) -> None:
    """Send the names of files and runs that have changed, until the page goes."""
    workspace = socket.app.state.studio.workspace
    await socket.accept()
    gone = asyncio.create_task(socket.receive())
    before = await to_thread.run_sync(workspace.signature)
    try:
        await socket.send_json({"changed": []})
        while not gone.done():
            await asyncio.wait([gone], timeout=STUDIO.watch)
            now = await to_thread.run_sync(workspace.signature)
            changed = [name for name in {*before, *now} if before.get(name) != now.get(name)]
            if changed:
                await socket.send_json({"changed": sorted(changed)})
            before = now
    except (WebSocketDisconnect, RuntimeError):
        pass  # the page is gone
    finally:
        gone.cancel()


EVENTS = [WebSocketRoute("/ws/events", _events)]
