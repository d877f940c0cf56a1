"""TOML: the common slips are answered with the line and the mend."""

import re
from pathlib import Path

import pytest

from turgor.foundation.errors import TurgorError
from turgor.foundation.toml_text import read_text, read_toml
from turgor.job.text.problems import JobError


@pytest.mark.parametrize(
    ("text", "sentence"),
    [
        ("a = 1\nlength = 36 mm  # long", '2: a text with a unit needs quotes; put quotes around it: "36 mm".'),
        ("wall = { low = 1 mm, high = 2 mm }", 'put quotes around it: "1 mm".'),
        ("at = [10 mm, 20 mm]", 'put quotes around it: "10 mm".'),
        ("type = fast_pneunet", '1: a text needs quotes; put quotes around it: "fast_pneunet".'),
        ("report = False", "1: write false instead of False."),
        ("wall = 1,5", "1: '1,5' has a decimal comma; write a point"),
        ('name = "finger', "1: a quote is missing"),
        ('size: "3 mm"', '1: write an equals sign after the key: size = "3 mm".'),
        (r'file = "C:\Users\me\part.step"', r'1: write / instead of \ in a path: "C:/Users/me/part.step".'),
        (r'file = "C:\parts\new.step"', r'1: write / instead of \ in a path: "C:/parts/new.step".'),
        (r'file = "C:\new\tube.step"', r'1: write / instead of \ in a path: "C:/new/tube.step".'),
        (
            '[actuator]\nchambers = 3\nwall = "1 mm"\nchambers = 4',
            "4: 'chambers' stands twice, in lines 2 and 4; leave one out.",
        ),
        ('[mesh]\n[loads]\n[mesh]\nsize = "1 mm"', "3: 'mesh' stands twice, in lines 1 and 3; leave one out."),
        ("a = { b = 1, b = 2 }", "1: 'b' stands twice in a table in braces; leave one out."),
        ('a = "x" b', "1: this is not valid TOML: Expected newline"),
        ("[loads", "1: this is not valid TOML: Expected ']'"),
    ],
)
def test_a_slip_is_answered_with_the_mend(text: str, sentence: str) -> None:
    with pytest.raises(TurgorError, match=re.escape(sentence)) as error:
        read_toml(text, "job.toml")
    assert str(error.value).startswith("job.toml:")


@pytest.mark.parametrize(
    "text", ['f = "C:/x"', r"f = 'C:\new'", r'f = "C:\\new"', r'# f = "C:\new"', "[a]\nx=1\n[b]\nx=1"]
)
def test_what_is_right_is_read(text: str) -> None:
    read_toml(text, "job.toml")


@pytest.mark.parametrize(
    ("text", "said"),
    [
        (f"a = {'[' * 600}{']' * 600}", "a.toml: it is nested too deeply"),
        (f"{'a.' * 5000}b = 1", "a.toml: it is nested too deeply"),
        (f"a = {'[' * 30}{']' * 30}", "a.toml: it is nested too deeply; allowed are 20 levels"),
        (f"a = {'1' * 5000}", "a.toml: a number has too many digits"),
    ],
)
def test_files_without_end_are_refused(text, said):
    with pytest.raises(TurgorError, match=said):
        read_toml(text, "a.toml")


def test_texts_that_are_none_are_refused(tmp_path):
    (tmp_path / "latin.toml").write_bytes("größe = 1".encode("latin-1"))
    (tmp_path / "utf16.toml").write_bytes("a = 1".encode("utf-16"))
    for name in ("latin.toml", "utf16.toml"):
        with pytest.raises(TurgorError, match="is not a text file in UTF-8; save it in UTF-8"):
            read_text(tmp_path / name)
    for path in (tmp_path, Path("/dev/zero")):
        with pytest.raises(TurgorError, match="is no file"):
            read_text(path)


@pytest.mark.parametrize("made", [TurgorError, lambda text: JobError([text, "mesh: no."])])
def test_a_long_value_is_not_repeated_to_its_end(made):
    said = made(f"wall is '{'9' * 100_000}'; a length is needed.")
    for text in (str(said), said.on_command_line, *getattr(said, "problems", ())):
        assert len(text) < 2000
    assert str(said).startswith("wall is '999")
    assert "99'; a length is needed." in str(said)
