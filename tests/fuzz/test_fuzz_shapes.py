"""Damaged STEP and STL files never end this process: they are read, refused with a sentence, or end a child process."""

import random
from pathlib import Path

import cad_cases as cases
import numpy as np
from mutants import changed_bytes, changed_lines, seeds
from netgen.occ import Box, Pnt
from shape_batch import read_all

from turgor.core.geometry.cad.facets import find_facets
from turgor.core.geometry.child_process import Work, in_child
from turgor.foundation.errors import TurgorError

#: One child reads many files; it is stopped if one of them takes longer than all should, as few in a hundred do.
WORK = Work(who="the CAD kernel", doing="reading mutants", advice="Look at it.", limit=60.0)

#: Files in one child.
BATCH = 20


def survived(files: list[Path], folder: Path) -> dict[str, int]:
    """Read files in child processes, and count what became of them."""
    left, found = list(files), {"read": 0, "refused": 0, "died": 0}
    while left:
        progress = folder / "progress.txt"
        try:
            in_child(WORK, read_all, left[:BATCH], progress)
            died = False
        except TurgorError as error:
            died = "died while reading mutants" in str(error) or "was stopped" in str(error)
            if not died:
                raise
        lines = progress.read_text(encoding="utf-8").splitlines()
        begun = [line for line in lines if line.startswith("begun")]
        used = sum(line.startswith("used") for line in lines)
        assert sum(line.startswith("read") for line in lines) == used, f"it was read and could not be used: {lines[-1]}"
        found["read"] += used
        found["died"] += died
        found["refused"] += len(begun) - used - died
        left = left[len(begun) :]
    return found


def test_damaged_step_files(tmp_path: Path) -> None:
    files = []
    for seed in seeds(14):
        chance = random.Random(seed)
        name = chance.choice(("cup_and_plate.step", "tube_radial_inlet.step"))
        files.append(tmp_path / f"{seed}.step")
        files[-1].write_text(changed_lines((cases.DATA / name).read_text("ascii"), chance), encoding="utf-8")
    assert sum(survived(files, tmp_path).values()) == len(files)


def test_damaged_stl_files(tmp_path: Path) -> None:
    shape = Box(Pnt(0, 0, 0), Pnt(20, 10, 10)) - Box(Pnt(2, 2, 2), Pnt(18, 8, 8))
    whole = find_facets(shape, list(dict.fromkeys(shape.faces))).corners()
    files = []
    for seed in seeds(24):
        chance = random.Random(seed)
        files.append(tmp_path / f"{seed}.stl")
        if chance.random() < 0.6:  # the same surface with corners elsewhere, closed still
            corners, places = np.unique(whole.reshape(-1, 3), axis=0, return_inverse=True)
            for _ in range(chance.choice((1, 1, 2, 5))):
                i, j = chance.randrange(len(corners)), chance.randrange(len(corners))
                moved = [chance.choice((0.0, 1e-7, 1e-3, 3.0, -30.0, 1e9)) for _ in range(3)]
                corners[i] = corners[j] + moved if chance.random() < 0.5 else corners[i] + moved
            cases.write_stl(files[-1], corners[places].reshape(-1, 3, 3), text=chance.random() < 0.3)
        else:
            cases.write_stl(files[-1], whole, text=chance.random() < 0.5)
            files[-1].write_bytes(changed_bytes(files[-1].read_bytes(), chance))
    assert sum(survived(files, tmp_path).values()) == len(files)
