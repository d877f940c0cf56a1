"""The text of a job in the page, its problems, and the script that repeats a screen."""

import subprocess
import sys

import pytest
import reduced_cases
from served import needs_browser, open_page, served

from turgor.studio.tasks.code import problems_of

#: A file of somebody with a taste of his own: quotes, blanks and no line end at the end.
OWN = "# mine\n[actuator]\ntype   = 'fast_pneunet'\nwall='1 mm' # thin\n\n\n[loads]\npressure = \"10 kPa\""

MATERIALS = """

[materials]
body = { library = "ecoflex-00-30", record = "yeoh-steck-2019" }
base = { library = "ecoflex-00-30", record = "yeoh-steck-2019" }
strain_limiting_layer = { library = "paper", record = "hooke-polygerinos-2020", thickness = "0.1 mm" }
"""


def test_problems_stand_at_their_lines(tmp_path):
    file = tmp_path / "finger.toml"
    file.write_text(
        '[actuator]\ntype = "fast_pneunet"\nwal = "1 mm"\n\n[loads]\npressure = "10 mm"\n', encoding="utf-8"
    )
    found = problems_of(file)
    assert [each["line"] for each in found][:1] == [3]
    assert "did you mean 'wall'" in found[0]["sentence"]
    assert str(tmp_path) not in "".join(each["sentence"] for each in found)
    file.write_text("[actuator]\ntype = \n", encoding="utf-8")
    assert problems_of(file)[0]["line"] == 2
    file.write_text("title = 'notes'\n", encoding="utf-8")
    assert problems_of(file) == []


def _written(tmp_path, text, ends="\n"):
    file = tmp_path / "finger.toml"
    file.write_bytes(text.replace("\n", ends).encode())
    return file


@needs_browser
@pytest.mark.parametrize("ends", ["\n", "\r\n"])
def test_file_stays_byte_for_byte_until_it_is_edited(tmp_path, ends):
    file = _written(tmp_path, OWN, ends)
    before = file.read_bytes()
    with served(tmp_path) as studio, open_page(studio, "#/code/finger.toml") as shown:
        page = shown.page
        page.wait_for_selector(".code-problems li")
        assert page.get_by_role("button", name="Save").is_disabled()
        page.keyboard.press("Control+s")
        assert file.read_bytes() == before
        text = page.input_value("textarea")
        page.fill("textarea", text.replace("'1 mm'", "'2 mm'"))
        page.get_by_role("button", name="Save").click()
        shown.until("document.querySelector('.code-editor [role=status]').textContent === 'Saved'")
        page.wait_for_timeout(100)
        assert file.read_bytes() == before.replace(b"'1 mm'", b"'2 mm'")
        page.get_by_role("button", name="undo").click()
        shown.until("document.querySelector('textarea').value.includes(\"'1 mm'\")")
        assert file.read_bytes() == before
        shown.check()


@needs_browser
def test_change_of_an_editor_appears_and_is_not_lost(tmp_path):
    file = _written(tmp_path, OWN)
    with served(tmp_path) as studio, open_page(studio, "#/code/finger.toml") as shown:
        page = shown.page
        page.wait_for_selector(".code-problems li")
        file.write_text(OWN.replace("wall", "wal"), encoding="utf-8")
        page.wait_for_selector(".code-problems:has-text(\"did you mean 'wall'\")")
        assert page.locator(".code-line.wrong").inner_text().strip() == "● 4"
        page.fill("textarea", OWN + "\n# typed")
        file.write_text(OWN + "\n# elsewhere", encoding="utf-8")
        page.wait_for_selector(".code-editor :text('has changed on disk')")
        assert page.input_value("textarea").endswith("# typed")  # what was typed is still there
        assert file.read_text("utf-8").endswith("# elsewhere")
        page.get_by_role("button", name="Discard").click()
        assert page.input_value("textarea").endswith("# elsewhere")


@needs_browser
def test_script_of_real_time_gives_what_was_seen(tmp_path):
    reduced_cases.reduced_of(6).save(tmp_path / "finger.reduced")
    with served(tmp_path) as studio, open_page(studio, "#/live/finger.reduced") as shown:
        page = shown.page
        page.wait_for_selector(".live-grip")
        page.fill(".live-input .live-number", "7.5")
        page.keyboard.press("Enter")
        shown.until("/-1\\.\\d+\\) mm/.test(document.querySelector('.live-rows').innerText)")
        tip = page.locator(".live-rows dd:has-text(') mm')").first.inner_text()
        page.get_by_role("link", name="Show the code").click()
        script = page.locator("[data-snippet=Python]").inner_text()
        command = page.locator("[data-snippet=Terminal]").inner_text()
    assert "7.5 * kPa" in script
    assert "--at 'loads.pressure=7.5 kPa'" in command
    script += "\nprint('(' + ', '.join(f'{1e3 * x:.3f}' for x in answer.tip.round(6)) + ') mm')"
    ran = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True, check=True)
    assert ran.stdout.strip().splitlines()[-1].replace("-0.000", "0.000") == tip


@needs_browser
@pytest.mark.parametrize("screen", ["shape", "materials"])
def test_script_of_a_screen_runs(tmp_path, screen):
    _written(tmp_path, OWN + MATERIALS)
    with served(tmp_path) as studio, open_page(studio, f"#/{screen}/finger.toml") as shown:
        shown.page.get_by_role("link", name="Show the code").click()
        script = shown.page.locator("[data-snippet=Python]").inner_text()
    ran = subprocess.run([sys.executable, "-c", script], cwd=tmp_path, capture_output=True, text=True)
    assert ran.returncode == 0, ran.stderr
    assert "body" in ran.stdout
