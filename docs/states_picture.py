"""Draw docs/images/states.png, the strip of examples/states_before_loading.py, in a minute."""

import runpy
from pathlib import Path

from howto_pictures import smaller

import turgor as tg

ROOT = Path(__file__).parents[1]
PICTURE = ROOT / "docs" / "images" / "states.png"


def main() -> None:
    """Draw the strip at the ends of three stages."""
    solution = runpy.run_path(str(ROOT / "examples" / "states_before_loading.py"))["frozen"]()
    ends = {state.stage: state for state in solution.states}
    words = {"melt": "core melted", "bend": "bent", "release": "frozen and released"}
    states = {text: ends[stage] for stage, text in words.items()}
    tg.pictures.side_by_side(states, PICTURE, width=1000)
    smaller(PICTURE)


if __name__ == "__main__":
    main()
