"""The command ``turgor import``: what it prints, writes and refuses."""

import json

import pytest

import turgor as tg
from deck_cases import FIXED, deck
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE


def test_it_lists_the_keywords_and_writes_a_job_that_checks(tmp_path, capsys):
    assert main(["import", str(deck(tmp_path)), "--output", str(tmp_path / "job")]) == DONE
    lines = capsys.readouterr().out.splitlines()
    assert lines[0].split() == ["block.inp:1", "*HEADING", "not", "needed", "it", "changes", "no", "result"]
    assert any("*HYPERELASTIC, NEO HOOKE" in line and line.endswith("taken       NeoHooke") for line in lines)
    assert "mm, N, MPa" in lines[-2]
    job = tmp_path / "job" / "block.toml"
    assert str(job) in lines[-1]
    assert main(["check", str(job)]) == DONE


def test_stated_units_are_no_guess(tmp_path, capsys):
    assert main(["import", str(deck(tmp_path)), "-o", str(tmp_path / "job"), "--units", "mm, N, MPa"]) == DONE
    assert "states no units" not in capsys.readouterr().out


def test_what_it_cannot_express_it_refuses_without_writing(tmp_path, capsys):
    file = deck(tmp_path, model=FIXED + "*RIGID BODY, NSET=TOP\n")
    assert main(["import", str(file), "-o", str(tmp_path / "job")]) == BAD_INPUT
    message = capsys.readouterr().err
    assert "--partial" in message
    assert "*RIGID BODY, NSET=TOP is missing" in message
    assert not (tmp_path / "job").exists()
    assert main(["import", str(file), "-o", str(tmp_path / "job"), "--partial"]) == DONE
    assert main(["import", str(file), "-o", str(tmp_path / "job"), "--partial"]) == BAD_INPUT
    assert "--force" in capsys.readouterr().err


def test_its_document_has_a_row_for_each_keyword(tmp_path, capsys):
    file = deck(tmp_path)
    assert main(["import", str(file), "-o", str(tmp_path / "job"), "--json"]) == DONE
    result = json.loads(capsys.readouterr().out)["result"]
    rows = tg.files.import_deck(file).rows
    assert [(row["line"], row["verdict"]) for row in result["rows"]] == [(row.line, row.verdict) for row in rows]


def test_a_file_that_is_not_there(tmp_path, capsys):
    assert main(["import", str(tmp_path / "none.inp")]) == BAD_INPUT
    assert "there is no deck" in capsys.readouterr().err


def test_a_folder_is_no_deck(tmp_path, capsys):
    assert main(["import", str(tmp_path)]) == BAD_INPUT
    assert "is a folder" in capsys.readouterr().err


@pytest.mark.parametrize("material", ["*HYPERELASTIC, OGDEN, N=two\n0.1, 2., 0.\n", "*MULLINS EFFECT\n1.\n"])
def test_damaged_materials_are_named_by_line(tmp_path, capsys, material):
    assert main(["import", str(deck(tmp_path, material=material))]) == BAD_INPUT
    message = capsys.readouterr().err
    assert f"*{material[1:10]}" in message
    assert "a number is none" in message


def test_a_byte_order_mark_hides_nothing(tmp_path):
    file = deck(tmp_path)
    file.write_text(file.read_text(encoding="utf-8").partition("a block\n")[2], encoding="utf-8-sig")
    assert tg.files.import_deck(file).rows[0].text == "12 lines of nodes"


@pytest.mark.parametrize("text", ["", "*NODE\n1, 0, 0, x\n", "*ELEMENT, TYPE=C3D8\n1,1\n"])
def test_damaged_decks_end_in_a_sentence(tmp_path, capsys, text):
    file = tmp_path / "bad.inp"
    file.write_text(text)
    assert main(["import", str(file)]) == BAD_INPUT
    assert "Traceback" not in capsys.readouterr().err
