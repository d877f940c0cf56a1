"""Reads many damaged shapes in one child process, and writes down how far it came, because it may die."""

import pickle
from pathlib import Path

from mutants import check_sentence

from turgor.core.geometry.cad.read import read_here
from turgor.core.meshing.default_settings import chosen_settings
from turgor.core.meshing.settings import MeshSettings
from turgor.core.meshing.sizing.sizes import check_face_sizes
from turgor.foundation.errors import TurgorError


def read_all(files: list[Path], progress: Path) -> None:
    """Read files; for each a line when it is begun, and one when it is read: then the parent process may use it."""
    with progress.open("w", encoding="utf-8", buffering=1) as out:
        for file in files:
            out.write(f"begun {file.name}\n")
            try:
                geometry = read_here(file)
            except TurgorError as error:
                check_sentence(error)
                continue
            except Exception as error:  # `in_child` makes it a sentence
                out.write(f"failed {type(error).__name__}: {error}\n")
                continue
            out.write(f"read {file.name}\n")
            again = pickle.loads(pickle.dumps(geometry))
            assert again.solid_volume > 0 and again.smallest_wall > 0 and again.extent > 0
            try:
                chosen = chosen_settings(again, MeshSettings())
                check_face_sizes(again, dict.fromkeys(again.faces, chosen.size), chosen.size or 0.0)
            except TurgorError as error:
                check_sentence(error)
            out.write(f"used {file.name}\n")
