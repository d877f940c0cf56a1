"""Compiled loops: their threads, and what keeps numba's cache on disk true when one of several files changes."""

import os
from collections import deque
from collections.abc import Callable, Iterator, Sequence
from concurrent.futures import ThreadPoolExecutor
from contextvars import ContextVar, copy_context
from functools import cache, partial
from hashlib import sha256
from pathlib import Path
from types import ModuleType
from typing import Any, TypeVar

from turgor.foundation.processors import processors

Loop = TypeVar("Loop", bound=Callable)
Item = TypeVar("Item")
Result = TypeVar("Result")


#: Options of a loop that Python calls, and of a function that compiled loops alone call, which Python must not. Nothing
#: here is called from C, and what numba adds for callers that do not exist takes a tenth of the time to compile. Such
#: functions are inlined. Else a loop takes the copy that its process compiled first, and a first run, which compiles
#: all of them, has other last digits than one that finds the loops on disk.
LOOP = {"cache": True, "no_cfunc_wrapper": True, "error_model": "numpy", "nogil": True}
INNER = LOOP | {"no_cpython_wrapper": True, "forceinline": True}

#: Threads of `over`, where `turgor.core.engine.runtime.use_threads` says how many.
THREADS: ContextVar[int | None] = ContextVar("threads", default=None)

#: Passes of a loop below which another thread costs more than it saves, and parts of a loop for each thread, so that
#: none waits long for another.
LEAST, PARTS = 256, 4


def over(count: int, loop: Callable[..., None], *arguments: Any) -> None:
    """Call ``loop(begin, end, *arguments)`` for ranges that together are 0 to ``count``, on several threads.

    The loop is compiled with ``nogil=True`` and writes only what belongs to its range. It compiles in a third of the
    time of a parallel loop of numba.
    """
    threads = min(_threads(), count // LEAST)
    if threads < 2:
        if count:
            loop(0, count, *arguments)
        return
    ends = [count * k // (PARTS * threads) for k in range(PARTS * threads + 1)]
    list(_pool(threads, os.getpid()).map(lambda k: loop(ends[k], ends[k + 1], *arguments), range(len(ends) - 1)))


def later(count: int, function: Callable[..., Result], *arguments: Any) -> Callable[[], Result]:
    """Begin a call on another thread; what is returned waits for the result.

    Where there is one thread, or the loops that run meanwhile have too few passes (``count``) to be worth another, it
    is called there. Loops within the call stay on its thread, so that no thread waits for one of its own pool.
    """
    threads = _threads()
    if min(threads, count // LEAST) < 2:
        return partial(function, *arguments)
    return _pool(threads, os.getpid()).submit(copy_context().run, _alone, function, *arguments).result


def in_order(function: Callable[[Item], Result], items: Sequence[Item]) -> Iterator[Result]:
    """Yield the results for items in their order, the next ones computed meanwhile on other threads.

    Each item is work for some milliseconds. As few results are in memory as keep the threads busy.
    """
    ahead: deque[Callable[[], Result]] = deque()
    for item in items:
        ahead.append(later(LEAST * len(items), function, item))
        if len(ahead) > _threads():
            yield ahead.popleft()()
    for result in ahead:
        yield result()


def _alone(function: Callable[..., Result], *arguments: Any) -> Result:
    THREADS.set(1)  # in a copy of the context
    return function(*arguments)


def _threads() -> int:
    stated = THREADS.get()
    return processors() if stated is None else stated


@cache
def _pool(threads: int, _process: int) -> ThreadPoolExecutor:
    """Threads that wait for the next loop; a process that was forked has its own."""
    return ThreadPoolExecutor(threads, thread_name_prefix="turgor-kernels")


def calls(*modules: ModuleType) -> Callable[[Loop], Loop]:
    """Name a function after the text of the modules that it calls, below ``numba.njit``.

    numba keeps compiled code next to the file of a function, under the function's qualified name, and renews it when
    that file changes. It does not notice a change in another file, whose functions it compiled along. With this
    decorator such a change gives the function another name on disk, so that it is compiled again. Name every module
    of turgor that the function calls, and those that these call.
    """
    text = b"".join(_text(module) for module in modules)
    key = sha256(text).hexdigest()[:12]

    def named(function: Loop) -> Loop:
        function.__qualname__ = f"{function.__qualname__}_{key}"
        return function

    return named


def _text(module: ModuleType) -> bytes:
    try:
        return Path(str(module.__file__)).read_bytes()
    except OSError:  # a frozen program has no sources, and none of them changes
        return b""
