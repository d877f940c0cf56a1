"""TOML: the common slips are answered with the line and the mend."""

from pathlib import Path

import pytest

from refused import refused
from turgor.foundation.errors import TurgorError
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.text.problems import JobError


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        ("a = 1\nlength = 36 mm  # long", [":2:", '"36 mm"']),
        ("wall = { low = 1 mm, high = 2 mm }", [":1:", '"1 mm"']),
        ("at = [10 mm, 20 mm]", [":1:", '"10 mm"']),
        ("type = fast_pneunet", [":1:", '"fast_pneunet"']),
        ("report = False", [":1:", "false", "False"]),
        ("wall = 1,5", [":1:", "'1,5'", "comma", "point"]),
        ('name = "finger', [":1:", "quote"]),
        ('size: "3 mm"', [":1:", 'size = "3 mm"']),
        (r'file = "C:\Users\me\part.step"', [":1:", '"C:/Users/me/part.step"']),
        (r'file = "C:\parts\new.step"', [":1:", '"C:/parts/new.step"']),
        (r'file = "C:\new\tube.step"', [":1:", '"C:/new/tube.step"']),
        (
            '[actuator]\nchambers = 3\nwall = "1 mm"\nchambers = 4',
            [":4:", "'chambers'", "2 and 4"],
        ),
        ('[mesh]\n[loads]\n[mesh]\nsize = "1 mm"', [":3:", "'mesh'", "1 and 3"]),
        ("a = { b = 1, b = 2 }", [":1:", "'b'", "twice"]),
        ('a = "x" b', [":1:", "TOML", "newline"]),
        ("[loads", [":1:", "TOML", "']'"]),
    ],
)
def test_a_slip_is_answered_with_the_mend(text: str, facts: list[str]) -> None:
    with refused("job.toml", *facts):
        read_toml(text, "job.toml")


@pytest.mark.parametrize(
    "text", ['f = "C:/x"', r"f = 'C:\new'", r'f = "C:\\new"', r'# f = "C:\new"', "[a]\nx=1\n[b]\nx=1"]
)
def test_what_is_right_is_read(text: str) -> None:
    read_toml(text, "job.toml")


@pytest.mark.parametrize(
    ("text", "facts"),
    [
        (f"a = {'[' * 600}{']' * 600}", ["nested", "20 levels"]),
        (f"{'a.' * 5000}b = 1", ["nested", "20 levels"]),
        (f"a = {'[' * 30}{']' * 30}", ["nested", "20 levels"]),
        (f"a = {'1' * 5000}", ["digits", "4300"]),
    ],
)
def test_files_without_end_are_refused(text, facts):
    with refused("a.toml", *facts):
        read_toml(text, "a.toml")


def test_texts_that_are_none_are_refused(tmp_path):
    (tmp_path / "latin.toml").write_bytes("größe = 1".encode("latin-1"))
    (tmp_path / "utf16.toml").write_bytes("a = 1".encode("utf-16"))
    for name in ("latin.toml", "utf16.toml"):
        with refused(name, "UTF-8"):
            read_text(tmp_path / name)
    for path in (tmp_path, Path("/dev/zero")):
        with refused(path):
            read_text(path)


@pytest.mark.parametrize("made", [TurgorError, lambda text: JobError([text, "mesh: no."])])
def test_a_long_value_is_not_repeated_to_its_end(made):
    said = made(f"wall is '{'9' * 100_000}'; a length is needed.")
    for text in (str(said), said.on_command_line, *getattr(said, "problems", ())):
        assert len(text) < 2000
    assert str(said).startswith("wall is '999")
    assert "99'; a length is needed." in str(said)
