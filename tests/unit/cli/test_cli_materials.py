"""The commands ``turgor materials list | choose | show | plot``, and the plot they write."""

import json
import re
from dataclasses import replace
from pathlib import Path

import numpy as np
import pytest
from matplotlib.figure import Figure

from refused import refused, states
from turgor.cli import main
from turgor.cli.exits import BAD_INPUT, DONE
from turgor.core.materials.library.record_files import library
from turgor.core.materials.library.record_text import describe_material, library_tables
from turgor.core.materials.library.records import find_record, records
from turgor.views.plots.materials import curve, material_figure, material_panels, plot_records, write_material_plot

DOCS = Path(__file__).parents[3] / "docs"

TEST = "stretch,nominal stress (kPa)\n1.0,0\n1.5,20\n2.0,35\n3.0,62\n"


@pytest.fixture
def folder(tmp_path: Path, monkeypatch: pytest.MonkeyPatch) -> Path:
    monkeypatch.chdir(tmp_path)
    (tmp_path / "strip_uniaxial.csv").write_text(TEST, encoding="utf-8")
    return tmp_path


@pytest.mark.parametrize("arguments", [["materials"], ["materials", "list"]])
def test_list_has_a_row_for_every_material(arguments: list[str], capsys: pytest.CaptureFixture[str]) -> None:
    assert main(arguments) == DONE
    lines = capsys.readouterr().out.splitlines()
    names = [line.split()[0] for line in lines[1 : len(library()) + 1]]
    assert sorted(names) == list(library())
    assert names.index("ecoflex-00-30") < names.index("dragon-skin-30") < names.index("paper"), "softest first"
    (line,) = (line for line in lines if line.startswith("ecoflex-00-30 "))
    assert line.split("  ")[-1].strip() == "yeoh-kulkarni-2015"
    assert "76.2 kPa" in line  # 6 C10 of that record
    assert line.split()[-3:-1] == ["10", "13"], "it breaks at a stretch of 10, and has thirteen sets"


def test_choose_orders_rubbers_by_their_modulus(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["materials", "choose", "--modulus", "190 kPa", "--count", "2"]) == DONE
    out = capsys.readouterr().out
    assert [line.split()[0] for line in out.splitlines()[1:3]] == ["mold-star-16", "mold-star-15"]
    assert main(["materials", "choose", "--modulus", "190 mm"]) == BAD_INPUT
    assert "190 mm" in capsys.readouterr().err


def test_show_prints_both_forms_and_the_doubts(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["materials", "show", "dragon-skin-10", "--record", "ogden-nuthi-2018"]) == DONE
    out = capsys.readouterr().out
    assert out.startswith("Dragon Skin 10, Shore hardness 10 A\n")
    assert "  law: ogden in the convention abaqus\n" in out
    assert "  printed: mu_1 = 0.1802 MPa, mu_2 = -0.5538 MPa" in out
    assert "  canonical: mu_1 = -1.804707 MPa, mu_2 = -0.7487325 MPa" in out
    assert "  bulk modulus: 0.8939 MPa\n" in out
    assert "  doubt M05 wrong convention negative: " in out
    assert "yeoh-caasenbrood-2020" not in out


def test_show_of_a_material_shows_every_record(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["materials", "show", "ecoflex-00-30"]) == DONE
    out = capsys.readouterr().out
    assert all(f"\n{record.name}\n" in out for record in records("ecoflex-00-30"))
    assert "  canonical: no law\n" in out
    assert "supplier: nominal stress at stretch 2 is 68.9 kPa" in out


@pytest.mark.parametrize(
    ("arguments", "sentence"),
    [
        (["materials", "show"], "turgor: Missing argument 'NAME'."),
        (["materials", "shaw", "paper"], "turgor: No such command 'shaw'."),
        (["materials", "show", "ecoflex-30"], "unknown library material 'ecoflex-30'; did you mean 'ecoflex-00-30'?"),
        (["materials", "plot", "papr"], "unknown library material 'papr'; did you mean 'paper'?"),
        (
            ["materials", "show", "paper", "--record", "hooke-yang"],
            "unknown record 'hooke-yang' of 'paper'; did you mean 'hooke-yang-2020'?",
        ),
        (["materials", "show", "mine.toml"], "there is no file 'mine.toml' with records of a material."),
        (["materials", "plot", "paper", "--output", "a.pdf"], "plot 'a.pdf' ends in '.pdf'; allowed is .png or .svg."),
        (["materials", "plot", "paper", "--output", "no/a.png"], "'no/a.png' cannot be read or written: No such file"),
        (["materials", "plot", "paper", "--range", "1-4"], "--range is '1-4'; write the smallest and the largest"),
        (["materials", "plot", "paper", "--range", "4:1"], "stretches from 4 to 1; two rising numbers above 0"),
    ],
)
def test_mistakes_are_one_sentence(
    folder: Path, capsys: pytest.CaptureFixture[str], arguments: list[str], sentence: str
) -> None:
    assert main(arguments) == BAD_INPUT
    out, err = capsys.readouterr()
    assert err.startswith(sentence)
    assert err.count("\n") == 1
    assert out == ""


def test_plot_against_a_test(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    arguments = ["materials", "plot", "ecoflex-00-30", "--against", "strip_uniaxial.csv", "--output", "plot.svg"]
    assert main(arguments) == DONE
    assert capsys.readouterr().out == "Plot in plot.svg.\n"
    assert main(["materials", "plot", "paper"]) == DONE
    assert sorted(file.name for file in folder.iterdir()) == ["paper.png", "plot.svg", "strip_uniaxial.csv"]
    assert main(["materials", "plot", "ecoflex-00-30", "--against", "none.csv"]) == BAD_INPUT
    assert "none.csv" in capsys.readouterr().err


def test_a_test_that_does_not_say_how_it_was_loaded_is_asked(folder: Path, capsys: pytest.CaptureFixture[str]) -> None:
    (folder / "strip_uniaxial.csv").rename(folder / "strip.csv")
    arguments = ["materials", "plot", "ecoflex-00-30", "--against", "strip.csv"]
    assert main(arguments) == BAD_INPUT
    assert states(capsys.readouterr().err, "'strip.csv'", "--mode", "uniaxial")
    assert main([*arguments, "--mode", "planar", "--output", "plot.svg"]) == DONE
    assert "plot.svg" in [file.name for file in folder.iterdir()]


def test_the_picture_holds_every_record_and_the_test(folder: Path) -> None:
    from turgor.core.materials.experiments.read_tests import read_test

    (axes,) = material_figure("ecoflex-00-30", tests=[read_test("strip_uniaxial.csv")]).axes
    labels = axes.get_legend_handles_labels()[1]
    assert len(labels) == len(records("ecoflex-00-30")) + 1
    assert "yeoh-yan-2016 (M04)" in labels
    assert "mooney-rivlin-steck-2019 (M06): no law" in labels
    assert labels[-1].startswith("measured: ")
    assert axes.get_xlim() == (1.0, 3.0), "as far as the test goes"
    assert axes.get_ylim()[1] == pytest.approx(2.5 * 0.062), "a rubber ten times too stiff does not set the scale"


def test_curves_are_the_stress_of_the_law() -> None:
    """Neo-Hookean with C10 = 0.34 MPa at stretch 2: 2 C10 (λ - 1/λ²) = 1.19 MPa, by hand."""
    stretch = np.array([1.0, 2.0])
    assert curve(find_record("smooth-sil-950", "neo-hooke-polygerinos-2020"), stretch)[1] == pytest.approx(1.19)
    assert curve(find_record("ecoflex-00-30", "mooney-rivlin-steck-2019"), stretch) is None
    straight = curve(find_record("elastosil-m4601", "hooke-alici-2018"), stretch)
    assert straight[1] == pytest.approx(0.38666)


def test_what_was_fitted_is_solid_and_the_rest_dashed(tmp_path: Path) -> None:
    file = tmp_path / "ours.toml"
    record = (
        'law = "yeoh"\nconvention = "two_index"\nparameters = { C10 = "80 kPa", C20 = "1 kPa" }\nsource = "us, 2026"'
    )
    file.write_text(f'name = "Ours"\n[records.may]\n{record}\nstretch_range = [1.0, 2.0]\n', encoding="utf-8")
    axes = plot_records(Figure().add_subplot(), records(str(file)), np.linspace(1, 3, 21))
    dashed, solid = axes.lines
    assert (dashed.get_linestyle(), solid.get_linestyle()) == ("--", "-")
    assert solid.get_xdata().max() == 2.0
    assert dashed.get_xdata().max() == 3.0


def test_tests_of_two_modes_are_refused(folder: Path) -> None:
    from turgor.core.materials.experiments.read_tests import read_test

    both = [read_test("strip_uniaxial.csv"), read_test("strip_uniaxial.csv", mode="planar")]
    with refused("planar", "uniaxial"):
        material_figure("ecoflex-00-30", tests=both)
    with refused("simple_shear", "equibiaxial, planar"):
        material_figure("ecoflex-00-30", tests=[replace(both[0], mode="simple_shear")])


def test_equal_plots_are_equal_files(tmp_path: Path) -> None:
    for name in ("a.png", "b.png"):
        write_material_plot(tmp_path / name, "paper")
    assert (tmp_path / "a.png").read_bytes() == (tmp_path / "b.png").read_bytes()


def test_the_page_of_the_documentation_is_up_to_date() -> None:
    """``docs/materials.md`` holds the tables that ``docs/materials_page.py`` writes."""
    page = (DOCS / "materials.md").read_text(encoding="utf-8")
    for table in library_tables().values():
        assert table in page, "call python docs/materials_page.py"
    pictures = re.findall(r"images/materials/rubbers-(\d)\.png", page)
    assert all((DOCS / f"images/materials/rubbers-{number}.png").exists() for number in pictures)
    assert len(pictures) == 5


def test_panels_show_the_record_to_take_others_tests_and_the_maker() -> None:
    ecoflex, cheetah = material_panels(["ecoflex-00-30", "ninjatek-cheetah"]).axes
    (best,) = (line for line in ecoflex.lines if line.get_color() == "tab:blue")
    taken = find_record("ecoflex-00-30", "yeoh-kulkarni-2015")
    assert best.get_ydata()[-1] == pytest.approx(curve(taken, np.array([3.0]))[0])
    assert max(best.get_xdata()) == 3.0
    gray = [line for line in ecoflex.lines if line.get_color() == "0.65"]
    assert len(gray) == 8, "those without a computed doubt: neither ogden-steck-2019 nor the three wrong ones"
    assert min(max(line.get_xdata()) for line in gray) < 1.91, "a planar test ends there"
    (star,) = (line for line in ecoflex.lines if line.get_marker() == "*")
    assert star.get_ydata()[0] == pytest.approx(0.06895, rel=1e-3)
    assert any(line.get_marker() == "o" for line in ecoflex.lines)
    assert cheetah.get_xlim() == (1.0, 1.5)
    assert not [line for line in cheetah.lines if line.get_marker() in "*o"]


def test_choose_by_hardness_and_reach(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["materials", "choose", "--hardness", "30 A", "--for", "5"]) == DONE
    out = capsys.readouterr().out
    assert "elastosil-m4601" in out and "dragon-skin-30" not in out
    assert "Spread of " in out
    assert main(["materials", "choose"]) == BAD_INPUT
    assert states(capsys.readouterr().err, "modulus", "hardness")
    assert main(["materials", "choose", "--hardness", "30 A", "--for", "stretch 1:5", "--json"]) == DONE
    result = json.loads(capsys.readouterr().out)["result"]
    assert "dragon-skin-30" not in [each["material"] for each in result["rubbers"]]
    assert main(["materials", "choose", "--modulus", "100 kPa", "--for", "12", "--count", "2"]) == DONE
    assert "Not tested up to stretch 12: " in capsys.readouterr().out
    assert main(["materials", "choose", "--modulus", "100 kPa", "--for", "wide"]) == BAD_INPUT


def test_show_prints_strength_cure_and_spread(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["materials", "show", "dragon-skin-30"]) == DONE
    out = capsys.readouterr().out
    for text in ("elongation at break: 3.64 (", "tear strength: 18.9 kN/m (", "cure: pot life 45 min", "spread: 34% "):
        assert text in out


def test_show_as_json_names_the_record_to_take(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["materials", "show", "ecoflex-00-30", "--json"]) == DONE
    sets = json.loads(capsys.readouterr().out)["result"]["materials"]["ecoflex-00-30"]
    assert [each["record"] for each in sets if each["recommended"]] == ["yeoh-kulkarni-2015"]
    assert {each["ultimate_stretch"] for each in sets} == {10.0}


def test_text_and_command_agree(capsys: pytest.CaptureFixture[str]) -> None:
    assert main(["materials", "show", "paper"]) == DONE
    assert capsys.readouterr().out == describe_material("paper") + "\n"
