"""A guideline about a straight line, which costs nothing to run, and runs that fail."""

from base64 import b64decode

import turgor as tg
from turgor.studies import Computed, Run
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Verdict
from turgor_guidelines.values import last, listed, rises

#: The smallest picture: one gray pixel.
PICTURE = b64decode("iVBORw0KGgoAAAANSUhEUgAAAAEAAAABCAAAAAA6fptVAAAACklEQVR4nGNoAAAAggCBd81ytgAAAABJRU5ErkJggg==")


def line(slope: float) -> Computed:
    """A straight line."""
    columns = (
        tg.experiments.Column("pressure", "kPa", [0.0, 5e3, 10e3]),
        tg.experiments.Column("bending_angle", "deg", [0.0, 5e3 * slope, 10e3 * slope]),
        tg.experiments.Column("bending_angle_mesh_error", "deg", [0.0, 1e-6, 2e-6]),
    )
    response = tg.Response(columns=columns, source=tg.laws.Source(text="a line"), message="ended")
    return Computed(response=response, picture=PICTURE)


def refuses(slope: float) -> Computed:
    """Bad input."""
    raise tg.TurgorError("wall is -1 mm; allowed is above 0 mm.")


def steeper(runs) -> Judgement:
    """Whether the last angles rise from run to run."""
    angles = [last(each.response, "bending_angle") for each in runs.values()]
    return Judgement(verdict=Verdict.CONFIRMED if rises(angles) else Verdict.NOT_REPRODUCED, finding=listed(angles))


def curves(runs):
    """Two panels."""
    responses = [(name, each.response) for name, each in runs.items()]
    numbers = tg.pictures.Line(x=[1, 2], y=[1, 4], error=[0.1, 0.2], label="a < b")
    return (
        tg.pictures.Panel(x="pressure", y="bending_angle", responses=responses),
        tg.pictures.Panel(x="slope", y="angle", lines=[numbers]),
    )


def a_guideline(slopes=(1e-5, 2e-5), function=line) -> Guideline:
    """That steeper lines end higher; the full setting has one line more."""

    def runs(setting):
        some = slopes if setting == "quick" else (*slopes, 5e-5)
        return tuple(Run(name=f"slope {each:g}", function=function, values={"slope": each}) for each in some)

    study = GuidelineTest(title="Slope", setup="A line.", expected="It rises.", runs=runs, judge=steeper, panels=curves)
    return Guideline(key="9.9-1", rule="Steeper is more & better.", sources=("A 2000",), families=(), studies=(study,))
