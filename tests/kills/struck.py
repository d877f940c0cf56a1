"""The command ``turgor``, which kills itself (SIGKILL) at one of its operations on the files of a folder.

``python struck.py NUMBER FOLDER COUNT ARGUMENTS...``: the process is killed before the operation NUMBER, from 1; with 0
it lives, and the number of its operations is written into the file COUNT.
"""

import atexit
import os
import signal
import sys
from pathlib import Path

#: What is counted, as Python names it: files opened, renamed and removed, folders made and removed.
COUNTED = frozenset({"open", "os.rename", "os.remove", "os.mkdir", "os.rmdir"})


def main() -> None:
    number, folder, count = int(sys.argv[1]), sys.argv[2], Path(sys.argv[3])
    seen = 0

    def look(event: str, given: tuple[object, ...]) -> None:
        nonlocal seen
        if event in COUNTED and isinstance(given[0], str | os.PathLike) and str(given[0]).startswith(folder):
            seen += 1
            if seen == number:
                os.kill(os.getpid(), signal.SIGKILL)

    sys.addaudithook(look)
    from turgor.cli import command

    if number == 0:
        atexit.register(lambda: count.write_text(str(seen), encoding="utf-8"))
    sys.argv = ["turgor", *sys.argv[4:]]
    command()


if __name__ == "__main__":
    main()
