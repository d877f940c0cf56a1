"""Starting: the text of a job for a family or a part."""

from pathlib import Path

from turgor.foundation.errors import unknown


def job_of_family(family: str) -> str:
    """Return the commented job of an actuator family."""
    from turgor.job.job import ACTUATORS
    from turgor.job.reference.starters import starter

    if family not in ACTUATORS:
        raise unknown("actuator family", family, ACTUATORS)
    return starter(family)


def ready() -> None:
    """Load what a picture of a shape needs, while the user still looks at the first screen."""


def job_of_part(part: Path, unit: str | None) -> str:
    """Return the commented job of a part from a CAD or mesh file."""
    from turgor.job.reference.part_starters import part_starter

    return part_starter(part, part.parent, unit)
