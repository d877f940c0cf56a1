"""History: texts of a file before its edits, on disk, so that undo survives the server and the browser."""

import hashlib
from dataclasses import dataclass
from pathlib import Path

from turgor.foundation.errors import TurgorError
from turgor.foundation.store.atomic_files import whole
from turgor.studio.settings import STUDIO


class Conflict(TurgorError):
    """A file that has changed since the page has read it."""


def version_of(text: str) -> str:
    """Return what tells two texts apart."""
    return hashlib.sha256(text.encode()).hexdigest()[:16]


@dataclass(frozen=True, slots=True)
class History:
    """A file and its earlier and undone texts.

    Parameters
    ----------
    file : Path
    folder : Path
        Where the texts are: ``undo-0001.txt``, … and ``redo-0001.txt``, ….
    """

    file: Path
    folder: Path

    @property
    def text(self) -> str:
        """Text of the file, with its own line ends."""
        return self.file.read_bytes().decode("utf-8", errors="replace")

    def state(self) -> dict[str, object]:
        """Return the text, its version, and whether an edit can be undone or repeated."""
        text = self.text
        return {
            "name": self.file.name,
            "text": text,
            "version": version_of(text),
            "undo": len(self._texts("undo")),
            "redo": len(self._texts("redo")),
        }

    def write(self, text: str, version: str) -> None:
        """Replace the text, which can be undone; raise `Conflict` if another program has changed it."""
        before = self._checked(version)
        if text == before:
            return
        self._push("undo", before)
        for each in self._texts("redo"):
            each.unlink()
        _write(self.file, text)

    def step(self, way: str, version: str) -> None:
        """Undo the last edit, or repeat the last one that was undone: ``way`` is ``"undo"`` or ``"redo"``."""
        before = self._checked(version)
        texts = self._texts(way)
        if not texts:
            raise TurgorError(f"there is nothing to {way} in '{self.file.name}'.")
        text = texts[-1].read_bytes().decode("utf-8")
        self._push("redo" if way == "undo" else "undo", before)
        _write(self.file, text)
        texts[-1].unlink()

    def _checked(self, version: str) -> str:
        text = self.text
        if version_of(text) != version:
            raise Conflict(f"'{self.file.name}' has changed since this page has read it; the page shows the new text.")
        return text

    def _texts(self, kind: str) -> list[Path]:
        return sorted(self.folder.glob(f"{kind}-*.txt"))

    def _push(self, kind: str, text: str) -> None:
        self.folder.mkdir(exist_ok=True, mode=0o700)
        texts = self._texts(kind)
        last = int(texts[-1].stem.rpartition("-")[2]) if texts else 0
        _write(self.folder / f"{kind}-{last + 1:06d}.txt", text)
        for each in texts[: len(texts) + 1 - STUDIO.undo]:
            each.unlink()


def _write(file: Path, text: str) -> None:
    """Write a text with the line ends that it has."""
    with whole(file) as part:
        part.write_bytes(text.encode())
