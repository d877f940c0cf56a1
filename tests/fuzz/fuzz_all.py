"""Tries 10,000 damaged files of all kinds, or a share of them, and prints what became of them.

``python tests/fuzz/fuzz_all.py 300`` tries about 300 of them; ``python tests/fuzz/fuzz_all.py 10000 STEP`` those of one
kind; ``python tests/fuzz/fuzz_all.py --only STEP 17`` repeats one of them.
"""

import sys
from pathlib import Path
from tempfile import TemporaryDirectory

HERE = Path(__file__).parent
sys.path[:0] = [str(HERE), str(HERE.parent / "unit")]

import fuzz_jobs  # noqa: E402
import fuzz_meshes  # noqa: E402
import fuzz_stored  # noqa: E402
import fuzz_tables  # noqa: E402
from trials import HEAD, try_all  # noqa: E402

CASES = (*fuzz_jobs.CASES, *fuzz_tables.CASES, *fuzz_stored.CASES, *fuzz_meshes.CASES)
ALL = 10_000


def say(*lines: str) -> None:
    """Write lines at once, for those who wait."""
    sys.stdout.writelines(f"{line}\n".replace("\\n", "\n") for line in lines)
    sys.stdout.flush()


def main(total: int, kinds: list[str]) -> int:
    """Try files and return how many failed."""
    assert sum(case.share for case in CASES) == ALL
    failures = 0
    say(HEAD)
    with TemporaryDirectory(prefix="turgor-fuzz-") as folder:
        for case in CASES:
            if not kinds or any(kind in case.name for kind in kinds):
                tally = try_all(case, list(range(max(1, case.share * total // ALL))), Path(folder) / "files")
                say(tally.row(), *tally.failures)
                failures += len(tally.failures)
    return failures


def one(name: str, number: int) -> int:
    """Repeat one file."""
    case = next(case for case in CASES if name in case.name)
    with TemporaryDirectory(prefix="turgor-fuzz-") as folder:
        tally = try_all(case, [number], Path(folder) / "files")
    say(tally.row(), *tally.failures)
    return len(tally.failures)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--only"]:
        sys.exit(min(1, one(sys.argv[2], int(sys.argv[3]))))
    sys.exit(min(1, main(int(sys.argv[1]) if sys.argv[1:] else ALL, sys.argv[2:])))
