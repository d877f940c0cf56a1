"""Colors of faces and bodies in CAD files."""

import re
from collections.abc import Sequence

from turgor.foundation.errors import TurgorError, near_match

Color = tuple[float, float, float]

#: Largest difference in red, green or blue between two equal colors.
SAME_COLOR = 0.02

#: Names of colors.
NAMES = {
    "black": "#000000", "gray": "#808080", "silver": "#c0c0c0", "white": "#ffffff",
    "red": "#ff0000", "maroon": "#800000", "orange": "#ffa500", "yellow": "#ffff00",
    "lime": "#00ff00", "green": "#008000", "olive": "#808000", "teal": "#008080",
    "cyan": "#00ffff", "blue": "#0000ff", "navy": "#000080", "magenta": "#ff00ff", "purple": "#800080",
}  # fmt: skip


def parse_color(text: object) -> Color:
    """Return red, green and blue between 0 and 1.

    Examples
    --------
    >>> parse_color("#ff0000")
    (1.0, 0.0, 0.0)
    >>> parse_color("purpel")
    Traceback (most recent call last):
    turgor.TurgorError: color is 'purpel'; did you mean 'purple'? Allowed is a name or a number such as \
'#d02020'; names: black, gray, silver, white, red, maroon, orange, yellow, lime, green, olive, teal, cyan, blue, \
navy, magenta, purple.
    """
    code = NAMES.get(text.lower(), text.lower()) if isinstance(text, str) else ""
    if not re.fullmatch("#[0-9a-f]{6}", code):
        hint = near_match(str(text), NAMES)
        raise TurgorError(
            f"color is {text!r}{f'{hint} Allowed' if hint else '; allowed'} is a name or a number such as '#d02020'; "
            f"names: {', '.join(NAMES)}."
        )
    red, green, blue = (int(code[i : i + 2], 16) / 255 for i in (1, 3, 5))
    return red, green, blue


def hexadecimal(color: Color) -> str:
    """Write a color as ``#rrggbb``.

    Examples
    --------
    >>> hexadecimal((1.0, 0.5, 0.0))
    '#ff8000'
    """
    return "#" + "".join(f"{round(255 * part):02x}" for part in color)


def shown_color(linear: Sequence[float]) -> Color:
    """Return the sRGB color for a linear one, which the CAD kernel keeps.

    Examples
    --------
    >>> hexadecimal(shown_color((0.0, 0.2159, 0.0)))
    '#008000'
    """
    red, green, blue = (12.92 * c if c <= 0.0031308 else 1.055 * c ** (1 / 2.4) - 0.055 for c in linear[:3])
    return red, green, blue


def same_color(given: Color, target: Color) -> bool:
    """Return whether a color of a file equals a target, as sRGB or as a linear color.

    Examples
    --------
    >>> orange = parse_color("orange")
    >>> same_color(orange, orange), same_color(shown_color(orange), orange), same_color((1.0, 0.0, 0.0), orange)
    (True, True, False)
    """
    return any(
        max(abs(a - b) for a, b in zip(given, color, strict=True)) <= SAME_COLOR
        for color in (target, shown_color(target))
    )
