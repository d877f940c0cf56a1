"""References: what a reader cites who uses a result: the program, the laws, and where the constants came from."""

from collections.abc import Mapping
from types import MappingProxyType

from turgor.core.model.model import Model
from turgor.core.model.sheets import Sheet

#: The review whose laws and design rules the program implements.
REVIEW = (
    "M. S. Xavier, A. J. Fleming, Y. K. Yong, Finite Element Modeling of Soft Fluidic Actuators: Overview and Recent "
    "Developments, Adv. Intell. Syst. 2021, 3, 2000187"
)

#: First publication of each law, by its class, and the equation of the review that states it.
LAW_SOURCES: Mapping[str, tuple[str, str]] = MappingProxyType(
    {
        "NeoHooke": ("L. R. G. Treloar, Trans. Faraday Soc. 1943, 39, 241", "Eq. 15"),
        "MooneyRivlin": ("M. Mooney, J. Appl. Phys. 1940, 11, 582", "Eq. 12"),
        "GeneralizedRivlin": ("R. S. Rivlin, D. W. Saunders, Phil. Trans. R. Soc. A 1951, 243, 251", "Eq. 11"),
        "Ogden": ("R. W. Ogden, Proc. R. Soc. A 1972, 326, 565", "Eq. 13"),
        "Yeoh": ("O. H. Yeoh, Rubber Chem. Technol. 1993, 66, 754", "Eq. 14"),
        "YeohN": ("O. H. Yeoh, Rubber Chem. Technol. 1993, 66, 754", "Eq. 14"),
        "Gent": ("A. N. Gent, Rubber Chem. Technol. 1996, 69, 59", ""),
        "ExtendedTube": ("M. Kaliske, G. Heinrich, Rubber Chem. Technol. 1999, 72, 602", ""),
        "HolzapfelGasserOgden": ("T. C. Gasser, R. W. Ogden, G. A. Holzapfel, J. R. Soc. Interface 2006, 3, 15", ""),
        "Orthotropic": ("G. Y. Qiu, T. J. Pence, J. Elasticity 1997, 49, 1", ""),
        "Hyperfoam": ("B. Storåkers, J. Mech. Phys. Solids 1986, 34, 125", ""),
        "BlatzKo": ("P. J. Blatz, W. L. Ko, Trans. Soc. Rheol. 1962, 6, 223", ""),
        "CompressibleNeoHooke": (
            "J. Bonet, R. D. Wood, Nonlinear Continuum Mechanics for Finite Element Analysis, 2nd ed., Cambridge 2008",
            "",
        ),
        "ArrudaBoyce": ("E. M. Arruda, M. C. Boyce, J. Mech. Phys. Solids 1993, 41, 389", ""),
    }
)


def law_source(law: object) -> str:
    """Say where a law was published, and which equation of Xavier, Fleming and Yong (2021) states it.

    Parameters
    ----------
    law : Law

    Returns
    -------
    str
        Empty for Hooke's law.

    Examples
    --------
    >>> from turgor.core.materials.laws.laws import Yeoh
    >>> law_source(Yeoh(C10=1e5, C20=1e3))
    'O. H. Yeoh, Rubber Chem. Technol. 1993, 66, 754; Xavier, Fleming and Yong (2021), Eq. 14'
    """
    paper, equation = LAW_SOURCES.get(type(law).__name__, ("", ""))
    return f"{paper}; Xavier, Fleming and Yong (2021), {equation}" if equation else paper


def references(model: Model, version: str) -> list[str]:
    """List what to cite for a result: the program, the review, the laws and the sources of the constants.

    Parameters
    ----------
    model : Model
    version : str
        Version of the program; empty where it is unknown.

    Returns
    -------
    list of str
        Each once.
    """
    sources = [
        f"The turgor developers, turgor: finite element modeling of soft fluidic actuators{_version(version)}",
        REVIEW,
    ]
    used = [each.material if isinstance(each, Sheet) else each for each in model.materials.values()]
    used += [fibers.material for fibers in model.reinforcements]
    for material in used:
        sources += [LAW_SOURCES.get(type(material.law).__name__, ("", ""))[0], f"{material.name}: {material.source}"]
    return [text for text in dict.fromkeys(sources) if text]


def _version(version: str) -> str:
    return f", version {version}" if version else ""
