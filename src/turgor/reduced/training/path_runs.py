"""Training paths as runs: in worker processes, each saved as it ends, so that a killed training goes on."""

import hashlib
import json
from collections.abc import Sequence
from dataclasses import dataclass
from pathlib import Path

import numpy as np
from numpy.typing import NDArray

from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.runtime import EngineOptions, use_threads
from turgor.core.model.model import Model
from turgor.foundation.errors import NotSolved
from turgor.foundation.response import Column, Response
from turgor.foundation.source import Source
from turgor.foundation.store.archive import Content, read_archive, write_archive
from turgor.foundation.store.codec import Decoder, Encoder
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.training.trainer import Path as FullPath
from turgor.reduced.training.trainer import Trainer
from turgor.studies.runs.run import Computed, Place, Run
from turgor.studies.runs.run_all import run_all

Array = NDArray[np.float64]


@dataclass(frozen=True, slots=True)
class PathRuns:
    """Where training paths are computed and saved.

    Parameters
    ----------
    folder : str or Path
    processes : int
        Processes at once, each with one thread.
    """

    folder: str | Path
    processes: int = 1

    def paths(self, model: Model, trainer: Trainer, aims: Sequence[Array]) -> list[FullPath]:
        """Compute paths to some inputs, or read those that were computed before."""
        folder = Path(self.folder)
        folder.mkdir(parents=True, exist_ok=True)
        box = trainer.inputs
        encoder = Encoder()
        text = json.dumps(encoder.encode(model, "model"))
        content = hashlib.sha256(text.encode())
        for array in encoder.arrays.values():
            content.update(np.ascontiguousarray(array).tobytes())
        file = folder / f"model-{content.hexdigest()[:12]}.turgor"
        if not file.exists():
            model.save(file)
        stated = {"keys": list(box.keys), "low": box.low.tolist(), "high": box.high.tolist(), "steps": trainer.steps}
        stated |= {"motion": True} if trainer.motion else {}
        where = {"file": Place(file), "folder": Place(folder), "digest": content.hexdigest()}
        runs = [
            Run(name=f"path to {_shown(aim)}", function=path_run, values={**stated, **where, "aim": aim.tolist()})
            for aim in aims
        ]
        ended = run_all(runs, folder, processes=self.processes)
        for run in runs:
            if ended[run.key].result is None:
                raise NotSolved(f"the {run.name} failed: {ended[run.key].problem}")
        return [_read(_file(folder, aim, stated, content.hexdigest())) for aim in aims]


def path_run(
    *, keys: list[str], low: list[float], high: list[float], steps: int, file: str, folder: str, digest: str,
    aim: list[float], motion: bool = False,
) -> Computed:  # fmt: skip
    """Compute one path of a saved model, and save its states in the folder."""
    model = Model.load(file)
    box = Inputs(tuple(keys), np.array(low), np.array(high), ("",) * len(keys))
    model_at = model_variation(model, keys, inputs=True).model
    with use_threads(1):
        path = Trainer(model_at, box, steps, EngineOptions(threads=1), motion).path(np.array(aim))
    encoder = Encoder()
    stated = {"keys": keys, "low": low, "high": high, "steps": steps} | ({"motion": True} if motion else {})
    tree = encoder.encode(path, "path")
    write_archive(_file(Path(folder), np.array(aim), stated, digest), Content("Path", tree, encoder.arrays))
    shares = Column("share", "", path.inputs[:, 0])
    return Computed(response=Response(columns=(shares,), source=Source(text="a training path")), seconds=path.seconds)


def _shown(aim: Array) -> str:
    return ", ".join(f"{value:g}" for value in aim)


def _file(folder: Path, aim: Array, stated: object, digest: str) -> Path:
    text = json.dumps([aim.tolist(), stated, digest])
    return folder / f"path-{hashlib.sha256(text.encode()).hexdigest()[:12]}.turgor"


def _read(file: Path) -> FullPath:
    content = read_archive(file)
    path: FullPath = Decoder(content.arrays, _unknown).decode(content.tree)
    return path


def _unknown(name: str) -> object:
    raise NotSolved(f"a training path refers to '{name}' in another file.")
