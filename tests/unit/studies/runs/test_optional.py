"""Optional packages: what is missing is told by the name that installs it."""

import json
import sys

import pytest

from refused import refused
from turgor.studies.runs.optional_parts import needed


def test_a_module_that_is_there():
    assert needed("json", "a test") is json


@pytest.mark.parametrize(("module", "name"), [("sklearn.gaussian_process", "scikit-learn"), ("SALib.sample", "SALib")])
def test_a_missing_package_is_told_with_how_to_install_it(module, name, monkeypatch):
    monkeypatch.setitem(sys.modules, module, None)  # an import of it fails
    monkeypatch.setitem(sys.modules, module.split(".")[0], None)
    with refused("a test", name, '"turgor[studies]"'):
        needed(module, "a test")


@pytest.mark.parametrize(("extra", "installed"), [("learning", '"turgor[learning]"'), (None, "install torch")])
def test_the_group_of_packages_is_named_where_there_is_one(extra, installed, monkeypatch):
    monkeypatch.setitem(sys.modules, "torch", None)
    with refused("a test", "torch", installed):
        needed("torch", "a test", extra)
