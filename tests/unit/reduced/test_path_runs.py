"""Training paths in a folder are computed once, in processes of their own."""

import os

import numpy as np
import pytest
from reduced_cases import KEY, finger

from turgor.accuracy.gradients.model_keys import model_variation
from turgor.core.engine.runtime import EngineOptions
from turgor.reduced.states.inputs import Inputs
from turgor.reduced.training.path_runs import PathRuns
from turgor.reduced.training.trainer import Trainer


def test_paths_are_those_of_this_process_and_are_read_again(tmp_path):
    box = Inputs((KEY,), np.array([0.0]), np.array([2e3]), ("kPa",))
    trainer = Trainer(model_variation(finger(), [KEY]).model, box, 2, EngineOptions(threads=1))
    runs, aim = PathRuns(tmp_path), [np.array([2e3])]
    (path,) = runs.paths(finger(), trainer, aim)
    here = trainer.path(aim[0])
    assert path.displacements == pytest.approx(here.displacements, abs=1e-9)
    assert path.derivatives[0] == pytest.approx(here.derivatives[0], abs=1e-6)
    written = {each.name: os.stat(each).st_mtime_ns for each in tmp_path.iterdir()}
    (again,) = runs.paths(finger(), trainer, aim)
    assert {each.name: os.stat(each).st_mtime_ns for each in tmp_path.iterdir()} == written
    assert np.array_equal(again.displacements, path.displacements)
