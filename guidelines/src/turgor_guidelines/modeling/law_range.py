"""Claim 5-1: neo-Hooke and Mooney-Rivlin serve small strains, Yeoh and Ogden large ones too."""

import numpy as np

import turgor as tg
from turgor.studies import Computed, Run
from turgor_guidelines.guideline import Guideline, GuidelineTest, Judgement, Runs, Setting
from turgor_guidelines.judging import line_of, verdict_of
from turgor_guidelines.modeling.benders import rubber_of
from turgor_guidelines.parts import law_of
from turgor_guidelines.values import Value

#: Laws, and the nominal strain up to which each is claimed to be accurate.
CLAIMED = {"neo-hooke": 0.5, "mooney-rivlin": 2.0, "yeoh": 4.0, "ogden-2": 4.0}

#: Strains up to which the laws are fitted, and the largest error that counts as accurate.
STRAINS, ACCURATE = (0.25, 0.5, 1.0, 2.0, 3.0, 4.0), 0.1

#: Rubbers, each as the law of three terms that its authors fitted to their tests.
RUBBERS = {
    "Ecoflex 00-30, Moseley et al.": "ecoflex-00-30/ogden-moseley-2016",
    "Ecoflex 00-30, Agarwal et al.": "ecoflex-00-30/ogden-agarwal-2016",
    "Ecoflex 00-30, Kulkarni": "ecoflex-00-30/yeoh-kulkarni-2015",
}


def fitted(rubber: str, law: str) -> Computed:
    """Fit a law to uniaxial tension up to several strains; the largest relative error of the stress in each range."""
    truth = law_of(rubber_of(rubber))
    errors = []
    for strain in STRAINS:
        stretch = np.linspace(1, 1 + strain, 31)[1:]
        stress = tg.laws.curve(truth, "uniaxial", stretch).nominal_stress
        test = tg.experiments.MaterialTest(mode="uniaxial", stretch=stretch, nominal_stress=stress, name="a strip")
        result = law_of(tg.fit(law, test).material)
        again = tg.laws.curve(result, "uniaxial", stretch).nominal_stress
        far = stretch > 1 + 0.1 * strain
        errors.append(float(np.abs(again / stress - 1)[far].max()))
    columns = (
        tg.experiments.Column("strain", "", np.array(STRAINS)),
        tg.experiments.Column("error", "", np.array(errors)),
    )
    return Computed(response=tg.Response(columns=columns, source=tg.laws.Source(text="fits of tests made from a law")))


def runs(setting: Setting) -> tuple[Run, ...]:
    """Every law to every rubber; fits are cheap, so both settings have all."""
    del setting
    return tuple(
        Run(name=f"{law}; {name}", function=fitted, values={"rubber": rubber, "law": law})
        for name, rubber in RUBBERS.items()
        for law in CLAIMED
    )


def accurate_until(response: tg.Response) -> float:
    """Largest strain up to which the error stays small."""
    good = response["error"] <= ACCURATE
    count = len(good) if good.all() else int(np.argmin(good))
    return float(response["strain"][count - 1]) if count else 0.0


def judge(runs: Runs) -> Judgement:
    """Ranges in which each law is accurate, against those that are claimed."""
    holds, parts, notes = [], [], []
    for rubber in RUBBERS:
        reach = {law: accurate_until(runs[f"{law}; {rubber}"].response) for law in CLAIMED}
        low, high = ("neo-hooke", "mooney-rivlin"), ("yeoh", "ogden-2")
        holds += [reach[law] >= CLAIMED[law] for law in CLAIMED]
        holds += [max(reach[law] for law in low) < min(reach[law] for law in high)]
        parts.append(f"{rubber}: " + ", ".join(f"{law} {strain:.0%}" for law, strain in reach.items()))
        short = [f"{law} reaches {reach[law]:.0%} only" for law in CLAIMED if reach[law] < CLAIMED[law]]
        longer = [f"{law} reaches {reach[law]:.0%}" for law in low if reach[law] > CLAIMED[law]]
        if short or longer:
            notes.append(f"{rubber}: {', '.join([*short, *longer])}.")
    return Judgement(
        verdict=verdict_of(holds),
        finding=f"strain up to which the stress is within {ACCURATE:.0%}: {'; '.join(parts)}",
        conditions=" ".join(notes),
    )


def panels(runs: Runs) -> tuple[tg.pictures.Panel, ...]:
    """Error against the range of the fit, a panel for each rubber."""
    out = []
    for rubber in RUBBERS:
        lines = []
        for law in CLAIMED:
            response = runs[f"{law}; {rubber}"].response
            values = [Value(100 * float(error)) for error in response["error"]]
            lines.append(line_of([100 * float(strain) for strain in response["strain"]], values, law))
        out.append(
            tg.pictures.Panel(x=f"largest strain [%], {rubber}", y="largest error of the stress [%]", lines=lines)
        )
    return tuple(out)


GUIDELINE = Guideline(
    key="5-1",
    rule="Neo-Hooke and Mooney-Rivlin are accurate below strains of 50 % and 200 %; Yeoh and Ogden serve high "
    "strains too.",
    sources=("Moseley et al. 2016", "Martins et al. 2006", "Marckmann and Verron 2006"),
    families=(),
    studies=(
        GuidelineTest(
            title="Fits of uniaxial tension up to a strain",
            setup="Uniaxial tension of Ecoflex 00-30 as three published laws of three terms have it, up to strains "
            "of 25 to "
            "400 %; each law fitted to each range by least squares of the relative error. The largest relative "
            "error of "
            "the stress beyond a tenth of the range.",
            expected=f"Within {ACCURATE:.0%} up to 50 % (neo-Hooke), 200 % (Mooney-Rivlin), 400 % (Yeoh, Ogden with "
            f"two "
            "terms), and farther for the latter two.",
            runs=runs,
            judge=judge,
            panels=panels,
        ),
    ),
)
