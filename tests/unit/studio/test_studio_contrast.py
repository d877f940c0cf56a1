"""Colors of the studio in both schemes: text with a contrast of 4.5, lines of plots with 3 (WCAG 2.2, AA)."""

import re
from importlib.resources import files

import pytest

#: Text on ground, by the names of their colors.
TEXT = [(ink, ground) for ink in ("ink", "quiet", "accent", "wrong", "warn", "good") for ground in ("ground", "panel")]
TEXT += [("on-accent", "accent"), ("wrong", "wrong-ground"), ("ink", "wrong-ground"), ("warn", "warn-ground")]


def _stated() -> dict[str, dict[str, str]]:
    """Colors by name, as the style states them for the light and for the dark scheme."""
    style = (files("turgor.studio") / "page" / "studio.css").read_text("utf-8")
    dark = r"@media \(prefers-color-scheme: dark\) \{\s*:root \{([^}]*)\}"
    light = re.findall(r":root \{([^}]*)\}", re.sub(dark, "", style))
    texts = {"light": "".join(light), "dark": "".join(re.findall(dark, style))}
    return {name: dict(re.findall(r"--([\w-]+): (#[0-9a-f]{6})", text)) for name, text in texts.items()}


def _schemes() -> dict[str, dict[str, str]]:
    stated = _stated()
    return {"light": stated["light"], "dark": stated["light"] | stated["dark"]}


def contrast(one: str, other: str) -> float:
    """Contrast of two colors: (L₁ + 0.05) / (L₂ + 0.05) with relative luminances L (WCAG 2.2)."""
    high, low = sorted((_luminance(one), _luminance(other)), reverse=True)
    return (high + 0.05) / (low + 0.05)


def _luminance(color: str) -> float:
    parts = [int(color[k : k + 2], 16) / 255 for k in (1, 3, 5)]
    linear = [part / 12.92 if part <= 0.04045 else ((part + 0.055) / 1.055) ** 2.4 for part in parts]
    return 0.2126 * linear[0] + 0.7152 * linear[1] + 0.0722 * linear[2]


def test_contrast_of_known_colors():
    assert contrast("#ffffff", "#000000") == pytest.approx(21)
    assert contrast("#777777", "#ffffff") == pytest.approx(4.48, abs=0.01)


@pytest.mark.parametrize("scheme", ["light", "dark"])
@pytest.mark.parametrize(("ink", "ground"), TEXT)
def test_text_can_be_read(scheme, ink, ground):
    colors = _schemes()[scheme]
    assert contrast(colors[ink], colors[ground]) >= 4.5


@pytest.mark.parametrize("scheme", ["light", "dark"])
def test_lines_of_plots_can_be_seen(scheme):
    colors = _schemes()[scheme]
    lines = [name for name in colors if name.startswith("series-")]
    assert len(lines) == 8
    assert min(contrast(colors[name], colors["ground"]) for name in lines) >= 3


def test_every_color_has_both_schemes():
    style = (files("turgor.studio") / "page" / "studio.css").read_text("utf-8")
    used = set(re.findall(r"var\(--([\w-]+)\)", style))
    assert used - {"c"} <= set(_schemes()["light"])  # c is the color of one face, which the page sets
    assert _stated()["light"].keys() == _stated()["dark"].keys()
