"""The pages on the actuator families say what the classes say, and every family has its pictures."""

import sys
from pathlib import Path

import pytest

from turgor.job.job import ACTUATORS

DOCS = Path(__file__).parents[3] / "docs"
sys.path.insert(0, str(DOCS))
import actuator_pages  # noqa: E402  the script stands beside the pages that it writes


@pytest.mark.parametrize("name", ACTUATORS)
def test_page_is_what_the_class_says(name):
    written = (DOCS / "actuators" / f"{name}.md").read_text(encoding="utf-8")
    assert written == actuator_pages.page(name, ACTUATORS[name]), "run `make actuators`"


def test_overview_lists_every_family():
    assert (DOCS / "actuators" / "index.md").read_text(encoding="utf-8") == actuator_pages.overview()


@pytest.mark.parametrize("name", ACTUATORS)
def test_family_has_its_pictures(name):
    for picture in (f"{name}.png", f"{name}-cut.png"):
        assert (DOCS / "images" / "actuators" / picture).stat().st_size > 10_000
