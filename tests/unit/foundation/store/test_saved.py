"""Files of models, solutions and responses: what is saved is loaded, and what is wrong with a file is said."""

import json
import pickle
from dataclasses import dataclass, field
from pathlib import Path
from zipfile import ZipFile

import numpy as np
import pytest
import solver_cases

import turgor as tg
from refused import refused
from turgor.foundation.store.codec import FOUR_DIGITS, SIX_DIGITS, Decoder, Encoder
from turgor.foundation.store.folder import Store
from turgor.reduced.parts.threads import Threads


@pytest.fixture(scope="module")
def solution() -> tg.Solution:
    return tg.solve(solver_cases.model(), tg.Static(first_step=0.5, max_step=0.5))


def same(one: tg.Solution, other: tg.Solution) -> bool:
    """Whether two solutions are equal to the last bit."""
    pairs = list(zip(one.states, other.states, strict=True))
    fields = all(
        np.array_equal(getattr(a, name), getattr(b, name))
        for a, b in pairs
        for name in ("displacement", "mean_stress", "nodal_force")
    )
    return fields and (one.status, one.steps, one.timing) == (other.status, other.steps, other.timing)


def test_a_solution_is_loaded_as_it_was_saved(solution, tmp_path):
    file = solution.save(tmp_path / "path")
    assert file.name == "path.turgor"
    loaded = tg.load(file)
    assert same(loaded, solution)
    assert all(state.model is loaded.model for state in loaded.states)
    assert tg.measure(loaded, tg.measures.reaction).column("reaction")[-1] == pytest.approx(
        tg.measure(solution, tg.measures.reaction).column("reaction")[-1], rel=1e-15
    )


def test_the_ending_may_be_left_out_as_in_saving(solution, tmp_path):
    solution.save(tmp_path / "path.v2")
    (tmp_path / "path.v2").mkdir()  # a folder of that name, which holds no run
    assert same(tg.load(tmp_path / "path.v2"), solution)
    assert same(tg.Solution.load(tmp_path / "path.v2"), solution)


def test_pickle_keeps_models_and_solutions(solution):
    assert same(pickle.loads(pickle.dumps(solution)), solution)


def test_a_model_and_a_response_are_saved(solution, tmp_path):
    model = tg.Model.load(solution.model.save(tmp_path / "model"))
    assert model.materials == solution.model.materials and model.loads == solution.model.loads
    response = tg.measure(solution, tg.measures.reaction)
    loaded = tg.Response.load(response.save(tmp_path / "response"))
    assert loaded.names == response.names
    assert np.array_equal(loaded.column("reaction"), response.column("reaction"))


def test_no_pickle_is_in_a_file(solution, tmp_path):
    with ZipFile(solution.save(tmp_path / "path")) as archive:
        names = archive.namelist()
        head = json.loads(archive.read("content.json"))
    assert set(names) == {"content.json", *(name for name in names if name.startswith("arrays/"))}
    assert (head["format"], head["version"], head["kind"]) == ("turgor", 1, "Solution")


def test_a_function_is_refused_by_its_place(tmp_path):
    moving = tg.Dynamic(duration=1.0, velocity=lambda points: points)
    with refused("Dynamic.velocity", "<lambda>"):
        tg.solve(solver_cases.model(), moving, folder=tmp_path)


@pytest.mark.parametrize(
    ("content", "facts"),
    [
        (b"", ["damaged", "zip"]),
        (b"PK\x05\x06" + 18 * b"\0", ["damaged", "'content.json'"]),
        ({"format": "other"}, ["turgor"]),
        ({"format": "turgor", "version": 99, "written_by": "turgor 9.0"}, ["turgor 9.0", "version 99"]),
        ({"format": "turgor", "version": 1, "kind": "x", "content": {"same": 3}}, ["damaged", 3]),
        (
            {"format": "turgor", "version": 1, "kind": "x", "content": {"enum": "turgor.x:Y", "is": "Z"}},
            ["Y"],
        ),
        (
            {"format": "turgor", "version": 1, "kind": "x", "content": {"class": "os:system", "id": 0, "fields": {}}},
            ["os:system"],
        ),
        (
            {
                "format": "turgor",
                "version": 1,
                "kind": "x",
                "content": {"class": "turgor.core.model.loads:Gravity", "id": 0, "fields": {"size": 1}},
            },
            ["turgor.core.model.loads:Gravity", "fields", "history, size"],
        ),
    ],
)
def test_what_is_wrong_with_a_file_is_said(content, facts, tmp_path):
    file = tmp_path / "x.turgor"
    if isinstance(content, bytes):
        file.write_bytes(content)
    else:
        with ZipFile(file, "w") as archive:
            archive.writestr("content.json", json.dumps(content))
    with refused(file, *facts):
        tg.load(file)


def test_the_wrong_kind_and_a_missing_file_are_said(solution, tmp_path):
    file = solution.model.save(tmp_path / "model")
    with refused(file, "Model", "Solution"):
        tg.Solution.load(file)
    with refused(tmp_path / "none.turgor"):
        tg.load(tmp_path / "none.turgor")
    with refused(tmp_path, "path"):
        tg.load(tmp_path)


def test_values_of_every_kind_come_back():
    shared = np.arange(3.0)
    value = {
        "numbers": (1, 2.5, float("inf"), -float("inf"), True, None, np.float32(0.5)),
        "sets": frozenset({1, 2}),
        "path": Path("a") / "b",
        "arrays": [shared, shared, np.zeros((0, 3), dtype=np.int32), np.asfortranarray(np.eye(2))],
        ("a", 1): {"status": tg.Status.CONVERGED},
    }
    encoder = Encoder()
    tree = json.loads(json.dumps(encoder.encode(value), allow_nan=False))
    result = Decoder(encoder.arrays, lambda name: None).decode(tree)
    assert result["arrays"][0] is result["arrays"][1]
    assert str(result["arrays"]) == str(value["arrays"])
    assert {key: item for key, item in result.items() if key != "arrays"} == {
        key: item for key, item in value.items() if key != "arrays"
    }


def test_a_store_writes_every_array_once_and_forgets_what_nobody_needs(tmp_path):
    store, first, second = Store(tmp_path), np.arange(1000.0), np.arange(2000.0)
    store.keep("a", solver_cases.RUBBER, "Material")
    store.note("b", [first, solver_cases.RUBBER], "list")
    store.note("c", (first, second), "tuple")
    store.note("d", (second,), "tuple")
    assert (tmp_path / "d.turgor").stat().st_size < 1000
    store.forget(["c"])
    assert sorted(file.stem for file in tmp_path.iterdir()) == ["b", "c"]
    again = Store(tmp_path).read("c")
    assert np.array_equal(again[0], first) and np.array_equal(again[1], second)


def test_a_field_of_seven_digits_takes_half_of_the_space():
    threads = Threads(*(np.full(shape, 1 / 3) for shape in ((2, 3), (2, 3, 4), (2,), (2,), (2,))))
    encoder = Encoder()
    tree = encoder.encode(threads)
    assert sorted(array.nbytes for array in encoder.arrays.values()) == [16, 16, 16, 48, 96]
    loaded = Decoder(encoder.arrays, lambda name: None).decode(tree)
    assert loaded.modes.dtype == np.float64
    assert loaded.modes == pytest.approx(threads.modes, rel=1e-7)
    assert (loaded.rest == threads.rest).all()


@dataclass(frozen=True, slots=True, eq=False)
class Rounded:
    """Arrays whose unit stands at each place of the last axis, and of the first."""

    four: np.ndarray = field(metadata=FOUR_DIGITS)
    last: np.ndarray = field(metadata=SIX_DIGITS)
    first: np.ndarray = field(metadata=SIX_DIGITS)


def test_fields_of_four_and_six_digits_are_whole_numbers_of_units():
    scales = np.array([1.0, 1e-6, 0.0, 1e3])
    draws = np.random.default_rng(0).standard_normal((5, 9, 4))
    value = Rounded(draws * scales, draws * scales, (draws * scales).T.reshape(4, -1))
    encoder = Encoder()
    tree = encoder.encode(value)
    assert sum(each.nbytes for each in encoder.arrays.values()) == draws.size * (2 + 3 + 3) + 3 * 4 * 8
    loaded = Decoder(encoder.arrays, lambda name: None).decode(tree)
    for name, largest in (("four", 2**15 - 1), ("last", 2**23 - 1), ("first", 2**23 - 1)):
        got, exact = (getattr(each, name) for each in (loaded, value))
        axes = (1,) if name == "first" else (0, 1)
        assert got.dtype == np.float64
        assert (np.abs(got - exact).max(axis=axes) <= 0.51 / largest * np.abs(exact).max(axis=axes)).all()
